//! What a law says of itself: its word, what it reads of materials, what is wrong with its settings, what to keep in mind
//! of it. Those who check, plan, run and cite ask it here, and none of them knows a law by name.

#[macro_use]
mod family;
mod faults;

pub use faults::{Fault, Faults, HIGHEST_EXPONENT};

use crate::acoustics::Medium;
use crate::particles::{Material, Property};

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
    fn faults(&self, _: &mut Faults, _: &Context<'_>) {}

    /// What a plan tells before a run: where the law does not hold, or is not what its name says.
    fn notes(&self, _: &Context<'_>) -> Vec<String> {
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

/// A grain that there will be, on which a law can be tried.
#[derive(Clone, Copy, Debug)]
pub struct Sample<'a> {
    /// Radius [m].
    pub radius: f64,
    /// Mass [kg].
    pub mass: f64,
    /// Charge [C].
    pub charge: f64,
    /// What it is made of.
    pub material: &'a Material,
}

/// What there is besides the law.
#[derive(Clone, Debug)]
pub struct Context<'a> {
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
    /// The smallest and the largest grain of each group, as far as they are known.
    pub samples: Vec<Sample<'a>>,
}

/// A law that a scenario has chosen, whatever its family.
#[derive(Clone, Copy)]
pub struct Chosen<'a> {
    key: &'static str,
    /// Path of the table that its settings are in.
    table: &'static str,
    law: &'a dyn Told,
}

/// What [`Law`] says, of a law whose type is not known any more.
trait Told {
    fn reads(&self) -> &'static [Property];
    fn needs(&self) -> Needs;
    fn faults(&self, faults: &mut Faults, context: &Context<'_>);
    fn notes(&self, context: &Context<'_>) -> Vec<String>;
    fn warnings(&self) -> &'static [&'static str];
}

impl<L: Law> Told for L {
    fn reads(&self) -> &'static [Property] {
        Law::reads(self)
    }

    fn needs(&self) -> Needs {
        Law::needs(self)
    }

    fn faults(&self, faults: &mut Faults, context: &Context<'_>) {
        Law::faults(self, faults, context);
    }

    fn notes(&self, context: &Context<'_>) -> Vec<String> {
        Law::notes(self, context)
    }

    fn warnings(&self) -> &'static [&'static str] {
        Law::warnings(self)
    }
}

impl<'a> Chosen<'a> {
    /// A law whose table has this path in a scenario, such as `contact.normal.hertz`.
    pub(crate) fn new(key: &'static str, law: &'a impl Law) -> Self {
        Self { key, table: key, law }
    }

    /// The same, with settings in a table above the one that names the law.
    pub(crate) fn with_settings_in(self, table: &'static str) -> Self {
        Self { table, ..self }
    }

    /// Path of its table in a scenario.
    pub fn key(self) -> &'static str {
        self.key
    }

    /// What it reads of a material.
    pub fn reads(self) -> &'static [Property] {
        self.law.reads()
    }

    /// What it must find with every material in use.
    pub fn needs(self) -> Needs {
        self.law.needs()
    }

    /// What is wrong with its settings; keys are paths in the scenario.
    pub fn faults(self, faults: &mut Faults, context: &Context<'_>) {
        faults.under(self.table, |faults| self.law.faults(faults, context));
    }

    /// The same where the table that it is within is looked at already.
    pub(crate) fn faults_within(self, table: &str, faults: &mut Faults, context: &Context<'_>) {
        let path = self.table.strip_prefix(table).unwrap_or(self.table).trim_start_matches('.');
        faults.under(path, |faults| self.law.faults(faults, context));
    }

    /// What a plan tells before a run.
    pub fn notes(self, context: &Context<'_>) -> Vec<String> {
        self.law.notes(context)
    }

    /// Warnings that hold for a whole run.
    pub fn warnings(self) -> &'static [&'static str] {
        self.law.warnings()
    }
}

/// The one note of a law, where there is reason for it.
pub(crate) fn note_if(is_due: bool, note: &str) -> Vec<String> {
    is_due.then(|| note.to_owned()).into_iter().collect()
}

/// A law as its family lists it.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Path of its table in a scenario.
    pub key: &'static str,
    /// What it may read of a material.
    pub reads: &'static [Property],
}
