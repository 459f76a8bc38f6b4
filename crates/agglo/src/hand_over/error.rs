//! Why a run is not handed over.

use std::path::PathBuf;

use thiserror::Error;

use crate::record::RecordError;
use crate::scenario::Faults;

/// Why a run is not handed over.
#[derive(Debug, Error)]
pub enum HandOverError {
    /// There is no state to hand over.
    #[error("{}: {reason}", path.display())]
    Grown {
        /// The folder or the checkpoint.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// The state and the options do not go together.
    #[error("{0}")]
    Refused(String),
    /// The scenario that came out has faults.
    #[error("the scenario that came out has faults: {0}")]
    Faults(Faults),
    /// A file that would be written is there.
    #[error("{} is there already; remove it, or choose another name with -o", path.display())]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// A name that no scenario can have.
    #[error("{} is no name of a scenario; give one that ends with .toml, such as soft.toml", path.display())]
    Name {
        /// The name.
        path: PathBuf,
    },
    /// A file cannot be written.
    #[error(transparent)]
    Record(#[from] RecordError),
}

impl HandOverError {
    /// Exit code of the program: 2, but for trouble with the disk.
    pub fn exit_code(&self) -> u8 {
        if matches!(self, Self::Record(_)) { 1 } else { 2 }
    }
}
