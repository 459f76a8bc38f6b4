//! Chains of bonded grains against the theory of beams.
//!
//! A chain of N bonds of length l, held at its first grain (which is very heavy) and loaded by F at its last. In
//! bond b the bending moment is F l (N - b + 1/2); the rotations are a parabola that the bonds sum up by the
//! trapezoidal rule, so that the tip moves by
//!   w = F L³/(3 E I) (1 - 1/(4 N²)) + F L/(κ E A),
//! Euler and Bernoulli's deflection with a discrete correction, and Timoshenko's share of shear.

use std::f64::consts::PI;

use agglo::contact::bond::Break;
use agglo::engine::soft::Simulation;

use crate::common;

const BONDS: usize = 10;
const RADIUS: f64 = 1e-3;
const MODULUS: f64 = 1e9;
const SHEAR_RATIO: f64 = 0.4;
const LENGTH: f64 = 2.0 * RADIUS * BONDS as f64;
const AREA: f64 = PI * RADIUS * RADIUS;
const SECOND_MOMENT: f64 = 0.25 * PI * RADIUS * RADIUS * RADIUS * RADIUS;
const CHARGE: f64 = 1e-9;

/// A chain along x in a field of force on its last grain (newtons per `CHARGE`; may depend on t), drawn by so much
/// drag that the slowest bending dies away without swinging (at 3400/s: 4 ms are 13 of its times, 8 ms 26).
fn chain(strength: &str, force: [String; 3], end: f64) -> Simulation {
    let place = |k: usize| format!("[\"{:e} m\", \"0 m\", \"0 m\"]", 2.0 * RADIUS * k as f64);
    let places: Vec<String> = (1..=BONDS).map(place).collect();
    let field = force.map(|component| format!("\"({component})*10^9 + 0*t\"")).join(", ");
    let group = |material: &str, positions: &str| {
        format!(
            "[[grains]]\nmaterial = \"{material}\"\n[grains.size.constant]\nradius = \"{RADIUS:e} m\"\n\
             [grains.placement.list]\npositions = [{positions}]\n"
        )
    };
    let text = format!(
        "version = 1\n[time]\nend = \"{end:e} s\"\n[engine.verlet]\nsafety = 0.3\n[medium]\nviscosity = \"3.8 Pa s\"\n\
         [materials.grain]\ndensity = \"2500 kg/m3\"\n[materials.wall]\ndensity = \"1e20 kg/m3\"\n{}{}\
         [bonds.beam]\nyoungs_modulus = \"{MODULUS:e} Pa\"\nshear_ratio = {SHEAR_RATIO}\n\
         tensile_strength = \"{strength}\"\nshear_strength = \"1 GPa\"\n[fields.drag]\nlaw = \"stokes\"\n\
         [fields.lorentz]\nelectric_field = [{field}]\n",
        group("wall", &place(0)),
        group("grain", &places.join(", "))
    );
    let mut simulation = common::start(&text, |grains| grains.charge[BONDS] = CHARGE);
    assert_eq!(simulation.system.network.bonds().len(), BONDS);
    let mut turns = agglo_testing::Turns::at_most(10_000_000, "the bond to break");
    while !simulation.is_finished() && simulation.events.is_empty() {
        turns.take();
        common::steps(&mut simulation, 1);
    }
    simulation
}

fn no_force() -> String {
    "0".to_owned()
}

/// 2e-5: what is left of the motion after 26 damping times is 1e-6; deflections of 1e-3 L bend the theory by 1e-6.
#[test]
fn val_timoshenko_cantilever() {
    let force = 5e-3;
    let bent = chain("1 GPa", [no_force(), format!("{force}"), no_force()], 8e-3);
    let tip = common::grain(&bent, BONDS as u32);
    let slender = force * LENGTH.powi(3) / (3.0 * MODULUS * SECOND_MOMENT);
    let discrete = 1.0 - 0.25 / (BONDS * BONDS) as f64;
    let wanted = slender * discrete + force * LENGTH / (SHEAR_RATIO * MODULUS * AREA);
    common::found("cantilever", &[("off", tip.position.y / wanted - 1.0)]);
    assert!((tip.position.y / wanted - 1.0).abs() < 2e-5, "{} for {wanted}", tip.position.y);
    assert_eq!(tip.position.z, 0.0);
    assert_below!(bent.momentum_drift_relative(), 1e-9);
}

/// The bar lengthens by F L/(E A); 2e-5 as for the cantilever.
#[test]
fn val_hooke_axial_stiffness() {
    for force in [5.0, -5.0] {
        let bar = chain("1 GPa", [format!("{force}"), no_force(), no_force()], 4e-3);
        let found = common::grain(&bar, BONDS as u32).position.x - LENGTH;
        let wanted = force * LENGTH / (MODULUS * AREA);
        common::found("axial_stiffness", &[("off", found / wanted - 1.0)]);
        assert!((found / wanted - 1.0).abs() < 2e-5, "{found:e} for {wanted:e}");
    }
}

/// Pulled ever harder along its axis, the bar breaks by tension at F = σ A.
///
/// 0.3 %: the load rises in 2 ms, twenty periods of the bar, which swings by one part in a thousand about it.
#[test]
fn val_breaking_load_of_a_bar() {
    let wanted = 1e6 * AREA;
    let bar =
        chain("1 MPa", [format!("{wanted:e}*t*500").replace('e', "*10^"), no_force(), no_force()], 4e-3);
    let event = bar.events[0];
    assert_eq!(event.broke, Some(Break::Tension));
    let found = wanted * event.time / 2e-3;
    assert!((found / wanted - 1.0).abs() < 0.003, "{found} for {wanted}");
    // What the bond held when it broke: σ² A l/(2 E).
    let energy = 1e12 * AREA * 2.0 * RADIUS / (2.0 * MODULUS);
    common::found("bar", &[("load_off", found / wanted - 1.0), ("energy_off", event.energy / energy - 1.0)]);
    assert!((event.energy / energy - 1.0).abs() < 0.02, "{} for {energy}", event.energy);
}

/// Bent ever harder, the cantilever breaks where it is held, when M r/I = σ there: M = F l (N - 1/2).
///
/// 0.5 %: the load rises over a thousand damping times; the beam lags by about two.
#[test]
fn val_breaking_load_of_a_cantilever() {
    let wanted = 1e5 * SECOND_MOMENT / (RADIUS * 2.0 * RADIUS * (BONDS as f64 - 0.5));
    let rise = 0.4;
    let rate = format!("{:.15}*t", wanted / rise);
    let bent = chain("0.1 MPa", [no_force(), rate, no_force()], 2.0 * rise);
    let event = bent.events[0];
    assert_eq!((event.ids, event.broke), ([0, 1], Some(Break::Tension)));
    let found = wanted * event.time / rise;
    common::found("cantilever_load", &[("off", found / wanted - 1.0)]);
    assert!((found / wanted - 1.0).abs() < 0.005, "{found} for {wanted}");
}
