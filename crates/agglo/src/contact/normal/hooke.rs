//! Linear spring along the line of centres.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::contact::{PairConstants, Touch};
use crate::units::Stiffness;

/// A linear spring.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Hooke {
    /// Spring constant of every contact.
    pub stiffness: Stiffness,
}

impl Hooke {
    /// Repulsion [N].
    #[inline]
    pub fn force(&self, _: &PairConstants, touch: &Touch) -> f64 {
        self.stiffness.si() * touch.overlap
    }

    /// Energy stored [J].
    pub fn energy(&self, _: &PairConstants, touch: &Touch) -> f64 {
        0.5 * self.stiffness.si() * touch.overlap * touch.overlap
    }

    /// Slope of the force over the overlap [N/m].
    #[inline]
    pub fn tangent_stiffness(&self, _: &PairConstants, _: &Touch) -> f64 {
        self.stiffness.si()
    }

    /// The force grows like overlap.
    pub fn exponent(&self) -> f64 {
        1.0
    }
}
