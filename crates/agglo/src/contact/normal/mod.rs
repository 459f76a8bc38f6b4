//! Elastic laws along the line of centres.

mod hertz;
mod hooke;
mod strain_power;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use hertz::Hertz;
pub use hooke::Hooke;
pub use strain_power::StrainPower;

use super::{PairConstants, Touch};

/// The closed set of elastic normal laws.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Normal {
    /// Force from the power of a strain over the contact area ([A] 11-15).
    StrainPower(StrainPower),
    /// Hertz.
    Hertz(Hertz),
    /// Linear spring.
    Hooke(Hooke),
}

macro_rules! dispatch {
    ($self:ident, $law:ident => $call:expr) => {
        match $self {
            Normal::StrainPower($law) => $call,
            Normal::Hertz($law) => $call,
            Normal::Hooke($law) => $call,
        }
    };
}

impl Normal {
    /// Repulsion [N].
    #[inline]
    pub fn force(&self, pair: &PairConstants, touch: &Touch) -> f64 {
        dispatch!(self, law => law.force(pair, touch))
    }

    /// Energy stored [J]; the force is its slope over the overlap.
    pub fn energy(&self, pair: &PairConstants, touch: &Touch) -> f64 {
        dispatch!(self, law => law.energy(pair, touch))
    }

    /// Slope of the force over the overlap [N/m].
    #[inline]
    pub fn tangent_stiffness(&self, pair: &PairConstants, touch: &Touch) -> f64 {
        dispatch!(self, law => law.tangent_stiffness(pair, touch))
    }

    /// n where the force grows like overlap^n at small overlap.
    #[inline]
    pub fn exponent(&self) -> f64 {
        dispatch!(self, law => law.exponent())
    }
}
