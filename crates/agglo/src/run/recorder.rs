//! When what is written. The recorder sees the simulation and never changes it.

use serde::{Deserialize, Serialize};

use crate::record::RecordError;
use crate::scenario::Scenario;

use super::folder::Folder;
use super::frames::{FrameLists, Frames};
use super::job::Job;
use super::tables::{Tables, TablesState};
use super::timers::Timers;

/// Where the recorder stands; a checkpoint holds it, so that files can be cut back to it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct RecorderState {
    timers: Timers,
    last_row: f64,
    tables: TablesState,
    frames: FrameLists,
}

/// Writes tables, frames and events.
#[derive(Debug)]
pub struct Recorder {
    timers: Timers,
    last_row: f64,
    tables: Tables,
    frames: Frames,
}

impl Recorder {
    /// Opens new files in the folder; the scenario is resolved.
    ///
    /// # Errors
    /// [`RecordError`] where a file cannot be made.
    pub fn create<J: Job>(scenario: &Scenario, folder: &Folder) -> Result<Self, RecordError> {
        Ok(Self {
            timers: Timers::new(&scenario.output),
            last_row: -1.0,
            tables: Tables::create(J::TABLES, folder.root())?,
            frames: Frames::new(&folder.frames(), FrameLists::default()),
        })
    }

    /// Opens the files of a run that goes on and cuts them back to the checkpoint.
    ///
    /// # Errors
    /// [`RecordError`] where a file is missing or shorter than it was.
    pub fn resume<J: Job>(folder: &Folder, state: RecorderState) -> Result<Self, RecordError> {
        Ok(Self {
            timers: state.timers,
            last_row: state.last_row,
            tables: Tables::resume(J::TABLES, folder.root(), &state.tables)?,
            frames: Frames::new(&folder.frames(), state.frames),
        })
    }

    /// Where the recorder stands; call [`Recorder::sync`] first.
    pub fn state(&self) -> RecorderState {
        RecorderState {
            timers: self.timers,
            last_row: self.last_row,
            tables: self.tables.state(),
            frames: self.frames.lists().clone(),
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
        let time = job.time();
        job.record_events(&mut self.tables)?;
        if self.timers.rows.is_due(time) {
            self.write_rows(job)?;
        }
        if self.timers.frames.is_due(time) {
            self.write_frame(job)?;
        }
        Ok(())
    }

    /// Writes the last row and frame, if they were not just written, and what is written once.
    ///
    /// # Errors
    /// [`RecordError`] where a file cannot be written.
    pub fn record_end<J: Job>(&mut self, job: &mut J, folder: &Folder) -> Result<(), RecordError> {
        let time = job.time();
        if self.last_row < time {
            self.write_rows(job)?;
        }
        if self.frames.last_time().is_none_or(|last| last < time) {
            self.write_frame(job)?;
        }
        job.record_end(folder)?;
        self.sync()
    }

    /// Whether a checkpoint is due at `time` [s].
    pub fn checkpoint_is_due(&mut self, time: f64) -> bool {
        self.timers.checkpoints.is_due(time)
    }

    /// Hands all rows to the operating system, for those who look at the tables while the run goes on.
    ///
    /// # Errors
    /// [`RecordError`] where a file cannot be written.
    pub fn flush(&mut self) -> Result<(), RecordError> {
        self.tables.flush()
    }

    /// Puts all rows onto the disk.
    ///
    /// # Errors
    /// [`RecordError`] where a file cannot be written.
    pub fn sync(&mut self) -> Result<(), RecordError> {
        self.tables.sync()
    }

    /// Writes a row in each table over time, due or not.
    ///
    /// # Errors
    /// [`RecordError`] where a file cannot be written.
    pub fn write_rows<J: Job>(&mut self, job: &mut J) -> Result<(), RecordError> {
        self.last_row = job.time();
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
