//! When what is written. The recorder sees the simulation and never changes it.

use serde::{Deserialize, Serialize};

use crate::folder::RunFolder;
use crate::record::{Opened, RecordError};
use crate::scenario::Scenario;

use super::fit::Reading;
use super::frames::{FrameLists, Frames};
use super::guests::Known;
use super::job::Job;
use super::own::{Own, OwnState};
use super::tables::{Tables, TablesState};
use super::tables_of;
use super::timers::{Moment, ROUND_OFF, Timers};

/// The time of the last row before there is any [s].
const NO_ROW: f64 = -1.0;

/// How many rows and frames that were due fell into one with another, since one step passed both times.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
struct Merged {
    rows: u64,
    frames: u64,
}

/// Where the recorder stands; a checkpoint holds it, so that files can be cut back to it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct RecorderState {
    timers: Timers,
    last_row: f64,
    merged: Merged,
    tables: TablesState,
    frames: FrameLists,
    own: OwnState,
}

/// The tables of a run that is to go on, as its checkpoint left them and not yet cut.
#[derive(Debug)]
pub struct Reopened {
    tables: Vec<Opened>,
    own: Option<Opened>,
}

impl RecorderState {
    /// Opens the tables and holds them to the checkpoint; nothing is changed.
    ///
    /// # Errors
    /// [`RecordError`] where a table is missing, or not what it was.
    pub fn check_tables(&self, scenario: &Scenario, folder: &RunFolder) -> Result<Reopened, RecordError> {
        let tables = self.tables.check(&tables_of(scenario), folder.root())?;
        Ok(Reopened { tables, own: self.own.check(folder)? })
    }

    /// What is known of a caller's own measures and rule.
    pub fn own(&self) -> &OwnState {
        &self.own
    }

    /// What cannot be of a run of this scenario at this moment, if anything.
    pub fn fault(&self, scenario: &Scenario, now: &Moment) -> Option<&'static str> {
        // Before the first row there is a time that no row has.
        let last_row_can_be = self.last_row == NO_ROW || (0.0..=now.time).contains(&self.last_row);
        if !self.timers.stand(&scenario.output, now) {
            Some("its output is due at other times than the scenario says")
        } else if !last_row_can_be {
            Some("the time of its last row cannot be")
        } else {
            self.frames.fault(now.time).or(self.own.fault())
        }
    }

    /// Holds the frames to the checkpoint.
    ///
    /// # Errors
    /// Which is not what it was, and why.
    pub fn check_frames(&self, folder: &RunFolder, reading: &mut Reading<'_>) -> Result<(), String> {
        self.frames.check(folder, reading)
    }
}

/// Writes tables, frames and events.
#[derive(Debug)]
pub struct Recorder {
    timers: Timers,
    last_row: f64,
    merged: Merged,
    tables: Tables,
    frames: Frames,
    /// What a caller measures; who drives the run looks whenever that is due.
    pub own: Own,
}

impl Recorder {
    /// Opens new files in the folder, for these guests; the scenario is resolved.
    ///
    /// # Errors
    /// [`RecordError`] where a file cannot be made.
    pub fn create(scenario: &Scenario, folder: &RunFolder, guests: Known) -> Result<Self, RecordError> {
        Ok(Self {
            timers: Timers::new(&scenario.output),
            last_row: NO_ROW,
            merged: Merged::default(),
            tables: Tables::create(tables_of(scenario), folder.root())?,
            frames: Frames::new(folder, FrameLists::default()),
            own: Own::create(guests, folder)?,
        })
    }

    /// Opens the files of a run that goes on and cuts them back to the checkpoint.
    ///
    /// # Errors
    /// [`RecordError`] where a table cannot be cut.
    pub fn resume(
        scenario: &Scenario,
        folder: &RunFolder,
        state: RecorderState,
        opened: Reopened,
    ) -> Result<Self, RecordError> {
        Ok(Self {
            timers: state.timers,
            last_row: state.last_row,
            merged: state.merged,
            tables: Tables::resume(tables_of(scenario), opened.tables)?,
            frames: Frames::new(folder, state.frames),
            own: Own::resume(state.own, opened.own)?,
        })
    }

