//! Grains at faces that turn them back and that take them out.

use super::*;
use crate::contact::bond::Break;
use crate::math::Vec3;
use crate::testing::{Scenario, place};

/// A box of 2 mm along x, without an end along the other axes.
fn scenario(faces: &str, places: &str, more: &str) -> Scenario {
    let text = format!(
        r#"
version = 1
time.end = "1 s"
engine.verlet.step = "10 us"
[volume]
lower = ["-1 mm", "-1 mm", "-1 mm"]
upper = ["1 mm", "1 mm", "1 mm"]
boundary = "open"
faces.x = "{faces}"
[materials.glass]
density = "2500 kg/m3"
[[grains]]
material = "glass"
size.constant.radius = "0.1 mm"
placement.list.positions = {places}
{more}
"#
    );
    Scenario::from_toml(&text).unwrap_or_else(|faults| panic!("{faults}"))
}

fn started(scenario: &Scenario, velocities: &[Vec3]) -> Simulation {
    let mut grains = place(scenario).unwrap();
    // Grains are not sorted yet.
    grains.velocity.copy_from_slice(velocities);
    Simulation::start(scenario, grains).unwrap_or_else(|error| panic!("{error}"))
}

fn steps(simulation: &mut Simulation, count: usize) {
    (0..count).for_each(|_| simulation.step().unwrap_or_else(|error| panic!("{error}")));
}

const ONE: &str = r#"[["0 m", "0 m", "0 m"]]"#;
const GRAVITY: &str = "[fields.gravity]\nacceleration = [\"-9.8 m/s2\", \"0 m/s2\", \"0 m/s2\"]\n";
const WATER: &str =
    "[medium]\ndensity = \"1000 kg/m3\"\nviscosity = \"1 mPa s\"\n[fields.drag]\nlaw = \"stokes\"\n";

/// To and fro between surfaces 1.8 mm apart: each of the bounces is up to the way of a step, 4 um, beyond its face, and as much
/// way back. The speed has
/// the bits that it had, and the ledger knows of every impulse.
#[test]
fn a_free_grain_flies_to_and_fro() {
    let velocity = Vec3::new(0.4, 0.1, -0.2);
    let mut simulation = started(&scenario("reflecting", ONE, ""), &[velocity]);
    steps(&mut simulation, 5000);
    let grains = &simulation.system.grains;
    let way = 0.4 * simulation.clock().time;
    // The 20 mm end in the 11th or 12th bounce: a triangle wave about 0.
    let folded = ((way + 0.9e-3) % 3.6e-3 - 1.8e-3).abs();
    let bounces = ((way + 0.9e-3) / 1.8e-3).floor();
    assert_eq!(bounces, 11.0);
    assert_near!(grains.position[0].x, 0.9e-3 - folded, bounces * 8.01e-6);
    assert_eq!(grains.velocity[0], Vec3::new(-0.4, 0.1, -0.2));
    let given = simulation.ledger.flows.supplies.walls;
    let mass = grains.mass[0];
    assert_near!(given.force.x, -0.8 * mass, 1e-12 * mass);
    assert_eq!(given.power, 0.0);
    // One rounding each of 11 bounces.
    assert_below!(simulation.momentum_drift_relative(), 1e-14);
    let drift = simulation.momentum_drift(&simulation.momentum()).angular.norm();
    assert_below!(drift / (mass * 0.4 * 20e-3), 1e-13);
    assert_eq!(simulation.absorbed(), None);
}

/// Under a constant force the scheme has no error, so that neither energy nor work may have one beyond rounding; the load at the
/// start of the step after a bounce is that of the turned velocity.
#[test]
fn a_grain_that_falls_bounces_as_high_as_it_was() {
    let mut simulation = started(&scenario("reflecting", ONE, GRAVITY), &[Vec3::ZERO]);
    let (mut highest, mut bounces, mut before) = (f64::NEG_INFINITY, 0, 0.0);
    for _ in 0..30_000 {
        steps(&mut simulation, 1);
        let (place, velocity) =
            (simulation.system.grains.position[0].x, simulation.system.grains.velocity[0].x);
        bounces += i32::from(before < 0.0 && velocity > 0.0);
        before = velocity;
        highest = if bounces > 0 { highest.max(place) } else { highest };
    }
    // Down by 0.9 mm in sqrt(2 h/g) = 13.55 ms, and twice that from bounce to bounce, less what is left of a step: 11 in 0.3 s.
    assert_eq!(bounces, 11);
    assert_near!(highest, 0.0, 1e-9);
    let balance = simulation.balance();
    let depth = simulation.system.grains.position[0].x;
    let mass = simulation.system.grains.mass[0];
    assert_near!(balance.gravity, -mass * 9.8 * depth, 1e-11 * mass * 9.8 * 0.9e-3);
    assert_below!(balance.drift_relative, 1e-11);
    // Against all that gravity gave: 30,000 sums.
    let unexplained = simulation.momentum_drift(&simulation.momentum()).linear.norm();
    assert_below!(unexplained / (mass * 9.8 * 0.3), 1e-11);
}

/// A drag along the velocity turns round with it: the speed falls as in open space, and no less is lost.
#[test]
fn drag_turns_round_with_the_grain() {
    let velocity = Vec3::new(0.4, 0.0, 0.0);
    let [mut turned, mut free] = ["reflecting", "open"].map(|faces| {
        let mut simulation = started(&scenario(faces, ONE, WATER), &[velocity]);
        steps(&mut simulation, 2500);
        simulation
    });
    assert_above!(turned.ledger.flows.supplies.walls.force.norm(), 0.0);
    let speed = |simulation: &Simulation| simulation.system.grains.velocity[0].norm();
    assert_close!(speed(&turned), speed(&free), 1e-12);
    assert_close!(turned.balance().drag, free.balance().drag, 1e-12);
    steps(&mut turned, 1);
    steps(&mut free, 1);
    assert_close!(speed(&turned), speed(&free), 1e-12);
}

