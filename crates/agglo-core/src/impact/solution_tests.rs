//! Restitution and temperatures that go with each other: the coupled solution, and the iterations as printed.

use std::f64::consts::PI;

use super::tests::{HARDNESS, REACTIVE, TOUGH, laws, sphere};
use super::*;
use crate::constants::GAS_CONSTANT;
use crate::math::roots::root_between;

/// e against H(T'): both sides worked out anew from the outcome. Round-off of a square root near the root.
#[test]
fn coupled_solution_holds_its_equations() {
    let laws = laws(HARDNESS, [REACTIVE, TOUGH]);
    let softer = |t: [f64; 2]| {
        let of = |limit: f64, q: f64, t: f64| limit * (q / (GAS_CONSTANT * t)).exp();
        of(3e5, 600.0, t[0]).min(of(5e5, 200.0, t[1]))
    };
    for v in [0.5, 3.0, 8.0, 11.0, 14.0, 20.0, 40.0] {
        let (one, two) = (sphere(0, 1e-3, [v, 0.0, 0.0]), sphere(1, 2e-3, [-0.2 * v, 0.0, 0.0]));
        let outcome = laws.impact([&one, &two], Vec3::AXES[0]);
        let reduced = one.mass * two.mass / (one.mass + two.mass);
        let x = reduced * (1.2 * v).powi(2) / (4.0 * PI * 1e-9 * softer(outcome.temperatures));
        assert!(outcome.converged && outcome.iterations < 12, "{v}: {outcome:?}");
        if outcome.sticks {
            assert!(x >= 1.0, "{v}: {x}");
        } else {
            assert!((1.0 - outcome.restitution - x.sqrt()).abs() < 1e-14, "{v}: {x} {outcome:?}");
        }
        // The temperatures are those of the heat: lost energy and α a_c, α the mean of 400 and 0, shared by mass.
        let e = outcome.restitution;
        let heat = 0.5 * (1.0 - e * e) * reduced * (1.2 * v).powi(2) + 200.0 * (1.0 - e) * PI * 1e-6;
        let warmer = heat / (800.0 * (one.mass + two.mass));
        for after in outcome.temperatures {
            assert!(((after - 300.0) / warmer - 1.0).abs() < 1e-9, "{v}");
        }
        assert_close!(outcome.energy.heat, heat, 1e-13, "in J");
    }
}

/// Q = 40 kJ/mol has a hard and a soft solution at some speeds: of those that a fine scan finds, the smallest e is taken.
#[test]
fn of_several_solutions_the_smallest() {
    let soft = "hardness = \"0.2 MPa\"\nactivation_energy = \"40 kJ\"";
    let laws = laws(HARDNESS, [soft, soft]);
    let mut several = 0;
    for step in 0..120 {
        let v = 600.0 * 1.01_f64.powi(step);
        let (one, two) = (sphere(0, 1e-3, [v, 0.0, 0.0]), sphere(0, 1e-3, [0.0; 3]));
        let outcome = laws.impact([&one, &two], Vec3::AXES[0]);
        let residual = |e: f64| {
            let t = 300.0 + (1.0 - e * e) * v * v / 8.0 / 800.0;
            let x = 0.5 * one.mass * v * v / (4.0 * PI * 2e-4 * (40e3 / (GAS_CONSTANT * t)).exp());
            (1.0 - x.sqrt()).max(0.0) - e
        };
        let grid = |k: u32| f64::from(k) * 1e-4;
        let signs: Vec<u32> =
            (0..10_000).filter(|k| (residual(grid(*k)) > 0.0) != (residual(grid(k + 1)) > 0.0)).collect();
        several += u32::from(signs.len() + usize::from(residual(0.0) <= 0.0) > 1);
        let wanted = if residual(0.0) <= 0.0 {
            0.0
        } else {
            let ends = [grid(signs[0]), grid(signs[0] + 1)];
            root_between(residual, ends, ends.map(residual), 1e-15).at
        };
        assert!((outcome.restitution - wanted).abs() < 1e-11, "{v}: {} {wanted}", outcome.restitution);
    }
    assert!(several > 10, "{several}");
}

