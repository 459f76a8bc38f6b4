//! What the simulation looks at now and then: whether its laws hold, its step is short enough, and its energy is
//! accounted for.

use crate::domain::resolution;
use crate::engine::{Moment, SimError};

use super::validity;
use crate::engine::soft::simulation::Simulation;
use crate::engine::soft::step::step_size::Paces;
use crate::engine::soft::types::Scheme;

/// Steps between two looks at most. Counted in steps, so that a resumed run looks at the same moments.
const LOOK_EVERY: usize = 100;

const UNEXPLAINED: &str =
    "energy that the ledger does not explain is above limits.drift_warning: make the step smaller";

const DRIVEN: &str = "contact.custom: its part with speed drives grains instead of slowing them; what it puts in is in work_custom_J";

impl Simulation {
    /// Steps between two looks: fewer where grains are few and a look costs little.
    fn look_every(&self) -> u64 {
        self.system.grains.len().clamp(1, LOOK_EVERY) as u64
    }

    /// Looks, if it is time to.
    ///
    /// # Errors
    /// [`SimError::LedgerNotFinite`] where an entry of the ledger is not finite, [`SimError::Unexplained`] where more energy is unexplained than limits allow.
    pub(in crate::engine::soft) fn look_when_due(&mut self) -> Result<(), SimError> {
        if self.look_is_due() { self.look() } else { Ok(()) }
    }

    /// Whether it is time to look.
    pub(in crate::engine::soft) fn look_is_due(&self) -> bool {
        self.clock().step.is_multiple_of(self.look_every()) || self.is_finished()
    }

    /// # Errors
    /// As [`Simulation::look_when_due`].
    pub(in crate::engine::soft) fn look(&mut self) -> Result<(), SimError> {
        self.warn_of_drag();
        self.warn_of_places();
        if self.system.rates.driven > 0.0 {
            self.warnings.add(DRIVEN);
        }
        self.look_at_the_step();
        self.look_at_the_energy()
    }

    pub(in crate::engine::soft) fn warn_of_drag(&mut self) {
        if let Some(warning) = validity::of_drag(&self.system.laws, &self.system.grains, self.clock().time) {
            self.warnings.add(warning);
        }
    }

    fn warn_of_places(&mut self) {
        let grains = &self.system.grains;
        let motions = grains.position.iter().zip(&grains.velocity).zip(&grains.radius);
        let motions = motions.map(|((&position, &velocity), &radius)| (position, velocity, radius));
        if let Some(warning) = resolution::warning(motions, self.clock().last_step, self.end()) {
            self.warnings.add(warning);
        }
    }

    /// Looks again at how fast the laws are; where the step is given, warns if it is too long for them.
    fn look_at_the_step(&mut self) {
        let time = self.clock().time;
        if self.tempo.is_some() {
            self.paces = Paces::new(&self.system, Some(self.limits.strain), time);
            return;
        }
        let reached = Paces::new(&self.system, None, time);
        if self.clock().last_step > reached.total().critical_step() {
            let (name, advice) = match self.scheme {
                Scheme::Verlet(_) => ("engine.verlet.step", "leave it out, or make it shorter"),
                Scheme::Staggered(_) => ("engine.staggered", "make largest_step shorter"),
            };
            let law = reached.fastest();
            self.warnings
                .add(&format!("{name}: a step was longer than the critical step of {law}; {advice}"));
        }
    }

    fn look_at_the_energy(&mut self) -> Result<(), SimError> {
        let stored = self.stored_energy();
        let part = self.ledger.note(stored);
        let clock = self.clock();
        let at = Moment { step: clock.step, time: clock.time, dt: clock.last_step };
        if part.is_nan() {
            return Err(SimError::LedgerNotFinite { at, laws: self.acting_laws() });
        }
        if part > self.limits.drift_warning {
            self.warnings.add(UNEXPLAINED);
        }
        if part > self.limits.drift_error && !self.is_published() {
            let limit = self.limits.drift_error;
            return Err(SimError::Unexplained { at, part, limit, laws: self.acting_laws() });
        }
        Ok(())
    }

    /// Unexplained part of the energy from which on the run warns.
    pub fn drift_warning(&self) -> f64 {
        self.limits.drift_warning
    }

    /// Whether a law acts that does not converge: its energy is not to be explained.
    fn is_published(&self) -> bool {
        !self.system.laws.standing_warnings().is_empty() || !self.pulses.standing_warnings().is_empty()
    }
}
