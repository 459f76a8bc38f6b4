//! Laws given as formulas, against the laws that they write down and against closed forms.

use std::f64::consts::PI;

use agglo::engine::soft::Simulation;
use agglo::math::Vec3;

use crate::common::{self, Listed, grain, relative_velocity};

const RADIUS: f64 = 1e-3;

fn mass() -> f64 {
    2500.0 * 4.0 / 3.0 * PI * RADIUS.powi(3)
}

fn listed(positions: Vec<[f64; 3]>, end: f64, engine: String, more: &str) -> Listed {
    Listed {
        material: "density = \"2500 kg/m3\"\nyoungs_modulus = \"10 MPa\"\npoisson_ratio = 0.25",
        radius: RADIUS,
        positions,
        end,
        engine,
        more: format!("[limits]\ndisplacement = 1e3\n{more}"),
    }
}

/// Two grains that touch already, if only just, at a relative speed [m/s].
fn pair(speed: f64, end: f64, engine: String, more: &str) -> Simulation {
    let place = RADIUS * (1.0 - 1e-12);
    let places = vec![[-place, 0.0, 0.0], [place, 0.0, 0.0]];
    listed(places, end, engine, more).start(|grains| {
        grains.velocity = vec![Vec3::AXES[0] * (0.5 * speed), Vec3::AXES[0] * (-0.5 * speed)];
    })
}

/// Largest part of the energy that was not explained at any step.
fn unexplained(simulation: &mut Simulation) -> f64 {
    let mut worst = 0.0_f64;
    common::watch(simulation, |now| worst = worst.max(now.balance().drift_relative.abs()));
    worst
}

/// Three grains that bounce at angles, with damping and friction that take force and slope of the law: a formula of Hertz gives the
/// trajectories of the law. Powers and orders of multiplication round otherwise: 1e-15 a step, 1e-11 after 1000 steps in collisions.
#[test]
fn hertz_as_a_formula_is_hertz() {
    let run = |normal: &str| {
        let more = format!(
            "{normal}\n[contact.damping.restitution]\nrestitution = 0.7\n[contact.friction.mindlin]\nstatic_friction = 0.4\n"
        );
        let places = vec![[0.0; 3], [2.1e-3, 1e-3, 0.0], [1e-3, -2e-3, 1e-3]];
        let mut simulation = listed(places, 10e-3, common::verlet(2e-6), &more).start(|grains| {
            grains.velocity = vec![Vec3::ZERO, Vec3::new(-0.5, 0.1, 0.0), Vec3::new(0.0, 0.4, -0.2)];
            grains.angular_velocity[2] = Vec3::new(0.0, 30.0, 5.0);
        });
        common::finish(&mut simulation);
        let motions = [0, 1, 2].map(|id| {
            let grain = grain(&simulation, id);
            [grain.position * 1e3, grain.velocity * 10.0, grain.angular_velocity * 0.01]
        });
        (motions.concat(), simulation.balance())
    };
    let (law, of_law) = run("[contact.normal.hertz]");
    let force = "4/3*effective_modulus*sqrt(effective_radius)*overlap^1.5";
    let half = "2/3*effective_modulus*sqrt(effective_radius)*overlap^1.5";
    let energy = "8/15*effective_modulus*sqrt(effective_radius)*overlap^2.5";
    let formulas = [
        format!("[contact.custom]\nforce = \"{force}\"\n"),
        format!("[contact.custom]\nforce = \"{force}\"\nenergy = \"{energy}\"\n"),
    ];
    for formula in formulas {
        let (motions, balance) = run(&formula);
        let off = law.iter().zip(&motions).map(|(a, b)| (*a - *b).norm()).fold(0.0, f64::max);
        assert!(off < 1e-11, "{off:e}: {formula}");
        assert_close!(balance.damping, of_law.damping, 1e-10, "in J");
        assert!((balance.friction - of_law.friction).abs() < 1e-10 * of_law.damping, "{balance:?}");
    }
    // Beside another law it adds to it: twice the half is the whole.
    let (whole, _) = run(&format!("[contact.custom]\nforce = \"{half} + {half}\"\n"));
    let halves = format!(
        "[contact.normal.hooke]\nstiffness = \"100 N/m\"\n[contact.custom]\nforce = \"{force} - 100*overlap\"\n"
    );
    for (a, b) in whole.iter().zip(&run(&halves).0) {
        assert_near_vector!(*a, *b, 1e-10, "a part in each law");
    }
}

