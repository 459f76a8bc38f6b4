//! What a search or study file can say. Defaults and the JSON schema derive from these types.

mod check;
mod read;
mod scalar;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use read::campaign_schema;
pub use scalar::Scalar;

use super::ensemble::Ensemble;
use super::optimizer::{Method, NelderMead};
use super::plan::Plan;
use crate::units::Time;

/// A whole search or study.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Campaign {
    /// Version of the file format: 1.
    pub version: u32,
    /// One line that says what it is.
    #[serde(default)]
    pub title: String,
    /// Seed of the proposals and of the random replicates.
    #[serde(default = "one")]
    pub seed: u64,
    /// The scenario that is varied.
    pub base: Base,
    /// Values of the scenario that are fixed for the whole campaign: `key.path=value`.
    #[serde(default)]
    pub settings: Vec<String>,
    /// What is varied.
    pub parameters: Vec<Parameter>,
    /// Keys that follow from the parameters.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub derived: Vec<Derived>,
    /// What parameters must keep to each other; candidates that do not are not run.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub constraints: Vec<Constraint>,
    /// What is made small or large: one, or two for a front. A study without any measures the first of `columns`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub objectives: Vec<Objective>,
    /// What the outcome must keep to.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub limits: Vec<Limit>,
    /// Further columns of the summary that the tables show.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub columns: Vec<String>,
    /// Of a study of hard spheres: whether kernels and breakage by size are wanted, over all replicates of a candidate. The base
    /// says by which classes: `output.size_classes`.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub kernels: bool,
    /// How many random replicates a candidate gets.
    #[serde(default)]
    pub ensemble: Ensemble,
    /// How the space is searched; of a search.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub method: Option<Method>,
    /// Improves the best candidate of the search; not if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub polish: Option<NelderMead>,
    /// What the whole search may take; as long as it needs if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub budget: Option<Budget>,
    /// What the best candidates are held to at the end; of a search.
    #[serde(default)]
    pub confirm: Confirm,
    /// Which values are tried; of a study.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plan: Option<Plan>,
}

fn one() -> u64 {
    1
}

/// The scenario that is varied.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Base {
    /// A scenario file, relative to this file.
    File(String),
    /// A scenario of `agglo new`.
    Template(String),
}

/// One thing that is varied.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Parameter {
    /// Short name for tables and formulas: letters, digits and underscores.
    pub name: String,
    /// Path of the scenario's key that it sets, such as `acoustics.beams.0.rays`; none if only formulas use it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub key: Option<String>,
    /// Which values it can have.
    pub range: Range,
}

/// Which values a parameter can have.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Range {
    /// Between two bounds.
    Linear(Bounds),
    /// Between two positive bounds, on a logarithmic scale.
    Log(Bounds),
    /// Whole numbers from one bound to the other.
    Whole(Bounds),
    /// One of a list: words, numbers or quantities.
    Choices(Vec<Scalar>),
}

/// The bounds of a range; a quantity in quotes with its unit, or a number where the key has none.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Bounds {
    /// The smallest value.
    pub lower: Scalar,
    /// The largest value.
    pub upper: Scalar,
}

/// A key that follows from the parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Derived {
    /// Path of the scenario's key that it sets.
    pub key: String,
    /// Its value in SI units, from the names of parameters in SI units and pi: `0.1*v`. Rounded for whole numbers.
    pub formula: String,
}

/// What parameters must keep to each other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Constraint {
    /// A formula of parameters, in SI units.
    pub formula: String,
    /// Its smallest value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_least: Option<f64>,
    /// Its largest value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_most: Option<f64>,
}

/// What is made small or large: a column of the summary, or a formula of columns and parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Objective {
    /// To be small.
    Minimize(String),
    /// To be large.
    Maximize(String),
}

/// What the mean outcome of a candidate must keep to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Limit {
    /// A column of the summary, or a formula of columns and parameters.
    pub formula: String,
    /// Its smallest value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_least: Option<f64>,
    /// Its largest value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_most: Option<f64>,
}

/// What a search may take.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Budget {
    /// Wall time of all sessions together. No candidates are begun for which, with the confirmation and the run of the best,
    /// there is no time left by the replicates so far.
    pub time: Time,
}

/// What the best candidates are held to at the end: replicates that the search has not seen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Confirm {
    /// How many of the best candidates; none with 0.
    pub candidates: u32,
    /// Fresh replicates for each.
    pub replicates: u32,
}

impl Default for Confirm {
    fn default() -> Self {
        Self { candidates: 6, replicates: 32 }
    }
}
