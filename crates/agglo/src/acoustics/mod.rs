//! An acoustic pulse as thousands of rays: how it is launched, reflected and absorbed, and how it pushes grains.

mod beam;
mod flight;
pub mod fresnel;
mod medium;
mod ray_force;
mod tracer;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use beam::{Beam, Gaussian, Pattern, Profile, Pulses, RayStart, Strength, default_region};
pub use flight::{Flight, PulseCount, Ray};
pub use medium::Medium;
pub use ray_force::{Impulse, PublishedStep, RadiationPressure, RayForce};
pub use tracer::{Hit, Tracer};

use crate::domain::Region;

/// The acoustics of a scenario.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Acoustics {
    /// How a ray pushes the grain that it hits.
    pub force: RayForce,
    /// Rays live inside; a sphere about the grains and the beams' starts if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub region: Option<Region>,
    /// A ray whose power falls below this part of its first power is dropped (and counted); 0 follows all.
    #[serde(default)]
    pub truncation: f64,
    /// The beams.
    pub beams: Vec<Beam>,
}
