//! What a person does wrong with a folder: one that is occupied, a file, half empty, another's, or the wrong one.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::common::{Bench, EVENTS, STEPS, agglo, bytes, complained, ended, reference};

/// What is there, how it is made, and the words with which it is refused.
type Case = (&'static str, fn(&Path), &'static [&'static str]);

/// What lies where a run is to go, and the words with which that is refused.
const OCCUPIED: [Case; 8] = [
    ("texts of one's own", |place| put(place, "thesis.tex"), &["is not empty", "help: -o FOLDER"]),
    ("a hidden file", |place| put(place, ".notes"), &["is not empty"]),
    ("a folder that is empty", |place| fs::create_dir_all(place.join("frames")).unwrap(), &["is not empty"]),
    ("a file", |place| fs::write(place, "precious").unwrap(), &["is a file", "choose a folder with -o"]),
    ("a finished run", |place| copy(reference(STEPS), place), &["is not empty", "agglo resume"]),
    ("a finished run of another engine", |place| copy(reference(EVENTS), place), &["is not empty"]),
    ("a run without its scenario", |place| without(place, "scenario.toml"), &["is not empty"]),
    (
        "a run without its checkpoints",
        |place| without(place, "checkpoints"),
        &["is not empty", "help: -o FOLDER"],
    ),
];

/// What is given instead of the folder of a run, and the words with which going on is refused.
const NO_RUN: [Case; 8] = [
    ("nothing", |_| (), &["there is no folder"]),
    ("an empty folder", |place| fs::create_dir(place).unwrap(), &["holds no run", "agglo run SCENARIO -o"]),
    ("texts of one's own", |place| put(place, "thesis.tex"), &["holds no run", "no folder checkpoints/"]),
    (
        "a scenario",
        |place| fs::write(place, STEPS).unwrap(),
        &["is a file", "give the folder that `agglo run`"],
    ),
    ("the folder above the run", |place| copy(reference(STEPS), &place.join("run")), &["holds no run"]),
    (
        "a folder of the run",
        |place| {
            let run = place.with_extension("whole");
            copy(reference(STEPS), &run);
            fs::rename(run.join("checkpoints"), place).unwrap();
        },
        &["holds no run"],
    ),
    (
        "a run killed before its first checkpoint",
        |place| {
            for part in ["checkpoints", "frames", "series"] {
                fs::create_dir_all(place.join(part)).unwrap();
            }
        },
        &["before its first checkpoint", "remove the folder and start again"],
    ),
    (
        "a folder without any checkpoint",
        |place| fs::create_dir_all(place.join("checkpoints")).unwrap(),
        &["before its first checkpoint"],
    ),
];

fn put(place: &Path, name: &str) {
    fs::create_dir(place).unwrap();
    fs::write(place.join(name), "precious").unwrap();
}

fn copy(run: &Path, place: &Path) {
    fs::create_dir_all(place.parent().unwrap()).unwrap();
    assert_eq!(
        Command::new("cp").arg("-r").args([run, place]).status().unwrap().code(),
        Some(0),
        "exit code"
    );
}

/// A finished run of which something was removed.
fn without(place: &Path, name: &str) {
    copy(reference(STEPS), place);
    let part = place.join(name);
    if part.is_dir() { fs::remove_dir_all(part) } else { fs::remove_file(part) }.unwrap();
}

/// All that is in a place, folders without files as well.
fn inside(place: &Path) -> (Vec<String>, Vec<Vec<u8>>) {
    let found = Command::new("find").arg(place).output().unwrap();
    let mut names: Vec<String> = String::from_utf8_lossy(&found.stdout).lines().map(str::to_owned).collect();
    names.sort();
    let files = names.iter().filter_map(|name| fs::read(name).ok()).collect();
    (names, files)
}

/// Refuses with code 2 and these words, and leaves all as it was.
fn refused(what: &str, arguments: &[&str], place: &Path, words: &[&str]) {
    let before = inside(place);
    let output = agglo(arguments);
    let text = complained(&output);
    assert_eq!(output.status.code(), Some(2), "{what}: {arguments:?} ends with {:?}\n{text}", output.status);
    for word in words {
        assert!(text.contains(word), "{what}: {arguments:?} does not say \"{word}\":\n{text}");
    }
    assert!(inside(place) == before, "{what}: {arguments:?} changed what is there");
}

#[test]
fn a_run_into_an_occupied_folder_is_refused_and_nothing_is_touched() {
    for (what, make, words) in OCCUPIED {
        let bench = Bench::with(STEPS);
        let run = bench.run();
        make(&run);
        let place = run.to_str().unwrap();
        refused(what, &["run", &bench.scenario(), "-o", place], &run, words);
        // Neither does asking again with other words help.
        refused(what, &["run", &bench.scenario(), "-o", place, "--no-report", "--seed", "3"], &run, words);
    }
}

/// The folder of the scenario is where one is.
#[test]
fn a_run_into_the_folder_of_its_scenario_is_refused() {
    let bench = Bench::with(STEPS);
    let folder = bench.folder();
    refused(
        "its own",
        &["run", &bench.scenario(), "-o", folder.to_str().unwrap()],
        folder,
        &["is not empty"],
    );
}

#[test]
fn what_is_no_folder_of_a_run_is_not_gone_on_with() {
    for (what, make, words) in NO_RUN {
        let bench = Bench::with(STEPS);
        let run = bench.run();
        make(&run);
        let place = run.to_str().unwrap();
        refused(what, &["resume", place], &run, words);
        refused(what, &["resume", place, "--until", "1 s"], &run, words);
    }
}

/// A file instead of its folder.
#[test]
fn readers_say_that_a_file_is_no_folder() {
    let bench = Bench::with(STEPS);
    let (scenario, picture) = (bench.scenario(), bench.folder().join("picture.png"));
    let words = ["is a file", "give the folder"];
    refused("a scenario", &["watch", &scenario], bench.folder(), &words);
    refused("a scenario", &["render", &scenario, "-o", picture.to_str().unwrap()], bench.folder(), &words);
    refused("a scenario", &["report", &scenario], bench.folder(), &["holds no run", "give the folder"]);
}

/// Of a run that was stopped, each folder is taken away in turn: the message names what is missing, and nothing is made up.
#[test]
fn a_stopped_run_that_lost_a_folder_is_refused_by_its_name() {
    let bench = Bench::with(EVENTS);
    bench.stopped_after(1, &["--no-report"]);
    for (part, words) in [
        ("checkpoints", ["holds no run", "no folder checkpoints/"]),
        ("series", ["series", "no such file"]),
        ("frames", ["frames", "no such file"]),
    ] {
        let run = bench.folder().join(format!("without-{part}"));
        copy(&bench.run(), &run);
        fs::remove_dir_all(run.join(part)).unwrap();
        let before = bytes(&run);
        let text = complained(&agglo(&["resume", run.to_str().unwrap()]));
        assert!(words.iter().all(|word| text.contains(word)), "without {part}: {text}");
        assert!(bytes(&run) == before, "without {part}: the refused run was changed");
    }
    ended(bench.resume().output().unwrap(), 0);
}
