//! Corners of both engines: each of these tests is the only one that some spoiled engine does not pass.

use super::Simulation;
use super::test_systems::{Grain, advance_to, particles, restitution, scenario, start};
use crate::math::Vec3;

const EVENTS: &str = "[engine.event_driven]";
const STEPS: &str = "[engine.time_stepped]\nshortest_step = \"10 ns\"";

/// In one step of 10 us the left ball touches after 2 us and the right one after 6 us: the left one comes first. With
/// e = 1/2 the ball between goes 0, 3/4, -3/16 m/s; the other way round it would go -3/8, 21/32 and wait.
#[test]
fn who_touches_longest_comes_first() {
    let engine = "[engine.time_stepped]\nshortest_step = \"10 us\"\nlongest_step = \"10 us\"";
    let r = 1e-3;
    let grains: [Grain; 3] = [
        ([-2.0 * r - 2e-6, 0.0, 0.0], [1.0, 0.0, 0.0], r),
        ([0.0; 3], [0.0; 3], r),
        ([2.0 * r + 3e-6, 0.0, 0.0], [-0.5, 0.0, 0.0], r),
    ];
    for order in [[0, 1, 2], [2, 1, 0]] {
        let named = order.map(|at| grains[at]);
        let mut simulation = start(&scenario(engine, "open", &restitution(0.5)), &named);
        simulation.advance(1.0).unwrap();
        let mut found = simulation.snapshot().grains.velocity.iter().map(|v| v.x).collect::<Vec<_>>();
        if order[0] == 2 {
            found.reverse();
        }
        for (found, wanted) in found.iter().zip([0.25, -0.1875, 0.4375]) {
            // Two collisions that round.
            assert!((found - wanted).abs() < 1e-14, "{found} and not {wanted}");
        }
    }
}

/// Two slide along a wall into one another, step by step: their merged sphere reaches into the wall by a quarter of a
/// radius and turns round, but is not thrown out of the wall.
#[test]
fn a_sphere_that_grew_into_a_wall_only_turns_round() {
    let r = 1e-3;
    for side in [-1.0, 1.0] {
        let at = side * (0.01 - r - 1e-5);
        let grains: [Grain; 2] = [
            ([at, -1.5e-3, 0.0], [side * 0.01, 1.0, 0.0], r),
            ([at, 1.5e-3, 0.0], [side * 0.01, -1.0, 0.0], r),
        ];
        let mut simulation = start(&scenario(STEPS, "reflecting", &restitution(0.0)), &grains);
        advance_to(&mut simulation, 0.51e-3);
        let counts = &simulation.system().state.counts;
        assert_eq!((counts.merges, counts.walls), (1, 1));
        // 5 um on and then back; the collision may be late by a step of 10 ns, and the way back by all after it.
        let (time, place) = (simulation.clock().time, simulation.snapshot().grains.position[0].x);
        let wanted = side * (0.01 - r - 5e-6 - 0.01 * (time - 0.5e-3));
        assert!((place - wanted).abs() < 1e-9, "{place} and not {wanted}");
    }
}

/// Newton's cradle among others that fly on with it at 35 m/s: by the time of the collision all are 5 mm from where they
/// were sorted into cells, and those behind the one that is hit are found in the same step nevertheless.
#[test]
fn a_cradle_in_flight() {
    let flight = 35.0;
    let ball = |x: f64, speed: f64| ([x, 0.0, 0.0], [speed, flight, 0.0], 1e-3);
    let mut grains: Vec<Grain> = vec![ball(-5e-3, 7.0), ball(-2e-3, 0.0), ball(0.0, 0.0), ball(2e-3, 0.0)];
    let places = [-7.5e-3, -2.5e-3, 2.5e-3, 7.5e-3];
    for z in [-8e-3, -4e-3, 4e-3, 8e-3] {
        grains.extend(places.iter().flat_map(|&x| places.map(|y| ([x, y, z], [0.0, flight, 0.0], 0.3e-3))));
    }
    let mut simulation = start(&scenario(STEPS, "periodic", &restitution(1.0)), &grains);
    let mut turns = agglo_testing::Turns::at_most(1_000_000, "the first impact");
    while simulation.system().state.counts.collisions == 0 {
        turns.take();
        simulation.advance(1.0).unwrap();
    }
    assert_eq!(simulation.system().state.counts.collisions, 3);
    let after = simulation.snapshot().grains.velocity;
    // Three collisions that each round once.
    assert!((after[3] - Vec3::new(7.0, flight, 0.0)).norm() < 1e-13, "{:?}", after[3]);
}

