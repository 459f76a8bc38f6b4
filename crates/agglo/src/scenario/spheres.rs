//! From a scenario to what its kind of spheres is told.

use crate::engine::hard::Driver;
use crate::engine::soft::Scheme;
use crate::engine::{Engine, SimError, hard, soft};
use crate::packing::{Groups, Spheres};

use super::Scenario;

impl TryFrom<&Scenario> for soft::Settings {
    type Error = SimError;

    /// # Errors
    /// [`SimError::OtherSpheres`] for hard spheres.
    fn try_from(scenario: &Scenario) -> Result<Self, SimError> {
        let scheme = match &scenario.engine {
            Engine::Staggered(scheme) => Scheme::Staggered(scheme.clone()),
            Engine::Verlet(scheme) => Scheme::Verlet(scheme.clone()),
            Engine::EventDriven(_) | Engine::TimeStepped(_) => {
                return Err(SimError::OtherSpheres("soft spheres need engine.verlet or engine.staggered"));
            }
        };
        Ok(Self {
            seed: scenario.seed,
            end: scenario.time.end.si(),
            scheme,
            limits: scenario.limits.clone(),
            medium: scenario.medium.clone(),
            materials: scenario.materials.clone(),
            mixtures: scenario.mixtures.clone(),
            smallest_radius: scenario.grains.iter().map(|group| group.size.smallest()).reduce(f64::min),
            relax: scenario.start.relax.clone(),
            contact: scenario.contact.clone(),
            bonds: scenario.bonds.clone(),
            fields: scenario.fields.clone(),
            acoustics: scenario.acoustics.clone(),
        })
    }
}

impl TryFrom<&Scenario> for hard::Settings {
    type Error = SimError;

    /// # Errors
    /// [`SimError::OtherSpheres`] for soft spheres, and where the scenario says nothing of the volume or of impacts.
    fn try_from(scenario: &Scenario) -> Result<Self, SimError> {
        let driver = match &scenario.engine {
            Engine::EventDriven(options) => Some(Driver::EventDriven(options.clone())),
            Engine::TimeStepped(options) => Some(Driver::TimeStepped(options.clone())),
            Engine::Staggered(_) | Engine::Verlet(_) => None,
        };
        let (Some(driver), Some(volume), Some(impact)) = (driver, &scenario.volume, &scenario.impact) else {
            let needed =
                "hard spheres need engine.event_driven or engine.time_stepped, [volume] and [impact]";
            return Err(SimError::OtherSpheres(needed));
        };
        Ok(Self {
            seed: scenario.seed,
            end: scenario.time.end.si(),
            driver,
            volume: volume.clone(),
            materials: scenario.materials.clone(),
            mixtures: scenario.mixtures.clone(),
            impact: impact.clone(),
        })
    }
}

impl<'a> From<&'a Scenario> for Groups<'a> {
    fn from(scenario: &'a Scenario) -> Self {
        let may_leave = matches!(scenario.engine, Engine::TimeStepped(_));
        Self {
            groups: &scenario.grains,
            materials: &scenario.materials,
            seed: scenario.seed,
            volume: scenario.volume.as_ref(),
            spheres: if scenario.engine.is_hard() { Spheres::Hard { may_leave } } else { Spheres::Soft },
        }
    }
}
