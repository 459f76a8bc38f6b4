//! Forces between two soft spheres in contact.
//!
//! Signs, once and for all: overlap > 0 in contact; the normal points from i to j; a normal force > 0 repels;
//! the tangential velocity is that of j's surface relative to i's, and friction acts along it on i.

pub mod bond;
pub mod damping;
pub mod friction;
pub mod normal;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use bond::Bonds;
pub use damping::Damping;
pub use friction::Friction;
pub use normal::Normal;

/// The laws of contact of a scenario: what repels, what dissipates, what resists sliding.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContactLaws {
    /// The elastic repulsion along the line of centres.
    pub normal: Normal,
    /// The dissipation along the line of centres; none if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping: Option<Damping>,
    /// The resistance to sliding; none if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<Friction>,
}

/// What two materials have in common in contact, worked out once per pair of materials.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PairConstants {
    /// E* [Pa]: 1/E* = (1-ν_i²)/E_i + (1-ν_j²)/E_j.
    pub effective_modulus: f64,
    /// Tangential over normal contact stiffness, 4 G*/E* (Mindlin).
    pub tangential_ratio: f64,
    /// Normal restitution [-] that this pair of materials has by itself, if any.
    pub restitution: Option<f64>,
    /// Static friction [-] that this pair of materials has by itself, if any.
    pub static_friction: Option<f64>,
    /// Dynamic friction [-] that this pair of materials has by itself, if any.
    pub dynamic_friction: Option<f64>,
}

/// The geometry and inertia of one touching pair, as the laws see it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Touch {
    /// δ = R_i + R_j - d [m], > 0.
    pub overlap: f64,
    /// R_i + R_j [m].
    pub radius_sum: f64,
    /// R* = R_i R_j / (R_i + R_j) [m].
    pub effective_radius: f64,
    /// m* = m_i m_j / (m_i + m_j) [kg].
    pub effective_mass: f64,
    /// Mean of the two grains' contact stiffness [Pa], softened by heat.
    pub stiffness: f64,
}

impl Touch {
    /// Two grains with centres `distance` apart.
    pub fn new(radii: [f64; 2], masses: [f64; 2], stiffness: [f64; 2], distance: f64) -> Self {
        let radius_sum = radii[0] + radii[1];
        Self {
            overlap: radius_sum - distance,
            radius_sum,
            effective_radius: radii[0] * radii[1] / radius_sum,
            effective_mass: masses[0] * masses[1] / (masses[0] + masses[1]),
            stiffness: 0.5 * (stiffness[0] + stiffness[1]),
        }
    }

    /// d = |r_j - r_i| [m].
    #[inline]
    pub fn distance(&self) -> f64 {
        self.radius_sum - self.overlap
    }

    /// Area A [m²] of the disc in which the two spheres cut each other ([A] 64-69).
    ///
    /// a² = R_i² - L_i² with L_i = (d - (R_j² - R_i²)/d)/2, written so that A = 0 at touching without
    /// cancellation: 4 d² a² = δ (2 (R_i + R_j) - δ) (4 R_i R_j - 2 (R_i + R_j) δ + δ²), from Heron's formula.
    #[inline]
    pub fn area(&self) -> f64 {
        let (sum, overlap, distance) = (self.radius_sum, self.overlap, self.distance());
        let product = self.effective_radius * sum;
        let spread = 4.0 * product - overlap * (2.0 * sum - overlap);
        let squares = overlap * (2.0 * sum - overlap) * spread;
        std::f64::consts::PI * squares.max(0.0) / (4.0 * distance * distance)
    }
}