/// One partner cannot keep heat: its half of what was lost, 3/4 of m v²/4, is booked as not kept, and the ledger closes.
#[test]
fn heat_that_only_one_partner_keeps() {
    let impact = format!("[materials.dust]\ndensity = \"1000 kg/m3\"\n{}", restitution(0.5));
    let grains = [([-1e-3, 0.0, 0.0], [20.0, 0.0, 0.0], 1e-3), ([1.1e-3, 0.0, 0.0], [0.0; 3], 1e-3)];
    // Materials are numbered in the order of their names.
    let mut rows = particles(&grains);
    rows.material[1] = 1;
    let mut simulation = Simulation::start(&scenario(EVENTS, "open", &impact), &rows).unwrap();
    advance_to(&mut simulation, 1e-4);
    let lost = 0.75 * 0.25 * rows.mass[0] * 400.0;
    let ledger = &simulation.system().state.ledger;
    // The energy is a difference of squares, and what was kept one of temperatures near 300 K: 1e-16 of 1.3 J each.
    assert_near!(ledger.flows.unkept.value(), 0.5 * lost, 1e-14, "in J");
    assert_below!(simulation.balance().drift.abs(), 1e-14);
}

/// A millionth of mean radius over deviation: 2 mm over 5 m/s, with velocities (±3, 4 ∓ 4, 0) m/s about their mean.
#[test]
fn the_contact_duration_by_default() {
    let grains = [([-5e-3, 0.0, 0.0], [3.0, 0.0, 0.0], 1e-3), ([5e-3, 0.0, 0.0], [-3.0, 8.0, 0.0], 3e-3)];
    let simulation = start(&scenario(EVENTS, "open", &restitution(1.0)), &grains);
    assert_close!(simulation.system().contact_duration, 4e-10, 1e-14, "in s");
}

/// A merge is no bounce: what hits the merged sphere within the contact duration rebounds with its own restitution.
#[test]
fn a_merge_does_not_arm_the_guard() {
    let laws = "[materials.dust]\ndensity = \"1000 kg/m3\"\nheat_capacity = \"1000 J/kg/K\"\n\
                [[mixtures]]\nbetween = [\"dust\", \"stone\"]\nrestitution = 0.5\n";
    let impact = format!("{laws}{}", restitution(0.0));
    let engine = "[engine.event_driven]\ncontact_duration = \"1 s\"";
    let grains = [
        ([-1.1e-3, 0.0, 0.0], [1.0, 0.0, 0.0], 1e-3),
        ([1.1e-3, 0.0, 0.0], [-1.0, 0.0, 0.0], 1e-3),
        ([6e-3, 0.0, 0.0], [-3.0, 0.0, 0.0], 1e-3),
    ];
    let mut rows = particles(&grains);
    rows.material = vec![1, 1, 0];
    let mut simulation = Simulation::start(&scenario(engine, "open", &impact), &rows).unwrap();
    advance_to(&mut simulation, 5e-3);
    let counts = &simulation.system().state.counts;
    assert_eq!((counts.merges, counts.bounces, counts.tc_bounces), (1, 1, 0));
    // Masses 2 : 1 and e = 1/2: -1 -+ (1/3, 2/3) 1.5 m/s.
    let after = simulation.snapshot().grains.velocity;
    assert!((after[0].x + 1.5).abs() < 1e-14 && after[1].x.abs() < 1e-14, "{after:?}");
}
