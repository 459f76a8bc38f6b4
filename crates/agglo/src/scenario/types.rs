//! What a scenario file can say. Defaults, the JSON schema and the resolved scenario derive from these types.

use std::collections::BTreeMap;
use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::acoustics::{Acoustics, Medium};
use crate::contact::closeness::touching;
use crate::contact::{Bonds, ContactLaws};
use crate::domain::Volume;
use crate::engine::Engine;
use crate::engine::soft::{Limits, Relaxation};
use crate::fields::Fields;
use crate::impact::Impact;
use crate::packing::GrainGroup;
use crate::particles::{Material, Mixture};
use crate::units::Time;

/// A whole scenario.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// Version of the file format: 1.
    pub version: u32,
    /// One line that says what it is.
    #[serde(default)]
    pub title: String,
    /// Seed of all random numbers: places, sizes, rays.
    #[serde(default = "one")]
    pub seed: u64,
    /// How long.
    pub time: TimeSpan,
    /// How time is stepped, and with it whether grains are soft or hard spheres.
    pub engine: Engine,
    /// Bounds on motion and overlap; soft spheres only.
    #[serde(default)]
    pub limits: Limits,
    /// The fluid around the grains; soft spheres only.
    #[serde(default)]
    pub medium: Medium,
    /// Materials by name.
    pub materials: BTreeMap<String, Material>,
    /// What pairs of materials have in common, where it differs from the laws.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub mixtures: Vec<Mixture>,
    /// Groups of grains; none where `start.from` brings them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub grains: Vec<GrainGroup>,
    /// What happens before the clock starts.
    #[serde(default)]
    pub start: Start,
    /// The control volume; hard spheres only, which need it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub volume: Option<Volume>,
    /// Laws of impact; hard spheres only, which need them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub impact: Option<Impact>,
    /// Laws of contact; soft spheres only. Grains pass through one another if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact: Option<ContactLaws>,
    /// What holds grains together; soft spheres only. Nothing if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bonds: Option<Bonds>,
    /// Forces on single grains and at a distance; soft spheres only.
    #[serde(default)]
    pub fields: Fields,
    /// Beams of sound; soft spheres only. None if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub acoustics: Option<Acoustics>,
    /// What is measured.
    #[serde(default)]
    pub measures: Measures,
    /// What is written, and how often.
    #[serde(default)]
    pub output: Output,
}

fn one() -> u64 {
    1
}

/// How long a run lasts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TimeSpan {
    /// Simulated time at the end, above 0.
    pub end: Time,
}

/// What happens before the clock starts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Start {
    /// The folder of a run, or one of its checkpoints, relative to the scenario's folder: the state in it is the start, with
    /// bonds and names. The clock starts at zero.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<PathBuf>,
    /// Lets the grains come to rest first; not if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relax: Option<Relaxation>,
}

/// What is measured besides the state.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Measures {
    /// Grains whose surfaces are no farther apart than this part of the smaller radius belong to one cluster. With
    /// 0, grains that are placed as touching are together or not by round-off.
    #[serde(default = "touching")]
    pub cluster_gap: f64,
}

impl Default for Measures {
    fn default() -> Self {
        Self { cluster_gap: touching() }
    }
}

/// What is written, and how often in simulated time; worked out from the run's length if left out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Output {
    /// Rows of the tables; a two-hundredth of the run if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub series: Option<Time>,
    /// Frames for ParaView; a fortieth of the run if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frames: Option<Time>,
    /// More often while rays fly: from each launch until no ray is left. Not if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pulses: Option<PulseOutput>,
    /// Whether frames have the bonds.
    #[serde(default = "yes")]
    pub bonds: bool,
    /// Whether frames have the rays in flight.
    #[serde(default = "yes")]
    pub rays: bool,
    /// Checkpoints; a twentieth of the run if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub checkpoints: Option<Time>,
}

/// How often besides, while rays fly; counted from each launch.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PulseOutput {
    /// Rows of the tables; as always if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub series: Option<Time>,
    /// Frames for ParaView; as always if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frames: Option<Time>,
}

fn yes() -> bool {
    true
}

impl Default for Output {
    fn default() -> Self {
        Self { series: None, frames: None, pulses: None, bonds: true, rays: true, checkpoints: None }
    }
}
