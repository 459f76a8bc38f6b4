//! What an update of the trial motion amounts to, for more grains than one thread takes at a time.

use super::*;
use crate::contact::pass::deepest_pair;
use crate::engine::soft::Simulation;
use crate::engine::soft::skin::Skin;
use crate::particles::{Particles, Row};
use crate::testing::Scenario;

const RADIUS: f64 = 1e-4;
const DT: f64 = 1e-6;
/// Four leaves and a half, so that both halves are cut again.
const MANY: usize = 9 * BLOCK / 2;

/// A row of grains, far from one another, in water; each flies along x at its own speed, `fast` ten times as fast.
fn row(count: usize, fast: usize) -> System {
    let text = "version = 1\ntime.end = \"1 ms\"\nengine.verlet = {}\n\
                medium = { density = \"1000 kg/m3\", viscosity = \"1 mPa s\" }\n[materials.stone]\n\
                density = \"2500 kg/m3\"\n[[grains]]\nmaterial = \"stone\"\nsize.constant.radius = \"0.1 mm\"\n\
                placement.list.positions = [[\"0 m\", \"0 m\", \"0 m\"]]\n[fields.drag]\nlaw = \"stokes\"\n\
                [contact.normal.hooke]\nstiffness = \"10 N/m\"\n";
    let mut grains = Particles::default();
    for at in 0..count {
        let speed = if at == fast { 10.0 } else { 1.0 };
        grains.push(Row {
            id: at as u32,
            position: Vec3::AXES[0] * (10.0 * RADIUS * at as f64),
            velocity: Vec3::AXES[0] * speed,
            radius: RADIUS,
            mass: 1e-8,
            ..Row::default()
        });
    }
    Simulation::start(&Scenario::from_toml(text).unwrap(), grains).unwrap().system
}

/// The sums are those over all grains, and the farthest is found wherever it stands. Ways of 1 um are differences of places up
/// to 4.6 m, which are rounded at 4e-16 m.
#[test]
fn a_change_is_that_of_all_grains() {
    for fast in [3, BLOCK - 1, BLOCK + 7, 3 * BLOCK + 1, MANY - 1] {
        let mut system = row(MANY, fast);
        let change = system.move_trial(0.0, DT, 0.5, Ahead::AsAtStart);
        let ways: Vec<f64> =
            system.records.iter().map(|record| (record.now().0 - record.before().0).norm()).collect();
        let all: f64 = ways.iter().sum();
        assert_close!(change.since_start, all, 1e-9, "in m, {fast}");
        assert_close!(change.since_last, all, 1e-9, "in m, {fast}");
        assert_close!(change.farthest, ways[fast] / RADIUS, 1e-9, "in radii, {fast}");
        assert_close!(change.wavering, ways[fast], 1e-9, "in m, {fast}");
        assert_eq!([change.farthest_grain, change.wavering_grain], [fast as u32; 2]);
        assert_none!(change.not_finite);
        system.grains.velocity[fast].y = f64::NAN;
        let broken = system.move_trial(0.0, DT, 0.5, Ahead::AsAtStart);
        assert_eq!(broken.not_finite, Some(fast as u32));
    }
}

/// The deepest contact is found wherever it stands, among others: overlaps of 0.1 and, once, 0.2 of the sum of radii.
#[test]
fn the_deepest_contact_is_that_of_all_grains() {
    for deep in [3, BLOCK - 1, BLOCK + 7, 3 * BLOCK + 1, MANY - 2] {
        let mut system = row(MANY, usize::MAX);
        for at in (0..MANY - 1).filter(|at| at % 500 == 3 || *at == deep) {
            let part = if at == deep { 0.8 } else { 0.9 };
            let place = system.grains.position[at] + Vec3::AXES[0] * (2.0 * RADIUS * part);
            system.grains.position[at + 1] = place;
        }
        system.skin = Skin::new(&system.grains.radius);
        system.list_neighbors();
        system.evaluate(0.0, DT);
        let found = system.trial.contact;
        assert_close!(found.worst_strain, 0.2, 1e-9);
        assert_eq!(system.with_trial_contacts(deepest_pair), Some([deep, deep + 1]));
    }
}

/// Impulses of rays are given whole within a step, whatever its length, and forces act for as long as it is; from off the center
/// both turn the grain: J/m and L/I of a ball, in the first try and in the corrected one.
#[test]
fn rays_push_and_turn_each_grain() {
    let (push, twist) = (Vec3::new(3e-9, 0.0, 1e-9), Vec3::new(0.0, 2e-13, -5e-13));
    for (are_impulses, dt) in [(true, 2e-9), (true, 5e-9), (false, 2e-9), (false, 5e-9)] {
        let mut system = row(3, usize::MAX);
        for grain in 0..3 {
            let share = grain as f64 / if are_impulses { 1.0 } else { dt };
            system.ray_loads.fit(system.grains.len());
            system.ray_loads.force[grain] = push * share;
            system.ray_loads.torque[grain] = twist * share;
        }
        (system.has_ray_loads, system.rays_are_impulses) = (true, are_impulses);
        let inertia = 0.4 * 1e-8 * RADIUS * RADIUS;
        for is_corrected in [false, true] {
            if is_corrected {
                system.meet(dt, dt, dt);
                system.finish(dt, dt);
            } else {
                system.move_trial(0.0, dt, 0.5, Ahead::AsAtStart);
            }
            let found: Vec<(Vec3, Vec3, Vec3)> = if is_corrected {
                (0..3).map(|grain| system.grains.motion_of(grain)).collect()
            } else {
                system.records.iter().map(Record::now).collect()
            };
            for grain in 0..3 {
                let (velocity, angular_velocity) =
                    (Vec3::AXES[0] + push * (grain as f64 / 1e-8), twist * (grain as f64 / inertia));
                // Drag takes 6 π η R dt/m = 1e-6 of a speed in 5 ns, and 1.3e-5 of an angular velocity.
                assert_near_vector!(found[grain].1, velocity, 2e-6 * velocity.norm(), "in m/s");
                assert_near_vector!(
                    found[grain].2,
                    angular_velocity,
                    2e-5 * angular_velocity.norm(),
                    "in rad/s"
                );
            }
        }
    }
}

/// What solving for velocities changes in drag is that of each grain, added up: alike grains have so many times that of one.
#[test]
fn corrections_are_those_of_all_grains() {
    let corrected = |count: usize| {
        let mut system = row(count, usize::MAX);
        let before = system.rates.supplies.drag.force.x;
        system.trial.rates = system.rates;
        system.move_trial(0.0, DT, 0.5, Ahead::AsAtStart);
        let moved = (system.trial.rates.supplies.drag.force.x - before, system.trial.rates.bend);
        // A guess that is off, so that there is something to correct.
        for record in &mut system.records {
            let (place, (kick, twist)) = (record.now().0, record.changes());
            record.end(place, kick + Vec3::AXES[0] * 0.1, twist);
        }
        system.evaluate(DT, DT);
        let before = system.trial.rates.supplies.drag.force.x;
        system.finish(DT, DT);
        let rates = &system.trial.rates;
        [moved.0, moved.1, rates.supplies.drag.force.x - before, rates.bend]
    };
    let (one, all) = (corrected(1), corrected(MANY));
    for (all, one) in all.into_iter().zip(one) {
        assert!(one != 0.0, "nothing was corrected");
        // A correction is the difference of sums of forces some hundred times as large.
        assert_close!(all, MANY as f64 * one, 1e-10);
    }
}
