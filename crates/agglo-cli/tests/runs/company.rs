//! Two processes in one folder, and folders that hold something already.

use std::fs;
use std::path::Path;
use std::process::{Child, Output};
use std::time::Duration;

use crate::common::{
    Bench, EVENTS, STEPS, agglo, assert_same, bytes, command, complained, ended, reference, said, signal,
};

/// How often storms are repeated; `AGGLO_STORMS` asks for more.
pub fn storms() -> u64 {
    std::env::var("AGGLO_STORMS").ok().and_then(|count| count.parse().ok()).unwrap_or(20)
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// The first is held in the middle of its work, so that it is alive for sure.
#[test]
fn a_second_process_is_refused_while_the_first_lives_and_readers_are_not() {
    let bench = Bench::with(EVENTS);
    let first = bench.held_after(1, &[]);
    let before = bytes(&bench.run());
    let run = bench.run();
    for arguments in [vec!["resume", text(&run)], vec!["run", &bench.scenario(), "-o", text(&run)]] {
        let words = complained(&ended(agglo(&arguments), 2));
        let by = format!("process {}", first.id());
        assert!(words.contains("is at work in") && words.contains(&by), "{words}");
    }
    assert!(bytes(&run) == before, "the run that is alive was changed");
    let page = said(&ended(agglo(&["report", text(&run)]), 0));
    assert!(page.contains("report.html"), "{page}");
    signal(&first, "CONT");
    ended(first.wait_with_output().unwrap(), 0);
    assert_same(&run, reference(EVENTS));
}

/// The system releases the lock of a process that was killed; its file is no hindrance.
#[test]
fn the_lock_of_a_killed_process_holds_nobody_up() {
    let bench = Bench::with(STEPS);
    bench.killed_after(1, &[]);
    assert_there!(bench.run().join(".agglo.lock"));
    ended(bench.resume().output().unwrap(), 0);
    assert_same(&bench.run(), reference(STEPS));
    // A folder in which nothing but such a file is left is as good as an empty one.
    let other = bench.folder().join("other");
    fs::create_dir(&other).unwrap();
    fs::write(other.join(".agglo.lock"), "process 1").unwrap();
    ended(agglo(&["run", &bench.scenario(), "-o", text(&other)]), 0);
}

/// Where the file system has no locks, the run says so and goes on.
#[cfg(target_os = "linux")]
#[test]
fn without_locks_a_run_warns_and_goes_on() {
    const WITHOUT: &str =
        "#include <errno.h>\nint flock(int file, int what) { errno = ENOLCK; return -1; }\n";
    let bench = Bench::with(STEPS);
    let [source, library] = ["flock.c", "flock.so"].map(|name| bench.folder().join(name));
    fs::write(&source, WITHOUT).unwrap();
    let mut compiler = std::process::Command::new("cc");
    let made = compiler.args(["-shared", "-fPIC", "-o"]).arg(&library).arg(&source).status();
    assert_eq!(made.unwrap().code(), Some(0), "exit code");
    let mut command = bench.start(&[]);
    let done = ended(command.env("LD_PRELOAD", &library).output().unwrap(), 0);
    assert!(complained(&done).contains("has no locks"), "{}", complained(&done));
    assert_same(&bench.run(), reference(STEPS));
}

/// Starts both at nearly the same time; a process may be refused, but by nothing else than the other one.
fn both(mut commands: [std::process::Command; 2], apart: Duration) {
    let mut children: Vec<Child> = Vec::new();
    for command in &mut commands {
        children.push(command.spawn().unwrap());
        std::thread::sleep(apart);
    }
    let outputs: Vec<Output> = children.into_iter().map(|child| child.wait_with_output().unwrap()).collect();
    let done = outputs.iter().filter(|output| output.status.success()).count();
    for output in outputs.iter().filter(|output| !output.status.success()) {
        let words = complained(output);
        let reasons = [
            "is at work in",
            "is not empty",
            "there is no folder",
            "holds no run",
            "holds a run",
            "before its first checkpoint",
        ];
        assert!(output.status.code() == Some(2) && reasons.iter().any(|why| words.contains(why)), "{words}");
    }
    assert!(done >= 1, "both were refused: {outputs:?}");
}

#[test]
fn a_run_and_a_resume_at_once_lose_no_row() {
    for storm in 0..storms() {
        let bench = Bench::with(STEPS);
        both([bench.start(&["--no-report"]), bench.resume()], Duration::from_millis(storm * 11 % 97));
        assert_same_but_the_page(&bench);
    }
}

#[test]
fn two_runs_at_once_lose_no_row() {
    for storm in 0..storms() {
        let bench = Bench::with(STEPS);
        let starts = [bench.start(&["--no-report"]), bench.start(&["--no-report"])];
        both(starts, Duration::from_millis(storm * 7 % 31));
        assert_same_but_the_page(&bench);
    }
}

#[test]
fn two_resumes_at_once_lose_no_row() {
    let stopped = Bench::with(STEPS);
    stopped.stopped_after(1, &[]);
    for storm in 0..storms() {
        let bench = Bench::with(STEPS);
        let copied = std::process::Command::new("cp").arg("-r").arg(stopped.run()).arg(bench.run()).status();
        assert_eq!(copied.unwrap().code(), Some(0), "exit code");
        both([bench.resume(), bench.resume()], Duration::from_millis(storm * 3 % 17));
        assert_same_but_the_page(&bench);
    }
}

fn assert_same_but_the_page(bench: &Bench) {
    let done = ended(bench.resume().output().unwrap(), 0);
    assert!(said(&done).contains("has finished already"), "{}", said(&done));
    ended(command(&["report", text(&bench.run())]).output().unwrap(), 0);
    assert_same(&bench.run(), reference(STEPS));
}
