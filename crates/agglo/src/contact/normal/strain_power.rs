//! Repulsion from the power of an overlap strain over the contact area ([A] 11-15).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::contact::{PairConstants, Touch};

/// F = K E^p A; K is the materials' `contact_stiffness`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StrainPower {
    /// Power p of the strain.
    #[serde(default = "two")]
    pub exponent: f64,
}

fn two() -> f64 {
    2.0
}

impl StrainPower {
    /// Repulsion [N].
    #[inline]
    pub fn force(&self, _: &PairConstants, touch: &Touch) -> f64 {
        let strain = touch.overlap / touch.radius_sum;
        let power = if self.exponent == 2.0 { strain * strain } else { strain.powf(self.exponent) };
        touch.stiffness * power * touch.area()
    }

    /// Energy stored [J].
    pub fn energy(&self, pair: &PairConstants, touch: &Touch) -> f64 {
        let _ = (pair, touch);
        unimplemented!("quadrature")
    }

    /// Slope of the force over the overlap [N/m].
    #[inline]
    pub fn tangent_stiffness(&self, pair: &PairConstants, touch: &Touch) -> f64 {
        self.force(pair, touch) * (self.exponent + 1.0) / touch.overlap
    }

    /// The force grows like overlap^(p+1), since the area grows like the overlap.
    pub fn exponent(&self) -> f64 {
        self.exponent + 1.0
    }
}
