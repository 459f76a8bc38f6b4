//! Grains that slide and roll on planes.

use agglo::math::Vec3;

use crate::common::{self, grain};
use crate::walls::{G, GRAVITY, at_rest, damped, grains_at, mass, plane, wall};

/// A grain that slides at v0 rolls from t = 2 v0/(7 μ g) on, with (5/7) v0: what it has of angular momentum about the point of contact stays.
/// Steps are 2e-4 of that time. The arm of the moment is shorter by the overlap, 1e-5 of the radius.
#[test]
fn a_sliding_grain_comes_to_roll() {
    let (speed, friction) = (0.1, 0.3);
    let start = [0.0, 0.0, 1e-3 - at_rest(1.0)];
    let more = format!("{}{}{GRAVITY}", plane([0.0, 0.0, 1.0], ""), damped(friction));
    let text = grains_at(&[start], 15e-3, &common::verlet(2e-6), &more);
    let mut simulation = common::start(&text, |grains| grains.velocity[0].x = speed);
    let mut ended = None;
    let mut before = speed;
    common::watch(&mut simulation, |simulation| {
        let now = grain(simulation, 0);
        // The floor is below: the surface moves at v - ω R there.
        let slip = now.velocity.x - now.angular_velocity.y * 1e-3;
        let clock = simulation.clock();
        if ended.is_none() && slip <= 0.0 {
            ended = Some(clock.time - clock.last_step * slip / (slip - before));
        }
        before = slip;
    });
    assert_close!(ended.unwrap(), 2.0 * speed / (7.0 * friction * G), 1e-3, "in s");
    let end = grain(&simulation, 0);
    assert_close!(end.velocity.x, 5.0 / 7.0 * speed, 1e-4, "in m/s");
    assert_close!(end.angular_velocity.y, 5.0 / 7.0 * speed / 1e-3, 1e-4, "in rad/s");
    // Friction took (1/7) m v0², as it was written.
    let lost = mass() * speed * speed / 7.0;
    let balance = simulation.balance();
    assert_close!(balance.friction + balance.damping, lost, 2e-3, "in J");
    assert_near!(balance.drift, 0.0, 1e-3 * lost, "in J");
    assert_eq!(wall(&simulation, "floor").work, 0.0);
}

/// A grain on an incline of 30 degrees at rest: with μ above (2/7) tan θ it rolls with (5/7) g sin θ, below it slides with
/// g (sin θ - μ cos θ) and spins up by (5/2) μ g cos θ/R. Springs need a thousandth of the time to be loaded.
#[test]
fn a_grain_on_an_incline_rolls_or_slides() {
    let (sin, cos) = (0.5, 0.75_f64.sqrt());
    let along = Vec3::new(cos, 0.0, -sin);
    let end = 20e-3;
    for friction in [0.5, 0.1] {
        let out = 1e-3 - at_rest(cos);
        let more = format!("{}{}{GRAVITY}", plane([sin, 0.0, cos], ""), damped(friction));
        let text = grains_at(&[[sin * out, 0.0, cos * out]], end, &common::verlet(2e-6), &more);
        let mut simulation = common::start(&text, |_| {});
        common::finish(&mut simulation);
        let rolls = friction > 2.0 / 7.0 * sin / cos;
        let (acceleration, spin) = if rolls {
            (5.0 / 7.0 * G * sin, 5.0 / 7.0 * G * sin / 1e-3)
        } else {
            (G * (sin - friction * cos), 2.5 * friction * G * cos / 1e-3)
        };
        let found = grain(&simulation, 0);
        assert_close!(found.velocity.dot(along), acceleration * end, 1e-3, "in m/s, μ = {friction}");
        assert_close!(found.angular_velocity.y, spin * end, 1e-3, "in rad/s, μ = {friction}");
        assert_below!(simulation.balance().drift_relative.abs(), 1e-3);
    }
}

/// A grain in a groove of two planes that stand at right angles, one 30 degrees steep: it stays, and presses on each with its part of
/// the weight, m g cos 30° and m g sin 30°.
#[test]
fn a_grain_in_a_groove_stays() {
    let (sin, cos) = (0.5, 0.75_f64.sqrt());
    let stop = "[[walls]]\nname = \"stop\"\nmaterial = \"glass\"\n\
                shape.plane = { point = [\"0 m\", \"0 m\", \"0 m\"], normal = [-0.8660254037844386, 0.0, 0.5] }\n";
    let more = format!("{}{stop}{}{GRAVITY}", plane([sin, 0.0, cos], ""), damped(0.5));
    // The center is a radius less an overlap from each.
    let (a, b) = (1e-3 - at_rest(cos), 1e-3 - at_rest(sin));
    let start = [sin * a - cos * b, 0.0, cos * a + sin * b];
    let text = grains_at(&[start], 20e-3, &common::verlet(2e-6), &more);
    let mut simulation = common::start(&text, |_| {});
    common::finish(&mut simulation);
    let found = grain(&simulation, 0);
    // It was placed at rest to rounding of an overlap of 1e-8 m beside 1e-3 m.
    assert_near_vector!(found.position, Vec3::from(start), 1e-12, "in m");
    let weight = mass() * G;
    let (floor, stop) = (wall(&simulation, "floor"), wall(&simulation, "stop"));
    assert_close_vector!(floor.force, Vec3::new(-sin, 0.0, -cos) * (weight * cos), 1e-6, "in N");
    assert_close_vector!(stop.force, Vec3::new(cos, 0.0, -sin) * (weight * sin), 1e-6, "in N");
    assert_eq!((floor.contacts, stop.contacts), (1, 1));
}
