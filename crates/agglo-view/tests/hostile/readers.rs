//! All that reads what others may have written, each as one function of bytes: fuzzers and the bounded test call the same.
//!
//! A function panics where a promise is broken: that nothing panics behind it, that a refusal is a message that a terminal
//! can show, that what is taken can be written and read again. It gives the message of a refusal.

use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Duration;

use agglo::forecast::{Effort, Plan};
use agglo::packing;
use agglo::record::frames::{Collection, Frame};
use agglo::run;
use agglo::scenario::{Faults, Scenario};
use agglo::search::campaign::Means;
use agglo::search::{self, Campaign};
use agglo::text::visible;
use agglo_view::pictures::campaign_pictures;
use agglo_view::render::{FrameSequence, Options, Renderer};
use agglo_view::report::Report;
use agglo_view::watch::{Follower, Reading};

use crate::seeds;

/// Nothing where the bytes were taken, or the message of a refusal.
pub type Verdict = Result<(), String>;

/// A reader of one kind of file.
pub type Reader = fn(&Bench, &[u8]) -> Verdict;

/// No message is longer [bytes].
const LONGEST_MESSAGE: usize = 200_000;
/// What a plan may try of a scenario that was made up.
const LITTLE: Effort = Effort { most_grains: 3000, budget: Duration::from_millis(2) };

/// Folders that the readers of a folder's files find them in; each reader puts its own back as it was.
pub struct Bench {
    place: tempfile::TempDir,
    /// The files of a run, a search and so on, as they were made: path relative to the place, and bytes.
    files: Vec<(PathBuf, Vec<u8>)>,
}

impl Bench {
    /// Makes a run that was stopped, one that has finished, and a search that was stopped.
    pub fn new() -> Self {
        // In memory where the system has such a folder: runs and searches wait for the disk often.
        let memory = Path::new("/dev/shm");
        let parent = if memory.is_dir() { memory.to_owned() } else { std::env::temp_dir() };
        let place = tempfile::tempdir_in(parent).expect("a temporary folder");
        seeds::make(place.path());
        let mut files = Vec::new();
        gather(place.path(), Path::new(""), &mut files);
        Self { place, files }
    }

    /// A folder or file of the place.
    pub fn at(&self, name: &str) -> PathBuf {
        self.place.path().join(name)
    }

    /// The bytes of a file as it was made.
    pub fn bytes(&self, name: &Path) -> &[u8] {
        let found = self.files.iter().find(|(path, _)| path == name);
        &found.unwrap_or_else(|| panic!("{} was made", name.display())).1
    }

    /// The files whose names begin and end so.
    pub fn named(&self, begin: &str, end: &str) -> Vec<&Path> {
        let fits =
            |path: &&Path| path.to_string_lossy().starts_with(begin) && path.to_string_lossy().ends_with(end);
        self.files.iter().map(|(path, _)| path.as_path()).filter(fits).collect()
    }

    /// Puts a folder back as it was made, with these bytes in one of its files.
    fn with(&self, folder: &str, file: &Path, bytes: &[u8]) -> PathBuf {
        let dir = self.at(folder);
        let _ = fs::remove_dir_all(&dir);
        for (path, as_made) in self.files.iter().filter(|(path, _)| path.starts_with(folder)) {
            let to = self.place.path().join(path);
            fs::create_dir_all(to.parent().expect("a folder")).expect("a folder");
            fs::write(to, if path == file { bytes } else { as_made }).expect("a file");
        }
        dir
    }
}

fn gather(root: &Path, below: &Path, files: &mut Vec<(PathBuf, Vec<u8>)>) {
    let mut entries: Vec<_> = fs::read_dir(root.join(below)).expect("a folder").flatten().collect();
    entries.sort_by_key(fs::DirEntry::file_name);
    for entry in entries {
        let name = below.join(entry.file_name());
        if entry.path().is_dir() {
            gather(root, &name, files);
        } else {
            files.push((name, fs::read(entry.path()).expect("a file")));
        }
    }
}

