//! Order of accuracy: halving the step divides the error by two to the order claimed.

use agglo::engine::soft::Simulation;
use agglo::math::Vec3;

use crate::common::{self, Listed};
use crate::unlike::Unlike;

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

/// A pair of charges in a trap that swings, in a magnetic field that grows, and in a medium that shears and swings, with
/// added mass: every load depends on time and place, and drag and rotation on velocity. Grains differ in radius.
fn driven(engine: String) -> Vec<Vec3> {
    let unlike = Unlike {
        materials: ["density = \"2500 kg/m3\"", "density = \"1300 kg/m3\""],
        radii: [10e-6, 25e-6],
        temperatures: [300.0; 2],
        distance: 0.3e-3,
        end: 4e-3,
        engine,
        limits: String::new(),
        more: "[fields.near_field]\nlaw.coulomb.relative_permittivity = 1.0\n\
               [medium]\ndensity = \"1000 kg/m3\"\nviscosity = \"20 uPa s\"\n[fields.drag]\nlaw = \"schiller_naumann\"\n\
               added_mass = 0.5\nmedium_velocity = [\"0.3*sin(1500*t) + 400*y\", \"0.2*cos(1200*t)\", \"300*x*cos(900*t)\"]\n\
               [fields.magnetic]\nmagnetizability = \"1e-9 J/T2\"\n\
               magnetic_flux_density = [\"0.1 + 10*x\", \"0 T\", \"20*z*cos(1000*t)\"]\n\
               [fields.lorentz]\nelectric_field = [\"-2e7*x*(2 + sin(1500*t))\", \"-3e7*y + 1e3*cos(2000*t)\", \"-2e7*z\"]\n\
               magnetic_flux_density = [\"0 T\", \"2e4*t*1000\", \"2e4*(1 + 300*x)\"]"
            .to_owned(),
    };
    let mut simulation = unlike.start(|grains| {
        grains.charge = vec![1e-12, 2e-12];
        grains.velocity = vec![Vec3::new(0.1, -0.2, 0.05), Vec3::new(0.0, 0.1, -0.1)];
        grains.angular_velocity = vec![Vec3::new(0.0, 200.0, 0.0), Vec3::new(100.0, 0.0, -300.0)];
    });
    common::finish(&mut simulation);
    motion(&simulation)
}

/// Places in 0.1 mm, velocities in 0.1 m/s and angular velocities in 100 rad/s of both grains.
fn motion(simulation: &Simulation) -> Vec<Vec3> {
    let of = |id: u32| {
        let row = common::grain(simulation, id);
        [row.position * 1e4, row.velocity * 10.0, row.angular_velocity * 1e-2]
    };
    [of(0), of(1)].concat()
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
        grains.angular_velocity = vec![Vec3::new(0.0, 0.0, 100.0), Vec3::new(50.0, 0.0, 0.0)];
    });
    common::finish(&mut simulation);
    assert!(simulation.system.trial.contact.worst_strain > 0.0, "the grains parted");
    common::grain(&simulation, 1).position
}

/// With φ other than 1/2 the scheme is of first order, whatever else acts, and comes to the same motion. Neither place
/// nor velocity nor angular velocity is left out: an error of first order in one of them would show in all.
#[test]
fn orders_with_everything_that_depends_on_time() {
    let distance =
        |a: &[Vec3], b: &[Vec3]| a.iter().zip(b).map(|(a, b)| (*a - *b).norm_squared()).sum::<f64>().sqrt();
    // Where a grain turns round, rounding of its short way is above 1e-12 of it, and steps would be cut for that.
    let tolerance = 1e-11;
    let exact = driven(common::staggered(0.2e-6, tolerance, 0.5));
    let slopes = |engine: &dyn Fn(f64) -> String, coarsest: f64| -> Vec<f64> {
        let errors = [1.0, 0.5, 0.25].map(|part| distance(&driven(engine(part * coarsest)), &exact));
        errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect()
    };
    let implicit = |phi: f64| move |step: f64| common::staggered(step, tolerance, phi);
    let cases = [
        ("verlet", slopes(&common::verlet, 20e-6), 2.0),
        ("φ = 0.5", slopes(&implicit(0.5), 20e-6), 2.0),
        ("φ = 0.75", slopes(&implicit(0.75), 2e-6), 1.0),
        ("φ = 1", slopes(&implicit(1.0), 2e-6), 1.0),
    ];
    for (what, found, order) in cases {
        assert!(
            found.iter().all(|slope| (slope - order).abs() < 0.1),
            "{what}: errors fall by 2^{found:?} when the step is halved, expected 2^{order}"
        );
    }
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
        for slope in &found {
            common::found(if order == 1.0 { "first_order" } else { "second_order" }, &[("slope", *slope)]);
        }
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
