//! Why a run ended early.

use std::path::PathBuf;

use thiserror::Error;

use crate::engine::SimError;
use crate::packing::PackingError;
use crate::record::RecordError;
use crate::scenario::Faults;

/// Why a run ended early.
#[derive(Debug, Error)]
pub enum RunError {
    /// The grains cannot be placed as the scenario asks.
    #[error(transparent)]
    Placement(#[from] PackingError),
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
    /// The folder holds a run already.
    #[error(
        "{} holds a run already; go on with it by `agglo resume {}`, or choose another folder with -o",
        dir.display(), dir.display()
    )]
    FolderInUse {
        /// The folder.
        dir: PathBuf,
    },
    /// There is no run to go on with.
    #[error("{} holds no run that can be resumed; start one with `agglo run SCENARIO -o {}`", dir.display(), dir.display())]
    NoRun {
        /// The folder.
        dir: PathBuf,
    },
    /// The run ended before its first checkpoint.
    #[error(
        "the run in {} was stopped before its first checkpoint; remove the folder and start again with `agglo run`",
        dir.display()
    )]
    NoCheckpointYet {
        /// The folder.
        dir: PathBuf,
    },
    /// The checkpoint's scenario cannot be read by this version.
    #[error("{}: the scenario of the checkpoint cannot be read: {reason}", dir.display())]
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
            Self::Placement(_)
            | Self::Scenario(_)
            | Self::FolderInUse { .. }
            | Self::NoRun { .. }
            | Self::NoCheckpointYet { .. } => 2,
            Self::Step { .. }
            | Self::Start(_)
            | Self::Quiet(_)
            | Self::Record(_)
            | Self::CutShort { .. }
            | Self::BadCheckpoint { .. } => 1,
        }
    }
}
