//! Attraction and repulsion between grains at a distance ([A] 28).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::units::{Energy, Length};

/// The near field: a law, and how far it is followed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NearField {
    /// The law.
    pub law: NearFieldLaw,
    /// Distance of centres beyond which it is left out; all pairs if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cutoff: Option<Length>,
}

/// The closed set of near-field laws.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum NearFieldLaw {
    /// a1 d^-b1 - a2 d^-b2.
    PowerPair(PowerPair),
    /// Electrostatic force between the grains' charges.
    Coulomb(Coulomb),
    /// Hamaker's force between spheres.
    VanDerWaals(VanDerWaals),
}

/// Two power laws; the coefficients are in SI units of whatever makes the force a force.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PowerPair {
    /// What the coefficients are multiplied with.
    pub scaling: Scaling,
    /// a1.
    pub attraction: f64,
    /// b1.
    pub attraction_exponent: f64,
    /// a2.
    pub repulsion: f64,
    /// b2.
    pub repulsion_exponent: f64,
}

/// What the coefficients of [`PowerPair`] scale with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Scaling {
    /// m_i m_j.
    Mass,
    /// Product of the surfaces.
    Surface,
    /// Product of the volumes.
    Volume,
    /// Product of the charges.
    Charge,
}

/// Coulomb's law.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Coulomb {
    /// Relative permittivity of the medium.
    #[serde(default = "one")]
    pub relative_permittivity: f64,
}

fn one() -> f64 {
    1.0
}

/// Hamaker's law.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VanDerWaals {
    /// Hamaker constant.
    pub hamaker: Energy,
    /// Smallest gap of the surfaces; closer ones feel the force of this gap.
    pub smallest_gap: Length,
}
