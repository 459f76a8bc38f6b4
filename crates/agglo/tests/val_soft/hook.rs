//! Forces of the caller's own.

use std::f64::consts::PI;

use agglo::engine::soft::{Hook, LoadViews, Scene, Simulation};
use agglo::math::{Pace, Vec3};

use crate::common::{self, Listed, grain};

const RADIUS: f64 = 1e-3;

fn mass() -> f64 {
    2500.0 * 4.0 / 3.0 * PI * RADIUS.powi(3)
}

fn one(engine: String, more: &str) -> Simulation {
    let listed = Listed {
        material: "density = \"2500 kg/m3\"",
        radius: RADIUS,
        positions: vec![[1e-3, 0.0, 0.0], [0.0, 0.0, 50e-3]],
        end: 0.1,
        engine,
        more: format!("[limits]\ndisplacement = 1e3\nstrain = 2.0\n{more}"),
    };
    listed.start(|grains| grains.velocity[0] = Vec3::new(0.0, 0.2, 0.0))
}

/// A trap that says how fast it is, and counts steps.
#[derive(Default)]
struct Trap {
    steps: u64,
}

impl Hook for Trap {
    fn name(&self) -> &'static str {
        "a trap"
    }

    fn load(&self, now: &Scene<'_>, loads: &mut LoadViews<'_>) {
        for (force, place) in loads.force.iter_mut().zip(now.motion.position) {
            *force += Vec3::new(-2.0 * place.x, -2.0 * place.y, -2.0 * place.z);
        }
    }

    fn after_step(&mut self, _: &Scene<'_>) {
        self.steps += 1;
    }

    fn pace(&self, now: &Scene<'_>) -> Option<Pace> {
        Some(Pace::of_spring(2.0, now.grains.mass.iter().copied().fold(f64::INFINITY, f64::min)))
    }
}

/// A trap as a hook moves grains as a trap by formulas does, to the last bit: both are asked wherever the laws are.
#[test]
fn a_hook_is_as_good_as_a_law() {
    for engine in [common::verlet(2e-5), common::staggered(2e-5, 1e-9, 0.5)] {
        let mut law = one(engine.clone(), "[fields.custom]\nforce = [\"-2*x\", \"-2*y\", \"-2*z\"]\n");
        let mut hook = one(engine, "");
        hook.attach(Box::<Trap>::default());
        common::steps(&mut law, 1000);
        common::steps(&mut hook, 1000);
        for id in [0, 1] {
            assert_eq!(grain(&hook, id).position, grain(&law, id).position);
            assert_eq!(grain(&hook, id).velocity, grain(&law, id).velocity);
        }
        let (by_hook, by_law) = (hook.balance(), law.balance());
        assert_eq!((by_hook.custom, by_hook.fields), (by_law.fields, 0.0));
        assert_below!(by_hook.drift_relative.abs(), 1e-4);
        assert_below!(hook.momentum_drift_relative(), 1e-12);
    }
}

/// A constant force and torque: v = F t/m, w = M t/I, and the ledger has their work to rounding.
#[test]
fn forces_and_torques_are_booked() {
    let (push, twist) = (Vec3::new(1e-6, 0.0, -2e-6), Vec3::new(0.0, 3e-10, 0.0));
    let mut simulation = one(common::verlet(1e-4), "");
    simulation.attach(Box::new(move |_: &Scene<'_>, loads: &mut LoadViews<'_>| {
        loads.force[1] += push;
        loads.torque[1] += twist;
    }));
    let pushed = simulation.system.grains.id[1];
    common::steps(&mut simulation, 100);
    let found = grain(&simulation, pushed);
    let start = if pushed == 0 { Vec3::new(0.0, 0.2, 0.0) } else { Vec3::ZERO };
    let inertia = 0.4 * mass() * RADIUS * RADIUS;
    assert_close_vector!(found.velocity - start, push * (1e-2 / mass()), 1e-10, "in m/s");
    assert_close_vector!(found.angular_velocity, twist * (1e-2 / inertia), 1e-10, "in rad/s");
    let flow = simulation.ledger.flows.supplies.hook;
    assert_close_vector!(flow.force, push * 1e-2, 1e-12, "in N s");
    let gained = simulation.stored_energy().mechanical() - simulation.balance().mechanical_at_start;
    assert_close!(flow.power, gained, 1e-10, "in J");
    assert_below!(simulation.balance().drift_relative.abs(), 1e-12);
}

/// The automatic step takes the pace that a hook says, and warns of one that says nothing.
#[test]
fn the_automatic_step_asks_the_hook() {
    let mut simulation = one("[engine.verlet]\nsafety = 0.01".to_owned(), "");
    let free = simulation.clock().next_step;
    simulation.attach(Box::<Trap>::default());
    let wanted = 0.01 * 2.0 / (2.0 / mass()).sqrt();
    assert!(wanted < free, "{wanted} {free}");
    assert_close!(simulation.clock().next_step, wanted, 1e-12, "in s");
    assert_eq!(simulation.warnings.counts().len(), 0, "{:?}", simulation.warnings);
    common::steps(&mut simulation, 700);
    assert_close!(simulation.clock().last_step, wanted, 1e-12, "in s");
    let mut silent = one("[engine.verlet]".to_owned(), "");
    silent.attach(Box::new(|_: &Scene<'_>, _: &mut LoadViews<'_>| {}));
    let warned = silent.warnings.counts().keys().any(|text| text.contains("how fast a closure is"));
    assert!(warned, "{:?}", silent.warnings);
}
