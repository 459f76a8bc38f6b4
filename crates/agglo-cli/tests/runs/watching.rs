//! `agglo watch` and `agglo run --watch`.

use std::fs;
use std::process::Command;
use std::time::{Duration, Instant};

use crate::common::{
    Bench, EVENTS, STAGGERED, agglo, assert_same, command, complained, ended, reference, said,
};

#[test]
fn a_finished_run_is_summed_up() {
    for scenario in [STAGGERED, EVENTS] {
        let watched = ended(agglo(&["watch", reference(scenario).to_str().unwrap()]), 0);
        let text = said(&watched);
        assert!(text.contains("simulated time") && text.trim_end().ends_with("has finished"), "{text}");
    }
}

/// Without a terminal: lines with the quantities, and the summary once the run has finished.
#[test]
fn a_run_is_followed_to_its_end() {
    let bench = Bench::with(STAGGERED);
    let run = bench.start(&[]).spawn().unwrap();
    let begun = Instant::now();
    while !bench.run().join("scenario.toml").is_file() {
        assert!(begun.elapsed() < Duration::from_secs(60), "the run has not begun after a minute");
        std::thread::sleep(Duration::from_millis(1));
    }
    let watched = ended(agglo(&["watch", bench.run().to_str().unwrap()]), 0);
    assert!(said(&watched).trim_end().ends_with("has finished"), "{}", said(&watched));
    ended(run.wait_with_output().unwrap(), 0);
    // Nothing in the folder was touched.
    assert_same(&bench.run(), reference(STAGGERED));
}

#[test]
fn folders_that_cannot_be_watched() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let message = complained(&ended(agglo(&["watch", path]), 2));
    assert!(message.contains("holds no run"), "{message}");
    let message = complained(&ended(agglo(&["watch", "nowhere"]), 2));
    assert!(message.contains("there is no folder nowhere"), "{message}");
    fs::write(folder.path().join("scenario.toml"), "version = 1\nspeed = 3\n").unwrap();
    let message = complained(&ended(agglo(&["watch", path]), 2));
    assert!(message.contains("scenario.toml") && message.contains("speed"), "{message}");
}

#[test]
fn without_a_terminal_a_watched_run_has_no_dashboard() {
    let bench = Bench::with(EVENTS);
    let ran = ended(bench.start(&["--watch"]).output().unwrap(), 0);
    assert!(said(&ran).contains("simulated time") && !said(&ran).contains('\u{1b}'), "{}", said(&ran));
}

/// On a terminal, which `script` makes, the dashboard has a screen of its own and gives the old one back; the run is
/// the same to the last bit.
#[cfg(target_os = "linux")]
#[test]
fn a_dashboard_comes_and_goes() {
    let bench = Bench::with(STAGGERED);
    let run = bench.run();
    let line = format!(
        "'{}' run '{}' -o '{}' --watch",
        env!("CARGO_BIN_EXE_agglo"),
        bench.scenario(),
        run.display()
    );
    let mut script = Command::new("script");
    script.args(["--quiet", "--return", "--command", &line, "/dev/null"]).env("COLORTERM", "truecolor");
    let Ok(output) = script.output() else { return };
    let shown = said(&ended(output, 0));
    let (comes, goes) = (shown.find("\u{1b}[?1049h"), shown.rfind("\u{1b}[?1049l"));
    assert!(comes.is_some() && comes < goes, "{shown}");
    assert!(goes < shown.rfind("simulated time"), "{shown}");
    assert_same(&run, reference(STAGGERED));
    // A second look at the same folder finds it finished.
    let watched = command(&["watch", run.to_str().unwrap()]).output().unwrap();
    assert_contains!(said(&ended(watched, 0)), "has finished");
}
