//! Head-on impacts: Y. C. Chung and J. Y. Ooi, Granular Matter 13, 643 (2011), tests 1 to 3.
//!
//! A sphere ten thousand times as large as the grain stands for the rigid plane here; `walls` has the plane itself.

use agglo::engine::soft::Simulation;
use agglo::math::Vec3;
use agglo::particles::Particles;

use crate::common::{self, Listed, relative_velocity};

/// Largest overlap [m], largest force [N] and duration [s] of a contact that begins at time zero.
#[derive(Debug)]
struct Contact {
    overlap: f64,
    force: f64,
    duration: f64,
}

fn overlap(simulation: &Simulation) -> f64 {
    let grains = &simulation.system.grains;
    grains.radius[0] + grains.radius[1] - (grains.position[1] - grains.position[0]).norm()
}

/// Steps until the grains part; the end is interpolated between two steps.
fn contact(simulation: &mut Simulation) -> Contact {
    let mut found = Contact { overlap: 0.0, force: 0.0, duration: 0.0 };
    let mut before = 0.0;
    let mut turns = agglo_testing::Turns::at_most(10_000_000, "the grains to part");
    loop {
        turns.take();
        common::steps(simulation, 1);
        let (now, clock) = (overlap(simulation), simulation.clock());
        if now < 0.0 {
            found.duration = clock.time - clock.last_step * now / (now - before);
            return found;
        }
        found.overlap = found.overlap.max(now);
        found.force = found.force.max(simulation.system.loads.force[0].norm());
        before = now;
    }
}

fn glass() -> Listed {
    Listed {
        material: "density = \"2800 kg/m3\"\nyoungs_modulus = \"48 GPa\"\npoisson_ratio = 0.20",
        radius: 0.01,
        positions: vec![[-0.01, 0.0, 0.0], [0.01, 0.0, 0.0]],
        end: 1.0,
        engine: common::verlet(1e-8),
        more: "[contact.normal.hertz]".to_owned(),
    }
}

/// Two grains that approach each other along x, each with this speed [m/s].
fn meeting(speed: f64) -> impl FnOnce(&mut Particles) {
    move |grains: &mut Particles| {
        grains.velocity[0] = Vec3::AXES[0] * speed;
        grains.velocity[1] = Vec3::AXES[0] * -speed;
    }
}

/// A second-order scheme with 4000 steps a contact errs by some 1e-6, finding the largest overlap by steps by less,
/// and the five digits of the references by 2e-5.
const FIVE_DIGITS: f64 = 1e-4;

fn assert_contact(case: &str, found: &Contact, overlap: f64, force: f64, duration: f64) {
    let figures = [("overlap_m", found.overlap), ("force_N", found.force), ("duration_s", found.duration)];
    common::found(case, &figures);
    for (found, wanted) in [(found.overlap, overlap), (found.force, force), (found.duration, duration)] {
        // Durations are given with four digits.
        let tolerance = if wanted == duration { 3e-4 } else { FIVE_DIGITS };
        assert!((found / wanted - 1.0).abs() < tolerance, "{found:e} for {wanted:e}");
    }
}

/// Test 1; overlap, force and duration computed independently.
#[test]
fn val_chung_ooi_2011_two_spheres() {
    assert_contact("glass", &contact(&mut glass().start(meeting(10.0))), 274.11e-6, 10.697e3, 40.34e-6);
    let limestone = Listed {
        material: "density = \"2500 kg/m3\"\nyoungs_modulus = \"20 GPa\"\npoisson_ratio = 0.25",
        ..glass()
    };
    assert_contact("limestone", &contact(&mut limestone.start(meeting(10.0))), 368.30e-6, 7.108e3, 54.20e-6);
}

/// Stiffness of a plane that does not give way.
const RIGID: &str = "youngs_modulus = \"1e13 MPa\"\npoisson_ratio = 0.0";