/// Two pairs that press on each other and rub; the pair at the face leaves, the other one goes on as if it had been alone.
#[test]
fn who_stays_goes_on_as_if_alone() {
    let contact = "[contact.normal.hooke]\nstiffness = \"1 mN/m\"\n[contact.friction.mindlin]\nstatic_friction = 0.3\n\
                   stiffness_ratio = 0.8\n[limits]\ndrift_error = 1e3\n";
    let four = r#"[["0.80 mm", "0 m", "0 m"], ["0.80 mm", "0.199 mm", "0 m"], ["-0.5 mm", "0 m", "0 m"], ["-0.5 mm", "0.199 mm", "0 m"]]"#;
    let two = r#"[["-0.5 mm", "0 m", "0 m"], ["-0.5 mm", "0.199 mm", "0 m"]]"#;
    let (out, rub) = (Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 1e-3));
    let mut all = started(&scenario("absorbing", four, contact), &[out, out, rub, -rub]);
    let mut pair = started(&scenario("absorbing", two, contact), &[rub, -rub]);
    steps(&mut all, 60);
    steps(&mut pair, 60);
    let mass = pair.system.grains.mass[0];
    assert_eq!(all.absorbed(), Some(Absorbed { grains: 2, mass: 2.0 * mass }));
    let mut ids = all.system.grains.id.clone();
    ids.sort_unstable();
    assert_eq!(ids, [2, 3]);
    assert_eq!(all.system.remembered().len(), 1);
    for id in [2, 3] {
        let at = |simulation: &Simulation, id| {
            let grains = &simulation.system.grains;
            let at = grains.id.iter().position(|one| *one == id).unwrap();
            (grains.position[at], grains.velocity[at], grains.angular_velocity[at])
        };
        assert_eq!(at(&all, id), at(&pair, id - 2), "grain {id}");
    }
    // What left is what two masses have at 1 m/s, with k d^2/2 of their spring as it was at the start.
    let balance = all.balance();
    let spring = 0.5 * 1e-3 * 1e-6 * 1e-6;
    assert_near!(balance.absorbed - mass, spring, 1e-3 * spring + 1e-15 * mass);
    assert_below!((all.ledger.flows.carried_off.linear.x - 2.0 * mass).abs(), 1e-12 * mass);
    assert_below!(balance.drift_relative, 1e-4);
    assert_below!(all.momentum_drift_relative(), 1e-12);
}

/// A bond ends with one of its grains, is told, and has its energy carried off.
#[test]
fn bonds_end_with_their_grains() {
    let bond = "[bonds.beam]\nyoungs_modulus = \"1 kPa\"\ntensile_strength = \"1 GPa\"\nshear_strength = \"1 GPa\"\ngap = 0.1\n";
    let three = r#"[["0.93 mm", "0 m", "0 m"], ["0.725 mm", "0 m", "0 m"], ["0.52 mm", "0 m", "0 m"]]"#;
    let mut simulation =
        started(&scenario("absorbing", three, bond), &[Vec3::AXES[0] * 2.0, Vec3::ZERO, Vec3::ZERO]);
    assert_eq!(simulation.system.network.bonds().len(), 2);
    let mut before = simulation.balance();
    while simulation.absorbed().is_some_and(|absorbed| absorbed.grains == 0) {
        before = simulation.balance();
        steps(&mut simulation, 1);
    }
    let [left] = &simulation.system.network.bonds() else {
        panic!("{:?}", simulation.system.network.bonds())
    };
    assert_eq!(left.ids, [1, 2]);
    let [event] = &simulation.events[..] else { panic!("{:?}", simulation.events) };
    assert_eq!((event.ids, event.broke), ([0, 1], Some(Break::Left)));
    assert_above!(event.energy, 0.0);
    let balance = simulation.balance();
    assert_above!(balance.absorbed, event.energy);
    assert_eq!(balance.broken_bonds, 0.0);
    assert_near!(balance.drift, before.drift, 1e-5 * balance.absorbed);
    steps(&mut simulation, 200);
    assert_below!(simulation.balance().drift_relative, 1e-3);
    assert_below!(simulation.momentum_drift_relative(), 1e-12);
}

#[test]
fn a_run_ends_where_nothing_is_left() {
    let mut simulation = started(&scenario("absorbing", ONE, ""), &[Vec3::AXES[0]]);
    let error = (0..200).find_map(|_| simulation.step().err()).unwrap_or_else(|| panic!("grains are left"));
    // 1 mm at 1 m/s.
    assert_matches!(error, SimError::NoneLeft { at } if (at.time - 1e-3).abs() < 2e-5);
}

#[test]
fn faces_that_cannot_be_are_refused() {
    let refused = |faces: &str, more: &str| {
        let scenario = scenario(faces, ONE, more);
        Simulation::start(&scenario, place(&scenario).unwrap()).unwrap_err()
    };
    assert_matches!(refused("antipodal", ""), SimError::ForeignVolume { spheres: "soft", .. });
    let pressed = "[volume.deformation]\nstrain_rate = [\"0 1/s\", \"-1 1/s\", \"0 1/s\"]\n";
    assert_matches!(refused("absorbing", pressed), SimError::AbsorbsInDeformation);
}
