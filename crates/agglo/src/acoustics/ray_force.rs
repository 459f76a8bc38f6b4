//! How a ray pushes the grain that it hits ([A] 6-7, 18).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::units::Time;

/// The closed set of ray-force laws.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RayForce {
    /// [A] 7 for the duration of the pulse: the impulse of a hit does not depend on the step.
    Impulse(Impulse),
    /// [A] 7 for the one step in which the ray lands; does not converge.
    PublishedStep(PublishedStep),
    /// Momentum balance of the ray, for the duration of the pulse.
    RadiationPressure(RadiationPressure),
}

/// |F| = sqrt(I (1-R) rho_t c_t a_r) for the duration of the pulse.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Impulse {
    /// How long the pulse presses.
    pub duration: Time,
}

/// |F| = sqrt(I (1-R) rho_t c_t a_r) for one step of xi R / c.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PublishedStep {
    /// xi: part of a mean grain radius that a ray travels in one step.
    #[serde(default = "default_xi")]
    pub step_fraction: f64,
}

fn default_xi() -> f64 {
    0.1
}

/// F = (I/c)(d_in - R d_out) for the duration of the pulse.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RadiationPressure {
    /// How long the pulse presses.
    pub duration: Time,
}
