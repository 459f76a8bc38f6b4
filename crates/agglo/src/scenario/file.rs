//! A scenario as its file says it: tables side by side, whichever kind of spheres they belong to.

use std::collections::BTreeMap;
use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::types::{Engine, HardSpheres, Measures, Output, Scenario, SoftSpheres, TimeSpan};
use crate::acoustics::{Acoustics, Medium};
use crate::contact::{Bonds, ContactLaws};
use crate::domain::Volume;
use crate::engine::hard::{Driver, EventDriven, TimeStepped};
use crate::engine::soft::{Limits, Relaxation, Scheme, Staggered, Verlet};
use crate::fields::Fields;
use crate::impact::Impact;
use crate::packing::GrainGroup;
use crate::particles::{Material, Mixture};
use crate::walls::Wall;

/// A whole scenario.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Scenario")]
pub(crate) struct ScenarioFile {
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
    pub engine: EngineTable,
    /// Bounds on motion and overlap; soft spheres only.
    #[serde(default = "usual_limits", skip_serializing_if = "Option::is_none")]
    pub limits: Option<Limits>,
    /// The fluid around the grains; hard spheres do not feel it.
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
    pub start: StartTable,
    /// The control volume, which hard spheres need; across its faces space may repeat itself. Soft spheres are in open space if it
    /// is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub volume: Option<Volume>,
    /// Laws of impact; hard spheres only, which need them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub impact: Option<Impact>,
    /// Walls that grains touch; soft spheres only. None if left out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub walls: Vec<Wall>,
    /// Laws of contact; soft spheres only. Grains pass through one another if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact: Option<ContactLaws>,
    /// What holds grains together; soft spheres only. Nothing if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bonds: Option<Bonds>,
    /// Forces on single grains and at a distance; soft spheres only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fields: Option<Fields>,
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

#[expect(clippy::unnecessary_wraps, reason = "the default of a field that hard spheres leave out")]
fn usual_limits() -> Option<Limits> {
    Some(Limits::default())
}

/// How time is stepped.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Engine")]
pub(crate) enum EngineTable {
    /// Soft spheres: the staggered implicit scheme of [A] 31-34 with adaptive steps.
    Staggered(Staggered),
    /// Soft spheres: explicit velocity Verlet.
    Verlet(Verlet),
    /// Hard spheres: from collision to collision, each at its exact time.
    EventDriven(EventDriven),
    /// Hard spheres: steps that are as long as gaps allow, [B] 6.14.
    TimeStepped(TimeStepped),
}

/// What happens before the clock starts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Start")]
pub(crate) struct StartTable {
    /// The folder of a run, or one of its checkpoints, relative to the scenario's folder: the state in it is the start, with
    /// bonds and names. The clock starts at zero.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<PathBuf>,
    /// A CSV table of the grains that are bonded, relative to the scenario's folder: columns `grain_i` and `grain_j` with their
    /// ids, which are 0, 1, ... in the order of the groups if no table of grains says otherwise. It needs `[bonds.beam]`, which bonds neighbors if this is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bonds: Option<PathBuf>,
    /// Lets the grains come to rest first; soft spheres only. Not if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relax: Option<Relaxation>,
}

impl TryFrom<ScenarioFile> for Scenario {
    type Error = &'static str;

    /// Takes what belongs to its kind of spheres, and leaves what belongs to the other kind.
    ///
    /// # Errors
    /// For hard spheres without a control volume or laws of impact.
    fn try_from(file: ScenarioFile) -> Result<Self, &'static str> {
        let StartTable { from, bonds: bonded, relax } = file.start;
        let volume = &file.volume;
        let soft = |scheme| {
            Engine::Soft(Box::new(SoftSpheres {
                scheme,
                limits: file.limits.unwrap_or_default(),
                relax,
                volume: volume.clone(),
                bonded,
                walls: file.walls,
                contact: file.contact,
                bonds: file.bonds,
                fields: file.fields.unwrap_or_default(),
                acoustics: file.acoustics,
            }))
        };
        let hard = |driver| match (volume.clone(), file.impact) {
            (Some(volume), Some(impact)) => {
                Ok(Engine::Hard(Box::new(HardSpheres { driver, volume, impact })))
            }
            _ => Err("hard spheres need [volume] and [impact]"),
        };
        Ok(Self {
            engine: match file.engine {
                EngineTable::Staggered(scheme) => soft(Scheme::Staggered(scheme)),
                EngineTable::Verlet(scheme) => soft(Scheme::Verlet(scheme)),
                EngineTable::EventDriven(driver) => hard(Driver::EventDriven(driver))?,
                EngineTable::TimeStepped(driver) => hard(Driver::TimeStepped(driver))?,
            },
            version: file.version,
            title: file.title,
            seed: file.seed,
            time: file.time,
            medium: file.medium,
            materials: file.materials,
            mixtures: file.mixtures,
            grains: file.grains,
            from,
            measures: file.measures,
            output: file.output,
        })
    }
}

impl From<Scenario> for ScenarioFile {
    fn from(scenario: Scenario) -> Self {
        let blank = |engine| Self {
            engine,
            version: scenario.version,
            title: scenario.title,
            seed: scenario.seed,
            time: scenario.time,
            limits: None,
            medium: scenario.medium,
            materials: scenario.materials,
            mixtures: scenario.mixtures,
            grains: scenario.grains,
            start: StartTable { from: scenario.from, bonds: None, relax: None },
            volume: None,
            impact: None,
            walls: Vec::new(),
            contact: None,
            bonds: None,
            fields: None,
            acoustics: None,
            measures: scenario.measures,
            output: scenario.output,
        };
        match scenario.engine {
            Engine::Soft(soft) => {
                let mut file = blank(match soft.scheme {
                    Scheme::Staggered(scheme) => EngineTable::Staggered(scheme),
                    Scheme::Verlet(scheme) => EngineTable::Verlet(scheme),
                });
                (file.start.relax, file.start.bonds) = (soft.relax, soft.bonded);
                let (limits, fields) = (Some(soft.limits), Some(soft.fields));
                Self {
                    limits,
                    fields,
                    volume: soft.volume,
                    walls: soft.walls,
                    contact: soft.contact,
                    bonds: soft.bonds,
                    acoustics: soft.acoustics,
                    ..file
                }
            }
            Engine::Hard(hard) => {
                let file = blank(match hard.driver {
                    Driver::EventDriven(driver) => EngineTable::EventDriven(driver),
                    Driver::TimeStepped(driver) => EngineTable::TimeStepped(driver),
                });
                Self { volume: Some(hard.volume), impact: Some(hard.impact), ..file }
            }
        }
    }
}
