//! Rest before the clock starts.

use std::ops::ControlFlow;

use agglo::engine::SimError;
use agglo::engine::soft::{Resting, Simulation};
use agglo::math::Vec3;

use crate::common::{self, kinetic, start, steps};

/// Two grains pressed together and cemented there: rest is where the cement's tension holds the contact's repulsion.
const CEMENTED: &str = r#"
    version = 1
    time.end = "1 s"
    engine.verlet.safety = 0.05
    [materials.glass]
    density = "2500 kg/m3"
    youngs_modulus = "1 GPa"
    poisson_ratio = 0.25
    [[grains]]
    material = "glass"
    size.constant.radius = "1 mm"
    velocity = ["0 m/s", "0.3 m/s", "0 m/s"]
    [grains.placement.list]
    positions = [["0 m", "0 m", "0 m"], ["1.99 mm", "0 m", "0 m"]]
    [contact.normal.hertz]
    [contact.friction.mindlin]
    static_friction = 0.5
    [bonds.beam]
    youngs_modulus = "500 MPa"
    tensile_strength = "1 GPa"
    shear_strength = "1 GPa"
    [start.relax]
    speed = "1 um/s"
    longest = "1 s"
    damping_time = "5 us"
"#;

/// What holds the grains at rest must still be there when the clock starts: they then drift together, and what they
/// had of stretched cement would otherwise drive them apart at some meters per second.
#[test]
fn rest_lasts() {
    let mut simulation = start(CEMENTED, |_| {});
    let stored = simulation.stored_energy();
    assert!(stored.elastic > 1e-6 && stored.bonds > 1e-7, "nothing holds: {stored:?}");
    let apart = |simulation: &Simulation| {
        let at = &simulation.system.grains.position;
        (at[1] - at[0]).norm()
    };
    let (distance, drifting) = (apart(&simulation), kinetic(&simulation));
    assert_above!(distance, 1.9901e-3, "in m");
    steps(&mut simulation, 2000);
    // Rest to 1 um/s, a millionth of the energy of the drift at most.
    assert_close!(apart(&simulation), distance, 1e-6);
    assert_close!(kinetic(&simulation), drifting, 1e-5, "in J");
    let mean = (simulation.system.grains.velocity[0] + simulation.system.grains.velocity[1]) * 0.5;
    assert_near_vector!(mean, Vec3::new(0.0, 0.3, 0.0), 1e-12);
}

/// Whoever waits is told at every step how far rest is, and may stop.
#[test]
fn the_way_to_rest_is_told() {
    let scenario = common::scenario(CEMENTED);
    let mut told: Vec<Resting> = Vec::new();
    let mut watch = |resting: &Resting| {
        told.push(*resting);
        ControlFlow::Continue(())
    };
    Simulation::start_watched(&scenario, common::grains(&scenario, |_| {}), &mut watch).unwrap();
    assert_above!(told.len(), 10);
    assert_all!(told.windows(2), |pair| pair[1].step == pair[0].step + 1);
    assert_all!(told.iter(), |resting| resting.speed > resting.limit && resting.limit == 1e-6);
    let mut stop = |_: &Resting| ControlFlow::Break(());
    let stopped = Simulation::start_watched(&scenario, common::grains(&scenario, |_| {}), &mut stop);
    assert_eq!(stopped.unwrap_err(), SimError::StoppedAtRest);
}
