//! The automatic step, `[engine.verlet]` left empty: it sees every law that acts, alone and beside others.

use std::f64::consts::{PI, TAU};

use agglo::engine::SimError;
use agglo::engine::soft::Simulation;
use agglo::math::Vec3;

use crate::common::{self, Listed, grain, relative_velocity};

const EMPTY: &str = "[engine.verlet]";

fn listed(radius: f64, positions: Vec<[f64; 3]>, end: f64, more: &str) -> Listed {
    Listed {
        material: "density = \"2500 kg/m3\"\nyoungs_modulus = \"10 MPa\"\npoisson_ratio = 0.25\ncontact_stiffness = \"10 MPa\"",
        radius,
        positions,
        end,
        engine: EMPTY.to_owned(),
        more: more.to_owned(),
    }
}

fn mass(radius: f64) -> f64 {
    2500.0 * 4.0 / 3.0 * PI * radius.powi(3)
}

fn assert_accounted(simulation: &Simulation, what: &str) {
    let worst = simulation.ledger.worst;
    assert!(worst < 1e-3, "{what}: unexplained energy {worst:e}");
    let warned = simulation.warnings.counts().keys().find(|text| text.contains("does not explain"));
    assert_eq!(warned, None, "{what}");
}

/// A contact whose dashpot outgrows its spring by far while it is pressed: δ'' = -(k δ + c A(δ) δ')/m* from 0.2 m/s,
/// integrated independently with a hundred times as many steps (`dashpot_alone`).
#[test]
fn a_dashpot_by_area_is_seen() {
    let (radius, stiffness, dashpot) = (10e-6, 10.0, 1e8);
    let more = "[contact.normal.hooke]\nstiffness = \"10 N/m\"\n[contact.damping.viscous_area]\ncoefficient = \"1e8 Pa s/m\"";
    let apart = vec![[-radius, 0.0, 0.0], [radius, 0.0, 0.0]];
    let mut simulation = listed(radius, apart, 20e-6, more).start(|grains| {
        grains.velocity = vec![Vec3::AXES[0] * 0.1, Vec3::AXES[0] * -0.1];
    });
    common::finish(&mut simulation);
    let rebound = relative_velocity(&simulation).x / 0.2;
    let wanted = dashpot_alone(radius, stiffness, dashpot, 0.2, 20e-6);
    assert!((wanted - 0.0159).abs() < 5e-5, "{wanted}");
    assert!((rebound / wanted - 1.0).abs() < 2e-3, "{rebound} for {wanted}");
    assert_accounted(&simulation, "viscous_area");
}

/// Speed of parting over that of approach [m/s], by classical Runge-Kutta with steps of a thousandth of the decay.
fn dashpot_alone(radius: f64, stiffness: f64, dashpot: f64, speed: f64, end: f64) -> f64 {
    let reduced = 0.5 * mass(radius);
    let area = |overlap: f64| PI * overlap * (radius - 0.25 * overlap);
    let slope = |(x, v): (f64, f64)| {
        if x > 0.0 { (v, -(stiffness * x + dashpot * area(x) * v) / reduced) } else { (v, 0.0) }
    };
    let (mut state, mut time) = ((0.0_f64, speed), 0.0_f64);
    while time < end {
        let dt = (1e-3 / (1e6 + dashpot * area(state.0.max(0.0)) / reduced)).min(end - time);
        let ahead = |d: (f64, f64), part: f64| (state.0 + part * dt * d.0, state.1 + part * dt * d.1);
        let a = slope(state);
        let b = slope(ahead(a, 0.5));
        let c = slope(ahead(b, 0.5));
        let d = slope(ahead(c, 1.0));
        let sum = |a: f64, b: f64, c: f64, d: f64| dt / 6.0 * (a + 2.0 * b + 2.0 * c + d);
        state = (state.0 + sum(a.0, b.0, c.0, d.0), state.1 + sum(a.1, b.1, c.1, d.1));
        time += dt;
    }
    -state.1 / speed
}

/// Ten turns: the speed is kept to round-off, and the orbit's place to (w Δt)²/12 of the angle turned, 5e-3 here.
#[test]
fn a_rotation_in_a_magnetic_field_is_seen() {
    let (radius, charge, orbit) = (0.01, 1e-3, 3e-9);
    let turning = charge * 10.0 / mass(radius);
    let more = "[fields.lorentz]\nmagnetic_flux_density = [\"0 T\", \"0 T\", \"10 T\"]";
    let mut simulation = listed(radius, vec![[0.0; 3]], 10.0 * TAU / turning, more).start(|grains| {
        grains.charge[0] = charge;
        grains.velocity[0] = Vec3::AXES[0] * (orbit * turning);
    });
    common::finish(&mut simulation);
    let found = grain(&simulation, 0);
    assert_close!(found.velocity.norm(), orbit * turning, 1e-12, "in m/s");
    assert!(found.position.norm() < 5e-3 * TAU * orbit, "{:?}", found.position);
    assert_accounted(&simulation, "lorentz");
}