/// k δ + c v: δ = v0/ω_d e^(-βωt) sin ω_d t until contact ends at π/ω_d, e = exp(-π β/√(1 - β²)). Before that the error falls by
/// four as the step is halved; the end of contact lies between steps.
#[test]
fn a_spring_and_dashpot_as_a_formula() {
    let (stiffness, dashpot, speed, reduced) = (500.0_f64, 5e-3, 0.2, 0.5 * mass());
    let frequency = (stiffness / reduced).sqrt();
    let part = dashpot / (2.0 * (stiffness * reduced).sqrt());
    let damped = frequency * (1.0 - part * part).sqrt();
    let duration = PI / damped;
    let more = "[contact.custom]\nforce = \"500*overlap + 5e-3*speed\"\n";
    let end = 0.9 * duration;
    let wanted = speed / damped * (-part * frequency * end).exp() * (damped * end).sin();
    let errors = [100.0, 200.0, 400.0].map(|steps| {
        let mut simulation = pair(speed, end, common::verlet(end / steps), more);
        common::finish(&mut simulation);
        let overlap = 2.0 * RADIUS - (grain(&simulation, 1).position - grain(&simulation, 0).position).norm();
        (overlap - wanted).abs()
    });
    for two in errors.windows(2) {
        let slope = (two[0] / two[1]).log2();
        assert!((slope - 2.0).abs() < 0.05, "errors {errors:?} m");
    }
    let steps = 4000.0;
    let mut simulation = pair(speed, 1.2 * duration, common::verlet(duration / steps), more);
    let mut last_touch = 0.0;
    common::watch(&mut simulation, |now| {
        let apart = (grain(now, 1).position - grain(now, 0).position).norm();
        if apart < 2.0 * RADIUS {
            last_touch = now.clock().time;
        }
    });
    let restitution = relative_velocity(&simulation).x / speed;
    let by_hand = (-PI * part / (1.0 - part * part).sqrt()).exp();
    // One step more or less at the end, where the dashpot acts alone: 2 β ω Δt.
    assert_near!(restitution, by_hand, 2.0 * part * frequency * duration / steps);
    assert_near!(last_touch, duration, 1.5 * duration / steps, "in s");
    let balance = simulation.balance();
    let lost = 0.25 * mass() * speed * speed * (1.0 - restitution * restitution);
    assert_close!(balance.damping, lost, 1e-3, "in J");
    assert_eq!(balance.custom, 0.0);
}

/// A part that drives is booked as put in, the ledger closes, and the run warns.
#[test]
fn a_formula_that_drives_is_booked_as_such() {
    let more = "[contact.custom]\nforce = \"500*overlap - 5e-3*speed\"\n";
    let mut simulation = pair(0.2, 5e-3, common::verlet(1e-6), more);
    let worst = unexplained(&mut simulation);
    let balance = simulation.balance();
    let gained = balance.stored.kinetic - balance.mechanical_at_start;
    assert!(gained > 0.1 * balance.mechanical_at_start, "{balance:?}");
    assert_close!(balance.custom, gained, 1e-2, "in J");
    assert_eq!(balance.damping, 0.0);
    assert_below!(worst, 1e-3);
    let warned = simulation.warnings.counts().keys().any(|text| text.contains("work_custom_J"));
    assert!(warned, "{:?}", simulation.warnings);
}

