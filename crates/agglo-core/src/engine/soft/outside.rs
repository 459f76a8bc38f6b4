//! What a caller does to the grains of a simulation: hooks and kicks.

use crate::engine::SimError;
use crate::ledger::Supply;
use crate::math::Vec3;

use super::hook::Hook;
use super::simulation::Simulation;
use super::step::step_size::Paces;

impl Simulation {
    /// Lets forces of the caller's own act from now on; of two hooks the last one acts, and [`Hooks`](super::Hooks) are several.
    ///
    /// After [`Simulation::resume`] from the state of a run with a hook, attach it again before the first step.
    pub fn attach(&mut self, hook: Box<dyn Hook>) {
        let time = self.clock.time;
        self.system.attach(hook, time, self.is_hooked);
        if std::mem::replace(&mut self.is_hooked, true) {
            return;
        }
        if self.tempo.is_some() && self.system.hook_pace(time).is_none() {
            self.warnings.add(&format!(
                "the automatic step does not know how fast {} is: give engine.verlet.step, or its pace",
                self.hook_name()
            ));
        }
        self.shorten_step();
    }

    /// What kept the hook from giving its forces when it was asked last, if something did.
    pub fn hook_fault(&self) -> Option<SimError> {
        let hook = &self.system.hook.as_ref()?.hook;
        let at = self.moment(self.clock.next_step);
        hook.fault().map(|reason| SimError::Hook { at, name: hook.name().to_owned(), reason })
    }

    pub(super) fn hook_name(&self) -> &str {
        self.system.hook.as_ref().map_or("", |attached| attached.hook.name())
    }

    /// Gives a grain an impulse [N s] at its center, at once; `at` is its index. Its velocity changes by that over its mass, added
    /// mass included. The ledger has the energy with what hooks put in.
    pub fn kick(&mut self, at: usize, impulse: Vec3) {
        let system = &mut self.system;
        let before = system.grains.velocity[at];
        let after = before + impulse / system.inertial_mass[at];
        system.grains.velocity[at] = after;
        let work = Supply {
            power: 0.5 * impulse.dot(before + after),
            force: impulse,
            torque: system.grains.position[at].cross(impulse),
        };
        let put_in = &mut self.ledger.flows.supplies.hook;
        *put_in = *put_in + work;
        // Dashpots and drag are others now.
        system.evaluate_again(self.clock.time, self.clock.next_step);
        self.shorten_step();
    }

    /// Launches a pulse of beam number `beam` now, beside those that the scenario has; its rays scatter as those of no other. It is
    /// gone on with after [`Simulation::resume`] as any other.
    ///
    /// # Errors
    /// [`SimError::NoBeam`] where there is no such beam.
    pub fn pulse(&mut self, beam: u32) -> Result<(), SimError> {
        let now = self.clock.time;
        self.pulses.launch_now(beam, &self.system.grains, now, self.end(), &mut self.warnings)
    }

    /// Looks at the laws again, and takes a shorter automatic step if they ask for it.
    fn shorten_step(&mut self) {
        let Some(tempo) = self.tempo else { return };
        self.paces = Paces::new(&self.system, Some(self.limits.strain), self.clock.time);
        self.clock.next_step = self.clock.next_step.min(tempo.wanted(self.paces.total().critical_step()));
    }

    pub(super) fn warn_of_lost_hook(&mut self) {
        if self.is_hooked && self.system.hook.is_none() {
            self.warnings.add("the run that this one goes on from had a hook, and this one has none");
            self.is_hooked = false;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::soft::{LoadViews, Scene};
    use crate::testing::{Scenario, place};

    /// Two grains that press on each other with a spring and a dashpot of 5e-3 N s/m, bonded, in a liquid.
    fn pressed(engine: &str) -> Simulation {
        let text = "version = 1\ntime.end = \"1 ms\"\n[materials.glass]\ndensity = \"2500 kg/m3\"\n\
                    [medium]\ndensity = \"1000 kg/m3\"\n[[grains]]\nmaterial = \"glass\"\nsize.constant.radius = \"1 mm\"\n\
                    placement.list.positions = [[\"0 m\", \"0 m\", \"0 m\"], [\"1.99 mm\", \"0 m\", \"0 m\"]]\n\
                    [contact.custom]\nforce = \"500*overlap + 5e-3*speed\"\n\
                    [contact.friction.mindlin]\nstatic_friction = 0.4\nstiffness_ratio = 0.8\n\
                    [bonds.beam]\nyoungs_modulus = \"1 MPa\"\ntensile_strength = \"1 GPa\"\nshear_strength = \"1 GPa\"\n\
                    [fields.drag]\nlaw = \"schiller_naumann\"\nadded_mass = 0.5\n";
        let scenario = Scenario::from_toml(&format!("{text}{engine}\n")).unwrap();
        let mut simulation = Simulation::start(&scenario, place(&scenario).unwrap()).unwrap();
        steps(&mut simulation, 20);
        simulation
    }

    fn steps(simulation: &mut Simulation, count: usize) {
        (0..count).for_each(|_| simulation.step().unwrap());
    }

    /// By J over the mass and half of the displaced liquid's, with the work J·(v + v')/2: both to rounding.
    #[test]
    fn a_kick_moves_a_grain_and_stands_in_the_ledger() {
        let mut simulation = pressed("[engine.verlet]");
        let impulse = Vec3::new(-3e-6, 2e-6, 1e-6);
        let before = simulation.balance();
        let motion = simulation.system.grains.velocity[0];
        simulation.kick(0, impulse);
        let mass = 4.0 / 3.0 * std::f64::consts::PI * 1e-9 * (2500.0 + 0.5 * 1000.0);
        let wanted = motion + impulse / mass;
        assert_close_vector!(simulation.system.grains.velocity[0], wanted, 1e-14, "m/s");
        let after = simulation.balance();
        let gained = 0.5 * mass * (wanted.norm_squared() - motion.norm_squared());
        assert_close!(after.custom - before.custom, gained, 1e-12, "J");
        assert_near!(after.drift, before.drift, 1e-12 * gained, "J");
        assert_below!(simulation.momentum_drift_relative(), 1e-12);
        // The dashpot takes c v² from now on.
        let velocity = &simulation.system.grains.velocity;
        let speed = velocity[0].x - velocity[1].x;
        assert_close!(simulation.system.rates.damping, 5e-3 * speed * speed, 1e-12, "W");
        // What the steps leave unexplained afterwards is of their own order: with the dashpot of before it would be a tenth.
        steps(&mut simulation, 200);
        assert_below!(simulation.balance().drift_relative.abs(), 1e-3);
    }

    /// Without an impulse a run goes on as it would have, also with a hook: loads are worked out again, which for drag, solved for
    /// within a step, differs by the error of that step.
    #[test]
    fn a_kick_of_nothing_changes_nothing() {
        let pull = |_: &Scene<'_>, loads: &mut LoadViews<'_>| loads.force[1].y += 1e-4;
        let [mut kicked, mut left] = [(); 2].map(|()| pressed("[engine.verlet]\nstep = \"1 us\""));
        for simulation in [&mut kicked, &mut left] {
            simulation.attach(Box::new(pull));
            steps(simulation, 5);
        }
        kicked.kick(1, Vec3::ZERO);
        assert_eq!(kicked.balance().custom, left.balance().custom);
        for simulation in [&mut kicked, &mut left] {
            steps(simulation, 100);
        }
        for at in [0, 1] {
            let [found, wanted] = [&kicked, &left].map(|simulation| simulation.system.grains.velocity[at]);
            assert_close_vector!(found, wanted, 1e-6, "m/s");
        }
    }
}
