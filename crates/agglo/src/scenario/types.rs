//! What a scenario says, each kind of spheres with its own settings.

use std::collections::BTreeMap;
use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::file::ScenarioFile;
use crate::acoustics::{Acoustics, Medium};
use crate::contact::closeness::touching;
use crate::contact::{Bonds, ContactLaws};
use crate::domain::{Space, Volume};
use crate::engine::hard::Driver;
use crate::engine::soft::{Limits, Relaxation, Scheme};
use crate::fields::Fields;
use crate::impact::Impact;
use crate::measure::SizeClasses;
use crate::packing::GrainGroup;
use crate::particles::{Material, Mixture};
use crate::units::Time;
use crate::walls::Wall;

/// A whole scenario.
///
/// What only one kind of spheres knows is in [`Engine`]. A file says all tables side by side: what belongs to the other kind is a
/// fault there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "ScenarioFile", into = "ScenarioFile")]
pub struct Scenario {
    /// Version of the file format: 1.
    pub version: u32,
    /// One line that says what it is.
    pub title: String,
    /// Seed of all random numbers: places, sizes, rays.
    pub seed: u64,
    /// How long.
    pub time: TimeSpan,
    /// The kind of spheres, how time is stepped, and the laws.
    pub engine: Engine,
    /// The fluid around the grains; hard spheres do not feel it.
    pub medium: Medium,
    /// Materials by name.
    pub materials: BTreeMap<String, Material>,
    /// What pairs of materials have in common, where it differs from the laws.
    pub mixtures: Vec<Mixture>,
    /// Groups of grains; none where they come out of an earlier run.
    pub grains: Vec<GrainGroup>,
    /// The folder of a run, or one of its checkpoints, relative to the scenario's folder: the state in it is the start, with
    /// bonds and names. The clock starts at zero.
    pub from: Option<PathBuf>,
    /// What is measured.
    pub measures: Measures,
    /// What is written, and how often.
    pub output: Output,
}

/// The kind of spheres, with what only this kind has.
#[derive(Clone, Debug, PartialEq)]
pub enum Engine {
    /// Grains that overlap where they touch, and push each other apart over the time of a contact.
    Soft(Box<SoftSpheres>),
    /// Grains that collide in no time.
    Hard(Box<HardSpheres>),
}

/// What a scenario says of soft spheres alone.
#[derive(Clone, Debug, PartialEq)]
pub struct SoftSpheres {
    /// How time is stepped.
    pub scheme: Scheme,
    /// Bounds on motion and overlap.
    pub limits: Limits,
    /// Lets the grains come to rest before the clock starts; not if left out.
    pub relax: Option<Relaxation>,
    /// The control volume, across whose faces space may repeat itself; open space if left out.
    pub volume: Option<Volume>,
    /// A table of the grains that are bonded, relative to the scenario's folder; neighbors are if left out.
    pub bonded: Option<PathBuf>,
    /// Walls.
    pub walls: Vec<Wall>,
    /// Laws of contact; grains pass through one another without them.
    pub contact: Option<ContactLaws>,
    /// What holds grains together.
    pub bonds: Option<Bonds>,
    /// Forces on single grains and at a distance.
    pub fields: Fields,
    /// Beams of sound.
    pub acoustics: Option<Acoustics>,
}

/// What a scenario says of hard spheres alone.
#[derive(Clone, Debug, PartialEq)]
pub struct HardSpheres {
    /// What drives time.
    pub driver: Driver,
    /// The control volume.
    pub volume: Volume,
    /// Laws of impact.
    pub impact: Impact,
}

impl Scenario {
    /// Whether its spheres are hard.
    pub fn is_hard(&self) -> bool {
        self.hard().is_some()
    }

    /// What it says of soft spheres, if it is of such.
    pub fn soft(&self) -> Option<&SoftSpheres> {
        match &self.engine {
            Engine::Soft(soft) => Some(soft),
            Engine::Hard(_) => None,
        }
    }

    /// As [`Scenario::soft`], to be changed.
    pub fn soft_mut(&mut self) -> Option<&mut SoftSpheres> {
        match &mut self.engine {
            Engine::Soft(soft) => Some(soft),
            Engine::Hard(_) => None,
        }
    }

    /// What it says of hard spheres, if it is of such.
    pub fn hard(&self) -> Option<&HardSpheres> {
        match &self.engine {
            Engine::Hard(hard) => Some(hard),
            Engine::Soft(_) => None,
        }
    }

    /// As [`Scenario::hard`], to be changed.
    pub fn hard_mut(&mut self) -> Option<&mut HardSpheres> {
        match &mut self.engine {
            Engine::Hard(hard) => Some(hard),
            Engine::Soft(_) => None,
        }
    }

    /// Whether time goes in steps, and not from event to event.
    pub fn is_stepped(&self) -> bool {
        !self.hard().is_some_and(|hard| matches!(hard.driver, Driver::EventDriven(_)))
    }

    /// Its sound; hard spheres hear none.
    pub fn acoustics(&self) -> Option<&Acoustics> {
        self.soft()?.acoustics.as_ref()
    }

    /// The laws of impact of hard spheres.
    pub fn impact(&self) -> Option<&Impact> {
        self.hard().map(|hard| &hard.impact)
    }

    /// The control volume, if there is one.
    pub fn volume(&self) -> Option<&Volume> {
        match &self.engine {
            Engine::Soft(soft) => soft.volume.as_ref(),
            Engine::Hard(hard) => Some(&hard.volume),
        }
    }

    /// Space as the faces of its control volume make it.
    pub fn space(&self) -> Space {
        self.volume().map_or(Space::OPEN, Volume::space)
    }
}

/// How long a run lasts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TimeSpan {
    /// Simulated time at the end, above 0.
    pub end: Time,
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
    /// Of hard spheres: the fewest primaries of each class by which sizes, kernels and breakage are counted, such as [1, 2, 5, 20];
    /// the last class has no end. Powers of two if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size_classes: Option<Vec<u32>>,
}

impl Output {
    /// The classes of sizes.
    pub fn classes(&self) -> SizeClasses {
        self.size_classes.as_deref().map(SizeClasses::from_bounds).unwrap_or_default()
    }
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
        Self {
            series: None,
            frames: None,
            pulses: None,
            bonds: true,
            rays: true,
            checkpoints: None,
            size_classes: None,
        }
    }
}
