//! Scenarios, runs, and the comparison of run folders.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use agglo::engine::{hard, soft};
use serde_json::Value as Json;

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

/// Bytes at the end of a checkpoint that tell the wall time [8], the length of the state [8] and the checksum [4].
const AFTER_THE_STATE: usize = 20;
/// The file that the process locks whose folder it is.
const LOCK: &str = "lock";

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

/// The objects that a program wrote to its standard output: one a line, nothing else, each with its type first.
pub fn objects(output: &Output) -> Vec<Json> {
    let object = |line: &str| {
        assert_starts!(line, "{\"type\":\"");
        serde_json::from_str(line).unwrap_or_else(|error| panic!("{error}: {line}"))
    };
    said(output).lines().map(object).collect()
}

/// Holds an object to the keys that docs/json.md has in the section of this heading: all of them, and no other.
pub fn assert_documented(object: &Json, heading: &str) {
    let page = include_str!("../../../../docs/json.md");
    let of_it = |section: &&str| {
        section.lines().next().is_some_and(|line| line.trim_start_matches('#').trim() == heading)
    };
    let section = page.split("\n#").find(of_it).unwrap_or_else(|| panic!("docs/json.md has no {heading}"));
    let cells =
        section.lines().filter(|line| line.starts_with("| `")).filter_map(|line| line.split(" | ").next());
    let mut wanted: Vec<&str> = cells.flat_map(|cell| cell.split('`').skip(1).step_by(2)).collect();
    let mut found: Vec<&str> =
        object.as_object().into_iter().flat_map(|keys| keys.keys().map(String::as_str)).collect();
    wanted.sort_unstable();
    found.sort_unstable();
    assert_eq!(found, wanted, "keys of {heading}");
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
    pub fn stopped_after(&self, step: u64, more: &[&str]) -> Output {
        self.stopped_by("INT", step, more).0
    }

    /// A run that was stopped by this signal once it had a checkpoint of this step or a later one, and how long it took to
    /// end.
    ///
    /// Where the test was not looking for so long that the run came to its end, it is run again.
    pub fn stopped_by(&self, name: &str, step: u64, more: &[&str]) -> (Output, Duration) {
        until_it_succeeds(&self.run(), || {
            let child = self.start(more).spawn().unwrap();
            wait_for_step(&self.run(), step);
            let (output, taken) = interrupted(child, name);
            (output.status.code() != Some(0)).then(|| (ended(output, 1), taken))
        })
    }

    /// A run that was killed once it had a checkpoint of this step or a later one.
    pub fn killed_after(&self, step: u64, more: &[&str]) {
        let mut held = self.held_after(step, more);
        held.kill().unwrap();
        held.wait().unwrap();
    }

    /// A run that is alive and held where it is, once it had a checkpoint of this step or a later one.
    pub fn held_after(&self, step: u64, more: &[&str]) -> Child {
        until_it_succeeds(&self.run(), || {
            let child = self.start(more).spawn().unwrap();
            wait_for_step(&self.run(), step);
            hold(&child).then_some(child)
        })
    }
}

/// Tries again, the folder removed, where a program came to its end before it could be stopped.
pub fn until_it_succeeds<T>(run: &Path, mut attempt: impl FnMut() -> Option<T>) -> T {
    for _ in 0..20 {
        if let Some(found) = attempt() {
            return found;
        }
        fs::remove_dir_all(run).unwrap();
    }
    panic!("expected a program that is stopped on its way; 20 of them came to their end before");
}

/// SIGKILL at ten moments spread over a run or search of `wall_s` [s], each time in the session that went on after the last, until
/// all ten hit one. `sit` gives the order of a session, the first or a later one; `wait_for` waits for a part of the whole.
pub fn kill_at_ten_moments(out: &Path, wall_s: f64, sit: impl Fn(bool) -> Command, wait_for: impl Fn(f64)) {
    const KILLS: u32 = 10;
    // A third is left at the last kill, and none comes later than that by a tenth of the whole.
    let mut spread = wall_s / 10.0;
    until_it_succeeds(out, || {
        let mut killed = 0;
        for kill in 0..KILLS {
            let mut child = sit(kill == 0).spawn().unwrap();
            wait_for(f64::from(kill) / f64::from(KILLS + 4));
            // Away from the checkpoint, into steps, frames and the next checkpoint.
            std::thread::sleep(Duration::from_secs_f64(spread * f64::from(kill * 7 % 23) / 23.0));
            child.kill().unwrap();
            killed += u32::from(child.wait().unwrap().code().is_none());
        }
        // On a busy machine a session may have reached the end before its kill; then sooner.
        spread /= 2.0;
        (killed == KILLS).then_some(())
    });
}

/// Sends a signal by its name.
pub fn signal(child: &Child, name: &str) {
    assert!(is_signaled(child, name), "kill -{name} failed");
}

