//! Scenarios, runs, and the comparison of run folders.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use agglo::engine::{hard, soft};

/// Soft spheres with steps of adaptive length, some of them rejected.
pub const STAGGERED: &str = include_str!("staggered.toml");
/// Soft spheres with steps of fixed length.
pub const VERLET: &str = include_str!("verlet.toml");
/// Hard spheres that bounce, merge, break and cool, from impact to impact in a periodic volume.
pub const EVENTS: &str = include_str!("events.toml");
/// The same step by step, fewer of them, between walls.
pub const STEPS: &str = include_str!("steps.toml");
/// All of them by name.
pub const SCENARIOS: [(&str, &str); 4] =
    [("staggered", STAGGERED), ("verlet", VERLET), ("events", EVENTS), ("steps", STEPS)];

/// Bytes at the end of a checkpoint that tell the wall time [8] and the checksum [4].
const AFTER_THE_STATE: usize = 12;

/// A command of the program that has not started.
pub fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_agglo"));
    command.args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Runs the program to its end.
pub fn agglo(arguments: &[&str]) -> Output {
    command(arguments).output().unwrap()
}

/// What the program wrote to its standard output.
pub fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// What the program wrote to its standard error.
pub fn complained(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The output of a program that must have ended with this code.
pub fn ended(output: Output, code: i32) -> Output {
    assert_eq!(output.status.code(), Some(code), "{}\n{}", said(&output), complained(&output));
    output
}

/// A folder with a scenario file in it, and the place of a run.
pub struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    /// With this scenario.
    pub fn with(scenario: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("scenario.toml"), scenario).unwrap();
        Self { folder }
    }

    /// The folder itself.
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// The scenario file.
    pub fn scenario(&self) -> String {
        self.folder().join("scenario.toml").display().to_string()
    }

    /// The folder of the run.
    pub fn run(&self) -> PathBuf {
        self.folder().join("run")
    }

    /// `agglo run` into the run's folder.
    pub fn start(&self, more: &[&str]) -> Command {
        let (scenario, run) = (self.scenario(), self.run().display().to_string());
        let mut arguments = vec!["run", &scenario, "-o", &run];
        arguments.extend(more);
        command(&arguments)
    }

    /// `agglo resume` of the run's folder.
    pub fn resume(&self) -> Command {
        command(&["resume", &self.run().display().to_string()])
    }

    /// A run that was stopped by SIGINT once it had a checkpoint of this step or a later one.
    ///
    /// Where the test was not looking for so long that the run came to its end, it is run again.
    pub fn stopped_after(&self, step: u64, more: &[&str]) -> Output {
        for _ in 0..20 {
            let child = self.start(more).spawn().unwrap();
            wait_for_step(&self.run(), step);
            signal(&child, "INT");
            let output = child.wait_with_output().unwrap();
            if output.status.code() != Some(0) {
                return ended(output, 1);
            }
            fs::remove_dir_all(self.run()).unwrap();
        }
        panic!("expected a run stopped after step {step}; 20 runs came to their end before");
    }
}

/// Sends a signal by its name.
pub fn signal(child: &Child, name: &str) {
    let sent = Command::new("kill").args([&format!("-{name}"), &child.id().to_string()]).status().unwrap();
    assert!(sent.success());
}

/// Checkpoints of a run by their steps, in order.
pub fn checkpoints(run: &Path) -> Vec<(u64, PathBuf)> {
    let step = |path: &Path| -> Option<u64> {
        path.file_name()?.to_str()?.strip_prefix("checkpoint-")?.strip_suffix(".agglo")?.parse().ok()
    };
    let entries = fs::read_dir(run.join("checkpoints")).into_iter().flatten();
    let paths = entries.map(|entry| entry.unwrap().path());
    let mut found: Vec<_> = paths.filter_map(|path| Some((step(&path)?, path))).collect();
    found.sort();
    found
}

