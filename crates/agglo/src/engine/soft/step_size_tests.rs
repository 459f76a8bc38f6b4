//! The pace of each law against numbers worked out by hand: two grains that touch, R = 10 um, 2500 kg/m3.

use std::f64::consts::PI;
use std::path::Path;

use super::Simulation;
use super::step_size::Paces;
use crate::math::Pace;
use crate::packing::place;
use crate::scenario::Scenario;

const RADIUS: f64 = 10e-6;
const MASS: f64 = 2500.0 * 4.0 / 3.0 * PI * RADIUS * RADIUS * RADIUS;
/// Contacts reach this strain in `limits.strain`: an overlap of 2 um.
const STRAIN: f64 = 0.1;
const HOOKE: &str = "[contact.normal.hooke]\nstiffness = \"10 N/m\"\n";
const DASHPOT: &str = "[contact.damping.restitution]\nrestitution = 0.3\n";

fn paces(laws: &str) -> Paces {
    let text = format!(
        "version = 1\ntime.end = \"1 ms\"\nengine.verlet = {{}}\n\
         medium = {{ density = \"1000 kg/m3\", viscosity = \"1 mPa s\" }}\n[materials.stone]\n\
         density = \"2500 kg/m3\"\nyoungs_modulus = \"10 MPa\"\npoisson_ratio = 0.25\n\
         [[grains]]\nmaterial = \"stone\"\ncharge = \"1 pC\"\nsize.constant.radius = \"10 um\"\n\
         placement.list.positions = [[\"0 m\", \"0 m\", \"0 m\"], [\"20 um\", \"0 m\", \"0 m\"]]\n{laws}"
    );
    let scenario = Scenario::from_toml(&text).unwrap();
    let grains = place(&scenario, Path::new("")).unwrap();
    let simulation = Simulation::start(&scenario, grains).unwrap();
    Paces::new(&simulation.system, Some(STRAIN), 0.0)
}

fn assert_pace(found: Pace, square: f64, rate: f64, what: &str) {
    let close = |found: f64, wanted: f64| (found - wanted).abs() <= 1e-9 * wanted;
    assert!(close(found.square, square) && close(found.rate, rate), "{what}: {found:?}, {square:e} {rate:e}");
}

/// k/m*, 2 ζ √(k/m*), and 7/2 of κ k/m* and of half the dashpot for the spring across.
#[test]
fn contacts() {
    let square = 10.0 / (0.5 * MASS);
    assert_pace(paces(HOOKE).contact, square, 0.0, "hooke");
    let log = 0.3_f64.ln();
    let damped = 2.0 * -log / log.hypot(PI) * square.sqrt();
    assert_pace(paces(&format!("{HOOKE}{DASHPOT}")).contact, square, damped, "restitution");
    let friction =
        "[contact.friction.mindlin]\nstatic_friction = 0.4\nstiffness_ratio = 0.8\ndashpot = 0.5\n";
    let across = paces(&format!("{HOOKE}{DASHPOT}{friction}")).contact;
    assert_pace(across, 2.8 * square, 1.75 * damped, "mindlin");
    // 2 E* √(R* δ) with E* = E/(2 (1 - ν²)), R* = R/2 and δ = 2 um; Rayleigh's wave is slower here.
    let stiffness = 10e6 / (1.0 - 0.0625) * (0.5 * RADIUS * 2e-6_f64).sqrt();
    assert_pace(paces("[contact.normal.hertz]\n").contact, stiffness / (0.5 * MASS), 0.0, "hertz");
}

/// Drag by its solved rate of spin; q B/m and the gradient of E over all axes; 2 γ (∂B/∂z)².
#[test]
fn forces_on_single_grains() {
    let drag = paces("[fields.drag]\nlaw = \"stokes\"\n").drag;
    assert_pace(drag, 0.0, 15.0 / 6.0 * 1e-3 / (2500.0 * RADIUS * RADIUS), "drag");
    let flux = "[fields.lorentz]\nmagnetic_flux_density = [\"0 T\", \"6 T\", \"8 T\"]\n";
    assert_pace(paces(flux).lorentz, 0.0, 1e-11 / MASS, "rotation");
    let trap = "[fields.lorentz]\nelectric_field = [\"-2e11*x\", \"-2e11*y\", \"-2e11*z\"]\n";
    let found = paces(trap).lorentz;
    // A difference over a hundredth of the radius, rounded.
    assert!((found.square / (3.0_f64.sqrt() * 0.2 / MASS) - 1.0).abs() < 1e-9 && found.rate == 0.0);
    let field = "[fields.magnetic]\nmagnetisability = \"1e-9 J/T2\"\n\
                 magnetic_flux_density = [\"1 T\", \"0 T\", \"1e4*z\"]\n";
    let found = paces(field).magnetic;
    assert!((found.square / (0.2 / MASS) - 1.0).abs() < 1e-4 && found.rate == 0.0, "{found:?}");
}

/// Charges at the deepest overlap that contacts reach: 2 q²/(4 π ε d³) over m*; nothing without a contact.
#[test]
fn a_near_field_counts_where_contact_ends_the_approach() {
    let field = "[fields.near_field.law.coulomb]\nrelative_permittivity = 20.0\n";
    let distance = 2.0 * RADIUS * (1.0 - STRAIN);
    let gradient = 2.0 * 1e-24 / (4.0 * PI * 20.0 * 8.854_187_818_8e-12 * distance.powi(3));
    let found = paces(&format!("{HOOKE}{field}")).near_field;
    assert!((found.square / (gradient / (0.5 * MASS)) - 1.0).abs() < 1e-8, "{found:?}");
}

/// What acts together adds up.
#[test]
fn the_total_is_the_sum() {
    let drag = "[fields.drag]\nlaw = \"stokes\"\n";
    let found = paces(&format!("{HOOKE}{drag}"));
    assert_eq!(found.total(), found.contact + found.drag);
    assert_eq!(found.fastest(), "contact");
}