/// Every reader by the name of its target.
pub const READERS: [(&str, Reader); 11] = [
    ("scenario", scenario),
    ("setting", setting),
    ("plan", plan),
    ("campaign", campaign),
    ("table", table),
    ("checkpoint", checkpoint),
    ("journal", journal),
    ("part", part),
    ("frame", frame),
    ("series", series),
    ("summary", summary),
];

/// Holds the message of a refusal to what a message may be.
fn refused(message: &str) -> Verdict {
    assert!(!message.trim().is_empty(), "a refusal without a message");
    assert!(message.len() <= LONGEST_MESSAGE, "a message of {} bytes", message.len());
    assert!(visible(message) == message, "a message that acts on a terminal: {message:?}");
    Err(message.to_owned())
}

fn faulty(faults: &Faults, text: &str) -> Verdict {
    assert!(!faults.is_empty(), "a refusal without a fault");
    refused(&faults.render(text, "file.toml", false))?;
    refused(&faults.to_string())
}

/// A scenario's text: what is valid is written out and read back as the same.
pub fn scenario(_: &Bench, bytes: &[u8]) -> Verdict {
    let text = String::from_utf8_lossy(bytes);
    match Scenario::from_toml(&text) {
        Ok(scenario) => {
            comes_back(&scenario);
            Ok(())
        }
        Err(faults) => faulty(&faults, &text),
    }
}

/// A setting of a scenario that is valid without it.
pub fn setting(_: &Bench, bytes: &[u8]) -> Verdict {
    let (text, setting) = (seeds::valid(), String::from_utf8_lossy(bytes));
    match Scenario::with_overrides(text, &[setting]) {
        Ok(scenario) => {
            comes_back(&scenario);
            Ok(())
        }
        Err(faults) => faulty(&faults, text),
    }
}

fn comes_back(scenario: &Scenario) {
    for scenario in [scenario, &scenario.resolved()] {
        let written = scenario.to_toml().expect("a valid scenario has a text");
        let again = Scenario::from_toml(&written).unwrap_or_else(|faults| panic!("{faults}\n{written}"));
        assert!(again == *scenario, "it reads back as another:\n{written}");
    }
}

/// The plan of a scenario that is valid.
pub fn plan(_: &Bench, bytes: &[u8]) -> Verdict {
    let text = String::from_utf8_lossy(bytes);
    let Ok(scenario) = Scenario::from_toml(&text) else { return Err("no scenario".to_owned()) };
    match Plan::with(&scenario, Path::new("/nowhere"), LITTLE) {
        Ok(plan) => {
            finite(&plan);
            Ok(())
        }
        Err(error) => refused(&error.to_string()),
    }
}

/// Holds what a plan says to be numbers.
fn finite(plan: &Plan) {
    let said = plan.to_string().to_lowercase();
    let odd = said.split(|c: char| !c.is_alphanumeric()).find(|word| ["nan", "inf"].contains(word));
    assert!(odd.is_none(), "a plan of no numbers:\n{said}");
}

/// A search or study: what is valid is written out and read back as the same.
pub fn campaign(_: &Bench, bytes: &[u8]) -> Verdict {
    let text = String::from_utf8_lossy(bytes);
    let campaign = match Campaign::from_toml(&text) {
        Ok(campaign) => campaign,
        Err(faults) => return faulty(&faults, &text),
    };
    let written = campaign.to_toml().expect("a valid campaign has a text");
    let again = Campaign::from_toml(&written).unwrap_or_else(|faults| panic!("{faults}\n{written}"));
    assert!(again == campaign, "it reads back as another:\n{written}");
    Ok(())
}

/// A table of grains: planned first, as every run is, then placed.
pub fn table(bench: &Bench, bytes: &[u8]) -> Verdict {
    let dir = bench.with("table", Path::new("table/grains.csv"), bytes);
    let scenario = Scenario::load(&dir.join("scenario.toml")).expect("it is valid");
    let placed = Plan::with(&scenario, &dir, LITTLE).and_then(|_| Ok(packing::place(&scenario, &dir)?));
    match placed {
        Ok(grains) => {
            let numbers = grains.position.iter().flat_map(|place| [place.x, place.y, place.z]);
            assert_all!(numbers.chain(grains.radius.iter().copied()), f64::is_finite);
            Ok(())
        }
        Err(error) => refused(&error.to_string().replace(&dir.display().to_string(), "")),
    }
}

