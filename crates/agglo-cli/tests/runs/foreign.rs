//! Folders whose scenario, checkpoints, tables and frames do not belong together, and links that lead out of them.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};

use crate::common::{
    Bench, EVENTS, STEPS, agglo, assert_same, bytes, checkpoints, complained, ended, reference,
};

/// What is changed in a folder, and the words with which that is refused.
type Change = (&'static str, fn(&Path, &Path), &'static [&'static str]);

fn write(path: PathBuf, content: &[u8]) {
    fs::write(path, content).unwrap();
}

fn change(path: &Path, change: impl FnOnce(&mut Vec<u8>)) {
    let mut content = fs::read(path).unwrap();
    change(&mut content);
    fs::write(path, content).unwrap();
}

fn nul(path: &Path, from: usize, bytes: usize) {
    change(path, |content| content[from..from + bytes].fill(0));
}

fn edit(run: &Path, from: &str, to: &str) {
    let path = run.join("scenario.toml");
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains(from), "{text}");
    fs::write(&path, text.replace(from, to)).unwrap();
}

/// Takes a file of the other run.
fn swap(run: &Path, other: &Path, name: &str) {
    fs::copy(other.join(name), run.join(name)).unwrap();
}

const CHANGES: [Change; 13] = [
    (
        "an edited end",
        |run, _| edit(run, "seed = 7", "seed = 8"),
        &["scenario.toml was edited", "seed: 7, in scenario.toml 8"],
    ),
    (
        "a scenario that is gone",
        |run, _| fs::remove_file(run.join("scenario.toml")).unwrap(),
        &["scenario.toml is missing"],
    ),
    (
        "a scenario that is damaged",
        |run, _| nul(&run.join("scenario.toml"), 70, 30),
        &["scenario.toml", "damaged"],
    ),
    (
        "the scenario of another run",
        |run, other| swap(run, other, "scenario.toml"),
        &["scenario.toml", "seed: 7, in scenario.toml 9"],
    ),
    (
        "checkpoints of another run",
        |run, other| {
            fs::remove_dir_all(run.join("checkpoints")).unwrap();
            fs::create_dir(run.join("checkpoints")).unwrap();
            for (_, path) in checkpoints(other) {
                fs::copy(&path, run.join("checkpoints").join(path.file_name().unwrap())).unwrap();
            }
        },
        &["checkpoints are of another run", "seed: 9, in scenario.toml 7"],
    ),
    (
        "a table with 400 bytes of NUL",
        |run, _| nul(&run.join("series/energy.csv"), 200, 400),
        &["series/energy.csv", "was changed since"],
    ),
    (
        "a table with another first line",
        |run, _| nul(&run.join("series/steps.csv"), 0, 4),
        &["series/steps.csv", "first line"],
    ),
    ("the table of another run", |run, other| swap(run, other, "series/energy.csv"), &["series/energy.csv"]),
    (
        "a table that is gone",
        |run, _| fs::remove_file(run.join("events.csv")).unwrap(),
        &["events.csv", "no such file"],
    ),
    (
        "a frame that is gone",
        |run, _| fs::remove_file(run.join("frames/grains_000000.vtp")).unwrap(),
        &["frames/grains_000000.vtp is missing"],
    ),
    (
        "a frame with NUL",
        |run, _| nul(&run.join("frames/grains_000000.vtp"), 900, 400),
        &["frames/grains_000000.vtp is not what the run wrote"],
    ),
    (
        "a list of frames that is gone",
        |run, _| fs::remove_file(run.join("frames/grains.pvd")).unwrap(),
        &["frames/grains.pvd", "no such file"],
    ),
    (
        "a list of frames that leads out",
        |run, _| {
            let list = run.join("frames/grains.pvd");
            let text = fs::read_to_string(&list).unwrap().replacen(
                "grains_000000.vtp",
                "../../grains_000000.vtp",
                1,
            );
            fs::write(&list, text).unwrap();
        },
        &["frames/grains.pvd", "lies outside"],
    ),
];

/// The same scenario with another seed, stopped after its first checkpoints.
fn stopped(seed: &str) -> Bench {
    let bench = Bench::with(EVENTS);
    bench.stopped_after(1, &["--seed", seed, "--no-report"]);
    bench
}

fn copied(run: &Path, to: &Path) {
    // What an earlier change left.
    let _ = fs::remove_dir_all(to);
    assert_eq!(
        std::process::Command::new("cp").arg("-r").args([run, to]).status().unwrap().code(),
        Some(0),
        "exit code"
    );
}

/// Each kind of change is refused by name, and nothing in the folder is touched.
#[test]
fn what_does_not_belong_to_the_run_is_refused_by_name() {
    let (bench, other) = (stopped("7"), stopped("9"));
    let run = bench.folder().join("copy");
    for (what, change, words) in CHANGES {
        copied(&bench.run(), &run);
        change(&run, &other.run());
        let before = bytes(&run);
        let refused = agglo(&["resume", run.to_str().unwrap()]);
        let text = complained(&refused);
        assert!(!refused.status.success() && words.iter().all(|word| text.contains(word)), "{what}: {text}");
        assert!(bytes(&run) == before, "{what}: the refused run was changed");
    }
    copied(&bench.run(), &run);
    ended(agglo(&["resume", run.to_str().unwrap()]), 0);
}

/// A newer checkpoint of another run, or of another engine, is passed over by name for the older one of this run.
#[test]
fn a_newer_checkpoint_of_another_run_is_passed_over() {
    let other_seed = Bench::with(STEPS);
    ended(other_seed.start(&["--seed", "999", "--no-report"]).output().unwrap(), 0);
    for foreign in [other_seed.run().as_path(), reference(EVENTS)] {
        let bench = Bench::with(STEPS);
        bench.stopped_after(1, &[]);
        let newest = checkpoints(foreign).pop().unwrap().1;
        let name = format!("checkpoint-{:012}.agglo", 10_000_000);
        fs::copy(newest, bench.run().join("checkpoints").join(&name)).unwrap();
        let text = complained(&ended(bench.resume().output().unwrap(), 0));
        assert!(text.contains("warning: a checkpoint was passed over") && text.contains(&name), "{text}");
        assert!(text.contains("of another run"), "{text}");
        assert_same(&bench.run(), reference(STEPS));
    }
}

/// Damage behind the older checkpoint is mended by going on from that one.
#[test]
fn a_table_damaged_behind_the_older_checkpoint_is_written_anew() {
    let bench = Bench::with(STEPS);
    bench.stopped_after(1, &[]);
    let table = bench.run().join("series/energy.csv");
    let length = fs::metadata(&table).unwrap().len() as usize;
    nul(&table, length - 20, 10);
    let done = bench.resume().output().unwrap();
    let text = complained(&ended(done, 0));
    assert!(text.contains("a checkpoint was passed over") && text.contains("series/energy.csv"), "{text}");
    assert_same(&bench.run(), reference(STEPS));
}

/// A comment, or another layout, is no other scenario.
#[test]
fn a_comment_in_the_scenario_is_no_edit() {
    let bench = Bench::with(STEPS);
    bench.stopped_after(1, &[]);
    let path = bench.run().join("scenario.toml");
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, format!("# a note of mine\n{text}")).unwrap();
    ended(bench.resume().output().unwrap(), 0);
}

