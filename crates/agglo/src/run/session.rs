//! One sitting of a run: steps, records and checkpoints until the end, an error or a stop.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use crate::engine::soft::Resting;
use crate::particles::Particles;
use crate::record::checkpoint::{self, Refused};
use crate::record::{RecordError, atomic};
use crate::scenario::{Scenario, readable};

use super::folder::Folder;
use super::job::{AnySaved, Job, Saved};
use super::recorder::Recorder;
use super::{Ending, Observer, Progress, RunError};

/// How often the observer is told.
const TELL_EVERY: Duration = Duration::from_millis(100);

/// Reads the newest sound checkpoint in the folder, and what was wrong with newer ones.
///
/// # Errors
/// [`RunError`] where there is none.
pub fn load(folder: &Folder) -> Result<(AnySaved<'static>, Vec<Refused>), RunError> {
    match checkpoint::load_newest::<AnySaved<'_>>(&folder.checkpoints()) {
        Err(RecordError::NoCheckpoint { refused, .. }) if refused.is_empty() => {
            Err(RunError::NoCheckpointYet { dir: folder.root().to_owned() })
        }
        found => found.map(|(saved, _, refused)| (saved, refused)).map_err(RunError::from),
    }
}

/// The progress of grains that come to rest before the clock starts.
fn coming_to_rest(resting: &Resting, end: f64) -> Progress {
    let [speed, limit] = [resting.speed, resting.limit].map(|speed| readable(speed, "m/s"));
    let passed = readable(resting.time, "s");
    Progress {
        time: 0.0,
        end,
        step: resting.step,
        steps_are: "steps",
        now: format!("coming to rest for {passed}, fastest grain {speed} of {limit}"),
        warnings: Vec::new(),
    }
}

/// One sitting of a run.
pub struct Session<J> {
    scenario: Scenario,
    folder: Folder,
    job: J,
    recorder: Recorder,
    wall_before: f64,
    sat_down: Instant,
    told: Instant,
    notes: Vec<String>,
}

impl<J: Job> Session<J> {
    /// Starts a run in an empty folder; its wall time counts from `sat_down`. The observer is told of grains that come to
    /// rest first.
    ///
    /// # Errors
    /// [`RunError`] where the start fails or a file cannot be written.
    pub fn start(
        scenario: &Scenario,
        grains: Particles,
        folder: Folder,
        sat_down: Instant,
        observer: &mut Observer<'_>,
    ) -> Result<Self, RunError> {
        let end = scenario.time.end.si();
        let mut told = sat_down;
        let mut watch = |resting: &Resting| {
            if told.elapsed() < TELL_EVERY {
                return ControlFlow::Continue(());
            }
            told = Instant::now();
            observer(&coming_to_rest(resting, end))
        };
        let job = J::start(scenario, grains, &mut watch).map_err(RunError::Start)?;
        let head = format!(
            "# Resolved scenario of a run of agglo {}: every default is written out.\n",
            env!("CARGO_PKG_VERSION")
        );
        let text = scenario.to_toml()?;
        atomic::write(&folder.scenario(), (head + &text).as_bytes())?;
        let recorder = Recorder::create::<J>(scenario, &folder)?;
        let mut session = Self {
            scenario: scenario.clone(),
            folder,
            job,
            recorder,
            wall_before: 0.0,
            sat_down,
            told: sat_down,
            notes: Vec::new(),
        };
        session.recorder.record_due(&mut session.job)?;
        session.save()?;
        Ok(session)
    }

    /// Goes on from a checkpoint; `refused` are newer ones that are damaged.
    ///
    /// # Errors
    /// [`RunError`] where a file cannot be brought back to its state at that time.
    pub fn resume(folder: Folder, saved: Saved<J::State<'_>>, refused: &[Refused]) -> Result<Self, RunError> {
        let bad = |reason: String| RunError::BadCheckpoint { dir: folder.root().to_owned(), reason };
        let scenario = Scenario::from_toml(&saved.scenario).map_err(|faults| bad(faults.to_string()))?;
        let job = J::resume(&scenario, saved.state).map_err(|error| bad(error.to_string()))?;
        let recorder = Recorder::resume::<J>(&folder, saved.recorder)?;
        folder.sweep()?;
        let now = Instant::now();
        let passed_over =
            |damaged: &Refused| format!("a checkpoint is damaged and was passed over: {damaged}");
        Ok(Self {
            scenario,
            folder,
            job,
            recorder,
            wall_before: saved.wall_s,
            sat_down: now,
            told: now,
            notes: refused.iter().map(passed_over).collect(),
        })
    }

    /// Steps to the end, unless the observer asks to stop.
    ///
    /// # Errors
    /// [`RunError`] where a step fails or a file cannot be written.
    pub fn carry_on(self, observer: &mut Observer<'_>) -> Result<Ending, RunError> {
        let dir = self.folder.root().to_owned();
        self.steps(observer).map_err(|error| match error {
            RunError::Record(error) => RunError::CutShort { error, dir },
            other => other,
        })
    }

    fn steps(mut self, observer: &mut Observer<'_>) -> Result<Ending, RunError> {
        // What is known at the start is told even if the first step fails.
        if self.tell(observer).is_break() {
            return self.interrupted();
        }
        while !self.job.is_finished() {
            let stepped = self.job.advance(self.recorder.next_due());
            if let Err(error) = stepped {
                self.recorder.sync()?;
                return Err(RunError::Step { error, checkpoints: self.folder.checkpoints() });
            }
            self.recorder.record_due(&mut self.job)?;
            if self.recorder.checkpoint_is_due(&self.job.moment()) {
                self.save()?;
            }
            if self.told.elapsed() >= TELL_EVERY {
                self.recorder.flush()?;
                if self.tell(observer).is_break() {
                    return self.interrupted();
                }
            }
        }
        self.finish(observer)
    }

    fn interrupted(mut self) -> Result<Ending, RunError> {
        self.save()?;
        Ok(Ending::Interrupted(self.job.time()))
    }

    fn finish(mut self, observer: &mut Observer<'_>) -> Result<Ending, RunError> {
        self.recorder.record_end(&mut self.job, &self.folder)?;
        let summary = self.job.summary(&self.scenario, self.wall_s());
        let text = summary.to_json();
        self.notes.extend(self.recorder.merged());
        self.save()?;
        atomic::write(&self.folder.summary(), text.as_bytes())?;
        let _ = self.tell(observer);
        Ok(Ending::Finished(summary))
    }

    fn save(&mut self) -> Result<(), RunError> {
        self.recorder.sync()?;
        let saved = self.job.save(Saved {
            scenario: self.scenario.to_toml()?,
            state: (),
            recorder: self.recorder.state(),
            wall_s: self.wall_s(),
        });
        checkpoint::save(&self.folder.checkpoints(), self.job.step(), &saved)?;
        Ok(())
    }

    fn wall_s(&self) -> f64 {
        self.wall_before + self.sat_down.elapsed().as_secs_f64()
    }

    fn tell(&mut self, observer: &mut Observer<'_>) -> ControlFlow<()> {
        self.told = Instant::now();
        let mut warnings = std::mem::take(&mut self.notes);
        warnings.extend(self.job.fresh_warnings());
        let progress = Progress {
            time: self.job.time(),
            end: self.scenario.time.end.si(),
            step: self.job.step(),
            steps_are: self.job.steps_are(),
            now: self.job.now(),
            warnings,
        };
        observer(&progress)
    }
}
