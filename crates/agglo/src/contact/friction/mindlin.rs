//! Mindlin / Cundall-Strack friction: a tangential spring that is kept per contact.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::contact::PairConstants;
use crate::math::Vec3;

/// A tangential spring with Coulomb's limit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mindlin {
    /// Static friction coefficient.
    pub static_friction: f64,
    /// Dynamic friction coefficient; as static if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dynamic_friction: Option<f64>,
    /// Tangential over normal stiffness; Mindlin's 2 (1-ν)/(2-ν) of the materials if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness_ratio: Option<f64>,
    /// Tangential dashpot over the normal one.
    #[serde(default)]
    pub dashpot: f64,
}

/// What a contact remembers: the force of its tangential spring and the stiffness it was loaded with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TangentialSpring {
    /// Force on i [N].
    pub force: Vec3,
    /// Stiffness [N/m] at that moment.
    pub stiffness: f64,
}

impl TangentialSpring {
    /// Energy stored [J].
    pub fn energy(&self) -> f64 {
        if self.stiffness > 0.0 { 0.5 * self.force.norm_squared() / self.stiffness } else { 0.0 }
    }
}

/// What the law needs to know of the contact over one step.
pub struct Sliding {
    /// Unit normal from i to j at the end of the step.
    pub normal: Vec3,
    /// Displacement of j's surface relative to i's over the step, tangential [m].
    pub displacement: Vec3,
    /// Velocity of j's surface relative to i's at the end of the step, tangential [m/s].
    pub velocity: Vec3,
    /// Slope of the normal force over the overlap [N/m].
    pub normal_stiffness: f64,
    /// Normal dashpot [N s/m].
    pub normal_dashpot: f64,
    /// Normal force [N], repulsion > 0.
    pub normal_force: f64,
}

impl Mindlin {
    /// The force on i [N] and the spring to remember.
    #[inline]
    pub fn advance(
        &self,
        pair: &PairConstants,
        before: &TangentialSpring,
        sliding: &Sliding,
    ) -> (Vec3, TangentialSpring) {
        let stiffness = self.stiffness_ratio.unwrap_or(pair.tangential_ratio) * sliding.normal_stiffness;
        let mut carried = before.force.rejected_from(sliding.normal);
        let (old, new) = (before.force.norm_squared(), carried.norm_squared());
        if new > 0.0 {
            carried *= (old / new).sqrt();
        }
        if stiffness < before.stiffness {
            carried *= stiffness / before.stiffness;
        }
        let spring = carried + sliding.displacement * stiffness;
        let damping = sliding.velocity * (self.dashpot * sliding.normal_dashpot);
        let load = sliding.normal_force.max(0.0);
        let trial = spring + damping;
        let size = trial.norm();
        let at_rest = pair.static_friction.unwrap_or(self.static_friction);
        if size <= at_rest * load {
            return (trial, TangentialSpring { force: spring, stiffness });
        }
        let in_motion = pair.dynamic_friction.or(self.dynamic_friction).unwrap_or(at_rest);
        let force = trial * (in_motion * load / size);
        (force, TangentialSpring { force, stiffness })
    }
}
