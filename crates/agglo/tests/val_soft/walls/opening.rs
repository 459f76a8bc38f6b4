//! Grains at a hole in a plate.

use agglo::math::Vec3;

use crate::common::{self, grain};
use crate::walls::{G, GRAVITY, grains_at, wall};

fn plate(start: [f64; 3], end: f64) -> String {
    let more = "[[walls]]\nname = \"plate\"\nmaterial = \"glass\"\n\
                shape.plane = { point = [\"9 mm\", \"0 m\", \"0 m\"], normal = [0.0, 0.0, 1.0], \
                opening = { center = [\"0 m\", \"0 m\", \"0 m\"], radius = \"3 mm\" } }\n\
                [contact.normal.hooke]\nstiffness = \"1e4 N/m\"\n";
    grains_at(&[start], end, &common::verlet(2e-6), &format!("{more}{GRAVITY}"))
}

/// Over the middle of the hole a grain falls through without a touch: z0 - g t²/2, which Verlet has exactly.
#[test]
fn a_grain_falls_through_the_hole() {
    let mut simulation = common::start(&plate([0.5e-3, 0.0, 2e-3], 40e-3), |_| {});
    let mut touched = false;
    common::watch(&mut simulation, |simulation| touched |= wall(simulation, "plate").contacts > 0);
    let end = grain(&simulation, 0);
    assert_false!(touched, "it touches the plate");
    assert_near!(end.position.z, 2e-3 - 0.5 * G * 1.6e-3, 1e-12, "in m");
    assert_below!(end.position.z, -5e-3, "in m: it is below the plate");
}

/// Half a radius from the rim a grain touches it where it has come down to R cos 30°; the force is along the line from the rim to the
/// center, and the energy of its motion is kept over the bounce.
#[test]
fn a_grain_touches_the_rim() {
    let mut simulation = common::start(&plate([2.5e-3, 0.0, 2e-3], 30e-3), |_| {});
    let rim = Vec3::new(3e-3, 0.0, 0.0);
    let (mut first, mut presses) = (None, 0);
    common::watch(&mut simulation, |simulation| {
        let center = grain(simulation, 0).position;
        let of_plate = wall(simulation, "plate");
        if of_plate.contacts > 0 {
            first.get_or_insert(center.z);
            presses += 1;
            let away = center - rim;
            let overlap = 1e-3 - away.norm();
            assert_near_vector!(of_plate.force, away.normalized() * (-1e4 * overlap), 1e-9, "in N");
        }
    });
    // In a step of 2 us it comes down by 0.3 um.
    assert_near!(first.unwrap(), 1e-3 * 0.75_f64.sqrt(), 0.4e-6, "in m");
    assert_above!(presses, 20, "steps in contact");
    let end = grain(&simulation, 0);
    assert_below!(end.velocity.x, -0.01, "in m/s: the rim has thrown it inward");
    // With 50 steps a contact.
    assert_below!(simulation.balance().drift_relative.abs(), 1e-3);
}

/// From below a grain bounces off the underside of the plate, off the hole.
#[test]
fn the_plate_has_two_sides() {
    let text = plate([6e-3, 0.0, -2e-3], 10e-3).replace("-9.81 m/s2", "9.81 m/s2");
    let mut simulation = common::start(&text, |grains| grains.velocity[0].z = 0.3);
    let mut highest = f64::NEG_INFINITY;
    common::watch(&mut simulation, |simulation| highest = highest.max(grain(simulation, 0).position.z));
    assert_between!(highest, -1e-3..-0.9e-3, "in m");
    assert_below!(grain(&simulation, 0).velocity.z, 0.3, "in m/s");
}

/// A plate that goes down at 50 mm/s is passed where 2 mm - g t²/2 = -v t: within a step of 2 us, while 1 % of the time are 300 us.
#[test]
fn who_is_beyond_the_plate_has_passed() {
    for speed in [0.0, 0.05] {
        let motion =
            format!("motion.constant.velocity = [\"0 m/s\", \"0 m/s\", \"{:e} m/s\"]\n[contact", -speed);
        let text = plate([0.5e-3, 0.0, 2e-3], 40e-3).replacen("[contact", &motion, 1);
        let mut simulation = common::start(&text, |_| {});
        let (mut first, mut most) = (None, 0.0);
        common::watch(&mut simulation, |simulation| {
            let passed = wall(simulation, "plate").passed.unwrap();
            let mass = passed.grains as f64 * crate::walls::mass();
            assert_near!(passed.mass, mass, 1e-12 * crate::walls::mass(), "in kg");
            if passed.grains > 0 {
                first.get_or_insert(simulation.clock().time);
            }
            most = f64::max(most, passed.mass);
        });
        let due = (speed + (speed * speed + 2.0 * G * 2e-3).sqrt()) / G;
        assert_between!(first.unwrap(), due..due + 2.1e-6, "in s");
        assert_close!(most, crate::walls::mass(), 1e-12, "in kg");
    }
}

/// A grain that is thrown up through the hole has been beyond the plate from the start, is before it, and comes back; other walls have
/// nothing that passes.
#[test]
fn who_comes_back_is_taken_off() {
    let floor = "[[walls]]\nname = \"floor\"\nmaterial = \"glass\"\n\
                 shape.plane = { point = [\"0 m\", \"0 m\", \"-9 mm\"], normal = [0.0, 0.0, 1.0] }\n[contact";
    let text = plate([0.0, 0.0, -2e-3], 90e-3).replacen("[contact", floor, 1);
    let mut simulation = common::start(&text, |grains| grains.velocity[0].z = 0.4);
    let mut course = vec![];
    common::watch(&mut simulation, |simulation| {
        let passed = wall(simulation, "plate").passed.unwrap().grains;
        if course.last() != Some(&passed) {
            course.push(passed);
        }
        assert_none!(wall(simulation, "floor").passed);
    });
    assert_eq!(course, [1, 0, 1], "grains beyond the plate");
}
