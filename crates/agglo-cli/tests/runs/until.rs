//! Runs that go on to another end.

use std::fs;
use std::path::Path;

use crate::common::{
    Bench, EVENTS, STAGGERED, STEPS, VERLET, agglo, bytes, checkpoints, complained, ended, reference,
    results, said, state, until_it_succeeds,
};

/// Of each scenario the end that it has, half of it, and a step that lies before the half.
const ENDS: [(&str, &str, &str, u64); 4] = [
    (STAGGERED, "40 ms", "20 ms", 60),
    (VERLET, "30 ms", "15 ms", 60),
    (EVENTS, "1 ms", "500 us", 1),
    (STEPS, "500 us", "250 us", 1),
];

/// Holds a run to the one that had its end from the start: all files but those that say that it went on.
fn assert_same_course(bench: &Bench, scenario: &'static str) {
    let (mut found, mut wanted) = (results(&bench.run()), results(reference(scenario)));
    for files in [&mut found, &mut wanted] {
        let is_table = |name: &str| Path::new(name).extension().is_some_and(|kind| kind == "csv");
        files.retain(|name, _| is_table(name) || name.starts_with("frames/"));
    }
    assert_eq!(found.keys().collect::<Vec<_>>(), wanted.keys().collect::<Vec<_>>());
    for (name, content) in &wanted {
        assert!(found[name] == *content, "{name} differs");
    }
    assert!(state(&bench.run()) == state(reference(scenario)), "the last states differ");
    assert_eq!(
        checkpoints(&bench.run()).last().unwrap().0,
        checkpoints(reference(scenario)).last().unwrap().0
    );
}

fn assert_said(bench: &Bench, half: &str) {
    let text = fs::read_to_string(bench.run().join("scenario.toml")).unwrap();
    assert!(text.lines().nth(1).unwrap().contains(&format!("went on (--until) beyond {half}")), "{text}");
    let summary = fs::read_to_string(bench.run().join("summary.json")).unwrap();
    assert!(summary.contains("\"went_on_from_s\""), "{summary}");
    let again = said(&ended(bench.resume().output().unwrap(), 0));
    assert!(again.contains("went on from") && again.contains(half), "{again}");
}

fn until(bench: &Bench, end: &str) -> std::process::Output {
    bench.resume().args(["--until", end, "--no-report"]).output().unwrap()
}

/// A run that was stopped on its way to half of the time and goes on to the whole is the run that had it from the start.
#[test]
fn a_stopped_run_goes_on_as_if_its_end_had_been_the_later_one() {
    for (scenario, whole, half, step) in ENDS {
        let bench = Bench::with(scenario);
        bench.stopped_after(step, &["--set", &format!("time.end={half}"), "--no-report"]);
        ended(until(&bench, whole), 0);
        assert_same_course(&bench, scenario);
        assert_said(&bench, half);
    }
}

/// So is one that had come to half of the time: its last step, cut to the end, is done again.
#[test]
fn a_finished_run_goes_on_as_if_its_end_had_been_the_later_one() {
    for (scenario, whole, half, _) in ENDS {
        let bench = Bench::with(scenario);
        ended(bench.start(&["--set", &format!("time.end={half}"), "--no-report"]).output().unwrap(), 0);
        ended(until(&bench, whole), 0);
        assert_same_course(&bench, scenario);
        assert_said(&bench, half);
    }
}

/// Killed right after it got its new end, at any of the steps of that, it goes on to that end by a plain resume.
#[test]
fn a_run_killed_while_it_gets_another_end_is_whole() {
    let (scenario, whole, half, step) = ENDS[0];
    let before = Bench::with(scenario);
    before.stopped_after(step, &["--set", &format!("time.end={half}"), "--no-report"]);
    // The checkpoint has the new end, the scenario is still that of before.
    let bench = Bench::with(scenario);
    let old = fs::read(before.run().join("scenario.toml")).unwrap();
    until_it_succeeds(&bench.run(), || {
        let copied = std::process::Command::new("cp").arg("-r").arg(before.run()).arg(bench.run()).status();
        assert_eq!(copied.unwrap().code(), Some(0), "exit code");
        let mut child = bench.resume().args(["--until", whole]).spawn().unwrap();
        let mut turns = agglo_testing::Turns::at_most(60_000, "the scenario with the new end");
        while fs::read(bench.run().join("scenario.toml")).unwrap() == old {
            turns.take();
            std::thread::sleep(std::time::Duration::from_millis(1));
        }
        child.kill().unwrap();
        child.wait().unwrap();
        (!bench.run().join("summary.json").exists()).then_some(())
    });
    fs::write(bench.run().join("scenario.toml"), old).unwrap();
    ended(bench.resume().arg("--no-report").output().unwrap(), 0);
    assert_same_course(&bench, scenario);
    assert_said(&bench, half);
}

#[test]
fn an_end_that_has_passed_or_is_no_time_is_refused_and_nothing_is_changed() {
    let run = reference(STEPS);
    let before = bytes(run);
    for (end, words) in
        [("0.4 ms", "has come to 500 us already"), ("4 m", "a time is wanted"), ("soon", "--until")]
    {
        let refused = ended(agglo(&["resume", run.to_str().unwrap(), "--until", end]), 2);
        let text = complained(&refused);
        assert!(text.contains(words), "{end}: {text}");
    }
    assert!(bytes(run) == before, "the refused run was changed");
}
