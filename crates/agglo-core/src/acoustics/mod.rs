//! An acoustic pulse as thousands of rays: how it is launched, reflected and absorbed, and how it pushes grains.

mod beam;
mod flight;
mod follow;
pub mod fresnel;
mod hit;
mod medium;
pub mod ray_force;
mod scene;
mod tally;
mod tracer;
mod wavelength;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use beam::{Beam, Gaussian, Pattern, Profile, Pulses, RayStart, Strength};
pub use flight::{BeamPower, FIRST_FACE, Flight, PulseCount, Ray};
pub use follow::{ALLOWANCE, Followed};
pub use hit::{Ends, Hit, NONE, Targets};
pub use medium::Medium;
pub use ray_force::{Impedance, Impulse, PublishedStep, RadiationPressure, RayForce};
pub use tracer::{MOST_PERIODS, Tracer};

use crate::domain::Region;
use crate::units::Length;

/// The acoustics of a scenario.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Acoustics {
    /// How a ray pushes the grain that it hits.
    pub force: RayForce,
    /// Where rays live; it must hold every beam's disc. If left out, a ray lives until it can hit no grain any
    /// more, wherever the grains go. Give one only where sound itself ends, at a vessel of your own making: rays
    /// that leave it are lost, also to grains outside, and then there is a warning.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub region: Option<Region>,
    /// A ray whose power falls below this part of its first power is dropped (and counted); 0 follows all.
    #[serde(default)]
    pub truncation: f64,
    /// A ray that bounced this often is dropped (and counted). Between touching grains a ray at a distance y beside
    /// the contact needs about y^(-3/4) bounces: 7e5 at 10 nm between grains of 1 m.
    #[serde(default = "most_bounces")]
    pub bounces: u32,
    /// A ray that has come so far is dropped (and counted apart), at most a million of the shortest edge across which space repeats itself. If
    /// left out, a thousand of the longest of these edges; where space does not repeat itself, rays end by themselves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub way: Option<Length>,
    /// The beams.
    pub beams: Vec<Beam>,
}

fn most_bounces() -> u32 {
    Ends::default().bounces
}

impl Acoustics {
    /// How its rays end.
    pub fn ends(&self) -> Ends {
        Ends {
            region: self.region.clone(),
            truncation: self.truncation,
            bounces: self.bounces,
            way: self.way.map_or(f64::INFINITY, Length::si),
        }
    }
}
