//! A run looked at from outside while it goes on: what its folder tells so far.
//!
//! Nothing but the folder is read, and nothing is written. A run that is resumed cuts its tables back; they are read anew
//! then.

mod quantities;
mod tail;
#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};

pub use quantities::{Curve, Reading};

use agglo::folder::RunFolder;
use agglo::record::{RecordError, door};
use agglo::run::Summary;
use agglo::scenario::Scenario;

/// Why a folder cannot be followed.
#[derive(Debug, thiserror::Error)]
pub enum WatchError {
    /// The folder holds no run.
    #[error("{dir} holds no run: there is no {missing}", dir = .dir.display(), missing = .missing.display())]
    NoRun {
        /// The folder.
        dir: PathBuf,
        /// What should be there.
        missing: PathBuf,
    },
    /// The scenario in the folder cannot be read by this version.
    #[error("cannot read {path}: {reason}", path = .path.display())]
    Scenario {
        /// The file.
        path: PathBuf,
        /// Its faults.
        reason: String,
    },
    /// A file cannot be read.
    #[error(transparent)]
    Record(#[from] RecordError),
}

/// Follows the run in a folder.
#[derive(Debug)]
pub struct Follower {
    dir: PathBuf,
    title: String,
    end: f64,
    steps_are: &'static str,
    tables: quantities::Tables,
}

/// What the folder tells so far.
#[derive(Clone, Debug, Default)]
pub struct Sight {
    /// Simulated time [s] of the newest row.
    pub time: f64,
    /// Steps or events at the newest row.
    pub step: u64,
    /// Quantities of the newest row.
    pub quantities: Vec<Reading>,
    /// Curves over time.
    pub curves: Vec<Curve>,
    /// What the run came to, if it has finished.
    pub summary: Option<Summary>,
}

impl Follower {
    /// Opens the folder of a run, which may be going on or have finished.
    ///
    /// # Errors
    /// [`WatchError`] where it holds no run or a scenario of another version.
    pub fn open(dir: &Path) -> Result<Self, WatchError> {
        let folder = RunFolder::at(dir);
        let path = folder.scenario();
        if !path.is_file() {
            return Err(WatchError::NoRun { dir: dir.to_owned(), missing: path });
        }
        let text = door::read_text(&path, door::MOST_OF_A_TEXT).map_err(RecordError::file("read", &path))?;
        let scenario = Scenario::from_toml(&text)
            .map_err(|faults| WatchError::Scenario { path, reason: faults.to_string() })?;
        let is_hard = scenario.is_hard();
        let is_stepped = scenario.is_stepped();
        Ok(Self {
            title: scenario.title,
            end: scenario.time.end.si(),
            steps_are: if is_stepped { "steps" } else { "events" },
            tables: quantities::Tables::new(dir, is_hard),
            dir: dir.to_owned(),
        })
    }

    /// The folder.
    pub fn dir(&self) -> &Path {
        &self.dir
    }

    /// The scenario's title.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Simulated time at the end [s].
    pub fn end(&self) -> f64 {
        self.end
    }

    /// What steps are: "steps" or "events".
    pub fn steps_are(&self) -> &'static str {
        self.steps_are
    }

    /// Reads what is new.
    ///
    /// # Errors
    /// [`WatchError::Record`] where a table or the summary cannot be read.
    pub fn look(&mut self) -> Result<Sight, WatchError> {
        // Looked for first: what finished a moment later is seen the next time, and then with all rows.
        let summary = agglo::run::summary(&self.dir)?;
        self.tables.read()?;
        let newest = |column: &str| self.tables.newest("steps", column);
        Ok(Sight {
            time: newest("time_s").unwrap_or(0.0),
            step: newest("step").unwrap_or(0.0) as u64,
            quantities: self.tables.quantities(),
            curves: self.tables.curves(),
            summary,
        })
    }
}