    /// Where the recorder stands; call [`Recorder::sync`] first.
    pub fn state(&self) -> RecorderState {
        RecorderState {
            timers: self.timers,
            last_row: self.last_row,
            merged: self.merged,
            tables: self.tables.state(),
            frames: self.frames.lists().clone(),
            own: self.own.state(),
        }
    }

    /// Time [s] at which the next thing is due.
    pub fn next_due(&self) -> f64 {
        self.timers.next()
    }

    /// Writes what is due.
    ///
    /// # Errors
    /// [`RecordError`] where a file cannot be written.
    pub fn record_due<J: Job>(&mut self, job: &mut J) -> Result<(), RecordError> {
        let now = job.moment();
        job.record_events(&mut self.tables)?;
        if let Some(merged) = self.timers.rows.take(&now) {
            self.merged.rows = self.merged.rows.saturating_add(merged);
            self.write_rows(job)?;
        }
        if let Some(merged) = self.timers.frames.take(&now) {
            self.merged.frames = self.merged.frames.saturating_add(merged);
            self.write_frame(job)?;
        }
        Ok(())
    }

    /// Writes the last row and frame, if they were not just written, and what is written once.
    ///
    /// # Errors
    /// [`RecordError`] where a file cannot be written.
    pub fn record_end<J: Job>(&mut self, job: &mut J, folder: &RunFolder) -> Result<(), RecordError> {
        // A due time that is the end but for round-off has been served.
        let before = job.time() * (1.0 - ROUND_OFF);
        if self.last_row < before || self.last_row < 0.0 {
            self.write_rows(job)?;
        }
        if self.frames.last_time().is_none_or(|last| last < before) {
            self.write_frame(job)?;
        }
        job.record_end(folder)?;
        self.sync()
    }

    /// Whether a checkpoint is due.
    pub fn checkpoint_is_due(&mut self, now: &Moment) -> bool {
        self.timers.checkpoints.take(now) > 0
    }

    /// In words, how much was due that steps were too long for.
    pub fn merged(&self) -> Option<String> {
        let Merged { rows, frames } = self.merged;
        let of = |count: u64, what: &str| (count > 0).then(|| format!("{count} {what}"));
        let parts: Vec<String> = [of(rows, "rows"), of(frames, "frames")].into_iter().flatten().collect();
        (!parts.is_empty()).then(|| {
            format!(
                "{} that were due fell into one with others: steps were longer than the intervals in [output]",
                parts.join(" and ")
            )
        })
    }

    /// Hands all rows to the operating system, for those who look at the tables while the run goes on.
    ///
    /// # Errors
    /// [`RecordError`] where a file cannot be written.
    pub fn flush(&mut self) -> Result<(), RecordError> {
        self.tables.flush()?;
        self.own.flush()
    }

    /// Puts all rows onto the disk.
    ///
    /// # Errors
    /// [`RecordError`] where a file cannot be written.
    pub fn sync(&mut self) -> Result<(), RecordError> {
        self.tables.sync()?;
        self.own.sync()
    }

    /// Writes a row in each table over time, due or not.
    ///
    /// # Errors
    /// [`RecordError`] where a file cannot be written.
    pub fn write_rows<J: Job>(&mut self, job: &mut J) -> Result<(), RecordError> {
        self.last_row = job.time();
        self.own.ask();
        job.record_rows(&mut self.tables)
    }

    /// Writes a frame, due or not.
    ///
    /// # Errors
    /// [`RecordError`] where a file cannot be written.
    pub fn write_frame<J: Job>(&mut self, job: &mut J) -> Result<(), RecordError> {
        job.record_frame(&mut self.frames)
    }
}

#[cfg(test)]
#[path = "recorder_tests.rs"]
mod tests;
