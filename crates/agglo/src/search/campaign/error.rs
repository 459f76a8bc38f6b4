//! Why a campaign ended early.

use std::path::PathBuf;

use thiserror::Error;

use crate::folder::FolderError;
use crate::packing::StartError;
use crate::record::RecordError;
use crate::run::RunError;
use crate::scenario::Faults;

/// Why a campaign ended early.
#[derive(Debug, Error)]
pub enum CampaignError {
    /// A file could not be written or read.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// A campaign was cut short because a file could not be written.
    #[error(
        "{error}\nAll replicates that ended are kept; once the cause is put right, `agglo resume {}` goes on from there.",
        dir.display()
    )]
    CutShort {
        /// What went wrong.
        error: RecordError,
        /// The campaign's folder.
        dir: PathBuf,
    },
    /// The folder of a campaign that goes on is no longer there, or no longer its own.
    #[error(
        "{} was removed or taken over while the campaign wrote into it ({error}): nothing of it is left to go on from",
        dir.display()
    )]
    Gone {
        /// What went wrong.
        error: RecordError,
        /// The campaign's folder.
        dir: PathBuf,
    },
    /// The folder cannot be used.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// No candidate could be evaluated.
    #[error(
        "none of {candidates} candidates could be evaluated: {failures} failed, {excluded} miss the constraints{first}"
    )]
    Hopeless {
        /// How many were tried.
        candidates: u64,
        /// How many failed.
        failures: u64,
        /// How many were not run.
        excluded: u64,
        /// The reason of the first failure, with a headline; empty if there is none.
        first: String,
    },
    /// The campaign or its base has faults.
    #[error("the campaign has faults:\n{0}")]
    Faulty(#[from] Faults),
    /// Parts of a study that cannot be made or put together.
    #[error("{0}")]
    Parts(String),
    /// The machine cannot hold the simulations.
    #[error("{0}")]
    TooLarge(StartError),
    /// The run of the best candidate failed.
    #[error("the run of the best candidate failed: {0}")]
    BestRun(#[from] RunError),
}

impl CampaignError {
    /// Exit code of the program: 1 for a campaign that failed, 2 for bad input.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Folder(error) => error.exit_code(),
            Self::Faulty(_) | Self::Parts(_) | Self::TooLarge(_) => 2,
            Self::Record(_)
            | Self::CutShort { .. }
            | Self::Gone { .. }
            | Self::Hopeless { .. }
            | Self::BestRun(_) => 1,
        }
    }
}
