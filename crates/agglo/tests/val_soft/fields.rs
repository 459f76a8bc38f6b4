//! Single grains and pairs in fields: closed forms of motion.

use std::f64::consts::{PI, TAU};

use agglo::constants::VACUUM_PERMITTIVITY;
use agglo::math::Vec3;

use crate::common::{self, Listed, relative_velocity};

fn grains(positions: Vec<[f64; 3]>, end: f64, engine: String, more: &str) -> Listed {
    let material = "density = \"2500 kg/m3\"";
    Listed {
        material,
        radius: 10e-6,
        positions,
        end,
        engine,
        more: format!("[limits]\ndisplacement = 1e3\n{more}"),
    }
}

/// Stokes 1851: a grain sinks at (2/9) Δρ g R²/η. After 25 relaxation times e^-25 is left; 1e-6 is ample.
#[test]
fn val_stokes_1851_terminal_velocity() {
    let more = "[medium]\ndensity = \"1000 kg/m3\"\nviscosity = \"1 mPa s\"\n[fields.drag]\nlaw = \"stokes\"\n\
                added_mass = 0.5\n[fields.gravity]\nacceleration = [\"0 m/s2\", \"0 m/s2\", \"-9.81 m/s2\"]\n\
                buoyancy = true";
    let wanted = 2.0 / 9.0 * 1500.0 * 9.81 * 10e-6 * 10e-6 / 1e-3;
    // (m + m_added)/(6 π η R) = (2/9)(2500 + 500) R²/η = 6.7e-5 s.
    let relaxation = 2.0 / 9.0 * 3000.0 * 1e-10 / 1e-3;
    for engine in [common::verlet(relaxation / 50.0), common::staggered(relaxation / 50.0, 1e-12, 0.5)] {
        let mut simulation = grains(vec![[0.0; 3]], 25.0 * relaxation, engine, more).start(|_| {});
        common::finish(&mut simulation);
        let found = common::grain(&simulation, 0).velocity;
        assert!((found.z / -wanted - 1.0).abs() < 1e-6 && found.x == 0.0, "{found:?} for {wanted:e}");
    }
}

/// On the way there the speed is v (1 - e^(-t/τ)): after one relaxation time, with the added mass in τ.
/// 1e-5: the explicit scheme errs by the order of (Δt/τ)², 6e-6 here.
#[test]
fn a_sinking_grain_speeds_up_exponentially() {
    let more = "[medium]\ndensity = \"1000 kg/m3\"\nviscosity = \"1 mPa s\"\n[fields.drag]\nlaw = \"stokes\"\n\
                added_mass = 0.5\n[fields.gravity]\nacceleration = [\"0 m/s2\", \"0 m/s2\", \"-9.81 m/s2\"]\n\
                buoyancy = true";
    let relaxation = 2.0 / 9.0 * 3000.0 * 1e-10 / 1e-3;
    let listed = grains(vec![[0.0; 3]], relaxation, common::verlet(relaxation / 400.0), more);
    let mut simulation = listed.start(|_| {});
    common::finish(&mut simulation);
    let wanted = -2.0 / 9.0 * 1500.0 * 9.81 * 1e-10 / 1e-3 * (1.0 - (-1.0_f64).exp());
    let found = common::grain(&simulation, 0).velocity.z;
    assert!((found / wanted - 1.0).abs() < 1e-5, "{found:e} for {wanted:e}");
}

/// Two opposite charges circle each other at a distance d with m* w² d = q²/(4 π ε d²): after two turns they are
/// where they began, at the same distance. A step of 1e-3 of the time of a radian errs by its square over 12 or so.
#[test]
fn val_coulomb_two_bodies_circle() {
    let (charge, distance) = (1e-12, 1e-3);
    let mass = 2500.0 * 4.0 / 3.0 * PI * 1e-15;
    let pull = charge * charge / (4.0 * PI * VACUUM_PERMITTIVITY * distance * distance);
    let turning = (pull / (0.5 * mass * distance)).sqrt();
    let turns = 2.0;
    let step = 1e-3 / turning;
    for engine in [common::verlet(step), common::staggered(step, 1e-12, 0.5)] {
        let positions = vec![[-0.5 * distance, 0.0, 0.0], [0.5 * distance, 0.0, 0.0]];
        let more = "[fields.near_field]\nlaw.coulomb.relative_permittivity = 1.0";
        let mut simulation = grains(positions, turns * TAU / turning, engine.clone(), more).start(|grains| {
            grains.charge = vec![charge, -charge];
            let speed = 0.5 * distance * turning;
            grains.velocity = vec![Vec3::AXES[1] * -speed, Vec3::AXES[1] * speed];
        });
        let mut worst = 0.0_f64;
        common::watch(&mut simulation, |now| {
            let apart = common::grain(now, 1).position - common::grain(now, 0).position;
            worst = worst.max((apart.norm() / distance - 1.0).abs());
        });
        assert!(worst < 1e-6, "distance off by {worst:e}: {engine}");
        let apart = common::grain(&simulation, 1).position - common::grain(&simulation, 0).position;
        // Angle missed over the angle turned: the relative error of the period.
        let missed = apart.y.atan2(apart.x) / (turns * TAU);
        assert!(missed.abs() < 1e-6, "period off by {missed:e}: {engine}");
        assert!((relative_velocity(&simulation).norm() / (distance * turning) - 1.0).abs() < 1e-6);
    }
}

/// A charge in a uniform field circles with radius m v/(q B) and period 2 π m/(q B). The trapezoidal rule keeps the
/// radius to round-off and lengthens the period by (w Δt)²/12; the explicit scheme errs by (w Δt)² in the period.
#[test]
fn val_cyclotron_radius_and_period() {
    let (charge, speed) = (1e-9, 2.0);
    let mass = 2500.0 * 4.0 / 3.0 * PI * 1e-15;
    let turning = charge * 0.5 / mass;
    let step = 1e-3 / turning;
    for engine in [common::verlet(step), common::staggered(step, 1e-13, 0.5)] {
        let more = "[fields.lorentz]\nmagnetic_flux_density = [\"0 T\", \"0 T\", \"0.5 T\"]";
        let mut simulation = grains(vec![[0.0; 3]], TAU / turning, engine.clone(), more).start(|grains| {
            grains.charge[0] = charge;
            grains.velocity[0] = Vec3::AXES[0] * speed;
        });
        // A positive charge that flies along x turns about a centre on the side of -y.
        let radius = mass * speed / (charge * 0.5);
        let centre = Vec3::new(0.0, -radius, 0.0);
        let mut worst = 0.0_f64;
        common::watch(&mut simulation, |now| {
            let found = (common::grain(now, 0).position - centre).norm();
            worst = worst.max((found / radius - 1.0).abs());
        });
        assert!(worst < 1e-6, "radius off by {worst:e}: {engine}");
        let back = (common::grain(&simulation, 0).position.norm() / radius) / TAU;
        assert!(back < 1e-6, "period off by {back:e}: {engine}");
        let kept = common::grain(&simulation, 0).velocity.norm() / speed - 1.0;
        assert!(kept.abs() < 1e-8, "speed off by {kept:e}: {engine}");
    }
}
