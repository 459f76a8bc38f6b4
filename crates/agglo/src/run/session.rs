//! One session of a run: steps, records and checkpoints until the end, an error or a stop.

use std::fmt::Write as _;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use crate::engine::Start;
use crate::engine::soft::Resting;
use crate::folder::RunFolder;
use crate::record::atomic;
use crate::record::checkpoint::{self, Refused};
use crate::scenario::Scenario;
use crate::text::readable;

use super::guests::{Guests, Look, Onlooker};
use super::job::{Job, Saved};
use super::own;
use super::recorder::{Recorder, Reopened};
use super::summary::ends_in_words;
use super::{Ending, Observer, Progress, RunError};

/// How often the observer is told.
pub const TELL_EVERY: Duration = Duration::from_millis(100);

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

/// How a run goes on from a checkpoint.
pub struct Way {
    /// Whether it goes on to another end than before.
    pub is_new_end: bool,
    /// Newer checkpoints that were not taken.
    pub refused: Vec<Refused>,
}

/// One session of a run.
pub struct Session<'g, J> {
    scenario: Scenario,
    /// Ends [s] that the run had before it got a later one.
    ends_before: Vec<f64>,
    folder: RunFolder,
    job: J,
    recorder: Recorder,
    wall_before: f64,
    began: Instant,
    told: Instant,
    notes: Vec<String>,
    onlooker: Option<&'g mut dyn Onlooker>,
}

impl<'g, J: Job> Session<'g, J> {
    /// Starts a run in an empty folder; its wall time counts from `began`. The observer is told of grains that come to
    /// rest first. The guests are checked.
    ///
    /// # Errors
    /// [`RunError`] where the start fails or a file cannot be written.
    pub fn start(
        scenario: &Scenario,
        start: Start,
        folder: RunFolder,
        began: Instant,
        mut guests: Guests<'g>,
        observer: &mut Observer<'_>,
    ) -> Result<Self, RunError> {
        let end = scenario.time.end.si();
        let mut told = began;
        let mut watch = |resting: &Resting| {
            if told.elapsed() < TELL_EVERY {
                return ControlFlow::Continue(());
            }
            told = Instant::now();
            observer(&coming_to_rest(resting, end))
        };
        let (known, domains) = (guests.known(), guests.domains());
        let mut job = J::start(scenario, start, &mut watch).map_err(RunError::Start)?;
        guests.take_forces().map_or(Ok(()), |forces| job.attach(forces)).map_err(RunError::Start)?;
        job.spread(scenario, domains).map_err(RunError::Start)?;
        let mut onlooker = guests.onlooker;
        // A first look that fails leaves nothing behind, and the folder can be taken again.
        let first = onlooker.as_deref_mut().map(|onlooker| own::look(onlooker, &known, &job));
        let first = first.transpose().map_err(|reason| RunError::FirstLook { reason })?;
        write_scenario(scenario, &[], &folder)?;
        let recorder = Recorder::create(scenario, &folder, known)?;
        let notes = folder.warning().map(str::to_owned).into_iter().collect();
        let mut session = Self {
            scenario: scenario.clone(),
            ends_before: Vec::new(),
            folder,
            job,
            recorder,
            wall_before: 0.0,
            began,
            told: began,
            notes,
            onlooker,
        };
        session.recorder.record_due(&mut session.job)?;
        first.map_or(Ok(()), |look| session.take(&look))?;
        session.save()?;
        Ok(session)
    }

    /// Goes on from a checkpoint that its folder was held to, with the guests that it knows.
    ///
    /// # Errors
    /// [`RunError`] where a file cannot be brought back to its state at that time.
    pub fn resume(
        folder: RunFolder,
        saved: Saved<J::State<'_>>,
        tables: Reopened,
        way: &Way,
        mut guests: Guests<'g>,
    ) -> Result<Self, RunError> {
        let bad = |reason: String| RunError::BadCheckpoint { dir: folder.root().to_owned(), reason };
        let scenario = Scenario::from_toml(&saved.scenario).map_err(|faults| bad(faults.to_string()))?;
        let mut job = J::resume(&scenario, saved.state).map_err(|error| bad(error.to_string()))?;
        let attached = guests.take_forces().map_or(Ok(()), |forces| job.attach(forces));
        let attached = attached.and_then(|()| job.spread(&scenario, guests.domains()));
        attached.map_err(|error| RunError::Step { error, checkpoints: folder.checkpoints() })?;
        let onlooker = guests.onlooker;
        let sums_can_be = saved.wall_s >= 0.0 && saved.ends_before.iter().all(|end| *end > 0.0);
        let are_finite = saved.wall_s.is_finite() && saved.ends_before.iter().all(|end| end.is_finite());
        let odd = saved.recorder.fault(&scenario, &job.moment());
        if let Some(reason) = odd.or((!sums_can_be || !are_finite).then_some("its times cannot be")) {
            return Err(bad(reason.to_owned()));
        }
        folder.sweep()?;
        let recorder = Recorder::resume(&scenario, &folder, saved.recorder, tables)?;
        let now = Instant::now();
        let unguarded = folder.warning().map(str::to_owned);
        let passed_over = |refused: &Refused| format!("a checkpoint was passed over: {refused}");
        let notes = unguarded.into_iter().chain(way.refused.iter().map(passed_over)).collect();
        let (has_other_end, ends_before) = (!saved.ends_before.is_empty(), saved.ends_before);
        let wall_before = saved.wall_s;
        let (began, told) = (now, now);
        let mut session =
            Self { scenario, ends_before, folder, job, recorder, wall_before, began, told, notes, onlooker };
        if way.is_new_end {
            // Those with the end before would not belong to the folder's scenario.
            let newest = session.save()?;
            checkpoint::keep_only(&newest)?;
        }
        if has_other_end {
            write_scenario(&session.scenario, &session.ends_before, &session.folder)?;
        }
        Ok(session)
    }