/// A grain of 0.1 mm across stops after v τ, τ = (2/9) ρ R²/η; rotation dies away with I/(8 π η R³). After 25 τ e^-25
/// is left, and the trapezoidal rule keeps the path to round-off, whatever the step.
#[test]
fn a_stop_in_a_liquid_is_seen() {
    let (radius, speed) = (50e-6, 1e-4);
    let relaxation = 2.0 / 9.0 * 2500.0 * radius * radius / 1e-3;
    let more = "[fields.drag]\nlaw = \"stokes\"";
    let mut simulation = listed(radius, vec![[0.0; 3]], 25.0 * relaxation, more).start(|grains| {
        grains.velocity[0] = Vec3::AXES[1] * speed;
        grains.angular_velocity[0] = Vec3::AXES[2] * 3.0;
    });
    common::finish(&mut simulation);
    let path = grain(&simulation, 0).position.y / (speed * relaxation);
    assert!((path - 1.0).abs() < 1e-9, "{path}");
    assert_accounted(&simulation, "drag");
}

/// Spin that dies away in a liquid and motion after a jump of the flow: both are within z²/(12 e) = 1.1 s² of what is
/// lost, z = 6 s for the faster one, the rotation (15 η/(ρ R²)), and a tenth of that for the motion (4.5 η/(ρ R²)).
/// Above half of it, so that steps are as long as that allows.
#[test]
fn decays_in_a_liquid_err_as_promised() {
    let (radius, speed) = (50e-6, 1e-4);
    let rates = [15.0, 4.5].map(|part| part * 1e-3 / (2500.0 * radius * radius));
    for safety in [0.03_f64, 0.1, 0.2] {
        let engine = format!("[engine.verlet]\nsafety = {safety}");
        let more = "[fields.drag]\nlaw = \"stokes\"\nmedium_velocity = [\"0.1 mm/s\", \"0 m/s\", \"0 m/s\"]";
        // No step is longer than a hundredth of the run.
        let listed = Listed { engine, ..listed(radius, vec![[0.0; 3]], 40.0 / rates[1], more) };
        let mut simulation = listed.start(|grains| grains.angular_velocity[0] = Vec3::AXES[2] * 3.0);
        let mut worst = [0.0_f64; 2];
        common::watch(&mut simulation, |now| {
            let (time, found) = (now.clock().time, grain(now, 0));
            let left = [found.angular_velocity.z / 3.0, 1.0 - found.velocity.x / speed];
            for (worst, (left, rate)) in worst.iter_mut().zip(left.into_iter().zip(rates)) {
                *worst = worst.max((left - (-rate * time).exp()).abs());
            }
        });
        let promised = [1.0, 0.09].map(|part| part * 3.0 * safety * safety / std::f64::consts::E);
        for (worst, promised) in worst.into_iter().zip(promised) {
            // The next term of the series is 0.15 z² of this one, 22 % at s = 0.2; steps miss the time of the worst.
            let most = 1.005 + 6.0 * safety * safety;
            assert!((0.97..most).contains(&(worst / promised)), "{safety}: {worst} of {promised}");
        }
        assert_accounted(&simulation, "drag");
    }
}

/// A pair that meets by van der Waals attraction, whose force gradient is 260 N/m at the smallest gap and next to
/// nothing where it starts, and swings ten times between that well and a contact.
#[test]
fn an_attraction_is_seen_before_grains_are_close() {
    for contact in ["[contact.normal.hooke]\nstiffness = \"200 N/m\"", "[contact.normal.hertz]"] {
        for gap in [0.4e-9, 4e-9] {
            let radius = 1e-6;
            let more = format!(
                "{contact}\n[fields.near_field.law.van_der_waals]\nhamaker = \"1e-19 J\"\nsmallest_gap = \"0.4 nm\""
            );
            let half = radius + 0.5 * gap;
            let apart = vec![[-half, 0.0, 0.0], [half, 0.0, 0.0]];
            let end = if gap > 1e-9 { 3e-6 } else { 2e-6 };
            let mut simulation = listed(radius, apart, end, &more).start(|grains| {
                grains.velocity = vec![Vec3::AXES[0] * 1e-3, Vec3::AXES[0] * -1e-3];
            });
            let (mut turns, mut before) = (0, 0.0);
            common::watch(&mut simulation, |now| {
                let parting = relative_velocity(now).x;
                turns += u32::from(before * parting < 0.0);
                before = parting;
            });
            assert!(turns > 4, "{contact} {gap}: {turns}");
            assert_accounted(&simulation, contact);
        }
    }
}

