//! Lists, completions and man pages: what the program says about itself.

#![allow(clippy::unwrap_used, reason = "a test that cannot read its files has failed")]

#[macro_use]
extern crate agglo_testing;

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use agglo::pages::all;

/// The verbs that `agglo --help` shows, without `help`.
fn verbs() -> Vec<String> {
    let help = said(&["--help"]);
    let (_, commands) = help.split_once("Commands:\n").unwrap();
    let lines = commands.lines().take_while(|line| line.starts_with("  "));
    let words = lines.filter_map(|line| line.split_whitespace().next());
    words.filter(|word| *word != "help").map(str::to_owned).collect()
}

fn agglo(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_agglo")).args(arguments).output().unwrap()
}

/// What the program prints where all is well.
fn said(arguments: &[&str]) -> String {
    let output = agglo(arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Whether a shell can read a script; `None` where there is no such shell.
fn parses(shell: &str, script: &str) -> Option<bool> {
    let mut child = Command::new(shell).arg("-n").stdin(Stdio::piped()).spawn().ok()?;
    child.stdin.take().unwrap().write_all(script.as_bytes()).unwrap();
    Some(child.wait().unwrap().success())
}

#[test]
fn every_law_is_listed_and_every_listed_word_is_explained() {
    let plain = said(&["list-laws"]);
    let markdown = said(&["list-laws", "--markdown"]);
    let json: serde_json::Value = serde_json::from_str(&said(&["list-laws", "--json"])).unwrap();
    let listed = json.as_array().unwrap();
    assert_eq!(listed.len(), all().count());
    assert_eq!(markdown.lines().count(), listed.len() + 2);
    assert!(markdown.lines().all(|line| line.matches('|').count() == 8), "{markdown}");
    for (page, law) in all().zip(listed) {
        assert_eq!(law["word"], page.name);
        assert_eq!(law["what"], page.title());
        assert!(law["equations"].as_array().is_some_and(|labels| !labels.is_empty()), "{law}");
        assert!(law["source"].as_str().is_some_and(|source| plain.contains(source)), "{law}");
        assert!(["soft", "hard", "search"].contains(&law["for"].as_str().unwrap()), "{law}");
        assert!(plain.lines().any(|line| line.split_whitespace().next() == Some(page.name)), "{}", page.name);
        assert!(markdown.contains(&format!("| `{}` ", page.name)), "{}", page.name);
        let also = law["also_explains"].as_array().unwrap().iter().map(|word| word.as_str().unwrap());
        for word in also.chain([page.name]) {
            assert!(said(&["explain", word]).starts_with(&format!("{} (", page.name)), "{word}");
        }
    }
    // Lines of an example that only the compiler needs are not for readers.
    assert_lacks!(said(&["list-laws", "--pages"]), "extern crate");
    let both = agglo(&["list-laws", "--markdown", "--json"]);
    assert_eq!(both.status.code(), Some(2));
}

#[test]
fn completions_parse_and_know_every_verb() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = said(&["completions", shell]);
        for verb in verbs() {
            assert!(script.contains(&verb), "{shell}: {verb}");
        }
        if ["bash", "zsh", "fish"].contains(&shell) {
            assert_ne!(parses(shell, &script), Some(false), "{shell}");
        }
    }
    assert_eq!(parses("bash", &said(&["completions", "bash"])), Some(true));
    assert_eq!(parses("bash", "if then"), Some(false), "the check itself");
    let unknown = agglo(&["completions", "rc"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert_contains!(String::from_utf8_lossy(&unknown.stderr), "bash");
}

#[test]
fn the_man_page_has_every_verb_and_every_verb_a_page() {
    let page = said(&["man"]);
    assert!(page.contains(".TH agglo 1") && page.contains("Exit codes"), "{page}");
    let folder = tempfile::tempdir().unwrap();
    let into = folder.path().join("share/man1");
    let written = said(&["man", "-o", into.to_str().unwrap()]);
    assert_eq!(fs::read_to_string(into.join("agglo.1")).unwrap().trim_end(), page.trim_end());
    let verbs = verbs();
    assert!(verbs.len() >= 11, "{verbs:?}");
    for verb in &verbs {
        // Troff escapes dashes.
        assert!(page.contains(&format!("agglo\\-{}(1)", verb.replace('-', "\\-"))), "{verb}");
        let of_verb = fs::read_to_string(into.join(format!("agglo-{verb}.1"))).unwrap();
        assert!(of_verb.contains(&format!(".TH agglo-{verb} 1")), "{of_verb}");
    }
    assert_eq!(written.lines().count(), verbs.len() + 1);
    assert_all!(written.lines(), |path| Path::new(path).is_file());
    let blocked = agglo(&["man", "-o", into.join("agglo.1").to_str().unwrap()]);
    assert_eq!(blocked.status.code(), Some(2));
}