/// Attraction -k (δ + ℓ) from a distance ℓ on: the gap closes as s = s0 cosh(√(k/m*) t), s = δ + ℓ, second order in the step; at
/// more than ℓ grains feel nothing. Caught by a spring, the pair swings on, and the ledger closes.
#[test]
fn a_force_reaches_beyond_touching() {
    let law = "[contact.normal.hooke]\nstiffness = \"500 N/m\"\n[contact.custom]\nforce = \"-20*(overlap + 1e-4)\"\nreach = \"0.1 mm\"\n";
    let start = |gap: f64, end: f64, steps: f64| {
        let places = vec![[0.0; 3], [2.0 * RADIUS + gap, 0.0, 0.0]];
        listed(places, end, common::verlet(end / steps), law).start(|_| {})
    };
    let rate = (20.0 / (0.5 * mass())).sqrt();
    let end = 2.0 / rate;
    let wanted = 1e-5 * 2.0_f64.cosh();
    let errors = [50.0, 100.0, 200.0].map(|steps| {
        let mut simulation = start(0.9e-4, end, steps);
        common::finish(&mut simulation);
        let apart = (grain(&simulation, 1).position - grain(&simulation, 0).position).norm();
        (2.0 * RADIUS + 1e-4 - apart - wanted).abs()
    });
    for two in errors.windows(2) {
        let slope = (two[0] / two[1]).log2();
        assert!((slope - 2.0).abs() < 0.05, "errors {errors:?} m");
    }
    let mut far = start(1.01e-4, end, 50.0);
    common::finish(&mut far);
    assert_eq!(relative_velocity(&far), Vec3::ZERO);
    let mut caught = start(0.5e-4, 20.0 / rate, 20_000.0);
    let mut deepest = 0.0_f64;
    let mut worst = 0.0_f64;
    common::watch(&mut caught, |now| {
        let balance = now.balance();
        deepest = deepest.max(2.0 * RADIUS - (grain(now, 1).position - grain(now, 0).position).norm());
        // The pair's energies are those of its binding, some 1e-8 J.
        worst = worst.max(balance.drift.abs() / (0.5 * 20.0 * 1e-8));
    });
    assert!(deepest > 1e-6, "never touched: {deepest:e} m");
    assert_below!(worst, 1e-3);
    let [stored, wanted] = [caught.stored_energy(), start(0.5e-4, end, 50.0).stored_energy()];
    assert_close!(wanted.elastic, -0.5 * 20.0 * 0.5e-4 * 0.5e-4, 1e-10, "in J");
    assert_finite!(stored.elastic);
}

/// The error of the energy of a trap, whose energy is given, falls by four as the step is halved: its swing is that of the scheme.
#[test]
fn a_trap_with_its_energy_keeps_it() {
    let more = "[fields.custom]\nforce = [\"-2*x\", \"-2*y\", \"-2*z\"]\nenergy = \"x^2 + y^2 + z^2\"\n";
    let frequency = (2.0 / mass()).sqrt();
    let turn = 2.0 * PI / frequency;
    let drifts = [100.0, 200.0, 400.0].map(|steps| {
        let listed = listed(vec![[1e-3, 0.0, 0.0]], 5.0 * turn, common::verlet(turn / steps), more);
        let mut simulation =
            listed.start(|grains| grains.velocity[0] = Vec3::new(0.0, 0.7e-3 * frequency, 0.0));
        assert_close!(simulation.stored_energy().fields, 1e-6, 1e-12, "in J");
        let worst = unexplained(&mut simulation);
        let balance = simulation.balance();
        assert_eq!([balance.fields, balance.drag], [0.0, 0.0], "all of it is stored");
        worst
    });
    for two in drifts.windows(2) {
        assert!(((two[0] / two[1]).log2() - 2.0).abs() < 0.05, "{drifts:?}");
    }
    // Without the energy it is work from outside.
    let without = more.lines().filter(|line| !line.starts_with("energy")).collect::<Vec<_>>().join("\n");
    let mut outside =
        listed(vec![[1e-3, 0.0, 0.0]], 0.25 * turn, common::verlet(turn / 400.0), &without).start(|_| {});
    common::finish(&mut outside);
    assert_close!(outside.balance().fields, 1e-6, 1e-3, "in J");
    assert_eq!(outside.stored_energy().fields, 0.0);
}

