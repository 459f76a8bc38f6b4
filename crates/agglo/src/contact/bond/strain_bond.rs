//! Attraction beyond a critical overlap strain ([A] 25-26).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::contact::Touch;
use crate::units::{AreaStiffness, Pressure};

/// K_nb E^pb A towards the partner, and K_rb |v_t| A dt along the slip, while E >= E*.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StrainBond {
    /// K_nb.
    pub stiffness: Pressure,
    /// Power p_b of the strain.
    pub exponent: f64,
    /// K_rb.
    pub tangential_stiffness: AreaStiffness,
    /// E*: overlap strain from which the bond acts.
    pub threshold_strain: f64,
}

impl StrainBond {
    /// Whether the bond acts at this overlap.
    #[inline]
    pub fn acts(&self, touch: &Touch) -> bool {
        touch.overlap >= self.threshold_strain * touch.radius_sum
    }

    /// Attraction [N], zero below the threshold.
    #[inline]
    pub fn attraction(&self, touch: &Touch) -> f64 {
        if !self.acts(touch) {
            return 0.0;
        }
        let strain = touch.overlap / touch.radius_sum;
        let power = if self.exponent == 2.0 { strain * strain } else { strain.powf(self.exponent) };
        self.stiffness.si() * power * touch.area()
    }

    /// Energy [J] (negative: the bond attracts); zero at the threshold.
    pub fn energy(&self, touch: &Touch) -> f64 {
        let _ = touch;
        unimplemented!("quadrature from the threshold")
    }

    /// Tangential force [N] along the relative tangential velocity.
    #[inline]
    pub fn tangential(&self, touch: &Touch, slip_speed: f64, dt: f64) -> f64 {
        if self.acts(touch) { self.tangential_stiffness.si() * slip_speed * touch.area() * dt } else { 0.0 }
    }
}