/// Waits until the run has a checkpoint of this step or a later one.
pub fn wait_for_step(run: &Path, step: u64) {
    let begun = Instant::now();
    while checkpoints(run).last().is_none_or(|newest| newest.0 < step) {
        assert!(begun.elapsed() < Duration::from_secs(60), "no checkpoint of step {step} after a minute");
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// All files below a folder by their names, as they are.
pub fn bytes(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    collect(folder, folder, &mut files);
    files
}

fn collect(root: &Path, folder: &Path, files: &mut BTreeMap<String, Vec<u8>>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect(root, &path, files);
        } else {
            let name = path.strip_prefix(root).unwrap().to_str().unwrap().to_owned();
            files.insert(name, fs::read(&path).unwrap());
        }
    }
}

/// All files of a run without what tells how long it took and on how many threads.
pub fn results(run: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = bytes(run);
    for (name, content) in &mut files {
        if name == "summary.json" {
            let text = String::from_utf8(content.clone()).unwrap();
            let kept = |line: &&str| !line.contains("\"wall_s\"") && !line.contains("\"threads\"");
            *content = text.lines().filter(kept).collect::<Vec<_>>().join("\n").into_bytes();
        } else if name == "report.html" {
            let text = String::from_utf8(content.clone()).unwrap();
            let kept = |line: &&str| !line.starts_with("<tr><td>wall time</td>");
            *content = text.lines().filter(kept).collect::<Vec<_>>().join("\n").into_bytes();
        } else if name.starts_with("checkpoints/") {
            content.truncate(content.len() - AFTER_THE_STATE);
        }
    }
    files
}

/// Holds two runs to the same files, bit by bit.
pub fn assert_same(run: &Path, reference: &Path) {
    let (found, wanted) = (results(run), results(reference));
    let names = |files: &BTreeMap<String, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&found), names(&wanted));
    for (name, content) in &wanted {
        let same = content.iter().zip(&found[name]).take_while(|(a, b)| a == b).count();
        assert!(found[name] == *content, "{name} of {} differs from byte {same} on", run.display());
    }
}

/// An uninterrupted run of the scenario, made once for all tests.
pub fn reference(scenario: &'static str) -> &'static Path {
    static RUNS: [OnceLock<PathBuf>; 4] = [const { OnceLock::new() }; 4];
    let which = SCENARIOS.iter().position(|known| known.1 == scenario).unwrap();
    let name = SCENARIOS[which].0;
    RUNS[which].get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("reference-{name}"));
        // What an earlier test run left; it may not be there.
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        let (file, run) = (folder.join("scenario.toml"), folder.join("run"));
        fs::write(&file, scenario).unwrap();
        ended(agglo(&["run", file.to_str().unwrap(), "-o", run.to_str().unwrap()]), 0);
        run
    })
}

/// Steps of a finished run.
pub fn steps(run: &Path) -> u64 {
    checkpoints(run).last().unwrap().0
}

/// The simulation's state in a run's newest checkpoint, without the recorder's.
pub fn state(run: &Path) -> Vec<u8> {
    let file = fs::read(&checkpoints(run).last().unwrap().1).unwrap();
    // Magic and format [12], the version with its length [1 + n], step and length [16]; see `record/checkpoint.rs`.
    let payload = &file[12 + 1 + usize::from(file[12]) + 16..];
    // The number of the engine's kind stands before the scenario.
    if payload[0] == 0 {
        type Saved = (u8, String, soft::SimulationState<'static>);
        let ((_, _, simulation), _) = postcard::take_from_bytes::<Saved>(payload).unwrap();
        postcard::to_stdvec(&simulation).unwrap()
    } else {
        type Saved = (u8, String, hard::SimulationState<'static>);
        let ((_, _, simulation), _) = postcard::take_from_bytes::<Saved>(payload).unwrap();
        postcard::to_stdvec(&simulation).unwrap()
    }
}
