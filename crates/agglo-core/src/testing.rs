//! For the tests of this crate: scenarios, the types of the scenario file read without its checks; and what laws say of themselves.

use crate::acoustics::Medium;
use crate::law::{Context, Faults, Law, Sample};
use crate::packing::{Groups, PackingError};
use crate::particles::{Material, Particles};
use crate::units::Quantity;

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

/// Faults and notes of a law, a line each, in a crowd of one kind: balls of 1 mm, 0.01 g and 1 nC.
pub fn told_by(law: &impl Law) -> String {
    let material = Material { density: Quantity(2500.0), ..Material::default() };
    let sample = Sample { radius: 1e-3, mass: 1e-5, charge: 1e-9, material: &material };
    let context = Context {
        medium: &Medium::default(),
        groups: 1,
        largest_radius: 1e-3,
        is_charged: false,
        is_stepped: true,
        samples: vec![sample],
    };
    let mut faults = Faults::default();
    law.faults(&mut faults, &context);
    let faults = faults.found().iter().map(|fault| format!("{}: {}", fault.key, fault.message));
    faults.chain(law.notes(&context)).collect::<Vec<_>>().join("\n")
}
