//! A run that is given a wall time: it ends in time, says so, and goes on with the same bits.

use std::time::{Duration, Instant};

use crate::common::{
    Bench, EVENTS, STAGGERED, assert_same, checkpoints, complained, ended, reference, said, until_it_succeeds,
};
use crate::signals::{PACKING, RESTING, SOON, holds_nothing};

/// A time that is up when the clock is first looked at.
const AT_ONCE: &str = "1 us";

fn assert_stopped(bench: &Bench, text: &str, allowed: &str) {
    let why = format!(": the wall time of {allowed} is up (");
    let advice = format!("`agglo resume {}` goes on from there", bench.run().display());
    assert_contains!(text, "stopped at t = ");
    assert_contains!(text, &why);
    assert_contains!(text, &advice);
    assert_gone!(bench.run().join("summary.json"));
}

#[test]
fn a_run_whose_time_is_up_goes_on_with_the_same_bits() {
    for scenario in [STAGGERED, EVENTS] {
        let bench = Bench::with(scenario);
        let stopped = ended(bench.start(&["--wall-time", AT_ONCE]).output().unwrap(), 3);
        assert_stopped(&bench, &complained(&stopped), AT_ONCE);
        assert_empty!(said(&stopped));
        // A resumed session has a time of its own. This one has not even read the checkpoint, and can be resumed all the same.
        let again = ended(bench.resume().args(["--wall-time", AT_ONCE]).output().unwrap(), 3);
        let files =
            "stopped while the run's files were read; nothing was changed: the wall time of 1 us is up (";
        assert_contains!(complained(&again), files);
        assert_contains!(complained(&again), &format!("`agglo resume {}` goes on", bench.run().display()));
        let done = ended(bench.resume().args(["--wall-time", "1 h"]).output().unwrap(), 0);
        assert_contains!(said(&done), "simulated time");
        assert_same(&bench.run(), reference(scenario));
    }
}

/// On its way, sessions of an eighth of the whole one after the other, as a queue would start them.
#[test]
fn sessions_of_part_of_the_time_come_to_the_same_end() {
    let longer = ["--set", "time.end=0.4 s"];
    let whole = Bench::with(STAGGERED);
    let begun = Instant::now();
    ended(whole.start(&[&longer[..], &["--no-report"]].concat()).output().unwrap(), 0);
    // A second is ten looks at the clock.
    let allowed = (begun.elapsed() / 8).min(Duration::from_secs(1)).as_secs_f64();
    let time = format!("{allowed:.3} s");
    let few = ["--wall-time", &time, "--no-report"];
    let bench = Bench::with(STAGGERED);
    let first = until_it_succeeds(&bench.run(), || {
        let begun = Instant::now();
        let output = bench.start(&[&longer[..], &few].concat()).output().unwrap();
        assert!(
            begun.elapsed().as_secs_f64() < allowed + SOON.as_secs_f64(),
            "it took {:?}",
            begun.elapsed()
        );
        (output.status.code() != Some(0)).then(|| ended(output, 3))
    });
    assert_stopped(&bench, &complained(&first), &time);
    assert!(checkpoints(&bench.run()).last().unwrap().0 > 0, "it stopped before its first step");
    for _ in 0..200 {
        let output = bench.resume().args(few).output().unwrap();
        if output.status.code() == Some(0) {
            return assert_same(&bench.run(), &whole.run());
        }
        assert_stopped(&bench, &complained(&ended(output, 3)), &time);
    }
    panic!("expected an end after 200 sessions of {time}");
}

#[test]
fn a_run_that_ends_before_knows_nothing_of_it() {
    let bench = Bench::with(STAGGERED);
    let done = ended(bench.start(&["--wall-time", "2 h"]).output().unwrap(), 0);
    assert_lacks!(complained(&done), "wall time of");
    assert_same(&bench.run(), reference(STAGGERED));
}

/// There is nothing to go on from, so that the exit code is that of a failure: who resumes on 3 would not come to an end.
#[test]
fn a_time_that_is_up_before_the_start_leaves_nothing() {
    for (scenario, stopped) in [(PACKING, "before the run began"), (RESTING, "while grains came to rest")] {
        let bench = Bench::with(scenario);
        let text = complained(&ended(bench.start(&["--wall-time", "0.2 s"]).output().unwrap(), 1));
        assert_contains!(&text, stopped);
        assert_contains!(&text, ": the wall time of 0.2 s is up");
        assert_contains!(&text, "give it more, and run again");
        assert_lacks!(&text, "agglo resume");
        holds_nothing(bench.folder());
    }
}

#[test]
fn what_is_no_wall_time_is_refused_and_nothing_is_written() {
    let bench = Bench::with(STAGGERED);
    let refusals = [
        ("0 s", "found \"0 s\"; more than 0 is wanted"),
        ("-1 s", "found \"-1 s\"; more than 0 is wanted"),
        ("5 m", "\"5 m\" is a length [m]; a time is wanted"),
        ("90", "\"90\" has no unit; a time is wanted"),
        ("--no-report", "\"--no-report\" does not begin with a number; a time is wanted"),
    ];
    for (time, words) in refusals {
        let text = complained(&ended(bench.start(&["--wall-time", time]).output().unwrap(), 2));
        assert_contains!(&text, &format!("error: --wall-time: {words}"));
        assert_contains!(&text, "such as \"90 s\", \"30 min\" or \"2 h\"");
        assert_eq!(text.matches("error").count(), 1, "{text}");
        holds_nothing(bench.folder());
    }
    let run = reference(STAGGERED).display().to_string();
    let text = complained(&ended(crate::common::agglo(&["resume", &run, "--wall-time", "0 s"]), 2));
    assert_contains!(text, "error: --wall-time: found \"0 s\"");
}

#[test]
fn the_exit_codes_are_in_the_help() {
    assert_contains!(said(&ended(crate::common::agglo(&["--help"]), 0)), "3 stopped at the given wall time");
}
