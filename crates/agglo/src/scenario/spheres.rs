//! From a scenario to what its kind of spheres is told.

use crate::engine::hard::Driver;
use crate::engine::{SimError, hard, soft};
use crate::packing::{Groups, SphereKind};

use super::{Engine, Scenario};

impl TryFrom<&Scenario> for soft::Settings {
    type Error = SimError;

    /// # Errors
    /// [`SimError::OtherSpheres`] for hard spheres.
    fn try_from(scenario: &Scenario) -> Result<Self, SimError> {
        let Engine::Soft(soft) = &scenario.engine else {
            return Err(SimError::OtherSpheres("soft spheres need engine.verlet or engine.staggered"));
        };
        Ok(Self {
            seed: scenario.seed,
            end: scenario.time.end.si(),
            scheme: soft.scheme.clone(),
            limits: soft.limits.clone(),
            medium: scenario.medium.clone(),
            materials: scenario.materials.clone(),
            mixtures: scenario.mixtures.clone(),
            smallest_radius: scenario.grains.iter().map(|group| group.size.smallest()).reduce(f64::min),
            relax: soft.relax.clone(),
            volume: soft.volume.clone(),
            walls: soft.walls.clone(),
            contact: soft.contact.clone(),
            bonds: soft.bonds.clone(),
            fields: soft.fields.clone(),
            acoustics: soft.acoustics.clone(),
        })
    }
}

impl TryFrom<&Scenario> for hard::Settings {
    type Error = SimError;

    /// # Errors
    /// [`SimError::OtherSpheres`] for soft spheres.
    fn try_from(scenario: &Scenario) -> Result<Self, SimError> {
        let Engine::Hard(hard) = &scenario.engine else {
            return Err(SimError::OtherSpheres(
                "hard spheres need engine.event_driven or engine.time_stepped",
            ));
        };
        Ok(Self {
            seed: scenario.seed,
            end: scenario.time.end.si(),
            driver: hard.driver.clone(),
            volume: hard.volume.clone(),
            materials: scenario.materials.clone(),
            mixtures: scenario.mixtures.clone(),
            impact: hard.impact.clone(),
            classes: scenario.output.classes(),
        })
    }
}

impl<'a> From<&'a Scenario> for Groups<'a> {
    fn from(scenario: &'a Scenario) -> Self {
        let kind = match &scenario.engine {
            Engine::Soft(soft) => SphereKind::Soft { volume: soft.volume.as_ref() },
            Engine::Hard(hard) => SphereKind::Hard {
                volume: &hard.volume,
                may_leave: matches!(hard.driver, Driver::TimeStepped(_)),
            },
        };
        Self { groups: &scenario.grains, materials: &scenario.materials, seed: scenario.seed, kind }
    }
}
