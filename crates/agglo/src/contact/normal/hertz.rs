//! Hertz contact: elastic repulsion of two smooth spheres.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::contact::{PairConstants, Touch};

/// Hertz contact; its only constants are the materials' Young's moduli and Poisson's ratios.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Hertz {}

impl Hertz {
    /// Repulsion [N].
    #[inline]
    pub fn force(&self, pair: &PairConstants, touch: &Touch) -> f64 {
        4.0 / 3.0 * pair.effective_modulus * (touch.effective_radius * touch.overlap).sqrt() * touch.overlap
    }

    /// Energy stored [J].
    pub fn energy(&self, pair: &PairConstants, touch: &Touch) -> f64 {
        0.4 * touch.overlap * self.force(pair, touch)
    }

    /// Slope of the force over the overlap [N/m].
    #[inline]
    pub fn tangent_stiffness(&self, pair: &PairConstants, touch: &Touch) -> f64 {
        2.0 * pair.effective_modulus * (touch.effective_radius * touch.overlap).sqrt()
    }

    /// The force grows like overlap^1.5.
    pub fn exponent(&self) -> f64 {
        1.5
    }
}
