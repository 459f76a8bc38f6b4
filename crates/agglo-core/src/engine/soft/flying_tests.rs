//! Steps that begin in the same pass in which the one before ends have the bits of steps taken one by one.

use super::simulation::Simulation;
use crate::engine::SimError;
use crate::math::Vec3;
use crate::math::rng::{Purpose, Stream};
use crate::testing::{Scenario, place};

/// A crowd of 150 grains of two materials that fall in on one another and spin, under these laws.
fn crowd(more: &str) -> Simulation {
    let text = format!(
        r#"
version = 1
time.end = "1 s"
medium.density = "1 kg/m3"
[materials.pigment]
density = "4000 kg/m3"
contact_stiffness = "1 GPa"
[materials.resin]
density = "1300 kg/m3"
contact_stiffness = "0.4 GPa"
[[grains]]
material = "pigment"
size.lognormal = {{ median = "10 um", geometric_deviation = 1.3, smallest = "5 um", largest = "20 um" }}
placement.random = {{ count = 100, region.sphere.radius = "90 um" }}
[[grains]]
material = "resin"
size.constant.radius = "8 um"
placement.random = {{ count = 50, region.sphere.radius = "90 um" }}
[contact.friction.mindlin]
static_friction = 0.4
dynamic_friction = 0.3
dashpot = 0.2
stiffness_ratio = 0.8
{more}
"#
    );
    let scenario = Scenario::from_toml(&text).unwrap_or_else(|faults| panic!("{faults}"));
    let mut grains = place(&scenario).unwrap();
    let mut stream = Stream::new(11, Purpose::Sampling, 0);
    for at in 0..grains.len() {
        grains.velocity[at] = grains.position[at] * -2e4 + stream.direction() * 0.2;
        grains.angular_velocity[at] = Vec3::new(stream.normal(), stream.normal(), stream.normal()) * 1e4;
    }
    Simulation::start(&scenario, grains).unwrap()
}

const STIFFENING: &str = "[contact.normal.strain_power]\nexponent = 3.0\n";
const RESTITUTION: &str =
    "[contact.normal.strain_power]\nexponent = 1.5\n[contact.damping.restitution]\nrestitution = 0.5\n";
const GRAVITY: &str =
    "[fields.gravity]\nacceleration = [\"0 m/s2\", \"-9.81 m/s2\", \"3 m/s2\"]\nbuoyancy = true\n";
/// Contacts that outgrow by far what the first step reckons with, so that steps are tried again.
const OUTGROWING: &str =
    "[limits]\nstrain = 1e-2\ndisplacement = 1e3\non_breach = \"warn\"\n[engine.verlet]\nsafety = 0.5\n";

fn bytes(simulation: &Simulation) -> Vec<u8> {
    postcard::to_stdvec(&simulation.state()).unwrap()
}

/// In flight from look to look, between moments that somebody asks for, and over sortings in space.
#[test]
fn flying_changes_no_bit() {
    let cases = [
        format!("{RESTITUTION}[engine.verlet]\nsafety = 0.1\n"),
        format!("{RESTITUTION}{GRAVITY}[engine.verlet]\nstep = \"2 ns\"\n"),
        format!("{STIFFENING}{OUTGROWING}{GRAVITY}"),
    ];
    for (case, text) in cases.iter().enumerate() {
        let (mut flown, mut stepped) = (crowd(text), crowd(text));
        (flown.sort_every, stepped.sort_every) = (70, 70);
        let (mut flights, mut longest, mut touched) = (0, 0, false);
        while flown.clock().step < 1000 {
            let (before, time) = (flown.clock().step, flown.clock().time);
            // Now and then somebody asks for a moment in between.
            let until = if flights % 3 == 2 { time + 7.3 * flown.clock().next_step } else { f64::INFINITY };
            flown.advance(until).unwrap();
            assert_none!(flown.system.afloat, "the columns of the grains are up to date");
            (flights, longest) = (flights + 1, longest.max(flown.clock().step - before));
            while stepped.clock().step < flown.clock().step {
                stepped.step().unwrap();
            }
            touched |= stepped.system.spring_energy() > 0.0;
            assert_true!(bytes(&flown) == bytes(&stepped), "case {case}, step {}", flown.clock().step);
        }
        assert_above!(longest, 50, "steps in one flight");
        assert_true!(touched, "grains touch, case {case}");
        assert_eq!(
            stepped.clock().rejected > 0,
            case == 2,
            "{} steps were tried again",
            stepped.clock().rejected
        );
    }
}

/// A flight stops before the moment that is asked for is passed, at the first step that reaches it.
#[test]
fn a_flight_ends_where_it_is_asked_to() {
    let mut simulation = crowd(&format!("{RESTITUTION}[engine.verlet]\nstep = \"2 ns\"\n"));
    simulation.advance(9e-9).unwrap();
    assert_eq!(simulation.clock().step, 5);
    assert_near!(simulation.clock().time, 10e-9, 1e-20, "s");
}

/// A step that is not taken leaves the grains where they were before it, whether it began by itself or in flight; loads come back
/// from what they did to velocities, which rounds.
#[test]
fn a_flight_that_fails_leaves_the_grains_before_the_step() {
    let text = format!("[limits]\nstrain = 0.005\n{RESTITUTION}[engine.verlet]\nstep = \"2 ns\"\n");
    let (mut flown, mut stepped) = (crowd(&text), crowd(&text));
    let fails = |simulation: &mut Simulation, by: fn(&mut Simulation) -> Result<(), SimError>| {
        (0..10_000).find_map(|_| by(simulation).err()).unwrap()
    };
    let failed = fails(&mut flown, |simulation| simulation.advance(f64::INFINITY));
    let also = fails(&mut stepped, Simulation::step);
    assert_eq!(failed.to_string(), also.to_string());
    assert!(matches!(failed, SimError::TooDeep { .. }), "{failed}");
    assert_true!(flown.clock().step > 20 && flown.clock().step % 100 != 1, "it failed in flight");
    assert_none!(flown.system.afloat);
    let [one, two] = [&flown, &stepped].map(|simulation| &simulation.system);
    assert_eq!(flown.clock(), stepped.clock());
    assert_true!(one.grains == two.grains, "the grains");
    let largest = two.loads.force.iter().map(|force| force.norm()).fold(0.0, f64::max);
    for (force, by_steps) in one.loads.force.iter().zip(&two.loads.force) {
        assert_near_vector!(*force, *by_steps, 1e-15 * largest, "in N");
    }
}
