//! One step of each scheme by hand, with loads that depend on time and velocity: which end of the step counts how much.
//!
//! Orders of accuracy cannot tell φ from 1 - φ, nor see a mistake that shrinks with the step as the scheme's own error does.

use std::f64::consts::PI;

use agglo::engine::soft::Simulation;
use agglo::math::Vec3;

use crate::common::{self, Listed, grain};

const RADIUS: f64 = 20e-6;
const STEP: f64 = 1e-6;
const CHARGE: f64 = 1e-12;

fn mass() -> f64 {
    2500.0 * 4.0 / 3.0 * PI * RADIUS.powi(3)
}

/// The engine with steps of `STEP` that takes the part φ of the loads at the end of the step.
fn engines() -> [(String, f64); 4] {
    let iterated = |phi: f64| (common::staggered(STEP, 1e-15, phi), phi);
    [(common::verlet(STEP), 0.5), iterated(0.5), iterated(0.75), iterated(1.0)]
}

fn one_step(engine: &str, more: &str, velocity: Vec3, angular_velocity: Vec3) -> Simulation {
    let listed = Listed {
        material: "density = \"2500 kg/m3\"",
        radius: RADIUS,
        positions: vec![[0.0; 3]],
        end: 1.0,
        engine: engine.to_owned(),
        more: format!("[limits]\ndisplacement = 1e6\ndrift_error = 1e9\n{more}"),
    };
    let mut simulation = listed.start(|grains| {
        grains.charge[0] = CHARGE;
        grains.velocity[0] = velocity;
        grains.angular_velocity[0] = angular_velocity;
    });
    common::steps(&mut simulation, 1);
    assert_close!(simulation.clock().time, STEP, 1e-15, "time after the step, s");
    simulation
}

/// Newton's laws for a force that changes in time: v' = v + Δt/m (φ F' + (1 - φ) F), and r' = r + Δt (φ v' + (1 - φ) v), for
/// explicit steps with the load of the start twice. The field's work and impulse are booked with the same weights, the work of
/// explicit steps at the velocity that this guess has.
#[test]
fn a_force_of_time() {
    let more = "[fields.lorentz]\nelectric_field = [\"1e4*(1 + 2e6*t)\", \"-2e4*t*1e6\", \"0 V/m\"]";
    let velocity = Vec3::new(0.1, 0.2, -0.3);
    for (engine, phi) in engines() {
        let found = one_step(&engine, more, velocity, Vec3::ZERO);
        let force = |t: f64| Vec3::new(1e4 * (1.0 + 2e6 * t), -2e4 * t * 1e6, 0.0) * CHARGE;
        let (before, after) = (force(0.0), force(STEP));
        let mean = after * phi + before * (1.0 - phi);
        let faster = velocity + mean * (STEP / mass());
        let what = |what: &str| format!("φ = {phi}, {}: {what}", engine.lines().next().unwrap());
        let row = grain(&found, 0);
        assert_close_vector!(row.velocity, faster, 1e-13, "{}, m/s", what("velocity"));
        let guess = if engine.contains("verlet") { velocity + before * (STEP / mass()) } else { faster };
        let place = (guess * phi + velocity * (1.0 - phi)) * STEP;

        assert_close_vector!(row.position, place, 1e-13, "{}, m", what("position"));
        let flow = found.ledger.flows.supplies.field;
        let work = STEP * (phi * after.dot(guess) + (1.0 - phi) * before.dot(velocity));
        assert_close!(flow.power, work, 1e-12, "{}, J", what("work of the field"));
        assert_close_vector!(flow.force, mean * STEP, 1e-12, "{}, N s", what("impulse of the field"));
    }
}

