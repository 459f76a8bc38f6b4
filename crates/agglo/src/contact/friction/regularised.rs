//! Regularised friction without memory ([A] 20-24).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::contact::PairConstants;
use crate::units::AreaStiffness;

/// Stick force K v A dt up to static friction, then dynamic friction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Regularised {
    /// Tangential compliance constant K.
    pub stiffness: AreaStiffness,
    /// Static friction coefficient.
    pub static_friction: f64,
    /// Dynamic friction coefficient.
    pub dynamic_friction: f64,
}

impl Regularised {
    /// Size of the friction force [N] along the relative tangential velocity.
    #[inline]
    pub fn force(&self, pair: &PairConstants, area: f64, slip_speed: f64, dt: f64, normal_force: f64) -> f64 {
        let stick = self.stiffness.si() * slip_speed * area * dt;
        let load = normal_force.abs();
        if stick < pair.static_friction.unwrap_or(self.static_friction) * load {
            stick
        } else {
            pair.dynamic_friction.unwrap_or(self.dynamic_friction) * load
        }
    }
}
