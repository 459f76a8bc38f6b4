//! The first moments of a run, tried in a folder that does not stay: what a step costs, and what its files weigh.
//!
//! It is the run itself, grain for grain and bit for bit, only cut off after a time on the clock. So how far it comes
//! depends on the machine; what happens on the way does not.

use std::fs;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::{Duration, Instant};

use crate::engine::soft::Resting;
use crate::engine::{SimError, Start};
use crate::folder::RunFolder;
use crate::record::{RecordError, checkpoint};
use crate::scenario::Scenario;

use super::guests::Known;
use super::hard::Hard;
use super::job::{Job, Saved};
use super::recorder::Recorder;
use super::soft::Soft;
use super::{RunError, Summary, on_a_worker};

/// Events of hard spheres are handed on at least so often in the simulated time.
const LOOKS: f64 = 2000.0;

/// Grains may take so many times the budget to come to rest.
const PATIENCE: u32 = 2;

/// Simulated time, steps and time on the clock that belong together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stretch {
    /// Simulated time [s].
    pub time: f64,
    /// Steps, or events.
    pub steps: f64,
    /// Time on the clock [s].
    pub wall_s: f64,
}

impl Stretch {
    fn plus(self, other: Self) -> Self {
        Self {
            time: self.time + other.time,
            steps: self.steps + other.steps,
            wall_s: self.wall_s + other.wall_s,
        }
    }
}

/// Steps of one kind: all of them, and the latest, from half to three quarters of all.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stretches {
    /// All.
    pub all: Stretch,
    before: Stretch,
    now: Stretch,
}

impl Stretches {
    /// The latest steps.
    pub fn latest(&self) -> Stretch {
        self.before.plus(self.now)
    }

    /// Adds the next step.
    pub fn add(&mut self, step: Stretch) {
        self.all = self.all.plus(step);
        self.now = self.now.plus(step);
        if 2.0 * self.now.steps > self.all.steps {
            self.before = std::mem::take(&mut self.now);
        }
    }
}

/// What the record weighs, in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Weights {
    /// All that was written until the end of the rehearsal, but for checkpoints.
    pub so_far: f64,
    /// A row in each table over time, at the end of the rehearsal.
    pub row: f64,
    /// A frame without rays in flight; nothing where rays flew all the time.
    pub frame: Option<f64>,
    /// A frame with all rays of a pulse in flight, if some flew.
    pub flying_frame: Option<f64>,
    /// A checkpoint.
    pub checkpoint: f64,
}

/// What a rehearsal came to.
#[derive(Clone, Debug)]
pub struct Rehearsal {
    /// Simulated time at its end [s].
    pub time: f64,
    /// Whether that is the end of the run.
    pub is_finished: bool,
    /// Steps without rays in flight.
    pub quiet: Stretches,
    /// Steps with rays in flight.
    pub flying: Stretches,
    /// Steps without rays of the same grains in a quiet medium, where they were tried because rays flew all the time.
    pub calm: Option<Stretches>,
    /// Time on the clock [s] of the start.
    pub start_s: f64,
    /// Time on the clock [s] of writing the record.
    pub writing_s: f64,
    /// What the record weighs; nothing where it cannot be written.
    pub weights: Option<Weights>,
    /// What the run had come to.
    pub summary: Summary,
    /// Why it ended early, if a step failed.
    pub trouble: Option<String>,
}

/// Tries the start of a run and as many steps as fit into `budget`, one at least.
///
/// # Errors
/// [`RunError::Start`] where the start fails, or where grains take longer than twice the budget to come to rest.
pub fn rehearse(scenario: &Scenario, start: Start, budget: Duration) -> Result<Rehearsal, RunError> {
    let scenario = scenario.resolved();
    let go = if scenario.is_hard() { sit::<Hard> } else { sit::<Soft> };
    on_a_worker(|| go(&scenario, start, budget)).map_err(RunError::Start)
}