/// v0 e^(-c t/m), with an error that falls by four as the step is halved; what the grain loses is lost to drag.
#[test]
fn a_drag_as_a_formula_is_lost_to_drag() {
    let more = "[fields.custom]\nforce = [\"-1e-3*vx\", \"-1e-3*vy\", \"-1e-3*vz\"]\n";
    let decay = mass() / 1e-3;
    let start = Vec3::new(0.3, -0.2, 0.1);
    let errors = [50.0, 100.0, 200.0].map(|steps| {
        let listed = listed(vec![[0.0; 3]], 2.0 * decay, common::verlet(decay / steps), more);
        let mut simulation = listed.start(|grains| grains.velocity[0] = start);
        common::finish(&mut simulation);
        let balance = simulation.balance();
        let lost = balance.mechanical_at_start - balance.stored.kinetic;
        assert_close!(balance.drag, lost, 4.0 / (steps * steps), "in J");
        assert_eq!([balance.fields, balance.custom], [0.0, 0.0]);
        (grain(&simulation, 0).velocity - start * (-2.0_f64).exp()).norm()
    });
    for two in errors.windows(2) {
        assert!(((two[0] / two[1]).log2() - 2.0).abs() < 0.1, "{errors:?}");
    }
}

/// The automatic step is 0.03 of the closed form: 2/ω of a trap, 1/Γ of a drag, 2/(Γ + √(Γ² + ω²)) of a spring with a dashpot
/// between two grains.
#[test]
fn the_automatic_step_is_that_of_the_closed_form() {
    let first = |positions: Vec<[f64; 3]>, more: &str| {
        listed(positions, 1e3, "[engine.verlet]".to_owned(), more).start(|_| {}).clock().next_step / 0.03
    };
    let alone = || vec![[0.0; 3]];
    let trap = "[fields.custom]\nforce = [\"-2*x\", \"-2*y\", \"-2*z\"]\n";
    assert_close!(first(alone(), trap), 2.0 / (2.0 / mass()).sqrt(), 1e-12, "in s");
    let drag = "[fields.custom]\nforce = [\"-1e-3*vx\", \"-1e-3*vy\", \"-1e-3*vz\"]\n";
    assert_close!(first(alone(), drag), mass() / 1e-3, 1e-12, "in s");
    let contact = "[contact.custom]\nforce = \"500*overlap + 5e-3*speed\"\n";
    let (square, rate) = (500.0 / (0.5 * mass()), 5e-3 / (0.5 * mass()));
    let wanted = 2.0 / (rate + (rate * rate + square).sqrt());
    assert_close!(first(vec![[0.0; 3], [3e-3, 0.0, 0.0]], contact), wanted, 1e-12, "in s");
}

/// A dashpot that grows with the speed has no slope at rest; at 2 m/s it is four times as fast as the spring. The automatic step sees
/// that, and the ledger is closed.
#[test]
fn a_dashpot_that_grows_with_the_speed_is_seen() {
    let more = "[contact.custom]\nforce = \"500*overlap + 0.05*speed*abs(speed)\"\n";
    let mut simulation = pair(2.0, 1e-3, "[engine.verlet]".to_owned(), more);
    let rate = 0.2 / (0.5 * mass());
    let wanted = 0.03 * 2.0 / (rate + (rate * rate + 500.0 / (0.5 * mass())).sqrt());
    assert_close!(simulation.clock().next_step, wanted, 1e-9, "in s");
    let worst = unexplained(&mut simulation);
    assert_below!(worst, 1e-3);
    assert_eq!(simulation.warnings.counts().len(), 0, "{:?}", simulation.warnings);
}
