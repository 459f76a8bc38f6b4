//! What a step is looked at for before it is taken: whether motion is finite, not too far and not too deep into another grain.

use crate::contact::pass::deepest_pair;
use crate::engine::SimError;
use crate::engine::soft::simulation::{Simulation, Step};
use crate::engine::soft::step::staggered;
use crate::engine::soft::types::Breach;

impl Simulation {
    /// Why no step was accepted.
    pub(in crate::engine::soft) fn not_converged(&self, trouble: &staggered::NotConverged) -> SimError {
        let (at, laws) = (self.moment(trouble.dt), self.acting_laws());
        let id = |place: u32| self.system.grains.id[place as usize];
        match trouble.not_finite {
            Some(place) => SimError::NotFinite { at, grain: id(place), laws },
            None => SimError::NotConverged { at, error: trouble.error, grain: id(trouble.grain), laws },
        }
    }

    /// Whether a step that was tried may be taken.
    ///
    /// # Errors
    /// [`SimError`] where it leads beyond what the limits allow, or nowhere.
    pub(in crate::engine::soft) fn guard(&mut self, step: &Step) -> Result<(), SimError> {
        let (change, contact, limits) = (&step.change, self.system.trial.contact, self.limits.clone());
        let is_too_deep = contact.worst_strain > limits.strain;
        let in_wall = self.system.walls.deepest().filter(|(strain, ..)| *strain == contact.worst_strain);
        let is_pair = is_too_deep && in_wall.is_none();
        let deepest = if is_pair { self.system.with_trial_contacts(deepest_pair) } else { None };
        let id = |place: usize| self.system.grains.id[place];
        let (at, laws) = (|| self.moment(step.dt), || self.acting_laws());
        if let Some(place) = change.not_finite {
            return Err(SimError::NotFinite { at: at(), grain: id(place as usize), laws: laws() });
        }
        let too_far = (change.farthest > limits.displacement).then(|| SimError::TooFar {
            at: at(),
            grain: id(change.farthest_grain as usize),
            radii: change.farthest,
            limit: limits.displacement,
            laws: laws(),
        });
        let too_deep = deepest.map(|grains| SimError::TooDeep {
            at: at(),
            grains: grains.map(id),
            strain: contact.worst_strain,
            limit: limits.strain,
            laws: laws(),
        });
        let into_wall =
            in_wall.filter(|_| is_too_deep).map(|(strain, grain, wall)| SimError::TooDeepInWall {
                at: Box::new(at()),
                grain: id(grain),
                wall: self.system.laws.walls.name(wall).into(),
                strain,
                limit: limits.strain,
                laws: laws(),
            });
        self.breach(too_far, "grains moved farther in one step than limits.displacement")?;
        self.breach(into_wall, "grains overlapped walls by more than limits.strain")?;
        self.breach(too_deep, "grains overlapped by more than limits.strain")
    }

    fn breach(&mut self, breach: Option<SimError>, warning: &str) -> Result<(), SimError> {
        match (breach, self.limits.on_breach) {
            (None, _) => Ok(()),
            (Some(error), Breach::Stop) => Err(error),
            (Some(_), Breach::Warn) => {
                self.warnings.add(warning);
                Ok(())
            }
        }
    }
}