    /// Steps to the end, unless the observer asks to stop.
    ///
    /// # Errors
    /// [`RunError`] where a step fails or a file cannot be written.
    pub fn carry_on(self, observer: &mut Observer<'_>) -> Result<Ending, RunError> {
        let dir = self.folder.root().to_owned();
        let folder = self.folder.clone();
        self.steps(observer).map_err(|error| match error {
            // Going on would come to the same.
            RunError::Record(error @ crate::record::RecordError::NotFinite { .. }) => RunError::Record(error),
            RunError::Record(error) if !folder.is_ours() || !folder.has_checkpoint() => {
                RunError::Gone { dir, error }
            }
            RunError::Record(error) => RunError::CutShort { error, dir },
            other => other,
        })
    }

    fn steps(mut self, observer: &mut Observer<'_>) -> Result<Ending, RunError> {
        // What is known at the start is told even if the first step fails.
        if self.tell(observer).is_break() {
            return self.interrupted();
        }
        // A look that failed is made up for.
        self.look()?;
        while !self.job.is_finished() && !self.recorder.own.is_over() {
            let stepped = self.job.advance(self.recorder.next_due());
            if let Err(error) = stepped {
                self.recorder.sync()?;
                return Err(RunError::Step { error, checkpoints: self.folder.checkpoints() });
            }
            self.recorder.record_due(&mut self.job)?;
            self.look()?;
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

    /// Lets the onlooker look, if a look is due. Where that fails there is a checkpoint that knows of it.
    fn look(&mut self) -> Result<(), RunError> {
        let known = self.recorder.own.known();
        let onlooker = self.onlooker.as_deref_mut().filter(|_| self.recorder.own.is_due());
        match onlooker.map(|onlooker| own::look(onlooker, known, &self.job)).transpose() {
            Ok(look) => look.map_or(Ok(()), |look| self.take(&look)),
            Err(reason) => {
                // One that is due now is this one.
                self.recorder.checkpoint_is_due(&self.job.moment());
                self.save()?;
                Err(RunError::Look { reason, checkpoints: self.folder.checkpoints() })
            }
        }
    }

    /// Takes in what a look came to.
    fn take(&mut self, look: &Look) -> Result<(), RunError> {
        let (time, is_over) = (self.job.time(), look.is_over && !self.job.is_finished());
        if is_over {
            let [now, end] = [time, self.scenario.time.end.si()].map(|time| readable(time, "s"));
            self.job.warn(&format!("ended at {now} by a rule of the caller, before its end at {end}"));
        }
        Ok(self.recorder.own.take(time, &look.values, is_over)?)
    }

    fn interrupted(mut self) -> Result<Ending, RunError> {
        self.save()?;
        Ok(Ending::Interrupted(self.job.time()))
    }

    fn finish(mut self, observer: &mut Observer<'_>) -> Result<Ending, RunError> {
        self.folder.hold_on()?;
        self.recorder.record_end(&mut self.job, &self.folder)?;
        self.look()?;
        let summary = self.job.summary(&self.scenario, self.wall_s()).that_went_on(&self.ends_before);
        let checkpoints = self.folder.checkpoints();
        let summary =
            summary.validated(self.job.time()).map_err(|error| RunError::Step { error, checkpoints })?;
        let text = summary.to_json();
        self.notes.extend(self.recorder.merged());
        self.save()?;
        atomic::write(&self.folder.summary(), text.as_bytes())?;
        let _ = self.tell(observer);
        Ok(Ending::Finished(summary))
    }

    fn save(&mut self) -> Result<PathBuf, RunError> {
        self.folder.hold_on()?;
        self.recorder.sync()?;
        let saved = self.job.save(Saved {
            scenario: self.scenario.to_toml()?,
            state: (),
            recorder: self.recorder.state(),
            ends_before: self.ends_before.clone(),
            wall_s: self.wall_s(),
        });
        Ok(checkpoint::save(&self.folder.checkpoints(), self.job.step(), &saved)?)
    }

    fn wall_s(&self) -> f64 {
        self.wall_before + self.began.elapsed().as_secs_f64()
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

/// Writes down what is run, and the ends that it had before.
fn write_scenario(scenario: &Scenario, ends_before: &[f64], folder: &RunFolder) -> Result<(), RunError> {
    let mut text = format!(
        "# Resolved scenario of a run of agglo {}: every default is written out.\n",
        env!("CARGO_PKG_VERSION")
    );
    if !ends_before.is_empty() {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "# The run went on (--until) beyond {}.", ends_in_words(ends_before));
    }
    text += &scenario.to_toml()?;
    Ok(atomic::write(&folder.scenario(), text.as_bytes())?)
}
