//! The program as a user meets it: exit codes, messages, and what is written.

#![allow(clippy::unwrap_used, reason = "a test that cannot read its files has failed")]

#[macro_use]
extern crate agglo_testing;

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const GOOD: &str = include_str!("../../agglo/tests/scenario/good/a_single_grain.toml");

fn agglo(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_agglo")).args(arguments).current_dir(folder).output().unwrap()
}

fn code(output: &Output) -> i32 {
    output.status.code().unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

fn complained(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Names of what a folder holds.
fn listing(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn templates_pass_their_own_check() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["acoustic", "acoustic-published", "microscale", "reacting", "reacting-published"] {
        let printed = agglo(folder.path(), &["new", name]);
        assert_eq!(code(&printed), 0);
        fs::write(folder.path().join("my.toml"), &printed.stdout).unwrap();
        let checked = agglo(folder.path(), &["check", "my.toml"]);
        assert_eq!(code(&checked), 0, "{}", complained(&checked));
        assert_contains!(said(&checked), "my.toml is valid");
        assert_contains!(said(&checked), "grains");
        assert_empty!(complained(&checked));
    }
    let unknown = agglo(folder.path(), &["new", "acustic"]);
    assert_eq!(code(&unknown), 2);
    assert_contains!(complained(&unknown), "did you mean \"acoustic\"?");
}

#[test]
fn bad_input_is_2_with_all_faults_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let bad = GOOD.replace("\"1 ms\"", "\"1 m\"").replace("density", "denisty");
    fs::write(folder.path().join("bad.toml"), bad).unwrap();
    for verb in [&["check", "bad.toml"][..], &["run", "bad.toml"], &["run", "bad.toml", "-o", "there"]] {
        let refused = agglo(folder.path(), verb);
        assert_eq!(code(&refused), 2);
        let text = complained(&refused);
        assert!(text.contains("bad.toml:3:12") && text.contains("\"1 m\" is a length"), "{text}");
        assert!(
            text.contains("did you mean \"density\"?") && text.contains("3 faults in bad.toml"),
            "{text}"
        );
        assert_empty!(said(&refused));
        assert_eq!(listing(folder.path()), ["bad.toml"]);
    }
}

#[test]
fn settings_are_checked_like_the_file() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("good.toml"), GOOD).unwrap();
    let refused = agglo(folder.path(), &["check", "good.toml", "--set", "time.end=3 kg"]);
    assert_eq!(code(&refused), 2);
    assert_contains!(complained(&refused), "is a mass");
    assert_eq!(code(&agglo(folder.path(), &["check", "good.toml", "--set", "time.end=3 s"])), 0);
    let seed = agglo(folder.path(), &["run", "good.toml", "--seed", "18446744073709551615"]);
    assert_eq!(code(&seed), 2);
    assert_eq!(listing(folder.path()), ["good.toml"]);
}

#[test]
fn wrong_usage_is_2() {
    let folder = tempfile::tempdir().unwrap();
    let uses: [&[&str]; 7] = [
        &[],
        &["rum", "x.toml"],
        &["run"],
        &["run", "missing.toml"],
        &["run", "missing.toml", "--threads", "0"],
        &["resume", "nowhere"],
        &["explain", "hertzz"],
    ];
    for arguments in uses {
        let refused = agglo(folder.path(), arguments);
        assert_eq!(code(&refused), 2, "{arguments:?}");
        assert!(!complained(&refused).is_empty() && said(&refused).is_empty(), "{arguments:?}");
    }
    assert_empty!(listing(folder.path()));
}

#[test]
fn a_folder_with_something_in_it_is_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("good.toml"), GOOD).unwrap();
    fs::create_dir_all(folder.path().join("out/good")).unwrap();
    fs::write(folder.path().join("out/good/scenario.toml"), "precious").unwrap();
    let refused = agglo(folder.path(), &["run", "good.toml"]);
    assert_eq!(code(&refused), 2);
    let text = complained(&refused);
    // What is in it is no run, so `resume` is no way out.
    assert!(text.contains("is not empty") && text.contains("-o") && !text.contains("agglo resume"), "{text}");
    assert_eq!(listing(&folder.path().join("out/good")), ["scenario.toml"]);
    assert_eq!(fs::read_to_string(folder.path().join("out/good/scenario.toml")).unwrap(), "precious");
}

#[test]
fn a_short_run_ends_with_0() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("good.toml"), GOOD).unwrap();
    let done = agglo(folder.path(), &["run", "good.toml", "--threads", "1", "--seed", "7", "-o", "there"]);
    assert_eq!(code(&done), 0, "{}", complained(&done));
    assert!(said(&done).contains("in there") && said(&done).contains("no warnings"), "{}", said(&done));
}

#[test]
fn laws_and_schema_are_printed() {
    let folder = tempfile::tempdir().unwrap();
    let page = agglo(folder.path(), &["explain", "hertz"]);
    assert_eq!(code(&page), 0);
    assert_starts!(said(&page), "hertz (contact/normal)");
    let all = agglo(folder.path(), &["explain"]);
    assert_contains!(said(&all), "viscous_area");
    assert_contains!(said(&all), "schiller_naumann");
    let schema = agglo(folder.path(), &["schema"]);
    assert_eq!(code(&schema), 0);
    assert_contains!(said(&schema), "\"$schema\"");
    assert_contains!(said(&schema), "x-dimension");
}
