//! The partners of an impact, and what it comes to.

use serde::{Deserialize, Serialize};

use crate::math::Vec3;

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
