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
    /// Points come from a program outside, and there is none.
    #[error(
        "method.external: a program outside says which points are tried, and there is none here; lead the campaign by \
         `agglo.search` in Python, or take one of agglo's methods, such as cma_es"
    )]
    NoProposer,
    /// A program outside proposes points for a campaign that has a method.
    #[error(
        "found {found}; a campaign whose points come from a program outside has method.external, such as `campaign.led(200)` in \
         Python"
    )]
    OwnMethod {
        /// What it has, such as "method.cma_es".
        found: String,
    },
    /// A program outside proposes another point than in an earlier session.
    #[error(
        "evaluation {evaluation}: the program that leads this campaign proposes another point than in the session before, so \
         what is known of that one is of no use; seed it so that it proposes the same when it is told the same, or begin anew"
    )]
    OtherPoint {
        /// Number of the evaluation.
        evaluation: u64,
    },
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
            Self::Faulty(_)
            | Self::Parts(_)
            | Self::TooLarge(_)
            | Self::NoProposer
            | Self::OtherPoint { .. }
            | Self::OwnMethod { .. } => 2,
            Self::Record(_)
            | Self::CutShort { .. }
            | Self::Gone { .. }
            | Self::Hopeless { .. }
            | Self::BestRun(_) => 1,
        }
    }
}
