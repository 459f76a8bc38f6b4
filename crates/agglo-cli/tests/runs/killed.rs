//! A run that is killed or stopped, and goes on.

use std::time::Instant;

use crate::common::{
    Bench, EVENTS, STAGGERED, STEPS, VERLET, assert_same, checkpoints, complained, ended,
    kill_at_ten_moments, reference, said, steps, summary, wait_for_step,
};
use crate::company::storms;

/// SIGKILL at ten moments spread over the run, each time in the session that went on after the last; then the rest.
fn killed_ten_times(scenario: &'static str) {
    let reference = reference(scenario);
    let bench = Bench::with(scenario);
    kill_at_ten_moments(
        &bench.run(),
        summary(reference)["wall_s"].as_f64().unwrap(),
        |is_first| if is_first { bench.start(&[]) } else { bench.resume() },
        |part| wait_for_step(&bench.run(), (steps(reference) as f64 * part) as u64),
    );
    ended(bench.resume().output().unwrap(), 0);
    assert_same(&bench.run(), reference);
}

#[test]
fn a_run_killed_at_ten_moments_ends_with_the_same_files_staggered() {
    killed_ten_times(STAGGERED);
}

#[test]
fn a_run_killed_at_ten_moments_ends_with_the_same_files_verlet() {
    killed_ten_times(VERLET);
}

#[test]
fn a_run_killed_at_ten_moments_ends_with_the_same_files_events() {
    killed_ten_times(EVENTS);
}

#[test]
fn a_run_killed_at_ten_moments_ends_with_the_same_files_steps() {
    killed_ten_times(STEPS);
}

/// Kills at moments that have nothing to do with checkpoints, as many as `AGGLO_STORMS` says, ten for each run.
#[test]
fn runs_killed_in_a_storm_end_with_the_same_files() {
    let reference = reference(STEPS);
    let begun = Instant::now();
    ended(Bench::with(STEPS).start(&["--no-report"]).output().unwrap(), 0);
    let whole = begun.elapsed();
    for round in 0..storms().div_ceil(10) {
        let bench = Bench::with(STEPS);
        for kill in 0..10 {
            // A run that was killed before its first checkpoint begins again.
            let begins = checkpoints(&bench.run()).is_empty();
            if begins {
                // What the kill left; it may not be there.
                let _ = std::fs::remove_dir_all(bench.run());
            }
            let mut order = if begins { bench.start(&[]) } else { bench.resume() };
            let mut child = order.spawn().unwrap();
            std::thread::sleep(whole.mul_f64(((round * 10 + kill) * 37 % 100) as f64 / 300.0));
            // It may have reached its end.
            let _ = child.kill();
            child.wait().unwrap();
        }
        let last = if checkpoints(&bench.run()).is_empty() {
            let _ = std::fs::remove_dir_all(bench.run());
            bench.start(&[]).output()
        } else {
            bench.resume().output()
        };
        ended(last.unwrap(), 0);
        ended(crate::common::agglo(&["report", bench.run().to_str().unwrap()]), 0);
        // Of a kill while the page of a run that had finished was written: such a run is not gone on with, and not swept.
        for entry in std::fs::read_dir(bench.run()).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|kind| kind == "part") {
                std::fs::remove_file(path).unwrap();
            }
        }
        assert_same(&bench.run(), reference);
    }
}

/// Half-written files that a kill left are gone, whichever folder they are in.
#[test]
fn leftovers_of_a_killed_run_are_swept_away() {
    let bench = Bench::with(STAGGERED);
    bench.stopped_after(100, &[]);
    for place in [".agglo-a1.part", "frames/.agglo-b2.part", "checkpoints/.agglo-c3.part"] {
        std::fs::write(bench.run().join(place), "half").unwrap();
    }
    ended(bench.resume().output().unwrap(), 0);
    assert_same(&bench.run(), reference(STAGGERED));
}

#[test]
fn ctrl_c_stops_with_a_checkpoint_and_says_how_to_go_on() {
    for name in ["INT", "TERM"] {
        let bench = Bench::with(STAGGERED);
        let text = complained(&bench.stopped_by(name, 60, &[]).0);
        let advice = format!("`agglo resume {}` goes on from there", bench.run().display());
        assert!(text.contains("stopped at t = ") && text.contains(&advice), "{text}");
        assert_gone!(bench.run().join("summary.json"));
        let done = ended(bench.resume().output().unwrap(), 0);
        assert!(said(&done).contains("simulated time"), "{}", said(&done));
        assert_same(&bench.run(), reference(STAGGERED));
    }
}

/// Killed before anything could be saved: there is nothing to go on from, and the message says what to do.
#[test]
fn a_run_killed_before_its_first_checkpoint_says_to_start_again() {
    let bench = Bench::with(STAGGERED);
    std::fs::create_dir_all(bench.run().join("checkpoints")).unwrap();
    let refused = ended(bench.resume().output().unwrap(), 2);
    let text = complained(&refused);
    assert!(text.contains("before its first checkpoint") && text.contains("start again"), "{text}");
}

/// As a kill between the results and the page leaves it.
#[test]
fn a_finished_run_without_its_page_gets_it() {
    let bench = Bench::with(STEPS);
    ended(bench.start(&["--no-report"]).output().unwrap(), 0);
    let page = bench.run().join("report.html");
    ended(bench.resume().arg("--no-report").output().unwrap(), 0);
    assert!(!page.exists(), "a page that nobody wants");
    let told = said(&ended(bench.resume().output().unwrap(), 0));
    assert!(told.contains("report.html shows it"), "{told}");
    assert_same(&bench.run(), reference(STEPS));
    let told = said(&ended(bench.resume().output().unwrap(), 0));
    assert!(!told.contains("report.html"), "{told}");
}
