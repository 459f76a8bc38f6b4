//! The medium between the grains.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::units::{Density, Velocity, Viscosity};

/// The fluid around the grains.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Medium {
    /// Density.
    #[serde(default = "water_density")]
    pub density: Density,
    /// Speed of sound.
    #[serde(default = "water_sound_speed")]
    pub sound_speed: Velocity,
    /// Dynamic viscosity.
    #[serde(default = "water_viscosity")]
    pub viscosity: Viscosity,
}

fn water_density() -> Density {
    crate::units::Quantity(1000.0)
}
fn water_sound_speed() -> Velocity {
    crate::units::Quantity(1500.0)
}
fn water_viscosity() -> Viscosity {
    crate::units::Quantity(1e-3)
}

impl Default for Medium {
    fn default() -> Self {
        Self { density: water_density(), sound_speed: water_sound_speed(), viscosity: water_viscosity() }
    }
}
