//! Signals at every phase: an answer within a second, and no empty folder.

use std::fs;
use std::path::Path;
use std::process::{Child, Command};
use std::time::{Duration, Instant};

use crate::common::{Bench, STAGGERED, command, complained, reference, signal};

/// A second, and as much again for a machine that is busy with other tests, on top of a build that is not optimized.
pub const SOON: Duration = Duration::from_secs(6);

/// Grains that are placed at random, denser than there is room for: the search for it takes minutes. They are many, and their
/// frames few: a disk that is nearly full has room for them.
pub const PACKING: &str = r#"
version = 1
time.end = "1 s"
output = { series = "1 s", frames = "1 s" }
[engine.verlet]
step = "1 us"
[materials.glass]
density = "2500 kg/m3"
youngs_modulus = "10 MPa"
poisson_ratio = 0.2
[[grains]]
material = "glass"
size.uniform = { smallest = "0.2 mm", largest = "0.5 mm" }
placement.random = { solid_fraction = 0.5, region.box = { lower = ["0 m", "0 m", "0 m"], upper = ["60 mm", "60 mm", "60 mm"] } }
[contact.normal.hertz]
"#;

/// Grains that come to rest for hours.
pub const RESTING: &str = r#"
version = 1
time.end = "1 s"
[engine.verlet]
step = "1 ns"
[materials.glass]
density = "2500 kg/m3"
youngs_modulus = "10 MPa"
poisson_ratio = 0.2
[[grains]]
material = "glass"
size.constant.radius = "1 mm"
placement.list.positions = [["-0.9 mm", "0 m", "0 m"], ["0.9 mm", "0 m", "0 m"]]
[contact.normal.hertz]
[start.relax]
speed = "1e-12 m/s"
longest = "1 h"
damping_time = "1 s"
"#;

/// Ends within a second of the signal; with what the program said.
fn answer(child: Child, name: &str, code: i32) -> String {
    let asked = Instant::now();
    signal(&child, name);
    let output = child.wait_with_output().unwrap();
    let taken = asked.elapsed();
    assert!(taken < SOON, "{name}: {taken:?}");
    assert_eq!(output.status.code(), Some(code), "{}", complained(&output));
    complained(&output)
}

/// Nothing but the scenario file is in a bench's folder.
pub fn holds_nothing(folder: &Path) {
    let left: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left, ["scenario.toml"], "something is left");
}

/// A program that listens to signals, some time after it began to.
fn listening(mut order: Command) -> Child {
    // SIGINT is the second.
    const INTERRUPT: u64 = 1 << 1;
    let child = order.spawn().unwrap();
    let begun = Instant::now();
    loop {
        let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap();
        let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap();
        if u64::from_str_radix(caught.trim(), 16).unwrap() & INTERRUPT != 0 {
            break;
        }
        assert!(begun.elapsed() < Duration::from_secs(60), "it does not listen to signals after a minute");
        std::thread::sleep(Duration::from_millis(1));
    }
    std::thread::sleep(Duration::from_secs(1));
    child
}

fn started(mut order: Command, after: Duration) -> Child {
    let child = order.spawn().unwrap();
    std::thread::sleep(after);
    child
}

#[test]
fn placing_grains_is_stopped_and_leaves_nothing() {
    for name in ["INT", "TERM", "HUP"] {
        let bench = Bench::with(PACKING);
        let text = answer(listening(bench.start(&[])), name, 1);
        assert!(text.contains("stopped before the run began; nothing was written"), "{text}");
        holds_nothing(bench.folder());
    }
}

#[test]
fn coming_to_rest_is_stopped_and_leaves_nothing() {
    for name in ["INT", "TERM"] {
        let bench = Bench::with(RESTING);
        let text = answer(listening(bench.start(&[])), name, 1);
        assert!(text.contains("stopped while grains came to rest"), "{text}");
        holds_nothing(bench.folder());
    }
}

#[test]
fn steps_are_stopped_with_a_checkpoint() {
    for name in ["INT", "TERM"] {
        let bench = Bench::with(STAGGERED);
        let (stopped, taken) = bench.stopped_by(name, 30, &[]);
        assert!(taken < SOON, "{name}: {taken:?}");
        let text = complained(&stopped);
        assert!(text.contains("stopped at t = ") && text.contains("agglo resume"), "{text}");
    }
}

/// Two at once, as from an impatient user: whatever there is then, it is no empty folder.
#[test]
fn a_second_signal_leaves_no_empty_folder() {
    for (scenario, milliseconds) in [(RESTING, 1000), (PACKING, 600), (RESTING, 30), (RESTING, 80)] {
        let bench = Bench::with(scenario);
        let below = bench.folder().join("a/b/run");
        let order = command(&["run", &bench.scenario(), "-o", below.to_str().unwrap()]);
        let child = started(order, Duration::from_millis(milliseconds));
        signal(&child, "INT");
        signal(&child, "TERM");
        child.wait_with_output().unwrap();
        holds_nothing(bench.folder());
    }
}

/// Checks, reports and pictures have nothing to save.
#[test]
fn other_verbs_end_at_once() {
    let bench = Bench::with(PACKING);
    let asked = Instant::now();
    let child = started(command(&["check", &bench.scenario()]), Duration::from_millis(500));
    signal(&child, "TERM");
    assert_ne!(child.wait_with_output().unwrap().status.code(), Some(0), "exit code");
    let run = reference(STAGGERED).to_str().unwrap();
    let picture = bench.folder().join("picture.png").display().to_string();
    let large = ["render", run, "-o", &picture, "--size", "16000x16000"];
    let child = started(command(&large), Duration::from_millis(500));
    signal(&child, "INT");
    assert_ne!(child.wait_with_output().unwrap().status.code(), Some(0), "exit code");
    assert!(asked.elapsed() < 2 * SOON + Duration::from_secs(1), "{:?}", asked.elapsed());
    holds_nothing(bench.folder());
}