/// A table, a list or a folder that was replaced by a link: what the link leads to is as it was.
#[test]
fn links_are_not_followed() {
    let bench = stopped("7");
    let (run, outside) = (bench.folder().join("copy"), bench.folder().join("outside"));
    for name in
        ["series/energy.csv", "events.csv", "scenario.toml", ".agglo.lock", "series", "checkpoints", "frames"]
    {
        copied(&bench.run(), &run);
        copied(&bench.run(), &outside);
        write(outside.join(".agglo.lock"), b"precious");
        if run.join(name).is_dir() {
            fs::remove_dir_all(run.join(name)).unwrap();
        } else {
            // The lock's file is not there.
            let _ = fs::remove_file(run.join(name));
        }
        symlink(outside.join(name), run.join(name)).unwrap();
        let before = bytes(&outside);
        let refused = agglo(&["resume", run.to_str().unwrap()]);
        let text = complained(&refused);
        assert!(!refused.status.success() && text.contains(name) && text.contains("link"), "{name}: {text}");
        assert!(bytes(&outside) == before, "{name}: the file outside was changed");
    }
}

/// A copy by hard links, as backups are: what goes on leaves the copy as it was, which then comes to the same end.
#[test]
fn copies_by_hard_links_stay_as_they_were() {
    let bench = stopped("7");
    let copy = bench.folder().join("linked");
    let linked = std::process::Command::new("cp").arg("-al").arg(bench.run()).arg(&copy).status();
    assert_eq!(linked.unwrap().code(), Some(0), "exit code");
    let before = bytes(&copy);
    ended(bench.resume().output().unwrap(), 0);
    assert!(bytes(&copy) == before, "the copy was changed");
    ended(agglo(&["resume", copy.to_str().unwrap()]), 0);
    assert_same(&copy, &bench.run());
}