/// The printed iteration flips between 0 and 1 - x for a0 = 0, and is at once at the root for a0 = af.
#[test]
fn fixed_point_as_printed() {
    let cold = ["hardness = \"0.3 MPa\""; 2];
    let (one, two) = (sphere(0, 1e-3, [6.0, 0.0, 0.0]), sphere(0, 1e-3, [-6.0, 0.0, 0.0]));
    let x = 0.5 * one.mass * 144.0 / (4.0 * PI * 1e-9 * 3e5);
    let run = |more: &str| laws(&format!("{HARDNESS}\n{more}"), cold).impact([&one, &two], Vec3::AXES[0]);
    let odd = run("solver.fixed_point = { most_iterations = 7 }");
    assert_false!(odd.converged, "the law has found its solution");
    assert_eq!(odd.iterations, 7);
    assert_near!(odd.restitution, 1.0 - x, 1e-15);
    let even = run("solver.fixed_point = { most_iterations = 8 }");
    assert_false!(even.converged, "the law has found its solution");
    assert_eq!(even.restitution, 0.0);
    assert_true!(even.sticks, "the pair sticks");
    let level = run("elastic_area = 0.5\nsticking_area = 0.5\nsolver.fixed_point = {}");
    assert_true!(level.converged, "the law has found its solution");
    assert_eq!(level.iterations, 2);
    assert_near!(level.restitution, 1.0 - 2.0 * x, 1e-15);
    let bracketed = run("elastic_area = 0.5\nsticking_area = 0.5");
    assert_near!(bracketed.restitution, level.restitution, 1e-15);
    // Within its tolerance of 5e-4 it finds the coupled root too, where the areas differ little.
    let areas = "elastic_area = 0.8\nsticking_area = 0.9\n";
    let coupled = |more: &str| {
        laws(&format!("{HARDNESS}\n{areas}{more}"), [REACTIVE; 2]).impact([&one, &two], Vec3::AXES[0])
    };
    let (plain, consistent) = (coupled("solver.fixed_point = {}"), coupled(""));
    assert_true!(plain.converged, "the law has found its solution");
    assert_close!(plain.restitution, consistent.restitution, 5e-4);
}

/// With the mean force over compression alone, as 4.14 has it, the work of 4.4-4.9 is 1 + e times as much, since its peak is
/// twice the mean: (1-e)² = x (1+e) has e = 1/2 at x = 1/6, and m* v² = 120.
#[test]
fn val_zohdi_2004_work_of_the_printed_force() {
    let load = 120.0 / (4.0 * PI * 0.125);
    let soft = format!("hardness = \"{} Pa\"", 6.0 * load);
    let rule = "[impact.restitution.hardness]\nforce_over = \"compression\"\n[impact.heat]\nbalance = \"published\"\n";
    let one = Body { mass: 2.0, radius: 0.5, heat_capacity: 4.0, ..sphere(0, 1.0, [6.0, 0.0, 0.0]) };
    let two = Body { mass: 3.0, radius: 0.7, heat_capacity: 5.0, ..sphere(1, 1.0, [-4.0, 0.0, 0.0]) };
    let outcome = laws(rule, [&soft, &soft]).impact([&one, &two], Vec3::AXES[0]);
    assert!((outcome.restitution - 0.5).abs() < 1e-14, "{}", outcome.restitution);
    // What was lost, (1 - e²) m* v²/2, and twice the work.
    let wanted = 45.0 + 2.0 * 1.5 * 0.75 * 120.0 / 3.0;
    assert!((outcome.energy.heat - wanted).abs() < 1e-11, "{}", outcome.energy.heat);
}