/// A checkpoint in the folder of its run, and as the start of another, as it is and with a right checksum. A run that goes
/// on is told to stop soon.
pub fn checkpoint(bench: &Bench, bytes: &[u8]) -> Verdict {
    let names = bench.named("stopped/checkpoints/", ".agglo");
    let name = names.last().expect("the run has checkpoints");
    let mut verdict = Err("not read".to_owned());
    for bytes in [bytes, &seeds::sealed(bytes)] {
        let found = [
            resumed(&bench.with("stopped", name, bytes)),
            begun(&bench.with("begun", Path::new("begun/state.agglo"), bytes)),
            begun(&bench.with("begun-hard", Path::new("begun-hard/state.agglo"), bytes)),
        ];
        verdict = found.into_iter().fold(verdict, Verdict::or);
    }
    verdict
}

/// The plan of a scenario that starts from a state.
fn begun(dir: &Path) -> Verdict {
    let scenario = Scenario::load(&dir.join("scenario.toml")).expect("it is valid");
    match Plan::with(&scenario, dir, LITTLE) {
        Ok(plan) => {
            finite(&plan);
            Ok(())
        }
        Err(error) => refused(&error.to_string()),
    }
}

fn resumed(dir: &Path) -> Verdict {
    let mut calls = 0;
    let mut observer = |progress: &run::Progress| {
        // Without an end the files are still read.
        calls += u32::from(progress.end > 0.0);
        if calls > 1 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    match run::resume(dir, &mut observer) {
        Ok(run::Ending::Finished(summary)) => {
            let _ = summary.table();
            let read = run::summary(dir).expect("the summary can be read");
            assert!(read.is_some(), "the summary is there");
            Ok(())
        }
        Ok(run::Ending::Interrupted(_)) => Ok(()),
        Err(error) => refused(&error.to_string()),
    }
}

/// The journal of a search that was stopped, as it is and with right checksums: the search goes on to its end.
pub fn journal(bench: &Bench, bytes: &[u8]) -> Verdict {
    let name = Path::new("search/replicates.journal");
    let verdict = gone_on(&bench.with("search", name, bytes));
    let sealed = seeds::sealed_lines(bytes);
    if sealed == bytes { verdict } else { gone_on(&bench.with("search", name, &sealed)) }
}

/// Which part of a study a folder holds: the part goes on to its end. Whether it is put together with no other depends on
/// whether it is the only one.
pub fn part(bench: &Bench, bytes: &[u8]) -> Verdict {
    let dir = bench.with("part", Path::new("part/part.json"), bytes);
    // One that has finished would not look.
    fs::remove_file(dir.join("summary.json")).expect("it was made");
    gone_on(&dir)?;
    let whole = bench.at("whole");
    let _ = fs::remove_dir_all(&whole);
    let mut goes_on = |_: &search::campaign::CampaignProgress| ControlFlow::Continue(());
    match search::campaign::join(&[dir], &whole, Means::threads(1), &mut goes_on) {
        Ok(_) => assert!(search::campaign::finished(&whole).is_some(), "the summary of a study can be read"),
        Err(error) => assert!(refused(&error.to_string()).is_err(), "a refusal"),
    }
    Ok(())
}

fn gone_on(dir: &Path) -> Verdict {
    let means = Means { draw: Some(&campaign_pictures), ..Means::threads(1) };
    match search::campaign::resume(dir, means, &mut |_| ControlFlow::Continue(())) {
        Ok(_) => {
            assert!(search::campaign::finished(dir).is_some(), "the summary of a search can be read");
            let _ = Report::of_campaign(dir);
            Ok(())
        }
        Err(error) => refused(&error.to_string()),
    }
}

/// A frame of grains, bonds or rays, or a list of frames: read, shown in a report, and drawn.
pub fn frame(bench: &Bench, bytes: &[u8]) -> Verdict {
    let as_one = |kind: &str| -> (PathBuf, PathBuf) {
        let names = bench.named("finished/frames/", kind);
        let name = names.last().unwrap_or_else(|| panic!("{kind} is there"));
        (bench.with("finished", name, bytes), bench.place.path().join(name))
    };
    let (dir, path) = as_one("grains.pvd");
    let list = Collection::read(&path).map_err(|error| error.to_string());
    if list.is_ok() {
        drawn(&dir);
        return Ok(());
    }
    let (dir, path) = as_one("_000001.vtp");
    let frame = Frame::read(&path).map_err(|error| error.to_string());
    shown(&dir);
    if frame.is_ok() {
        for kind in ["grains", "bonds", "rays"] {
            let (dir, _) = as_one(&format!("{kind}_000001.vtp"));
            shown(&dir);
            drawn(&dir);
        }
        return Ok(());
    }
    let _ = list.or_else(|message| refused(&message).map(|()| Collection::default()));
    frame.map(drop).or_else(|message| refused(&message))
}

/// The report of a run's folder, whatever is in it.
fn shown(dir: &Path) {
    match Report::of_run(dir) {
        Ok(report) => report.notes.iter().for_each(|note| drop(refused(note))),
        Err(error) => drop(refused(&error.to_string())),
    }
}

/// A picture by every kind of quantity, small.
fn drawn(dir: &Path) {
    let sequence = match FrameSequence::open(dir) {
        Ok(sequence) => sequence,
        Err(error) => return drop(refused(&error.to_string())),
    };
    let frames: Vec<usize> = (0..sequence.len().min(3)).collect();
    for color in ["speed", "cluster", "material"] {
        let (color, size) = (color.to_owned(), [24, 16]);
        let options = Options { color, size, bonds: true, rays: true, ..Options::default() };
        let renderer = Renderer::prepare(sequence.clone(), options, &frames, &mut |_| true);
        let drawn = renderer
            .and_then(|renderer| renderer.map(|renderer| renderer.picture(frames.len() - 1)).transpose());
        if let Err(error) = drawn {
            drop(refused(&error.to_string()));
        }
    }
}

/// A table of a run over time: watched, and shown in a report.
pub fn series(bench: &Bench, bytes: &[u8]) -> Verdict {
    let dir = bench.with("finished", Path::new("finished/series/clusters.csv"), bytes);
    shown(&dir);
    followed(&dir)
}

fn followed(dir: &Path) -> Verdict {
    match Follower::open(dir).and_then(|mut follower| follower.look()) {
        Ok(sight) => {
            let quantities: Vec<String> = sight.quantities.iter().map(Reading::text).collect();
            assert!(quantities.iter().all(|text| text.len() < 100), "{quantities:?}");
            Ok(())
        }
        Err(error) => refused(&error.to_string()),
    }
}

/// A summary of a run or of a search: what is taken is written and read again, and shown.
pub fn summary(bench: &Bench, bytes: &[u8]) -> Verdict {
    let dir = bench.with("finished", Path::new("finished/summary.json"), bytes);
    let read = run::summary(&dir);
    shown(&dir);
    let _ = followed(&dir);
    let campaign = bench.with("ended", Path::new("ended/summary.json"), bytes);
    let of_campaign = search::campaign::finished(&campaign);
    let _ = Report::of_campaign(&campaign);
    match read {
        Ok(Some(summary)) => {
            let _ = summary.table();
            let written = summary.to_json();
            fs::write(dir.join("summary.json"), &written).expect("a file");
            let again = run::finished(&dir).unwrap_or_else(|| panic!("it cannot be read again:\n{written}"));
            assert!(again.to_json() == written, "it reads back as another:\n{written}");
            Ok(())
        }
        Ok(None) => panic!("the summary is there"),
        Err(_) if of_campaign.is_some() => Ok(()),
        Err(error) => refused(&error.to_string()),
    }
}