fn sit<J: Job>(scenario: &Scenario, start: Start, budget: Duration) -> Result<Rehearsal, SimError> {
    let began = Instant::now();
    let mut watch = |_: &Resting| {
        if began.elapsed() < PATIENCE * budget { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    };
    let mut job = J::start(scenario, start, &mut watch)?;
    let start_s = began.elapsed().as_secs_f64();
    let mut record = Record::of(&mut job, scenario).ok();
    let mut writing_s = began.elapsed().as_secs_f64() - start_s;
    let (mut quiet, mut flying) = (Stretches::default(), Stretches::default());
    let look = scenario.time.end.si() / LOOKS;
    let began = Instant::now();
    let mut trouble = None;
    while !job.is_finished() && trouble.is_none() && began.elapsed() < budget {
        let (time, steps, before) = (job.time(), job.step(), Instant::now());
        let due = record.as_ref().map_or(f64::INFINITY, |record| record.recorder.next_due());
        trouble = job.advance(due.min(time + look)).err().map(|error| error.to_string());
        let wall_s = before.elapsed().as_secs_f64();
        record = record.and_then(|record| record.go_on(&mut job).ok());
        if record.is_none() {
            job.forget_events();
        }
        writing_s += before.elapsed().as_secs_f64() - wall_s;
        let stretches = if job.is_ray_flight() { &mut flying } else { &mut quiet };
        stretches.add(Stretch { time: job.time() - time, steps: (job.step() - steps) as f64, wall_s });
    }
    Ok(Rehearsal {
        time: job.time(),
        is_finished: job.is_finished(),
        quiet,
        flying,
        calm: None,
        start_s,
        writing_s,
        weights: record.and_then(|record| record.weigh(&mut job).ok()),
        summary: job.summary(scenario, 0.0),
        trouble,
    })
}

/// The record of a rehearsal; its folder goes when it is dropped.
struct Record {
    scenario: String,
    place: tempfile::TempDir,
    folder: RunFolder,
    recorder: Recorder,
    /// Bytes of a frame without and with rays in flight.
    frames: [Option<f64>; 2],
}

impl Record {
    fn of<J: Job>(job: &mut J, scenario: &Scenario) -> Result<Self, RunError> {
        let place =
            tempfile::tempdir().map_err(RecordError::file("make a folder in", &std::env::temp_dir()))?;
        let folder = RunFolder::create(&place.path().join("run"))?;
        let recorder = Recorder::create(scenario, &folder, Known::default())?;
        let mut record = Self { scenario: scenario.to_toml()?, place, folder, recorder, frames: [None; 2] };
        record.recorder.record_due(job)?;
        record.weigh_frame(job)?;
        record.save(job)?;
        Ok(record)
    }

    /// Writes what is due.
    fn go_on<J: Job>(mut self, job: &mut J) -> Result<Self, RunError> {
        self.recorder.record_due(job)?;
        if self.recorder.checkpoint_is_due(&job.moment()) {
            self.save(job)?;
        }
        self.weigh_frame(job)?;
        Ok(self)
    }

    /// What it all weighs, with one more of each piece.
    fn weigh<J: Job>(mut self, job: &mut J) -> Result<Weights, RunError> {
        self.recorder.flush()?;
        let checkpoints = bytes_below(&self.folder.checkpoints());
        let so_far = bytes_below(self.place.path()) - checkpoints + self.scenario.len() as f64;
        let row = self.weighed(|record| {
            Ok(record.recorder.write_rows(job).and_then(|()| record.recorder.flush())?)
        })?;
        self.save(job)?;
        let newest = bytes_below(&self.folder.checkpoints()) - 0.5 * checkpoints;
        let [frame, flying_frame] = self.frames;
        Ok(Weights { so_far, row, frame, flying_frame, checkpoint: newest.max(0.0) })
    }

    /// Writes the first frame without rays and the first with all rays in flight, due or not; only the weights are kept.
    fn weigh_frame<J: Job>(&mut self, job: &mut J) -> Result<(), RunError> {
        let kind = usize::from(job.is_ray_flight());
        if self.frames[kind].is_none() {
            self.frames[kind] = Some(self.weighed(|record| Ok(record.recorder.write_frame(job)?))?);
        }
        Ok(())
    }

    fn weighed(&mut self, work: impl FnOnce(&mut Self) -> Result<(), RunError>) -> Result<f64, RunError> {
        let before = bytes_below(self.place.path());
        work(self)?;
        Ok(bytes_below(self.place.path()) - before)
    }

    fn save<J: Job>(&mut self, job: &J) -> Result<(), RunError> {
        self.recorder.sync()?;
        let (scenario, recorder) = (self.scenario.clone(), self.recorder.state());
        let saved = job.save(Saved { scenario, state: (), recorder, ends_before: Vec::new(), wall_s: 0.0 });
        checkpoint::save(&self.folder.checkpoints(), job.step(), &saved)?;
        Ok(())
    }
}

fn bytes_below(dir: &Path) -> f64 {
    let Ok(entries) = fs::read_dir(dir) else { return 0.0 };
    let bytes_of = |entry: fs::DirEntry| match entry.metadata() {
        Ok(data) if data.is_dir() => bytes_below(&entry.path()),
        Ok(data) => data.len() as f64,
        Err(_) => 0.0,
    };
    entries.filter_map(Result::ok).map(bytes_of).sum()
}
