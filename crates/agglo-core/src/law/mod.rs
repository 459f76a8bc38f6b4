//! What a law says of itself: its word, what it reads of materials, what is wrong with its settings, what to keep in mind
//! of it. Those who check, plan, run and cite ask it here, and none of them knows a law by name.

#[macro_use]
mod family;
mod faults;

pub use faults::{Fault, Faults, HIGHEST_EXPONENT};

use crate::acoustics::Medium;
use crate::particles::Property;

/// A law as its file writes it.
///
/// All of it has a default: a law without settings, needs and doubts says nothing.
pub trait Law {
    /// Words of its settings that its page explains besides its own.
    const WORDS: &'static [&'static str] = &[];

    /// What it may read of a material, or of what two materials share.
    const READS: &'static [Property] = &[];

    /// What of that it reads with its settings.
    fn reads(&self) -> &'static [Property] {
        Self::READS
    }

    /// What it must find with every material in use.
    fn needs(&self) -> Needs {
        Needs::default()
    }

    /// What is wrong with its settings; keys are relative to the law's table.
    fn faults(&self, _: &mut Faults, _: &Surroundings<'_>) {}

    /// What a plan tells before a run: where the law does not hold, or is not what its name says.
    fn notes(&self, _: &Surroundings<'_>) -> Vec<String> {
        Vec::new()
    }

    /// Warnings that hold for a whole run: the law does not converge, or does not do what its name says.
    fn warnings(&self) -> &'static [&'static str] {
        &[]
    }
}

/// What a law must find with every material in use.
#[derive(Clone, Copy, Debug, Default)]
pub struct Needs {
    /// The properties.
    pub properties: &'static [Property],
    /// Setting of the law by which it needs them, such as "without stiffness_ratio"; empty if it always does.
    pub because: &'static str,
}

impl Needs {
    /// These, whatever the law's settings.
    pub const fn always(properties: &'static [Property]) -> Self {
        Self { properties, because: "" }
    }
}

/// What there is besides the law.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings<'a> {
    /// The fluid around the grains.
    pub medium: &'a Medium,
    /// How many groups of grains there are.
    pub groups: usize,
    /// Radius [m] of the largest grain, as far as it is known; 0 if it is not.
    pub largest_radius: f64,
    /// Whether a grain carries a charge.
    pub is_charged: bool,
    /// Whether the engine takes steps of its own, as that of soft spheres and the time-stepped one of hard spheres do.
    pub is_stepped: bool,
}

/// A law that a scenario has chosen, whatever its family.
pub trait Chosen {
    /// Path of its table in a scenario, such as `contact.normal.hertz`.
    fn key(&self) -> &'static str;

    /// What it may read of a material.
    fn reads(&self) -> &'static [Property];

    /// What it must find with every material in use.
    fn needs(&self) -> Needs;

    /// What is wrong with its settings; keys are paths in the scenario.
    fn faults(&self, faults: &mut Faults, around: &Surroundings<'_>);

    /// What a plan tells before a run.
    fn notes(&self, around: &Surroundings<'_>) -> Vec<String>;

    /// Warnings that hold for a whole run.
    fn warnings(&self) -> &'static [&'static str];
}

/// A law as its family lists it.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Path of its table in a scenario.
    pub key: &'static str,
    /// What it may read of a material.
    pub reads: &'static [Property],
}
