//! What is to be placed: groups of grains, and where they belong.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Placement, Size, VelocitySpread};
use crate::domain::Volume;
use crate::particles::Material;
use crate::units::{Charge, Frequency, Quantity, Temperature, Triple, Velocity};

/// Groups of grains to be placed one after another.
#[derive(Clone, Copy, Debug)]
pub struct Groups<'a> {
    /// The groups.
    pub groups: &'a [GrainGroup],
    /// Materials by name; a grain's number of its material is the index in this map.
    pub materials: &'a BTreeMap<String, Material>,
    /// Seed of all random numbers.
    pub seed: u64,
    /// What kind of spheres the grains are.
    pub kind: SphereKind<'a>,
}

impl<'a> Groups<'a> {
    /// The control volume, where there is one.
    pub fn volume(&self) -> Option<&'a Volume> {
        match self.kind {
            SphereKind::Soft { volume } => volume,
            SphereKind::Hard { volume, .. } => Some(volume),
        }
    }
}

/// What kind of spheres grains are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SphereKind<'a> {
    /// They may overlap, and be anywhere but beyond faces across which space repeats itself.
    Soft {
        /// The control volume, if there is one.
        volume: Option<&'a Volume>,
    },
    /// They may not overlap, and lie in the control volume.
    Hard {
        /// The control volume.
        volume: &'a Volume,
        /// Whether grains of an earlier run may have left a volume with antipodal faces, on their way back in.
        may_leave: bool,
    },
}

/// Grains of one material, with their sizes and places.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GrainGroup {
    /// Name of their material.
    pub material: String,
    /// How large.
    pub size: Size,
    /// Where.
    pub placement: Placement,
    /// Velocity of all.
    #[serde(default)]
    pub velocity: Triple<Velocity>,
    /// How velocities scatter about that; not at all if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity_spread: Option<VelocitySpread>,
    /// Angular velocity of all; `"1 Hz"` and `"1 rad/s"` both mean 1 rad/s.
    #[serde(default)]
    pub angular_velocity: Triple<Frequency>,
    /// Temperature of all: it sets the contact stiffness, or the hardness at the start.
    #[serde(default = "room_temperature")]
    pub temperature: Temperature,
    /// Electric charge of each.
    #[serde(default)]
    pub charge: Charge,
    /// Sign c of the near field: 1 or -1.
    #[serde(default = "positive")]
    pub polarity: f64,
}

fn room_temperature() -> Temperature {
    Quantity(300.0)
}
fn positive() -> f64 {
    1.0
}
