//! A dashpot that gives a chosen coefficient of restitution.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::contact::{Normal, PairConstants, Touch};

/// Damping from a restitution coefficient.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Restitution {
    /// Normal restitution e in [0, 1]; a pair of materials may have its own.
    pub restitution: f64,
}

impl Restitution {
    /// Dashpot coefficient [N s/m].
    #[inline]
    pub fn coefficient(&self, pair: &PairConstants, touch: &Touch, normal: &Normal) -> f64 {
        let ratio = damping_ratio(pair.restitution.unwrap_or(self.restitution));
        let n = normal.exponent();
        2.0 * ratio
            * ((n + 1.0) / (2.0 * n) * normal.tangent_stiffness(pair, touch) * touch.effective_mass).sqrt()
    }
}

/// beta = -ln e / sqrt(pi^2 + ln^2 e).
fn damping_ratio(restitution: f64) -> f64 {
    if restitution <= 0.0 {
        return 1.0;
    }
    let log = restitution.ln();
    -log / (std::f64::consts::PI.powi(2) + log * log).sqrt()
}
