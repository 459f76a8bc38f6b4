//! The pace of each law against numbers worked out by hand: two grains that touch, R = 10 um, 2500 kg/m3.

use crate::fields::Fields;
use std::f64::consts::PI;

use super::step_size::{Paces, first};
use crate::engine::soft::{Scheme, Settings, Simulation};
use crate::math::Pace;
use crate::testing::{Scenario, place};
use crate::units::Quantity;

const RADIUS: f64 = 10e-6;
const MASS: f64 = 2500.0 * 4.0 / 3.0 * PI * RADIUS * RADIUS * RADIUS;
/// Contacts reach this strain in `limits.strain`: an overlap of 2 um.
const STRAIN: f64 = 0.1;
const HOOKE: &str = "[contact.normal.hooke]\nstiffness = \"10 N/m\"\n";
const DASHPOT: &str = "[contact.damping.restitution]\nrestitution = 0.3\n";

fn paces(laws: &str) -> Paces {
    paces_at("20 um", STRAIN, laws)
}

/// With centers at a distance, and contacts that reach this strain.
fn paces_at(distance: &str, strain: f64, laws: &str) -> Paces {
    let text = format!(
        "version = 1\ntime.end = \"1 ms\"\nengine.verlet = {{}}\n\
         medium = {{ density = \"1000 kg/m3\", viscosity = \"1 mPa s\" }}\n[materials.stone]\n\
         density = \"2500 kg/m3\"\nyoungs_modulus = \"10 MPa\"\npoisson_ratio = 0.25\n\
         [[grains]]\nmaterial = \"stone\"\ncharge = \"1 pC\"\nsize.constant.radius = \"10 um\"\n\
         placement.list.positions = [[\"0 m\", \"0 m\", \"0 m\"], [\"{distance}\", \"0 m\", \"0 m\"]]\n{laws}"
    );
    let scenario = Scenario::from_toml(&text).unwrap();
    let grains = place(&scenario).unwrap();
    let simulation = Simulation::start(&scenario, grains).unwrap();
    Paces::new(&simulation.system, Some(strain), 0.0)
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

/// Where contacts hardly reach anything, Rayleigh's wave: 4/T², T = π R √(ρ/G)/(0.1631 ν + 0.8766), G = 4 MPa.
#[test]
fn the_wave_of_stiff_contacts() {
    let time = PI * RADIUS * (2500.0_f64 / 4e6).sqrt() / (0.1631 * 0.25 + 0.8766);
    let found = paces_at("20 um", 1e-9, "[contact.normal.hertz]\n").contact;
    assert_pace(found, 4.0 / (time * time), 0.0, "wave");
}

/// Laws by the area of contact, of grains that overlap by 1 um: A = π δ (R - δ/4). Dashpot c A/m*; springs across
/// 4 (7/2) K A/m*, beside the normal one and, for a bond, on top of it.
#[test]
fn contacts_by_area() {
    let area = PI * 1e-6 * (RADIUS - 0.25e-6);
    let normal = 10.0 / (0.5 * MASS);
    let across = 14.0 * 1e12 * area / (0.5 * MASS);
    // The area is of two lenses that are known to rounding of the distance, 1e-16/1e-6 of the overlap.
    let with = |law: &str| paces_at("19 um", 1e-9, &format!("{HOOKE}{law}")).contact;
    let viscous = "[contact.damping.viscous_area]\ncoefficient = \"1e8 Pa s/m\"\n";
    assert_pace(with(viscous), normal, 1e8 * area / (0.5 * MASS), "viscous_area");
    let friction = "[contact.friction.regularized]\nstiffness = \"1e12 Pa/m\"\nstatic_friction = 0.4\ndynamic_friction = 0.3\n";
    assert_pace(with(friction), across, 0.0, "regularized");
    let bond = "[bonds.strain_bond]\nstiffness = \"1 kPa\"\nexponent = 2.0\ntangential_stiffness = \"1e12 Pa/m\"\n\
                threshold_strain = 0.001\n";
    assert_pace(with(bond), normal + across, 0.0, "strain_bond");
}

/// How fast one of the fields is.
fn field(word: &str, text: &str) -> Pace {
    let at = Fields::SINGLE.iter().position(|single| *single == word).unwrap();
    paces(text).fields[at]
}

/// Drag by its solved rate of rotation; q B/m and the gradient of E over all axes; 2 γ (∂B/∂z)².
#[test]
fn forces_on_single_grains() {
    let drag = paces("[fields.drag]\nlaw = \"stokes\"\n").drag;
    assert_pace(drag, 0.0, 15.0 / 6.0 * 1e-3 / (2500.0 * RADIUS * RADIUS), "drag");
    let flux = "[fields.lorentz]\nmagnetic_flux_density = [\"0 T\", \"6 T\", \"8 T\"]\n";
    assert_pace(field("fields.lorentz", flux), 0.0, 1e-11 / MASS, "rotation");
    let trap = "[fields.lorentz]\nelectric_field = [\"-2e11*x\", \"-2e11*y\", \"-2e11*z\"]\n";
    let found = field("fields.lorentz", trap);
    // A difference over a hundredth of the radius, rounded.
    assert_close!(found.square, 3.0_f64.sqrt() * 0.2 / MASS, 1e-9);
    assert_eq!(found.rate, 0.0);
    let magnet = "[fields.magnetic]\nmagnetizability = \"1e-9 J/T2\"\n\
                 magnetic_flux_density = [\"1 T\", \"0 T\", \"1e4*z\"]\n";
    let found = field("fields.magnetic", magnet);
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

/// Settings made by hand are held to no rules: a first step above the largest one is cut to it, one below stays.
#[test]
fn the_first_step_is_within_the_largest() {
    let text = "version = 1\ntime.end = \"1 ms\"\n[engine.staggered]\ninitial_step = \"20 ns\"\nlargest_step = \"80 ns\"\n\
                tolerance = 1e-5\ntarget_iterations = 8\n[materials.stone]\ndensity = \"2500 kg/m3\"\n[[grains]]\n\
                material = \"stone\"\nsize.constant.radius = \"10 um\"\n\
                placement.list.positions = [[\"0 m\", \"0 m\", \"0 m\"]]\n";
    let scenario = Scenario::from_toml(text).unwrap();
    let grains = place(&scenario).unwrap();
    let system = Simulation::start(&scenario, grains).unwrap().system;
    let mut settings = Settings::try_from(&scenario).unwrap();
    for (initial, due) in [(20e-9, 20e-9), (90e-9, 80e-9)] {
        if let Scheme::Staggered(scheme) = &mut settings.scheme {
            scheme.initial_step = Quantity(initial);
        }
        assert_close!(first(&settings, &system), due, 1e-15, "in s");
    }
}
