//! What happens when two hard spheres meet. Laws here are pure: they are asked, and return an outcome with its energies;
//! the engine changes the state and keeps the ledger.
//!
//! Signs: the normal points from the first partner to the second; the approach speed is the part of the first
//! velocity less the second along it, above zero when they approach.

pub mod contact_area;
pub mod contact_time;
pub mod cooling;
mod decay;
pub mod fragmentation;
pub mod heat;
mod laws;
pub mod reaction_heat;
pub mod restitution;
pub mod self_gravity;
pub mod softening;
mod solve;
pub mod sticking;
pub mod tangential;
pub mod work;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use cooling::Cooling;
pub use fragmentation::{Draws, Fragmentation};
pub use heat::HeatBalance;
pub use laws::ImpactLaws;
pub use restitution::Restitution;
pub use sticking::Sticking;
pub use tangential::Tangential;

use crate::math::Vec3;

/// Laws of impact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Impact {
    /// Along the line of centers.
    pub restitution: Restitution,
    /// Across the line of centers; frictionless if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tangential: Option<Tangential>,
    /// What becomes of a pair with restitution 0.
    #[serde(default)]
    pub sticking: Sticking,
    /// How agglomerates break; they do not if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fragmentation: Option<Fragmentation>,
    /// Where lost energy goes.
    #[serde(default)]
    pub heat: HeatBalance,
    /// Cooling between impacts; none if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cooling: Option<Cooling>,
}

/// A partner of an impact, just before it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Body {
    /// Velocity [m/s].
    pub velocity: Vec3,
    /// Mass [kg].
    pub mass: f64,
    /// Radius [m].
    pub radius: f64,
    /// Temperature [K].
    pub temperature: f64,
    /// Heat capacity of the whole body, m C [J/K]; 0 where the material has none.
    pub heat_capacity: f64,
    /// Number of the material.
    pub material: u32,
    /// How many primary grains it is made of.
    pub primaries: u32,
}

/// What an impact comes to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outcome {
    /// Restitution e.
    pub restitution: f64,
    /// Whether the pair becomes one sphere. Its partners then have one velocity and, if neither breaks, merge.
    pub sticks: bool,
    /// Velocities after [m/s].
    pub velocities: [Vec3; 2],
    /// Temperatures after [K].
    pub temperatures: [f64; 2],
    /// Into how many fragments each breaks; 1 where it stays whole. Never more than its primaries.
    pub fragments: [u32; 2],
    /// Where the energy went.
    pub energy: ImpactEnergy,
    /// Iterations of the coupled solve.
    pub iterations: u32,
    /// Whether the solve ended within its tolerance (`fixed_point` may not) and no temperature would have fallen to zero
    /// or below (published options can); such a partner keeps its temperature and its heat is not booked.
    pub converged: bool,
}

/// Energies of an impact [J].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ImpactEnergy {
    /// Kinetic energy lost along the normal.
    pub normal: f64,
    /// Kinetic energy lost across it.
    pub tangential: f64,
    /// Heat of reaction, put in.
    pub reaction: f64,
    /// Energy of new surfaces, taken out.
    pub surface: f64,
    /// Heat that warmed the pair. In the consistent balance normal + tangential + reaction - surface; `published` differs.
    pub heat: f64,
}