/// A drag in a medium whose velocity and rotation change in time, with added mass and the medium's own acceleration:
/// the end of the step is solved for, in velocity and in angular velocity. Relaxation takes 0.3 ms for the motion: 1e-6
/// s of it is a lot.
#[test]
fn a_drag_in_a_medium_that_moves() {
    let more = "[medium]\ndensity = \"1000 kg/m3\"\nviscosity = \"0.2 Pa s\"\n[fields.drag]\nlaw = \"stokes\"\n\
                added_mass = 0.5\nmedium_velocity = [\"0.4 + 3e5*t\", \"2e3*x*1e6*t\", \"0 m/s\"]";
    let (velocity, angular_velocity) = (Vec3::new(-0.2, 0.0, 0.5), Vec3::new(700.0, 0.0, -400.0));
    let displaced = 1000.0 * 4.0 / 3.0 * PI * RADIUS.powi(3);
    let heavy = mass() + 0.5 * displaced;
    let drag = 6.0 * PI * 0.2 * RADIUS;
    let (resistance, inertia) = (8.0 * PI * 0.2 * RADIUS.powi(3), 0.4 * mass() * RADIUS * RADIUS);
    for (engine, phi) in engines() {
        let found = one_step(&engine, more, velocity, angular_velocity);
        let row = grain(&found, 0);
        let what = |what: &str| format!("φ = {phi}, {}: {what}", engine.lines().next().unwrap());
        // Along x alone nothing depends on the place: u = 0.4 + 3e5 t, and 1.5 m_f ∂u/∂t pushes besides.
        let push = 1.5 * displaced * 3e5;
        let (flow, late) = (0.4, 0.4 + 3e5 * STEP);
        let at_start = drag * (flow - velocity.x) + push;
        // v' (1 + φ Δt c/M) = v + Δt/M (φ (c u' + push) + (1 - φ) F).
        let h = STEP / heavy;
        let x =
            (velocity.x + h * (phi * (drag * late + push) + (1.0 - phi) * at_start)) / (1.0 + phi * h * drag);
        assert_close!(row.velocity.x, x, 1e-9, "{}, m/s", what("velocity along the flow"));
        let z = velocity.z * (1.0 - (1.0 - phi) * h * drag) / (1.0 + phi * h * drag);
        assert_close!(row.velocity.z, z, 1e-12, "{}, m/s", what("velocity across the flow"));
        // Spin about x dies away; about z it is drawn to half the curl, 1e3 at the end and nothing at the start.
        let h = STEP / inertia;
        let of = |angular_velocity: f64, late: f64| {
            (angular_velocity + h * resistance * (phi * late - (1.0 - phi) * angular_velocity))
                / (1.0 + phi * h * resistance)
        };
        assert_close!(
            row.angular_velocity.x,
            of(angular_velocity.x, 0.0),
            1e-12,
            "{}, rad/s",
            what("angular velocity across")
        );
        // The curl is a difference over a part of the radius.
        assert_close!(
            row.angular_velocity.z,
            of(angular_velocity.z, 1e3),
            1e-8,
            "{}, rad/s",
            what("angular velocity with the flow")
        );
    }
}

/// Drag is booked as its mean force on the mean velocity, and so is its moment: by hand from both ends of a step that is
/// iterated to its end, in a medium that speeds up.
#[test]
fn the_work_of_drag_in_a_medium_that_speeds_up() {
    let more = "[medium]\ndensity = \"1000 kg/m3\"\nviscosity = \"0.2 Pa s\"\n[fields.drag]\nlaw = \"stokes\"\n\
                medium_velocity = [\"0.4 + 3e5*t\", \"0 m/s\", \"0 m/s\"]";
    let (velocity, angular_velocity) = (Vec3::new(-0.2, 0.0, 0.5), Vec3::new(700.0, 0.0, -400.0));
    let push = Vec3::AXES[0] * (1000.0 * 4.0 / 3.0 * PI * RADIUS.powi(3) * 3e5);
    let (drag, resistance) = (6.0 * PI * 0.2 * RADIUS, 8.0 * PI * 0.2 * RADIUS.powi(3));
    for phi in [0.5, 0.75] {
        let found = one_step(&common::staggered(STEP, 1e-15, phi), more, velocity, angular_velocity);
        let after = grain(&found, 0);
        let force = |t: f64, v: Vec3| (Vec3::AXES[0] * (0.4 + 3e5 * t) - v) * drag + push;
        let mean = |early: Vec3, late: Vec3| early * (1.0 - phi) + late * phi;
        let work = mean(force(0.0, velocity), force(STEP, after.velocity))
            .dot(mean(velocity, after.velocity))
            - mean(angular_velocity, after.angular_velocity).norm_squared() * resistance;
        let booked = found.ledger.flows.supplies.drag.power;
        assert_close!(booked, work * STEP, 1e-7, "φ = {phi}: work of the drag, J");
    }
}

/// A rotation about a magnetic field that grows in the step: both ends with their own field,
/// v' = v + h (φ v' × B' + (1 - φ) v × B), h = q Δt/m.
#[test]
fn a_rotation_in_a_field_that_grows() {
    let more = "[fields.lorentz]\nmagnetic_flux_density = [\"0 T\", \"0 T\", \"5e6*(1 + 1e6*t)\"]";
    let velocity = Vec3::new(0.3, -0.4, 0.1);
    let turning = CHARGE * 5e6 * STEP / mass();
    assert!((0.03..0.1).contains(&turning), "turns by {turning} in the step");
    for (engine, phi) in engines() {
        let found = grain(&one_step(&engine, more, velocity, Vec3::ZERO), 0).velocity;
        let (early, late) = ((1.0 - phi) * turning, phi * 2.0 * turning);
        // v × e_z = (v_y, -v_x): with b = h φ B', v' = (rest + b rest × e_z)/(1 + b²) across the field.
        let rest = [velocity.x + early * velocity.y, velocity.y - early * velocity.x];
        let over = 1.0 / (1.0 + late * late);
        let wanted =
            Vec3::new((rest[0] + late * rest[1]) * over, (rest[1] - late * rest[0]) * over, velocity.z);
        let what = format!("φ = {phi}, {}: velocity", engine.lines().next().unwrap());
        assert_close_vector!(found, wanted, 1e-12, "{what}, m/s");
    }
}