/// Laws by the table they belong to, of which a scenario has one each.
const LAWS: &[(&str, &str)] = &[
    ("normal", "[contact.normal.hooke]\nstiffness = \"10 N/m\"\n"),
    ("normal", "[contact.normal.hertz]\n"),
    ("normal", "[contact.normal.strain_power]\nexponent = 1.5\n"),
    ("damping", "[contact.damping.viscous_area]\ncoefficient = \"1e7 Pa s/m\"\n"),
    ("damping", "[contact.damping.restitution]\nrestitution = 0.3\n"),
    ("friction", "[contact.friction.mindlin]\nstatic_friction = 0.4\nstiffness_ratio = 0.8\ndashpot = 0.5\n"),
    (
        "friction",
        "[contact.friction.regularized]\nstiffness = \"1e12 Pa/m\"\nstatic_friction = 0.4\ndynamic_friction = 0.3\n",
    ),
    (
        "bonds",
        "[bonds.beam]\nyoungs_modulus = \"5 MPa\"\ntensile_strength = \"1 GPa\"\nshear_strength = \"1 GPa\"\ngap = 0.1\n\
         damping_ratio = 0.1\n",
    ),
    (
        "bonds",
        "[bonds.strain_bond]\nstiffness = \"1 MPa\"\nexponent = 2.0\ntangential_stiffness = \"1e10 Pa/m\"\n\
         threshold_strain = 0.001\n",
    ),
    (
        "gravity",
        "[fields.gravity]\nacceleration = [\"0 m/s2\", \"0 m/s2\", \"-9.81 m/s2\"]\nbuoyancy = true\n",
    ),
    ("drag", "[fields.drag]\nlaw = \"stokes\"\nadded_mass = 0.5\n"),
    (
        "drag",
        "[fields.drag]\nlaw = \"schiller_naumann\"\nmedium_velocity = [\"1e4*y\", \"0 m/s\", \"0 m/s\"]\n",
    ),
    // A trap of 0.2 N/m for 1e-12 C, and a rotation at 1e6 rad/s.
    ("lorentz", "[fields.lorentz]\nelectric_field = [\"-2e11*x\", \"-2e11*y\", \"-2e11*z\"]\n"),
    ("lorentz", "[fields.lorentz]\nmagnetic_flux_density = [\"0 T\", \"0 T\", \"1e7 T\"]\n"),
    (
        "magnetic",
        "[fields.magnetic]\nmagnetizability = \"1e-9 J/T2\"\n\
         magnetic_flux_density = [\"1 T\", \"0 T\", \"1e4*z\"]\n",
    ),
    ("near", "[fields.near_field.law.van_der_waals]\nhamaker = \"1e-19 J\"\nsmallest_gap = \"10 nm\"\n"),
    ("near", "[fields.near_field.law.coulomb]\nrelative_permittivity = 20.0\n"),
    // A well at 18 um, of 0.5 N/m at its bottom.
    (
        "near",
        "[fields.near_field.law.power_pair]\nscaling = \"volume\"\nattraction = 1e4\nattraction_exponent = 4.0\n\
         repulsion = 1.9e-20\nrepulsion_exponent = 9.0\n",
    ),
];

/// Laws that do not converge with the step, so that a warning is all that can be had.
fn is_published(law: &str) -> bool {
    law.contains("regularized") || law.contains("strain_bond")
}

/// Two grains that approach aslant and spin, over some ten periods of the springs here.
fn meeting(laws: &str) -> Simulation {
    let half = 10.05e-6;
    let apart = vec![[-half, -2e-6, 0.0], [half, 2e-6, 0.0]];
    let more = format!("[limits]\ndisplacement = 1e3\non_breach = \"warn\"\n{laws}");
    listed(10e-6, apart, 45e-6, &more).start(|grains| {
        grains.velocity = vec![Vec3::new(0.05, 0.02, 0.01), Vec3::new(-0.05, -0.02, 0.02)];
        grains.angular_velocity = vec![Vec3::new(0.0, 0.0, 1e3), Vec3::new(2e3, 0.0, 0.0)];
        grains.charge = vec![1e-12, 0.5e-12];
    })
}

