//! Any error of the library, for programs that hand all of them on.

use thiserror::Error;

use crate::engine::SimError;
use crate::engine::hard::EmbeddedError;
use crate::folder::FolderError;
use crate::hand_over::HandOverError;
use crate::packing::{PackingError, StartError, TableError};
use crate::record::RecordError;
use crate::run::RunError;
use crate::scenario::{Faults, LoadError};
use crate::search::campaign::CampaignError;
use crate::units::UnitError;

/// Why something of this library could not be done. Each part has an error of its own, which says more; all of them become
/// this one by `?`.
///
/// # Example
/// ```
/// fn grains(text: &str) -> Result<usize, agglo::Error> {
///     let scenario = agglo::scenario::Scenario::from_toml(text)?;
///     Ok(agglo::packing::place(&scenario, std::path::Path::new(""))?.len())
/// }
/// let error = grains("version = 1").unwrap_err();
/// assert_eq!(error.exit_code(), 2);
/// assert!(error.to_string().contains("engine"));
/// ```
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A text has faults.
    #[error(transparent)]
    Faults(#[from] Faults),
    /// A file could not be read, or has faults.
    #[error(transparent)]
    Load(#[from] LoadError),
    /// A quantity was not understood.
    #[error(transparent)]
    Unit(#[from] UnitError),
    /// A table of grains was not understood.
    #[error(transparent)]
    Table(#[from] TableError),
    /// Grains could not be placed.
    #[error(transparent)]
    Packing(#[from] PackingError),
    /// A run could not start.
    #[error(transparent)]
    Start(#[from] StartError),
    /// A simulation cannot go on.
    #[error(transparent)]
    Simulation(#[from] SimError),
    /// Grains of a flow could not be taken, or not stepped.
    #[error(transparent)]
    Embedded(#[from] EmbeddedError),
    /// A file of a run could not be written or read.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// A folder cannot be used.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// A run ended early.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A run could not be handed over.
    #[error(transparent)]
    HandOver(#[from] HandOverError),
    /// A search or study ended early.
    #[error(transparent)]
    Campaign(#[from] CampaignError),
}

impl Error {
    /// What a program ends with: 2 where the input has to change, 1 where something failed on the way.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Faults(_)
            | Self::Load(_)
            | Self::Unit(_)
            | Self::Table(_)
            | Self::Packing(_)
            | Self::Start(_)
            | Self::Embedded(_) => 2,
            Self::Simulation(_) | Self::Record(_) => 1,
            Self::Folder(error) => error.exit_code(),
            Self::Run(error) => error.exit_code(),
            Self::HandOver(error) => error.exit_code(),
            Self::Campaign(error) => error.exit_code(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn its_exit_code_is_that_of_what_went_wrong() {
        let failed = SimError::StoppedAtRest;
        assert_eq!(Error::from(RunError::Start(failed.clone())).exit_code(), 1);
        assert_eq!(Error::from(failed).exit_code(), 1);
        let taken = FolderError::InUse { dir: "run".into() };
        assert_eq!(Error::from(RunError::Folder(taken)).exit_code(), 2);
    }
}
