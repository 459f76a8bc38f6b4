//! Scenarios for the tests of this crate: the types of the scenario file, read without its checks.

use crate::packing::{Groups, PackingError};
use crate::particles::Particles;

#[path = "../../agglo/src/scenario/file.rs"]
mod file;
#[path = "../../agglo/src/scenario/spheres.rs"]
mod spheres;
#[path = "../../agglo/src/scenario/types.rs"]
mod types;

pub use types::*;

impl Scenario {
    /// Reads a scenario.
    pub fn from_toml(text: &str) -> Result<Self, toml::de::Error> {
        toml::from_str(text)
    }
}

/// Places the grains of a scenario without tables.
pub fn place<'a>(groups: impl Into<Groups<'a>>) -> Result<Particles, PackingError> {
    crate::packing::place(groups, &mut |table| Err(PackingError::Table(format!("{table:?}").into())))
}
