//! The ledger closes: energy to the order of the integrator, momentum to round-off.

use agglo::engine::soft::Simulation;
use agglo::math::rng::{Purpose, Stream};

use crate::{common, crowd};

/// A ball of 300 grains that fall in on one another.
fn cloud(engine: &str, laws: &str) -> Simulation {
    let text = format!(
        "version = 1\n[time]\nend = \"8 ms\"\n{engine}\n[limits]\nstrain = 0.3\n[materials.only]\n\
         density = \"2500 kg/m3\"\nyoungs_modulus = \"20 MPa\"\npoisson_ratio = 0.25\n[[grains]]\n\
         material = \"only\"\n[grains.size.uniform]\nsmallest = \"0.6 mm\"\nlargest = \"1.2 mm\"\n\
         [grains.placement.random]\ncount = 300\nregion.sphere.radius = \"10 mm\"\n{laws}"
    );
    common::start(&text, |grains| {
        let mut stream = Stream::new(3, Purpose::Sampling, 0);
        for at in 0..grains.len() {
            grains.velocity[at] = grains.position[at] * -100.0 + stream.direction() * 0.5;
            grains.angular_velocity[at] = stream.direction() * 300.0;
        }
    })
}

/// Largest relative drift of energy on the way; momentum is asserted.
fn drift(engine: &str, laws: &str) -> f64 {
    let mut simulation = cloud(engine, laws);
    let start = simulation.momentum();
    let (mut touched, mut worst) = (0, 0.0_f64);
    common::watch(&mut simulation, |now| {
        touched += u32::from(now.system.trial.contact.worst_strain > 0.0);
        if now.clock().step.is_multiple_of(10) {
            worst = worst.max(now.balance().drift_relative.abs());
        }
    });
    assert!(touched > 1000, "hardly any contact");
    let (end, size) = (simulation.momentum(), simulation.momentum_size());
    // Pair forces are equal and opposite to the bit; only sums round, once per contact and step.
    assert_near_vector!(end.linear, start.linear, 1e-12 * size);
    assert_below!(simulation.momentum_drift_relative(), 1e-12);
    worst
}

const ELASTIC: &str = "[contact.normal.hertz]";
const LOSSY: &str = "[contact.normal.hertz]\n[contact.damping.restitution]\nrestitution = 0.6\n\
                     [contact.friction.mindlin]\nstatic_friction = 0.4\ndynamic_friction = 0.3\ndashpot = 0.5";

/// Elastic collisions: energy wanders by the step squared, so a step of a half divides it by about four.
#[test]
fn elastic_collisions_keep_energy_to_second_order() {
    for engine in [common::verlet, |step| common::staggered(step, 1e-10, 0.5)] {
        let drifts = [2e-6, 1e-6].map(|step| drift(&engine(step), ELASTIC));
        common::found("elastic_drift", &[("coarse", drifts[0]), ("fine", drifts[1])]);
        assert!(drifts[0] < 1e-4 && drifts[1] < drifts[0] / 3.0, "{drifts:?}");
    }
}

/// What dashpots and friction take is booked: what is left unexplained falls with the step and is small. The largest step gives 4e-4.
#[test]
fn losses_are_booked() {
    let drifts = [2e-6, 1e-6, 0.5e-6].map(|step| drift(&common::verlet(step), LOSSY));
    common::found("lossy_drift", &[("coarse", drifts[0]), ("half", drifts[1]), ("quarter", drifts[2])]);
    assert!(drifts[0] < 1e-3 && drifts[1] < drifts[0] / 3.0 && drifts[2] < drifts[1] / 3.0, "{drifts:?}");
}

/// With rays, fields, drag, bonds that break and form: impulses that are booked explain the momentum.
#[test]
fn momentum_of_a_crowd_is_explained() {
    for engine in [crowd::VERLET, crowd::ADAPTIVE] {
        let mut simulation = crowd::start(engine, 300);
        common::steps(&mut simulation, 300);
        crowd::assert_busy(&simulation);
        common::found("crowd_momentum", &[("off", simulation.momentum_drift_relative())]);
        assert_below!(simulation.momentum_drift_relative(), 1e-12);
    }
}

/// Everything at once, bonds that break included: the drift is of second order in the step.
#[test]
fn a_crowd_drifts_to_second_order() {
    let drifts = [8e-9, 4e-9].map(|step| {
        let text = crowd::text(&common::verlet(step), 300).replace("end = \"1 s\"", "end = \"12 us\"");
        let mut simulation = common::start(&text, crowd::falling_in);
        common::finish(&mut simulation);
        crowd::assert_busy(&simulation);
        simulation.balance().drift_relative.abs()
    });
    common::found("crowd_drift", &[("coarse", drifts[0]), ("fine", drifts[1])]);
    assert!(drifts[0] < 2e-3 && drifts[1] < drifts[0] / 3.0, "{drifts:?}");
}
