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
        common::found("sinking", &[("off", found.z / -wanted - 1.0)]);
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
    common::found("speeding_up", &[("off", found / wanted - 1.0)]);
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
        common::found("circling_charges", &[("distance_off", worst), ("period_off", missed)]);
        assert!(missed.abs() < 1e-6, "period off by {missed:e}: {engine}");
        assert_close!(relative_velocity(&simulation).norm(), distance * turning, 1e-6, "in m/s");
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
        // A positive charge that flies along x turns about a center on the side of -y.
        let radius = mass * speed / (charge * 0.5);
        let center = Vec3::new(0.0, -radius, 0.0);
        let mut worst = 0.0_f64;
        common::watch(&mut simulation, |now| {
            let found = (common::grain(now, 0).position - center).norm();
            worst = worst.max((found / radius - 1.0).abs());
        });
        assert!(worst < 1e-6, "radius off by {worst:e}: {engine}");
        let back = (common::grain(&simulation, 0).position.norm() / radius) / TAU;
        common::found("cyclotron", &[("radius_off", worst), ("period_off", back)]);
        assert!(back < 1e-6, "period off by {back:e}: {engine}");
        let kept = common::grain(&simulation, 0).velocity.norm() / speed - 1.0;
        assert!(kept.abs() < 1e-8, "speed off by {kept:e}: {engine}");
    }
}

/// A grain of the liquid's density in a liquid that moves 0.01 sin(2 π 1 kHz t) m/s moves with it, with and without
/// added mass: pressure, added mass and drag ask for nothing else. 1e-6: the trapezoidal rule errs by (w Δt)²/12, 5e-7.
#[test]
fn a_grain_of_the_liquids_density_moves_with_an_oscillating_liquid() {
    let turning = TAU * 1e3;
    for added in [0.0, 0.5] {
        let more = format!(
            "[medium]\ndensity = \"2500 kg/m3\"\nviscosity = \"1 mPa s\"\n[fields.drag]\nlaw = \"stokes\"\n\
             added_mass = {added}\nmedium_velocity = [\"0.01*sin(2*pi*1000*t)\", \"0 m/s\", \"0 m/s\"]"
        );
        for engine in [common::verlet(4e-7), common::staggered(4e-7, 1e-12, 0.5)] {
            let listed = Listed { radius: 50e-6, ..grains(vec![[0.0; 3]], 1.25e-3, engine, &more) };
            let mut simulation = listed.start(|_| {});
            let mut worst = 0.0_f64;
            common::watch(&mut simulation, |now| {
                let liquid = 0.01 * (turning * now.clock().time).sin();
                worst = worst.max((common::grain(now, 0).velocity.x - liquid).abs());
            });
            assert!(worst < 1e-6 * 0.01, "{added}: {worst:e}");
        }
    }
}

/// The same in a liquid that turns as a whole: the grain circles with it, Du/Dt = -Ω² r, and spins at Ω from then on.
#[test]
fn a_grain_of_the_liquids_density_circles_with_a_turning_liquid() {
    let (turning, distance) = (500.0, 1e-3);
    let more = "[medium]\ndensity = \"2500 kg/m3\"\nviscosity = \"1 mPa s\"\n[fields.drag]\nlaw = \"stokes\"\n\
                added_mass = 0.5\nmedium_velocity = [\"-500*y\", \"500*x\", \"0 m/s\"]";
    for engine in [common::verlet(2e-7), common::staggered(2e-7, 1e-13, 0.5)] {
        let mut simulation =
            grains(vec![[distance, 0.0, 0.0]], TAU / turning, engine.clone(), more).start(|grains| {
                grains.velocity[0] = Vec3::AXES[1] * (distance * turning);
            });
        let mut worst = 0.0_f64;
        common::watch(&mut simulation, |now| {
            worst = worst.max((common::grain(now, 0).position.norm() / distance - 1.0).abs());
        });
        assert!(worst < 1e-6, "radius off by {worst:e}: {engine}");
        let angular_velocity = common::grain(&simulation, 0).angular_velocity;
        assert!((angular_velocity - Vec3::AXES[2] * turning).norm() < 1e-6 * turning, "{angular_velocity:?}");
    }
}

/// In a shear flow u = (g y, 0, 0) a grain spins up to half the vorticity, -g/2 about z, as 1 - e^(-t/τ) with
/// τ = ρ R²/(15 η).
#[test]
fn val_kirchhoff_1876_spin_in_shear() {
    let relaxation = 2500.0 * 1e-10 / (15.0 * 1e-3);
    let more = "[medium]\ndensity = \"1000 kg/m3\"\nviscosity = \"1 mPa s\"\n[fields.drag]\nlaw = \"stokes\"\n\
                medium_velocity = [\"300*y\", \"0 m/s\", \"0 m/s\"]";
    for (lasting, part) in [(1.0, 1.0 - (-1.0_f64).exp()), (20.0, 1.0)] {
        for engine in [common::verlet(relaxation / 200.0), common::staggered(relaxation / 200.0, 1e-12, 0.5)]
        {
            let mut simulation = grains(vec![[0.0; 3]], lasting * relaxation, engine, more).start(|_| {});
            common::finish(&mut simulation);
            let angular_velocity = common::grain(&simulation, 0).angular_velocity;
            // (1/200)²/12 of the decay.
            assert!((angular_velocity.z / (-150.0 * part) - 1.0).abs() < 2e-6, "{angular_velocity:?}");
        }
    }
}

