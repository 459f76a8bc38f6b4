//! What walls refuse and warn of in a run.

use agglo::engine::SimError;
use agglo::engine::soft::Simulation;

use crate::common::{self, grains, scenario};
use crate::walls::{GRAVITY, grains_at, plane};

const HOOKE: &str = "[contact.normal.hooke]\nstiffness = \"1e4 N/m\"\n";

fn refused(places: &[[f64; 3]], more: &str) -> Option<String> {
    let text = grains_at(places, 1e-3, &common::verlet(1e-6), &format!("{more}{HOOKE}"));
    let scenario = scenario(&text);
    let grains = grains(&scenario, |_| {});
    Simulation::start(&scenario, grains).err().map(|error| error.to_string())
}

/// The deepest of two is named, with its wall; up to `limits.strain` of the radius grains may press.
#[test]
fn grains_in_walls_are_refused() {
    let floor = plane([0.0, 0.0, 1.0], "");
    let message = refused(&[[0.0, 0.0, 0.8e-3], [5e-3, 0.0, -1e-3], [0.0, 5e-3, 2e-3]], &floor).unwrap();
    assert_contains!(
        message,
        "grain 1 is placed in the wall \"floor\": it overlaps it by 2 mm, 2.000 of its radius"
    );
    assert_contains!(refused(&[[0.0, 0.0, 0.89e-3]], &floor).unwrap(), "grain 0 is placed in the wall");
    assert_none!(refused(&[[0.0, 0.0, 0.91e-3]], &floor));
    let limits = "[limits]\non_breach = \"warn\"\n";
    assert_none!(refused(&[[0.0, 0.0, 0.1e-3]], &format!("{floor}{limits}")));
    assert_some!(refused(&[[0.0, 0.0, -0.1e-3]], &format!("{floor}{limits}")));
}

/// A grain that comes too deep into a wall ends the run, by name.
#[test]
fn too_deep_into_a_wall_is_an_error() {
    let more = format!("{}{HOOKE}{GRAVITY}", plane([0.0, 0.0, 1.0], ""));
    let text = grains_at(&[[0.0, 0.0, 1.1e-3], [4e-3, 0.0, 1.1e-3]], 1.0, &common::verlet(1e-6), &more);
    let mut simulation = common::start(&text, |grains| grains.velocity[1].z = -5.0);
    let error = (0..1000).find_map(|_| simulation.step().err()).unwrap();
    assert_matches!(&error, SimError::TooDeepInWall { grain: 1, limit: 0.1, .. });
    assert_contains!(error.to_string(), "grain 1 overlaps walls.floor by 0.10");
    // The last good state is that before the step.
    assert_above!(simulation.system.grains.position[1].z, 0.9e-3, "in m");
}

/// The automatic step is 0.03 of the critical one: 2 √(m/k) by hand for a wall whose spring is the only one, and 50 steps a contact
/// keep energy to 1e-3. A floor that shakes faster than that sets the step itself.
#[test]
fn the_automatic_step_knows_walls() {
    let start = |motion: &str| {
        let text = grains_at(
            &[[0.0, 0.0, 1.001e-3]],
            1e-2,
            "engine.verlet = {}",
            &format!("{}{HOOKE}", plane([0.0, 0.0, 1.0], motion)),
        );
        common::start(&text, |grains| grains.velocity[0].z = -0.3)
    };
    let mut simulation = start("");
    let by_hand = 0.03 * 2.0 * (crate::walls::mass() / 1e4).sqrt();
    // Two equal grains on such a spring have half the mass, and are there in principle.
    assert_close!(simulation.clock().next_step, by_hand / 2.0_f64.sqrt(), 1e-9, "in s");
    common::finish(&mut simulation);
    assert_below!(simulation.balance().drift_relative.abs(), 1e-3);
    let fast =
        start("motion.oscillating = { amplitude = [\"0 m\", \"0 m\", \"1 nm\"], frequency = \"100 kHz\" }");
    assert_close!(fast.clock().next_step, 0.03 * 2.0 / (std::f64::consts::TAU * 1e5), 1e-9, "in s");
}