/// A grain in front of a heavy sphere of ten thousand times its radius, which rests.
pub fn before_a_plane(radius: f64, material: &str, of_plane: &str, engine: &str, more: &str) -> String {
    let plane = 1e4 * radius;
    format!(
        "version = 1\n[time]\nend = \"1 s\"\n{engine}\n[materials.grain]\n{material}\n\
         [materials.plane]\ndensity = \"1e6 kg/m3\"\n{of_plane}\n\
         [[grains]]\nmaterial = \"grain\"\n[grains.size.constant]\nradius = \"{radius:e} m\"\n\
         [grains.placement.list]\npositions = [[\"{radius:e} m\", \"0 m\", \"0 m\"]]\n\
         [[grains]]\nmaterial = \"plane\"\n[grains.size.constant]\nradius = \"{plane:e} m\"\n\
         [grains.placement.list]\npositions = [[\"-{plane:e} m\", \"0 m\", \"0 m\"]]\n{more}"
    )
}

/// Test 2; computed independently. The sphere for a plane changes R* by 1e-4, the overlap by a fifth of that.
#[test]
fn val_chung_ooi_2011_sphere_on_plane() {
    let aluminum = "density = \"2699 kg/m3\"\nyoungs_modulus = \"70 GPa\"\npoisson_ratio = 0.30";
    let magnesium = "density = \"1800 kg/m3\"\nyoungs_modulus = \"40 GPa\"\npoisson_ratio = 0.35";
    for (name, material, [overlap, force, duration]) in [
        ("aluminum", aluminum, [49.717e-6, 11.370e3, 731.7e-6]),
        ("magnesium", magnesium, [52.123e-6, 7.233e3, 767.1e-6]),
    ] {
        let text = before_a_plane(0.1, material, RIGID, &common::verlet(2e-7), "[contact.normal.hertz]\n");
        let mut simulation = common::start(&text, |grains| grains.velocity[0].x = -0.2);
        assert_contact(name, &contact(&mut simulation), overlap, force, duration);
    }
}

/// Speed of parting over that of approach.
fn restitution(listed: &Listed, speed: f64) -> f64 {
    let mut simulation = listed.start(meeting(speed));
    contact(&mut simulation);
    relative_velocity(&simulation).x / (2.0 * speed)
}

/// Test 3, between two equal spheres: what is asked for comes out, since the dashpot may pull at the end.
/// 1e-3: a dashpot that acts from the first touch on costs a first-order error of the step in which that is.
#[test]
fn val_chung_ooi_2011_damped_impact() {
    let alumina = "density = \"4000 kg/m3\"\nyoungs_modulus = \"380 GPa\"\npoisson_ratio = 0.23";
    let iron = "density = \"7000 kg/m3\"\nyoungs_modulus = \"100 GPa\"\npoisson_ratio = 0.25";
    for material in [alumina, iron] {
        for normal in ["[contact.normal.hertz]", "[contact.normal.hooke]\nstiffness = \"30 MN/m\""] {
            let case = if normal.contains("hertz") { "damped_hertz" } else { "damped_hooke" };
            for wanted in [0.2, 0.4, 0.5, 0.6, 0.8, 1.0] {
                let listed = Listed {
                    material,
                    radius: 2.5e-3,
                    positions: vec![[-2.5e-3, 0.0, 0.0], [2.5e-3, 0.0, 0.0]],
                    engine: common::verlet(2e-9),
                    more: format!("{normal}\n[contact.damping.restitution]\nrestitution = {wanted}"),
                    ..glass()
                };
                let found = restitution(&listed, 1.95);
                common::found(case, &[("off", (found - wanted).abs())]);
                assert!((found - wanted).abs() < 1e-3, "{found} for {wanted}, {normal}");
            }
        }
    }
}

/// The staggered scheme gives the same contact.
#[test]
fn both_engines_agree_on_an_impact() {
    let implicit = Listed { engine: common::staggered(1e-8, 1e-10, 0.5), ..glass() };
    assert_contact(
        "glass_staggered",
        &contact(&mut implicit.start(meeting(10.0))),
        274.11e-6,
        10.697e3,
        40.34e-6,
    );
}
