//! Head-on impacts on a plane: Y. C. Chung and J. Y. Ooi, Granular Matter 13, 643 (2011), tests 2 and 3.

use agglo::engine::soft::Simulation;
use agglo::math::Vec3;

use crate::common;

/// Largest overlap [m], largest force [N] and duration [s] of a contact with the floor at z = 0 that begins at time zero, and the
/// speed of parting [m/s].
struct Contact {
    overlap: f64,
    force: f64,
    duration: f64,
    speed: f64,
}

fn contact(simulation: &mut Simulation, radius: f64) -> Contact {
    let mut found = Contact { overlap: 0.0, force: 0.0, duration: 0.0, speed: 0.0 };
    let mut before = 0.0;
    let mut turns = agglo_testing::Turns::at_most(10_000_000, "the grain to leave the floor");
    loop {
        turns.take();
        common::steps(simulation, 1);
        let (now, clock) = (radius - simulation.system.grains.position[0].z, simulation.clock());
        if now < 0.0 {
            found.duration = clock.time - clock.last_step * now / (now - before);
            found.speed = simulation.system.grains.velocity[0].z;
            return found;
        }
        found.overlap = found.overlap.max(now);
        found.force = found.force.max(simulation.system.loads.force[0].norm());
        before = now;
    }
}

/// A grain that touches a floor, with the materials of both.
fn touching(radius: f64, material: &str, of_floor: &str, engine: &str, laws: &str) -> String {
    format!(
        "version = 1\ntime.end = \"1 s\"\n{engine}\n[materials.grain]\n{material}\n\
         [materials.floor]\ndensity = \"1e6 kg/m3\"\n{of_floor}\n\
         [[grains]]\nmaterial = \"grain\"\nsize.constant.radius = \"{radius:e} m\"\n\
         placement.list.positions = [[\"0 m\", \"0 m\", \"{radius:e} m\"]]\n\
         [[walls]]\nname = \"floor\"\nmaterial = \"floor\"\n\
         shape.plane = {{ point = [\"0 m\", \"0 m\", \"0 m\"], normal = [0.0, 0.0, 1.0] }}\n{laws}"
    )
}

fn falling(text: &str, speed: f64) -> Simulation {
    common::start(text, |grains| grains.velocity[0] = Vec3::AXES[2] * -speed)
}

const RIGID: &str = "youngs_modulus = \"1e13 MPa\"\npoisson_ratio = 0.0";

/// Test 2; overlap, force and duration computed independently, to five and four digits. A second-order scheme with 4000 steps a contact
/// errs by some 1e-6.
#[test]
fn val_chung_ooi_2011_sphere_on_wall() {
    let aluminum = "density = \"2699 kg/m3\"\nyoungs_modulus = \"70 GPa\"\npoisson_ratio = 0.30";
    let magnesium = "density = \"1800 kg/m3\"\nyoungs_modulus = \"40 GPa\"\npoisson_ratio = 0.35";
    for (name, material, [overlap, force, duration]) in [
        ("aluminum", aluminum, [49.717e-6, 11.370e3, 731.7e-6]),
        ("magnesium", magnesium, [52.123e-6, 7.233e3, 767.1e-6]),
    ] {
        for engine in [common::verlet(2e-7), common::staggered(2e-7, 1e-10, 0.5)] {
            let text = touching(0.1, material, RIGID, &engine, "[contact.normal.hertz]\n");
            let found = contact(&mut falling(&text, 0.2), 0.1);
            let figures =
                [("overlap_m", found.overlap), ("force_N", found.force), ("duration_s", found.duration)];
            common::found(&format!("wall_{name}"), &figures);
            assert_close!(found.overlap, overlap, 2e-5, "in m");
            assert_close!(found.force, force, 1e-4, "in N");
            assert_close!(found.duration, duration, 1e-4, "in s");
            assert_close!(found.speed, 0.2, 1e-5, "in m/s");
        }
    }
}