/// A chain of touching grains along an extension at a rate e bears 6 π η R² e N²/4 in its middle: each grain is held
/// against the flow by the rest, and none shields another. Bonds are soft enough for the chain to come to rest, and
/// stiff enough for it not to grow: 1e-3.
#[test]
fn a_free_draining_chain_is_pulled_apart() {
    let (radius, count, rate) = (10e-6, 10, 10.0);
    let positions = (0..count).map(|k| [(2.0 * f64::from(k) - 9.0) * radius, 0.0, 0.0]).collect();
    let more = "[medium]\ndensity = \"1000 kg/m3\"\nviscosity = \"1 mPa s\"\n[fields.drag]\nlaw = \"stokes\"\n\
                medium_velocity = [\"10*x\", \"-5*y\", \"-5*z\"]\n[bonds.beam]\nyoungs_modulus = \"1 MPa\"\n\
                tensile_strength = \"1 GPa\"\nshear_strength = \"1 GPa\"\nradius_ratio = 0.5\ndamping_ratio = 0.5";
    let mut simulation = grains(positions, 1e-3, "[engine.verlet]".to_owned(), more).start(|_| {});
    common::finish(&mut simulation);
    let at = |id: u32| common::grain(&simulation, id).position;
    // Tension of the bond in the middle, from how far it is stretched.
    let stiffness = 1e6 * PI * 25e-12 / (2.0 * radius);
    let tension = stiffness * ((at(5) - at(4)).norm() - 2.0 * radius);
    let wanted = 6.0 * PI * 1e-3 * radius * radius * rate * f64::from(count * count) / 4.0;
    assert!((tension / wanted - 1.0).abs() < 5e-3, "{tension:e} for {wanted:e}");
}

/// Two touching grains of unlike density in a liquid that swings, without drag worth speaking of: their bond bears
/// (3/2) u' (m_2 M_1 - m_1 M_2)/(M_1 + M_2), M = m_grain + m_liquid/2, at its peak: 4.785e-8 N for alumina and 1200 kg/m³,
/// R = 10 um, 20 kHz, 0.135 m/s. The bond is far faster than the sound; 1 % for the ringing that the start gives it.
#[test]
fn the_first_order_stress_of_sound_in_a_bond() {
    let (radius, amplitude) = (10e-6, 0.135);
    let turning = TAU * 20e3;
    let volume = 4.0 / 3.0 * PI * radius * radius * radius;
    let inertia = [3970.0, 1200.0].map(|density| (density + 500.0) * volume);
    let text = format!(
        "version = 1\n[time]\nend = \"12.5 us\"\n[engine.verlet]\n[limits]\ndisplacement = 1e3\n\
         [medium]\ndensity = \"1000 kg/m3\"\nviscosity = \"1e-12 Pa s\"\n\
         [materials.alumina]\ndensity = \"3970 kg/m3\"\n[materials.light]\ndensity = \"1200 kg/m3\"\n\
         [[grains]]\nmaterial = \"alumina\"\nsize.constant.radius = \"10 um\"\n\
         placement.list.positions = [[\"-10 um\", \"0 m\", \"0 m\"]]\n\
         [[grains]]\nmaterial = \"light\"\nsize.constant.radius = \"10 um\"\n\
         placement.list.positions = [[\"10 um\", \"0 m\", \"0 m\"]]\n\
         [fields.drag]\nlaw = \"stokes\"\nadded_mass = 0.5\n\
         medium_velocity = [\"{amplitude}*(1 - cos({turning}*t))\", \"0 m/s\", \"0 m/s\"]\n\
         [bonds.beam]\nyoungs_modulus = \"10 MPa\"\ntensile_strength = \"1 GPa\"\nshear_strength = \"1 GPa\"\n\
         damping_ratio = 0.2\n"
    );
    let mut simulation = common::start(&text, |_| {});
    common::finish(&mut simulation);
    let apart = common::grain(&simulation, 1).position - common::grain(&simulation, 0).position;
    let stiffness = 1e7 * PI * radius * radius / (2.0 * radius);
    let tension = stiffness * (apart.norm() - 2.0 * radius);
    let displaced = 1000.0 * volume;
    let wanted =
        1.5 * turning * amplitude * displaced * (inertia[0] - inertia[1]) / (inertia[0] + inertia[1]);
    assert!((wanted / 4.785e-8 - 1.0).abs() < 1e-3, "{wanted:e}");
    assert!((tension.abs() / wanted - 1.0).abs() < 1e-2, "{tension:e} for {wanted:e}");
}