/// What is wrong with the energy of a meeting under these laws, if anything is.
fn fault(laws: &[&str]) -> Option<String> {
    let mut simulation = meeting(&laws.concat());
    let mut turns = agglo_testing::Turns::at_most(10_000_000, "the end of the run");
    while !simulation.is_finished() {
        turns.take();
        if let Err(error) = simulation.step() {
            return Some(format!("{laws:?}: {error}"));
        }
    }
    let worst = simulation.ledger.worst;
    let warned = simulation.warnings.counts().keys().any(|text| text.contains("does not explain"));
    let is_published = laws.iter().any(|law| is_published(law));
    let is_told = warned == (worst > 1e-3) && (is_published || worst < 1e-3);
    (!is_told).then(|| format!("{laws:?}: unexplained {worst:e} in {} steps", simulation.clock().step))
}

fn assert_no_fault<'a>(cases: impl Iterator<Item = Vec<&'a str>>) {
    let faults: Vec<String> = cases.filter_map(|laws| fault(&laws)).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Whether a law needs a normal one beside it.
fn needs_normal((table, law): &(&str, &str)) -> bool {
    matches!(*table, "damping" | "friction") || law.contains("strain_bond")
}

#[test]
fn every_law_alone_is_accounted_for() {
    let with_normal = |law| if needs_normal(law) { vec![LAWS[0].1, law.1] } else { vec![law.1] };
    assert_no_fault(LAWS.iter().map(with_normal));
}

#[test]
fn every_pair_of_laws_is_accounted_for() {
    let pairs =
        LAWS.iter().enumerate().flat_map(|(at, one)| LAWS[at + 1..].iter().map(move |other| (one, other)));
    let pairs = pairs.filter(|(one, other)| one.0 != other.0);
    assert_no_fault(pairs.map(|(one, other)| {
        let has_normal = one.0 == "normal" || !(needs_normal(one) || needs_normal(other));
        let normal = if has_normal { "" } else { LAWS[0].1 };
        vec![normal, one.1, other.1]
    }));
}

/// Ends of a collision of two grains whose given step is 1.8/w of their spring: stable, and wrong by far.
fn too_coarse(more: &str) -> (Simulation, Result<(), SimError>) {
    let (radius, stiffness) = (10e-6, 10.0);
    let step = 1.8 / (2.0 * stiffness / mass(radius)).sqrt();
    let spring = format!("[limits]\ndisplacement = 1e3\non_breach = \"warn\"\n{more}");
    let apart = vec![[-1.01 * radius, 0.0, 0.0], [1.01 * radius, 0.0, 0.0]];
    let listed = Listed { engine: common::verlet(step), ..listed(radius, apart, 20e-6, &spring) };
    let mut simulation = listed.start(|grains| {
        grains.velocity = vec![Vec3::AXES[0] * 0.1, Vec3::AXES[0] * -0.1];
    });
    let mut ending = Ok(());
    let mut turns = agglo_testing::Turns::at_most(10_000_000, "the end of the run");
    while !simulation.is_finished() && ending.is_ok() {
        turns.take();
        ending = simulation.step();
    }
    (simulation, ending)
}

const SPRING: &str = "[contact.normal.hooke]\nstiffness = \"10 N/m\"\n";

/// Much unexplained energy ends a run, unless that is allowed or a published law acts; then it is a warning.
#[test]
fn unexplained_energy_raises_an_alarm() {
    let (_, ending) = too_coarse(SPRING);
    let error = ending.unwrap_err();
    assert!(matches!(error, SimError::Unexplained { part, limit: 0.1, .. } if part > 0.1), "{error}");
    let published = "[contact.friction.regularized]\nstiffness = \"1 Pa/m\"\nstatic_friction = 0.1\ndynamic_friction = 0.1\n";
    for more in [format!("drift_error = 1e9\n{SPRING}"), format!("{SPRING}{published}")] {
        let (simulation, ending) = too_coarse(&more);
        assert_eq!(ending, Ok(()), "{more}");
        let counts = simulation.warnings.counts();
        assert!(counts.keys().any(|text| text.contains("limits.drift_warning")), "{counts:?}");
        assert_above!(simulation.ledger.worst, 0.1);
    }
}

/// A given step stays as it is; where it is too long for a law, the run names the law.
#[test]
fn a_given_step_above_the_critical_one_warns() {
    let relaxation = 2.0 / 9.0 * 2500.0 * 1e-10 / 1e-3;
    for (part, warns) in [(0.1, false), (3.0, true)] {
        let engine = common::verlet(part * relaxation);
        let more = "[fields.drag]\nlaw = \"stokes\"";
        let listed = Listed { engine, ..listed(10e-6, vec![[0.0; 3]], 30.0 * relaxation, more) };
        let mut simulation = listed.start(|_| {});
        common::finish(&mut simulation);
        assert_eq!(simulation.clock().step, (30.0_f64 / part).round() as u64);
        let found =
            simulation.warnings.counts().keys().any(|text| text.contains("critical step of fields.drag"));
        assert_eq!(found, warns, "{part}");
    }
}
