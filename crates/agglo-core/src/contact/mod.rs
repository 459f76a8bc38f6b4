//! Forces between two soft spheres in contact.
//!
//! Signs, once and for all: overlap > 0 in contact; the normal points from i to j; a normal force > 0 repels;
//! the tangential velocity is that of j's surface relative to i's, and friction acts along it on i.

pub mod bond;
pub mod closeness;
pub mod damping;
pub mod friction;
pub mod network;
pub mod normal;
pub mod pass;
mod touch;

#[cfg(test)]
pub(crate) mod check;
#[cfg(test)]
mod collision;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use bond::Bonds;
pub use damping::Damping;
pub use friction::Friction;
pub use normal::Normal;
pub use touch::{Touch, arms};

use crate::math::Pace;

/// The laws of contact of a scenario: what repels, what dissipates, what resists sliding.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContactLaws {
    /// The elastic repulsion along the line of centers.
    pub normal: Normal,
    /// The dissipation along the line of centers; none if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping: Option<Damping>,
    /// The resistance to sliding; none if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<Friction>,
}

impl ContactLaws {
    /// How fast the laws are in a contact with this overlap: along the line of centers or across it.
    pub fn pace(&self, pair: &PairConstants, touch: &Touch) -> Pace {
        let damping = self.damping.as_ref().map_or(Pace::NONE, |law| law.pace(pair, touch, &self.normal));
        let along = self.normal.pace(pair, touch) + damping;
        let across = match &self.friction {
            None => Pace::NONE,
            Some(Friction::Regularized(law)) => law.pace(touch),
            Some(Friction::Mindlin(law)) => {
                let (stiffness, mass) = (self.normal.pace(pair, touch).square, touch.effective_mass);
                law.pace(pair, touch, stiffness * mass, damping.rate * mass)
            }
        };
        along.max(across)
    }

    /// The laws without those that can outgrow the elastic contact: how fast the rest is at the deepest overlap holds
    /// for all others.
    #[must_use]
    pub fn bounded(&self) -> Self {
        let damping = self.damping.clone().filter(|law| !law.outgrows_contact());
        let friction = self.friction.clone().filter(|law| matches!(law, Friction::Mindlin(_)));
        Self { normal: self.normal.clone(), damping, friction }
    }
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
