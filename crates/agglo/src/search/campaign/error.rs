//! Why a campaign ended early.

use std::path::PathBuf;

use thiserror::Error;

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
        "{error}\nAll starts that ended are kept; once the cause is put right, `agglo resume {}` goes on from there.",
        dir.display()
    )]
    CutShort {
        /// What went wrong.
        error: RecordError,
        /// The campaign's folder.
        dir: PathBuf,
    },
    /// The folder holds something already.
    #[error(
        "{} holds a campaign or a run already; go on with it by `agglo resume {}`, or choose another folder with -o",
        dir.display(), dir.display()
    )]
    FolderInUse {
        /// The folder.
        dir: PathBuf,
    },
    /// There is no campaign to go on with.
    #[error("{} holds no campaign that can be resumed: {reason}", dir.display())]
    NoCampaign {
        /// The folder.
        dir: PathBuf,
        /// Why.
        reason: String,
    },
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
    /// The run of the best candidate failed.
    #[error("the run of the best candidate failed: {0}")]
    BestRun(#[from] RunError),
}

impl CampaignError {
    /// Exit code of the program: 1 for a campaign that failed, 2 for bad input.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::FolderInUse { .. } | Self::NoCampaign { .. } | Self::Faulty(_) => 2,
            Self::Record(_) | Self::CutShort { .. } | Self::Hopeless { .. } | Self::BestRun(_) => 1,
        }
    }
}
