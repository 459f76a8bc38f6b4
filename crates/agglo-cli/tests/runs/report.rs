//! Pages of runs: whole, of damaged folders, and of none.

use std::fs;
use std::path::Path;

use crate::common::{
    Bench, EVENTS, STAGGERED, agglo, assert_same, bytes, complained, ended, reference, said,
};

/// A copy of a whole run that may be damaged.
fn copy(scenario: &'static str) -> Bench {
    let bench = Bench::with(scenario);
    for (name, content) in bytes(reference(scenario)) {
        let path = bench.run().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, content).unwrap();
    }
    bench
}

/// What `agglo report` says of a folder, and the page.
fn reported(run: &Path) -> (String, String) {
    let output = ended(agglo(&["report", run.to_str().unwrap()]), 0);
    (said(&output), fs::read_to_string(run.join("report.html")).unwrap())
}

fn cut(path: &Path, bytes: usize) {
    let content = fs::read(path).unwrap();
    fs::write(path, &content[..content.len() - bytes]).unwrap();
}

#[test]
fn a_run_ends_with_the_page_that_report_writes() {
    for scenario in [STAGGERED, EVENTS] {
        let at_the_end = fs::read(reference(scenario).join("report.html")).unwrap();
        let bench = copy(scenario);
        let (told, page) = reported(&bench.run());
        assert!(!told.contains("note:") || told.contains("no frame shows rays"), "{told}");
        assert!(page.as_bytes() == at_the_end, "the same page");
        for part in ["id=\"replay\"", "id=\"chart-energy\"", "To run it again", "What to cite", "default</i>"]
        {
            let is_soft_only = part.contains("energy") && scenario == STAGGERED;
            assert!(page.contains(if is_soft_only { "id=\"chart-stores\"" } else { part }), "{part}");
        }
        assert_below!(page.len(), 25_000_000);
    }
}

#[test]
fn no_report_means_none_and_the_results_are_the_same() {
    let bench = Bench::with(STAGGERED);
    let output = ended(bench.start(&["--no-report"]).output().unwrap(), 0);
    assert_gone!(bench.run().join("report.html"));
    assert_lacks!(said(&output), "report.html");
    let other = copy(STAGGERED);
    fs::remove_file(other.run().join("report.html")).unwrap();
    assert_same(&bench.run(), &other.run());
}

#[test]
fn a_page_that_cannot_be_written_is_a_warning() {
    let bench = Bench::with(STAGGERED);
    bench.stopped_after(100, &[]);
    assert!(!bench.run().join("report.html").exists(), "there is no page of half a run");
    fs::create_dir(bench.run().join("report.html")).unwrap();
    let output = ended(bench.resume().output().unwrap(), 0);
    let warning = complained(&output);
    assert_eq!(warning.matches("warning: there is no report").count(), 1, "{warning}");
    assert!(said(&output).contains("energy drift"), "the summary is shown all the same");
}

#[test]
fn damaged_tables_and_frames_are_said_and_the_rest_is_shown() {
    let bench = copy(STAGGERED);
    let run = bench.run();
    cut(&run.join("series/energy.csv"), 30);
    fs::write(run.join("series/clusters.csv"), "").unwrap();
    fs::remove_file(run.join("series/steps.csv")).unwrap();
    cut(&run.join("frames/grains_000001.vtp"), 4000);
    fs::remove_file(run.join("frames/grains_000002.vtp")).unwrap();
    let (told, page) = reported(&run);
    for note in [
        "note: series/energy.csv is cut or damaged: 1 row is left out",
        "note: series/clusters.csv cannot be used: it is empty",
        "note: series/steps.csv is missing",
        "note: frames are missing: grains_000002.vtp",
        "grains_000001.vtp: it is cut short",
    ] {
        assert!(told.contains(note), "{note}: {told}");
        let words = note.trim_start_matches("note: ");
        assert!(page.contains(words), "{note} is not on the page");
    }
    assert_contains!(page, "id=\"replay\"");
    assert_contains!(page, "id=\"chart-stores\"");
    assert_lacks!(page, "id=\"chart-dispersion\"");
    assert_lacks!(page, "id=\"chart-step\"");
}

#[test]
fn without_frames_tables_and_summary_the_scenario_is_shown() {
    let bench = copy(EVENTS);
    let run = bench.run();
    for part in ["frames", "series"] {
        fs::remove_dir_all(run.join(part)).unwrap();
    }
    fs::remove_file(run.join("summary.json")).unwrap();
    let (told, page) = reported(&run);
    for note in
        ["there are no frames", "there are no tables", "summary.json is missing: the run has not finished"]
    {
        assert!(told.contains(note), "{note}: {told}");
    }
    assert_lacks!(page, "id=\"replay\"");
    assert_lacks!(page, "id=\"charts\"");
    assert_contains!(page, "[impact");
    assert_contains!(page, "What to cite");
}

#[test]
fn another_version_is_named() {
    let bench = copy(EVENTS);
    let run = bench.run();
    let scenario = fs::read_to_string(run.join("scenario.toml")).unwrap();
    fs::write(run.join("scenario.toml"), scenario.replace("version = 1", "version = 7")).unwrap();
    fs::write(run.join("summary.json"), "{\"version\": \"9.8.7\", \"grains\": 3}").unwrap();
    let (told, page) = reported(&run);
    assert!(told.contains("scenario.toml is damaged or of another version (line 2"), "{told}");
    assert!(told.contains("summary.json is of agglo 9.8.7"), "{told}");
    assert_contains!(page, "version = 7");
    assert_contains!(page, "id=\"chart-grains\"");
    fs::write(run.join("summary.json"), "{\"version\": ").unwrap();
    assert_contains!(reported(&run).0, "summary.json is cut or damaged");
}

#[test]
fn a_folder_without_a_run_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("notes.txt"), "no run").unwrap();
    for place in [folder.path().to_owned(), folder.path().join("nowhere")] {
        let output = ended(agglo(&["report", place.to_str().unwrap()]), 2);
        let text = complained(&output);
        assert!(text.contains("holds no run, search or study") && text.contains("agglo run"), "{text}");
    }
    assert_eq!(bytes(folder.path()).len(), 1, "nothing is written");
}