/// Hertz against a plane of another material, in closed form: δ = (15 m v²/(16 E* √R))^(2/5), F = (4/3) E* √R δ^(3/2),
/// T = 2.943275 δ/v (the integral 2 ∫ dx/√(1 - x^(5/2)) from 0 to 1).
#[test]
fn the_walls_material_counts() {
    let material = "density = \"2500 kg/m3\"\nyoungs_modulus = \"1 GPa\"\npoisson_ratio = 0.25";
    let of_floor = "youngs_modulus = \"0.5 GPa\"\npoisson_ratio = 0.4";
    let text = touching(1e-3, material, of_floor, &common::verlet(2e-8), "[contact.normal.hertz]\n");
    let found = contact(&mut falling(&text, 0.3), 1e-3);
    let modulus = 1.0 / ((1.0 - 0.0625) / 1e9 + (1.0 - 0.16) / 0.5e9);
    let (mass, root) = (crate::walls::mass(), 1e-3_f64.sqrt());
    let overlap = (15.0 * mass * 0.09 / (16.0 * modulus * root)).powf(0.4);
    assert_close!(found.overlap, overlap, 1e-4, "in m");
    assert_close!(found.force, 4.0 / 3.0 * modulus * root * overlap.powf(1.5), 1e-4, "in N");
    assert_close!(found.duration, 2.943_275 * overlap / 0.3, 1e-4, "in s");
}

/// Test 3 at a wall: the restitution of the law, or that of the pair of materials, comes out. 1e-3: a dashpot that acts from the first
/// touch on costs a first-order error of the step in which that is.
#[test]
fn restitution_comes_back_from_a_wall() {
    let alumina = "density = \"4000 kg/m3\"\nyoungs_modulus = \"380 GPa\"\npoisson_ratio = 0.23";
    for wanted in [0.2, 0.5, 0.8, 1.0] {
        let laws =
            format!("[contact.normal.hertz]\n[contact.damping.restitution]\nrestitution = {wanted:?}\n");
        let own = format!(
            "[contact.normal.hertz]\n[contact.damping.restitution]\nrestitution = 0.9\n\
             [[mixtures]]\nbetween = [\"floor\", \"grain\"]\nrestitution = {wanted:?}\n"
        );
        for laws in [laws, own] {
            let text = touching(2.5e-3, alumina, RIGID, &common::verlet(2e-9), &laws);
            let found = contact(&mut falling(&text, 3.9), 2.5e-3);
            assert_near!(found.speed / 3.9, wanted, 1e-3, "restitution");
        }
    }
}

/// By hand: K = (1 + 3)/2 MPa, ℰ = δ/R and A = π (2 R δ - δ²) make K ℰ² A; the largest overlap has K π R³ (u⁴/2 - u⁵/5) = m v²/2.
#[test]
fn strains_are_taken_over_the_grains_radius() {
    let material = "density = \"2500 kg/m3\"\ncontact_stiffness = \"1 MPa\"";
    let of_floor = "contact_stiffness = \"3 MPa\"";
    let laws = "[contact.normal.strain_power]\nexponent = 2.0\n[limits]\nstrain = 0.5\n";
    let text = touching(1e-3, material, of_floor, &common::verlet(1e-7), laws);
    let found = contact(&mut falling(&text, 0.3), 1e-3);
    let energy = |u: f64| 2e6 * std::f64::consts::PI * 1e-9 * (u.powi(4) / 2.0 - u.powi(5) / 5.0);
    let strain = found.overlap / 1e-3;
    assert_between!(strain, 0.1..0.5);
    // The overlap is largest between two steps, to second order in their length.
    assert_close!(energy(strain), 0.5 * crate::walls::mass() * 0.09, 1e-4, "in J");
    let area = std::f64::consts::PI * found.overlap * (2e-3 - found.overlap);
    assert_close!(found.force, 2e6 * strain * strain * area, 1e-6, "in N");
}
