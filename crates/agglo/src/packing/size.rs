//! How large grains are.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::units::Length;

/// The closed set of size distributions (by number).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Size {
    /// All the same.
    Constant(ConstantSize),
    /// Uniform between two radii.
    Uniform(UniformSize),
    /// Lognormal, cut at two radii.
    Lognormal(LognormalSize),
    /// Classes with their shares.
    Table(SizeTable),
}

/// All grains of one radius.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ConstantSize {
    /// The radius.
    pub radius: Length,
}

/// Radii uniform between two bounds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UniformSize {
    /// Smallest radius.
    pub smallest: Length,
    /// Largest radius.
    pub largest: Length,
}

/// Lognormal radii.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LognormalSize {
    /// Median radius (the geometric mean).
    pub median: Length,
    /// Geometric standard deviation, above 1.
    pub geometric_deviation: f64,
    /// Smallest radius.
    pub smallest: Length,
    /// Largest radius.
    pub largest: Length,
}

/// Classes of radii with their shares by number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SizeTable {
    /// Radii of the classes.
    pub radii: Vec<Length>,
    /// Shares by number, of any sum.
    pub shares: Vec<f64>,
}
