//! The same bits for any number of domains, resumed on another number of them too.

use agglo::engine::SimError;
use agglo::engine::soft::Simulation;
use agglo::math::Vec3;
use agglo::particles::Particles;

use crate::{common, crowd};

/// Three blocks of grains, so that of five domains two have none.
const COUNT: u32 = 2500;

/// Grains that shake between walls and across periodic faces: nobody looks at them for many steps.
fn shaken(faces: &str) -> String {
    format!(
        r#"
version = 1
time.end = "1 s"
engine.verlet.safety = 0.2
[volume]
lower = ["0 m", "0 m", "23 um"]
upper = ["0.4 mm", "0.4 mm", "1 mm"]
faces = {faces}
[materials.glass]
density = "2500 kg/m3"
youngs_modulus = "0.1 GPa"
poisson_ratio = 0.25
[[grains]]
material = "glass"
size.uniform = {{ smallest = "9 um", largest = "13 um" }}
placement.random.count = {COUNT}
placement.random.region.box = {{ lower = ["13 um", "13 um", "15 um"], upper = ["387 um", "387 um", "700 um"] }}
velocity_spread.maxwell.deviation = "1 m/s"
[[walls]]
name = "floor"
material = "glass"
shape.plane = {{ point = ["0 m", "0 m", "0 m"], normal = [0.0, 0.0, 1.0] }}
[contact.normal.hertz]
[contact.damping.restitution]
restitution = 0.6
[contact.friction.mindlin]
static_friction = 0.4
[fields.gravity]
acceleration = ["0 m/s2", "0 m/s2", "-1e5 m/s2"]
"#
    )
}

const BETWEEN: &str = r#"{ x = "periodic", y = "periodic", z = "open" }"#;
/// The lowest layer leaves.
const OUT: &str = r#"{ x = "periodic", y = "reflecting", z = "absorbing" }"#;

fn spread(text: &str, mut simulation: Simulation, domains: usize) -> Simulation {
    simulation.spread(&common::scenario(text), domains).unwrap_or_else(|error| panic!("{error}"));
    simulation
}

/// The states of a run by 1, 2, 3 and 5 domains are those of one that is not spread, after `go` and again after it.
fn assert_same(text: &str, start: impl Fn() -> Simulation, go: impl Fn(&mut Simulation)) {
    let mut alone = start();
    go(&mut alone);
    let middle = common::bytes(&alone);
    go(&mut alone);
    let end = common::bytes(&alone);
    for (domains, others) in [(1, 3), (2, 5), (3, 2), (5, 1)] {
        let mut run = spread(text, start(), domains);
        go(&mut run);
        common::assert_same_state(&common::bytes(&run), &middle, &format!("{domains} domains"));
        let scenario = common::scenario(text);
        let resumed = Simulation::resume(&scenario, common::written_and_read(&run)).unwrap();
        drop(run);
        let mut resumed = spread(text, resumed, others);
        go(&mut resumed);
        let when = format!("by {others} domains what {domains} began");
        common::assert_same_state(&common::bytes(&resumed), &end, &when);
    }
}

#[test]
fn a_crowd_has_the_same_bits_by_1_2_3_and_5_domains() {
    for engine in [crowd::VERLET, crowd::ADAPTIVE] {
        let go = |simulation: &mut Simulation| {
            common::steps(simulation, 25);
            assert!(!simulation.pulses.flight().rays().is_empty(), "no rays in flight");
            assert_above!(simulation.system.remembered().len(), 0, "contacts");
        };
        assert_same(&crowd::text(engine, COUNT), || crowd::start(engine, COUNT), go);
    }
}

#[test]
fn grains_between_walls_have_the_same_bits_by_1_2_3_and_5_domains() {
    let go = |simulation: &mut Simulation| {
        let until = simulation.clock().time + 2e-6;
        while simulation.clock().time < until {
            simulation.advance(until).unwrap_or_else(|error| panic!("{error}"));
        }
        let pressed = simulation.system.remembered().len();
        assert_above!(pressed, 100, "contacts");
        assert_true!(
            simulation.absorbed().is_none_or(|absorbed| absorbed.grains > 10),
            "{:?}",
            simulation.absorbed()
        );
    };
    for (faces, carried) in [(BETWEEN, 0.0), (OUT, 10.0)] {
        let text = shaken(faces);
        let down = Vec3::AXES[2] * carried;
        let carry =
            |grains: &mut Particles| grains.velocity.iter_mut().for_each(|velocity| *velocity -= down);
        assert_same(&text, || common::start(&text, carry), go);
    }
}

#[test]
fn a_state_that_is_changed_from_outside_is_noticed() {
    let text = shaken(BETWEEN);
    let mut run = spread(&text, common::start(&text, |_| {}), 2);
    common::steps(&mut run, 2);
    run.system.grains.velocity[7] += Vec3::AXES[0] * 1e-9;
    let error = run.step().unwrap_err();
    assert!(matches!(error, SimError::Apart { .. }), "{error}");
}