/// Whether a process was there to get a signal. Every shell knows how to send one; the program `kill` is not on every machine.
fn is_signaled(child: &Child, name: &str) -> bool {
    let order = format!("kill -{name} {}", child.id());
    Command::new("sh").args(["-c", &order]).stderr(Stdio::null()).status().unwrap().success()
}

/// Sends a signal to a program that looks for it ten times a second, and waits for its end; gives how long it took.
///
/// It is held meanwhile, so that it is due to look as soon as it goes on: else a run of 50 ms would never see it.
pub fn interrupted(child: Child, name: &str) -> (Output, Duration) {
    if hold(&child) {
        signal(&child, name);
        std::thread::sleep(Duration::from_millis(120));
    }
    let asked = Instant::now();
    // Where it has ended, nobody is there to be told.
    is_signaled(&child, "CONT");
    (child.wait_with_output().unwrap(), asked.elapsed())
}

/// Holds a program where it is: when this returns, none of its threads writes anything. False if it has ended.
///
/// A signal is on its way for some time, and a thread that is in the middle of a write ends that first.
pub fn hold(child: &Child) -> bool {
    signal(child, "STOP");
    let begun = Instant::now();
    loop {
        match states(child.id()) {
            states if states.contains(&'Z') || states.is_empty() => return false,
            states if states.iter().all(|state| *state == 'T') => return true,
            _ => assert!(begun.elapsed() < Duration::from_secs(60), "it does not stop"),
        }
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// What the threads of a process do, by the letters of Linux: T is stopped, Z has ended.
fn states(process: u32) -> Vec<char> {
    let threads = fs::read_dir(format!("/proc/{process}/task")).into_iter().flatten();
    // A thread that ended in between has no file any more.
    let files = threads.filter_map(|thread| fs::read_to_string(thread.ok()?.path().join("stat")).ok());
    // The name before stands in brackets and may hold anything.
    files.filter_map(|text| text.rsplit_once(") ")?.1.chars().next()).collect()
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

/// An uninterrupted run of the scenario, made once for all tests of this process.
pub fn reference(scenario: &'static str) -> &'static Path {
    static RUNS: [OnceLock<PathBuf>; 4] = [const { OnceLock::new() }; 4];
    let which = SCENARIOS.iter().position(|known| known.1 == scenario).unwrap();
    RUNS[which].get_or_init(|| {
        let folder = lasting().join(SCENARIOS[which].0);
        fs::create_dir(&folder).unwrap();
        let (file, run) = (folder.join("scenario.toml"), folder.join("run"));
        fs::write(&file, scenario).unwrap();
        ended(agglo(&["run", file.to_str().unwrap(), "-o", run.to_str().unwrap()]), 0);
        run
    })
}

/// A folder that lasts as long as this process and is no other's.
///
/// Nobody can remove it at the end of a process; the tests of a later one do. A lock tells whose process still lives: numbers of
/// processes come again, and are counted by themselves in each container.
pub fn lasting() -> &'static Path {
    static FOLDER: OnceLock<(PathBuf, File)> = OnceLock::new();
    let (folder, _) = FOLDER.get_or_init(|| {
        let all = Path::new(env!("CARGO_TARGET_TMPDIR")).join("references");
        fs::create_dir_all(&all).unwrap();
        sweep(&all);
        loop {
            let folder = tempfile::tempdir_in(&all).unwrap().keep();
            let lock = File::create(folder.join(LOCK)).unwrap();
            lock.lock().unwrap();
            // Another process may have swept it away before it was locked.
            if folder.join(LOCK).exists() {
                return (folder, lock);
            }
        }
    });
    folder
}

/// Removes what the tests of processes that have ended left behind.
fn sweep(all: &Path) {
    for entry in fs::read_dir(all).unwrap() {
        let folder = entry.unwrap().path();
        // Without a lock it is just being made, or swept by another.
        if let Ok(lock) = File::open(folder.join(LOCK))
            && lock.try_lock().is_ok()
        {
            let _ = fs::remove_dir_all(folder);
        }
    }
}

/// What `summary.json` of a run holds.
pub fn summary(run: &Path) -> serde_json::Value {
    serde_json::from_slice(&fs::read(run.join("summary.json")).unwrap()).unwrap()
}

/// A number of a summary.
pub fn number(summary: &serde_json::Value, key: &str) -> f64 {
    summary[key].as_f64().unwrap_or_else(|| panic!("{key} is {:?}", summary[key]))
}

/// Steps of a finished run.
pub fn steps(run: &Path) -> u64 {
    checkpoints(run).last().unwrap().0
}

/// The simulation's state in a run's newest checkpoint, without the recorder's.
pub fn state(run: &Path) -> Vec<u8> {
    let file = fs::read(&checkpoints(run).last().unwrap().1).unwrap();
    // Magic and format [12], the version with its length [1 + n], step [8]; see `record/checkpoint.rs`.
    let payload = &file[12 + 1 + usize::from(file[12]) + 8..];
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
