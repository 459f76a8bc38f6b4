//! Parallel-bond beam: an elastic disc of cement between two grains (Potyondy and Cundall 2004).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::math::Vec3;
use crate::units::Pressure;

/// Cement between grains that carries tension, shear, bending and twisting, and breaks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Beam {
    /// Young's modulus of the cement; normal stiffness per area is this over the bond's length.
    pub youngs_modulus: Pressure,
    /// Shear over normal stiffness per area.
    #[serde(default = "default_shear_ratio")]
    pub shear_ratio: f64,
    /// Radius of the disc over the smaller grain's radius.
    #[serde(default = "one")]
    pub radius_ratio: f64,
    /// Tensile strength.
    pub tensile_strength: Pressure,
    /// Shear strength.
    pub shear_strength: Pressure,
    /// Grains whose surfaces are closer than this part of the smaller radius are bonded at the start.
    #[serde(default = "default_gap")]
    pub gap: f64,
    /// Overlap strain at which two grains bond during the run; never if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub forming_strain: Option<f64>,
    /// Part of critical damping in each of the bond's four modes.
    #[serde(default)]
    pub damping_ratio: f64,
}

fn default_shear_ratio() -> f64 {
    0.4
}
fn one() -> f64 {
    1.0
}
fn default_gap() -> f64 {
    1e-3
}

/// What a bond remembers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BeamState {
    /// Distance of the centres [m] when the bond was made: no normal force there.
    pub length: f64,
    /// Radius of the disc [m].
    pub radius: f64,
    /// Shear force on i [N].
    pub shear: Vec3,
    /// Bending moment on i [N m].
    pub bending: Vec3,
    /// Twisting moment on i about the normal [N m].
    pub twist: f64,
    /// Normal of the step before, from i to j.
    pub normal: Vec3,
}

/// Forces and moments [N, N m] of a bond on its two grains.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BeamLoad {
    /// Force on i; on j the opposite.
    pub force: Vec3,
    /// Moment on i about its centre.
    pub moment_i: Vec3,
    /// Moment on j about its centre.
    pub moment_j: Vec3,
    /// Tension over tensile strength: breaks at 1.
    pub tensile_use: f64,
    /// Shear over shear strength: breaks at 1.
    pub shear_use: f64,
    /// Power lost in the bond's dashpots [W].
    pub damping_power: f64,
}

/// How a bond broke.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Break {
    /// The tensile strength was reached.
    Tension,
    /// The shear strength was reached.
    Shear,
}
