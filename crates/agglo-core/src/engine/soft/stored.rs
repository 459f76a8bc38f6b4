//! Energy and momentum of the committed state, for the ledger.

use std::ops::Range;

use crate::contact::pass::contact_energy;
use crate::ledger::{Balance, Momentum, Stored};
use crate::math::Vec3;
use crate::math::parallel::{self, BLOCK};

use super::forces::laws::{Laws, source};
use super::simulation::Simulation;

impl Simulation {
    /// Energy that the grains hold.
    pub fn stored_energy(&self) -> Stored {
        let system = &self.system;
        let contact = system.with_contacts(contact_energy);
        let walls = system.at_walls(self.clock().time).energy();
        let grains = &system.grains;
        let (kinetic, rotational) = self.sum(
            |at| {
                (
                    0.5 * system.inertial_mass[at] * grains.velocity[at].norm_squared(),
                    0.5 * grains.inertia(at) * grains.angular_velocity[at].norm_squared(),
                )
            },
            |a, b| (a.0 + b.0, a.1 + b.1),
            (0.0, 0.0),
        );
        Stored {
            kinetic,
            rotational,
            elastic: contact.normal + walls.normal,
            tangential_spring: system.spring_energy(),
            bonds: contact.bond + walls.bond + system.network.energy(grains, &system.space),
            near_field: self.near_field_energy(),
            fields: self.field_energy(),
            thermal: 0.0,
        }
    }

    /// Mass of all grains [kg].
    pub(super) fn total_mass(&self) -> f64 {
        self.sum(|at| self.system.grains.mass[at], |a, b| a + b, 0.0)
    }

    /// Linear and angular momentum.
    pub fn momentum(&self) -> Momentum {
        let system = &self.system;
        let grains = &system.grains;
        self.sum(
            |at| {
                let linear = grains.velocity[at] * system.inertial_mass[at];
                let angular =
                    grains.position[at].cross(linear) + grains.angular_velocity[at] * grains.inertia(at);
                Momentum { linear, angular }
            },
            |a, b| a + b,
            Momentum::default(),
        )
    }

    /// Linear and angular momentum that impulses do not explain. About an axis across which space repeats itself angular momentum
    /// is none that is kept, as a grain has it anew when it comes back in: 0 there.
    pub fn momentum_drift(&self, now: &Momentum) -> Momentum {
        let Momentum { linear, angular } = self.ledger.momentum_drift(now);
        let is_kept = |axis: usize| {
            let across = [(axis + 1) % 3, (axis + 2) % 3];
            !across.into_iter().any(|axis| self.system.space.repeats_along(axis))
        };
        let kept = |axis: usize| if is_kept(axis) { angular[axis] } else { 0.0 };
        Momentum { linear, angular: Vec3::new(kept(0), kept(1), kept(2)) }
    }

    /// Sum of all grains' momenta without regard to direction [kg m/s].
    pub fn momentum_size(&self) -> f64 {
        let system = &self.system;
        self.sum(|at| system.inertial_mass[at] * system.grains.velocity[at].norm(), |a, b| a + b, 0.0)
    }

    /// The ledger's balance now.
    pub fn balance(&self) -> Balance {
        self.ledger.balance(self.stored_energy(), 0.0)
    }

    /// Relative drift of linear momentum now.
    pub fn momentum_drift_relative(&self) -> f64 {
        self.ledger.momentum_drift_relative(&self.momentum(), self.momentum_size())
    }

    fn field_energy(&self) -> f64 {
        let Laws { fields, .. } = &self.system.laws;
        if !fields.store() {
            return 0.0;
        }
        let (grains, time) = (&self.system.grains, self.clock().time);
        let energy = |at: usize| {
            let motion = (grains.position[at], grains.velocity[at]);
            fields.energy(&self.system.laws.grain(grains, at, motion, time))
        };
        self.sum(energy, |a, b| a + b, 0.0)
    }

    fn near_field_energy(&self) -> f64 {
        let grains = &self.system.grains;
        let Some(law) = &self.system.laws.fields.near_field else { return 0.0 };
        let energy = |a: usize, b: usize| {
            let distance = self.system.space.shortest(grains.position[b] - grains.position[a]).norm();
            law.energy(&source(grains, a), &source(grains, b), distance)
        };
        let near = self.system.near_list();
        let of_grain = |a: usize| match near {
            Some(list) => list.owned(a).map(|pair| energy(a, list.partners()[pair] as usize)).sum::<f64>(),
            None => (a + 1..grains.len()).map(|b| energy(a, b)).sum(),
        };
        self.sum(of_grain, |a, b| a + b, 0.0)
    }

    fn sum<T: Send + Sync + Copy>(
        &self,
        of_grain: impl Fn(usize) -> T + Sync,
        join: impl Fn(T, T) -> T + Sync,
        nothing: T,
    ) -> T {
        let leaf = |range: Range<usize>, ()| range.map(&of_grain).fold(nothing, &join);
        parallel::over(0..self.system.grains.len(), BLOCK, (), &leaf, &join)
    }
}
