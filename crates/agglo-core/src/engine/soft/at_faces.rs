//! Grains at the faces of the control volume: some are turned back, others taken out.

use crate::engine::SimError;
use crate::ledger::{Supplies, Supply};

use super::faces::{Absorbed, EndFaces};
use super::simulation::Simulation;
use super::system::System;

impl Simulation {
    /// Turns grains back that reach into reflecting faces, and takes those out that are beyond absorbing ones.
    ///
    /// A grain is turned where a step has led it, less than its way in one step beyond the face, so that it has the energy that it
    /// had: its places are of first order in the step.
    ///
    /// # Errors
    /// [`SimError::NoneLeft`] where no grain stays.
    pub(super) fn end_at_faces(&mut self) -> Result<(), SimError> {
        let Some(faces) = self.faces else { return Ok(()) };
        let impulse = self.system.turn_back(&faces, self.clock.time);
        let walls = &mut self.ledger.flows.supplies.walls;
        *walls = *walls + impulse;
        let stays = |at: &u32| !faces.takes(self.system.grains.position[*at as usize]);
        let staying: Vec<u32> = (0..self.system.grains.len() as u32).filter(stays).collect();
        match staying.len() {
            0 => Err(SimError::NoneLeft { at: self.moment(self.clock.next_step) }),
            n if n == self.system.grains.len() => Ok(()),
            _ => {
                self.keep(&staying);
                Ok(())
            }
        }
    }

    /// Takes all grains but these out of the run. Their bonds go with them, and so do the energy and the momentum of what is gone.
    fn keep(&mut self, staying: &[u32]) {
        let (grains, mass) = (self.system.grains.len(), self.total_mass());
        let (energy, momentum) = (self.stored_energy().mechanical(), self.momentum());
        let (place, parted) = self.system.keep(staying, self.clock.time);
        self.pulses.reindex(&place);
        self.events.extend(parted);
        // Who stays is loaded by fewer now.
        self.system.evaluate_again(self.clock.time, self.clock.next_step);
        let carried_off = (energy - self.stored_energy().mechanical(), momentum - self.momentum());
        let flows = &mut self.ledger.flows;
        flows.absorbed += carried_off.0;
        flows.carried_off = flows.carried_off + carried_off.1;
        self.absorbed.grains += (grains - staying.len()) as u64;
        self.absorbed.mass += mass - self.total_mass();
    }

    /// What has left through absorbing faces since the start; nothing where there are none.
    pub fn absorbed(&self) -> Option<Absorbed> {
        let absorbs = self.faces.is_some_and(|faces| faces.absorb());
        absorbs.then_some(self.absorbed)
    }
}

impl System {
    /// Turns grains round at reflecting faces, at a time [s]; the impulse that the faces give them [N s, N m s]. The loads of laws
    /// that act on single grains follow their velocities at once; contacts do when the next step meets them.
    fn turn_back(&mut self, faces: &EndFaces, time: f64) -> Supply {
        let mut impulse = Supply::default();
        for at in 0..self.grains.len() {
            let (place, velocity, spin) = self.grains.motion_of(at);
            let Some(turned) = faces.turned(place, self.grains.radius[at], velocity) else { continue };
            let given = (turned - velocity) * self.inertial_mass[at];
            // A face that is smooth and at rest does no work.
            impulse = impulse + Supply { power: 0.0, force: given, torque: place.cross(given) };
            let [mut before, mut after] = [Supplies::default(); 2];
            let old = self.laws.on_single(&self.grains, at, (place, velocity, spin), time, &mut before);
            let new = self.laws.on_single(&self.grains, at, (place, turned, spin), time, &mut after);
            self.loads.force[at] += new.force - old.force;
            self.loads.torque[at] += new.torque - old.torque;
            self.rates.supplies = self.rates.supplies + after.less(before);
            self.grains.velocity[at] = turned;
        }
        impulse
    }
}

#[cfg(test)]
#[path = "at_faces_tests.rs"]
mod tests;
