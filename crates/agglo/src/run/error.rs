//! Why a run ended early.

use std::path::PathBuf;

use thiserror::Error;

use crate::engine::SimError;
use crate::folder::FolderError;
use crate::folder::names::SCENARIO;
use crate::packing::StartError;
use crate::record::RecordError;
use crate::scenario::Faults;
use crate::text::readable;

/// Why a run ended early.
#[derive(Debug, Error)]
pub enum RunError {
    /// The grains cannot be placed as the scenario asks.
    #[error(transparent)]
    Placement(#[from] StartError),
    /// A step failed.
    #[error("{error}\nThe last good checkpoint is kept in {}.", checkpoints.display())]
    Step {
        /// What went wrong.
        error: SimError,
        /// Where the checkpoints are.
        checkpoints: PathBuf,
    },
    /// The start failed before anything was written.
    #[error(transparent)]
    Start(SimError),
    /// A step of a run without a folder failed.
    #[error(transparent)]
    Quiet(SimError),
    /// A file could not be written or read.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// A run was cut short because a file could not be written.
    #[error(
        "{error}\nThe last good checkpoint is kept; once the cause is put right, `agglo resume {}` goes on from it.",
        dir.display()
    )]
    CutShort {
        /// What went wrong.
        error: RecordError,
        /// The run's folder.
        dir: PathBuf,
    },
    /// The scenario has faults or cannot be written down.
    #[error("the scenario has faults:\n{0}")]
    Scenario(#[from] Faults),
    /// The folder cannot be used.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// The run ended before its first checkpoint.
    #[error(
        "the run in {} was stopped before its first checkpoint; remove the folder and start again with `agglo run`",
        dir.display()
    )]
    NoCheckpointYet {
        /// The folder.
        dir: PathBuf,
    },
    /// It was asked to stop before a run began or went on.
    #[error("stopped {0}")]
    StoppedBefore(&'static str),
    /// A run has come farther than it is to go.
    #[error("--until {}: the run in {} has come to {} already; give a later time", readable(*until, "s"), dir.display(), readable(*reached, "s"))]
    Until {
        /// The run's folder.
        dir: PathBuf,
        /// The end that was asked for [s].
        until: f64,
        /// Where it is [s].
        reached: f64,
    },
    /// The folder of a run that goes on is no longer there, or no longer its own.
    #[error(
        "{} was removed or taken over while the run wrote into it ({error}): nothing of this run is left to go on from",
        dir.display()
    )]
    Gone {
        /// The run's folder.
        dir: PathBuf,
        /// What could not be done.
        error: RecordError,
    },
    /// The folder's scenario cannot be read.
    #[error("cannot go on: {} {reason}\nhelp: it says what is run; put it back as it was", path.display())]
    ScenarioLost {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// The folder's scenario is not what its checkpoints are of.
    #[error(
        "cannot go on: {0}/{SCENARIO} was edited, or its checkpoints are of another run; they have {keys}\n\
         help: put the file back as it was; `agglo resume {0} --until \"40 s\"` goes on to another end, and \
         `agglo run {0}/{SCENARIO} -o ANOTHER` runs what the file says now",
        dir.display(), SCENARIO = SCENARIO
    )]
    Edited {
        /// The run's folder.
        dir: PathBuf,
        /// The keys that differ, with both values.
        keys: String,
    },
    /// The guests of a run cannot be.
    #[error("{reason}")]
    Guests {
        /// Which, why, and what can be.
        reason: String,
    },
    /// A run is to go on with other guests than it began with.
    #[error(
        "cannot go on: the run in {} began with {began}, and is to go on with {given}\n\
         help: its results would be others; go on with the same: `agglo::run::resume_with` in Rust, in Python `agglo.resume` \
         with force, measures and stop",
        dir.display()
    )]
    OtherGuests {
        /// The run's folder.
        dir: PathBuf,
        /// Those of the run.
        began: String,
        /// Those that are there now.
        given: String,
    },
    /// Somebody who measures could not, at the first look: the run did not begin.
    #[error("{reason}\nNothing was written.")]
    FirstLook {
        /// Why.
        reason: String,
    },
    /// Somebody who measures could not.
    #[error(
        "{reason}\nA checkpoint is kept in {}; once the cause is put right, the run goes on from there.",
        checkpoints.display()
    )]
    Look {
        /// Why.
        reason: String,
        /// Where the checkpoints are.
        checkpoints: PathBuf,
    },
    /// The checkpoint holds what no run has come to.
    #[error("{}: the checkpoint cannot be gone on from: {reason}", dir.display())]
    BadCheckpoint {
        /// The run's folder.
        dir: PathBuf,
        /// Why.
        reason: String,
    },
}

impl RunError {
    /// Exit code of the program: 1 for a run that failed, 2 for bad input.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Folder(error) => error.exit_code(),
            Self::Placement(_)
            | Self::Scenario(_)
            | Self::NoCheckpointYet { .. }
            | Self::ScenarioLost { .. }
            | Self::Until { .. }
            | Self::Guests { .. }
            | Self::OtherGuests { .. }
            | Self::Edited { .. } => 2,
            Self::Step { .. }
            | Self::Start(_)
            | Self::Quiet(_)
            | Self::StoppedBefore(_)
            | Self::FirstLook { .. }
            | Self::Look { .. }
            | Self::Gone { .. }
            | Self::Record(_)
            | Self::CutShort { .. }
            | Self::BadCheckpoint { .. } => 1,
        }
    }
}
