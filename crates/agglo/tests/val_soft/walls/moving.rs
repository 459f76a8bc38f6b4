//! Grains at walls that move.

use agglo::math::Vec3;
use agglo::math::quadrature::integral;

use crate::common::{self, grain};
use crate::walls::{G, GRAVITY, at_rest, damped, grains_at, mass, plane, wall};

fn resting() -> [f64; 3] {
    [0.0, 0.0, 1e-3 - at_rest(1.0)]
}

/// A grain put on a belt at V rolls on it with (2/7) V: the belt's friction turns it as it pulls it. The belt's work is the impulse
/// (2/7) m V times V. Neither the time of sliding nor the arm is off by more than 1e-3.
#[test]
fn a_belt_takes_a_grain_along() {
    let (speed, more) = (0.1, |motion: &str| format!("motion.{motion}"));
    let motions = [
        more("constant = { velocity = [\"0.1 m/s\", \"0 m/s\", \"0 m/s\"] }"),
        more("formula = { velocity = [\"0.1\", \"0\", \"0\"] }"),
    ];
    for motion in motions {
        let more = format!("{}{}{GRAVITY}", plane([0.0, 0.0, 1.0], &motion), damped(0.3));
        let text = grains_at(&[resting()], 20e-3, &common::verlet(2e-6), &more);
        let mut simulation = common::start(&text, |_| {});
        common::finish(&mut simulation);
        let end = grain(&simulation, 0);
        assert_close!(end.velocity.x, 2.0 / 7.0 * speed, 1e-3, "in m/s, {motion}");
        assert_close!(end.angular_velocity.y, -5.0 / 7.0 * speed / 1e-3, 1e-3, "in rad/s, {motion}");
        let work = 2.0 / 7.0 * mass() * speed * speed;
        assert_close!(wall(&simulation, "floor").work, work, 1e-3, "in J, {motion}");
        let balance = simulation.balance();
        assert_close!(balance.walls, work, 1e-3, "in J, {motion}");
        assert_near!(balance.drift, 0.0, 1e-3 * work, "in J, {motion}");
        assert_below!(simulation.momentum_drift_relative(), 1e-9);
    }
}

/// A grain that rolls on a turntable goes round in circles at (2/7) Ω, wherever it is (K. Weltner, Am. J. Phys. 47, 984 (1979)). It begins to
/// roll without sliding: ω = (z × v + Ω r)/R. 1e-3: springs of contact give way, and the arm is shorter by 1e-5.
#[test]
fn val_weltner_1979_a_grain_on_a_turntable() {
    let (rate, end) = (20.0, 0.1);
    let motion = "motion.constant = { angular_velocity = [\"0 rad/s\", \"0 rad/s\", \"20 rad/s\"], \
                  about = [\"-5 mm\", \"2 mm\", \"0 m\"] }";
    let more = format!("{}{}{GRAVITY}", plane([0.0, 0.0, 1.0], motion), damped(0.5));
    let text = grains_at(&[resting()], end, &common::verlet(4e-6), &more);
    let velocity = Vec3::new(0.01, 0.0, 0.0);
    let offset = Vec3::new(5e-3, -2e-3, 0.0);
    let mut simulation = common::start(&text, |grains| {
        grains.velocity[0] = velocity;
        grains.angular_velocity[0] = (Vec3::AXES[2].cross(velocity) + offset * rate) / 1e-3;
    });
    common::finish(&mut simulation);
    let (sin, cos) = (2.0 / 7.0 * rate * end).sin_cos();
    let end = grain(&simulation, 0);
    assert_near_vector!(end.velocity, Vec3::new(cos, sin, 0.0) * 0.01, 1e-3 * 0.01, "in m/s");
    // The radius of the circle is v/(2 Ω/7) = 1.75 mm.
    let radius = 0.01 / (2.0 / 7.0 * rate);
    assert_near_vector!(
        end.position,
        Vec3::from(resting()) + Vec3::new(sin, 1.0 - cos, 0.0) * radius,
        1e-3 * radius,
        "in m"
    );
}

/// A grain on a spring over a floor that goes up and down: with r = Ω/ω0 it is at a/(1 - r²) (sin Ω t - r sin ω0 t), and the floor's work is
/// the integral of its force times its velocity. With 300 steps a period of the spring phases are off by (ω0 Δt)²/24 = 2e-5 of the angle, 22
/// rad in all.
#[test]
fn an_oscillating_floor_works_as_its_force_times_its_velocity() {
    let (stiffness, amplitude, frequency, end) = (1e4, 2e-9, 1500.0, 0.7e-3);
    let motions = [
        "motion.oscillating = { amplitude = [\"0 m\", \"0 m\", \"2 nm\"], frequency = \"1500 Hz\" }"
            .to_owned(),
        format!("motion.formula.velocity = [\"0\", \"0\", \"{amplitude:e}*2*pi*1500*cos(2*pi*1500*t)\"]"),
    ];
    let natural = (stiffness / mass()).sqrt();
    let driven = std::f64::consts::TAU * frequency;
    let ratio = driven / natural;
    let place =
        |t: f64| amplitude / (1.0 - ratio * ratio) * ((driven * t).sin() - ratio * (natural * t).sin());
    let force = |t: f64| stiffness * (amplitude * (driven * t).sin() - place(t)) + mass() * G;
    let work = integral(|t| force(t) * amplitude * driven * (driven * t).cos(), 0.0, end);
    let without_weight =
        integral(|t| (force(t) - mass() * G) * amplitude * driven * (driven * t).cos(), 0.0, end);
    for motion in motions {
        let hooke = "[contact.normal.hooke]\nstiffness = \"1e4 N/m\"\n";
        let more = format!("{}{hooke}{GRAVITY}", plane([0.0, 0.0, 1.0], &motion));
        let step = std::f64::consts::TAU / natural / 300.0;
        let text = grains_at(&[resting()], end, &common::verlet(step), &more);
        let mut simulation = common::start(&text, |_| {});
        common::finish(&mut simulation);
        let found = grain(&simulation, 0).position.z - resting()[2];
        assert_near!(found, place(end), 1e-3 * amplitude, "in m, {motion}");
        let put_in = wall(&simulation, "floor").work;
        assert_near!(put_in, work, 1e-3 * without_weight.abs(), "in J, {motion}");
        assert_near!(simulation.balance().drift, 0.0, 1e-3 * without_weight.abs(), "in J, {motion}");
    }
}

/// A ram at constant speed throws a grain that rests in its way with twice its speed; a formula that says the same does the same.
#[test]
fn a_ram_throws_a_grain() {
    let motions = [
        "motion.constant.velocity = [\"0 m/s\", \"0 m/s\", \"0.1 m/s\"]",
        "motion.formula.velocity = [\"0\", \"0\", \"0.1 + 0*t\"]",
    ];
    for motion in motions {
        let hooke = "[contact.normal.hooke]\nstiffness = \"1e4 N/m\"\n";
        let more = format!("{}{hooke}", plane([0.0, 0.0, 1.0], motion));
        let text = grains_at(&[[0.0, 0.0, 1.05e-3]], 1e-3, &common::verlet(2e-7), &more);
        let mut simulation = common::start(&text, |_| {});
        common::finish(&mut simulation);
        // 500 steps a contact: (ω Δt)² of the speed.
        assert_close!(grain(&simulation, 0).velocity.z, 0.2, 1e-5, "in m/s, {motion}");
        assert_close!(wall(&simulation, "floor").work, 0.5 * mass() * 0.04, 1e-4, "in J, {motion}");
    }
}
