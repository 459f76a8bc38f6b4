//! Order of accuracy: halving the step divides the error by two to the order claimed.

use agglo::math::Vec3;

use crate::common::{self, Listed};

/// A pair of opposite charges on an eccentric orbit, that spins in a magnetic field besides: forces that depend on
/// place and velocity, smooth throughout.
fn orbit(engine: String) -> Vec3 {
    let listed = Listed {
        material: "density = \"2500 kg/m3\"",
        radius: 10e-6,
        positions: vec![[-0.5e-3, 0.0, 0.0], [0.5e-3, 0.0, 0.0]],
        end: 5e-3,
        engine,
        more: "[limits]\ndisplacement = 1e3\nstrain = 2.0\n[fields.near_field]\nlaw.coulomb.relative_permittivity = 1.0\n\
               [medium]\ndensity = \"1000 kg/m3\"\nviscosity = \"0.2 uPa s\"\n[fields.drag]\nlaw = \"stokes\"\n\
               [fields.lorentz]\nmagnetic_flux_density = [\"0 T\", \"0 T\", \"1000 T\"]"
            .to_owned(),
    };
    let mut simulation = listed.start(|grains| {
        grains.charge = vec![1e-12, -1e-12];
        grains.velocity = vec![Vec3::new(0.0, -0.5, 0.1), Vec3::new(0.0, 0.5, -0.1)];
    });
    common::finish(&mut simulation);
    common::grain(&simulation, 1).position
}

/// Two grains that touch all the time, pressed together and sheared; in a contact no force has a kink then.
fn pressed(laws: &str, engine: String) -> Vec3 {
    let listed = Listed {
        material: "density = \"2500 kg/m3\"\nyoungs_modulus = \"1 GPa\"\npoisson_ratio = 0.25",
        radius: 1e-3,
        positions: vec![[-0.95e-3, 0.0, 0.0], [0.95e-3, 0.0, 0.0]],
        end: 4e-6,
        engine,
        more: laws.to_owned(),
    };
    let mut simulation = listed.start(|grains| {
        grains.velocity = vec![Vec3::new(0.5, -0.3, 0.1), Vec3::new(-0.5, 0.3, 0.0)];
        grains.spin = vec![Vec3::new(0.0, 0.0, 100.0), Vec3::new(50.0, 0.0, 0.0)];
    });
    common::finish(&mut simulation);
    assert!(simulation.system.trial.contact.worst_strain > 0.0, "the grains parted");
    common::grain(&simulation, 1).position
}

/// Powers of two by which errors fall from step to step, against an answer at a step of 1/128 of the finest.
fn slopes(
    run: impl Fn(String) -> Vec3,
    engine: impl Fn(f64) -> String,
    coarsest: f64,
    exact: Vec3,
) -> Vec<f64> {
    let errors = [1.0, 0.5, 0.25, 0.125].map(|part| (run(engine(part * coarsest)) - exact).norm());
    errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect()
}

fn assert_order(run: impl Fn(String) -> Vec3 + Copy, coarsest: f64) {
    // Accurate to (1/128)² of the finest error below: it does not bend the slopes.
    let exact = run(common::staggered(coarsest / 1024.0, 1e-13, 0.5));
    let verlet = slopes(run, common::verlet, coarsest, exact);
    let trapezoid = slopes(run, |step| common::staggered(step, 1e-13, 0.5), coarsest, exact);
    let euler = slopes(run, |step| common::staggered(step, 1e-13, 1.0), coarsest / 16.0, exact);
    for (found, order) in [(verlet, 2.0), (trapezoid, 2.0), (euler, 1.0)] {
        assert!(found.iter().all(|slope| (slope - order).abs() < 0.1), "{found:?} for {order}");
    }
}

#[test]
fn orders_in_smooth_fields() {
    assert_order(orbit, 20e-6);
}

#[test]
fn orders_in_contact() {
    let damping = "[contact.damping.restitution]\nrestitution = 0.8";
    let friction =
        "[contact.friction.mindlin]\nstatic_friction = 100.0\ndashpot = 0.5\nstiffness_ratio = 0.8";
    for laws in [
        format!("[contact.normal.hertz]\n{damping}"),
        format!("[contact.normal.hooke]\nstiffness = \"0.2 MN/m\"\n{damping}\n{friction}"),
        format!("[contact.normal.hertz]\n{damping}\n{friction}"),
    ] {
        assert_order(|engine| pressed(&laws, engine), 0.1e-6);
    }
}
