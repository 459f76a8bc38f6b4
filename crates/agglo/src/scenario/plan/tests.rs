use super::*;
use crate::scenario::templates::TEMPLATES;

fn plan_of(text: &str) -> Plan {
    Plan::new(&Scenario::from_toml(text).unwrap(), Path::new(""))
}

fn template(name: &str) -> &'static str {
    TEMPLATES.iter().find(|template| template.name == name).unwrap().text
}

/// The sample problem, worked out by hand: 2000 grains, four pulses of 10,000 rays, 150 MPa <-> 4.7e10 W.
#[test]
fn the_sample_problem() {
    let plan = plan_of(template("acoustic"));
    assert_eq!((plan.grains, plan.rays_per_pulse, plan.pulses), (2000, 10_000, 4));
    // 2 s / 0.25 ms = 8000 steps, and flights of 4 x 2 m in steps of 5 mm, four times.
    assert_eq!(plan.steps, 8000.0 + 4.0 * 1600.0);
    assert!((plan.memory - (2000.0 * 1000.0 + 10_000.0 * 120.0)).abs() < 1.0);
    let page = plan.to_string();
    // p = sqrt(7.06e13 W x 1.5e6 / pi m²) = 5.806 GPa.
    assert!(page.contains("5.806 GPa"), "{page}");
    for law in ["regularised", "strain_bond", "published_step", "stokes"] {
        assert!(plan.notes.iter().any(|note| note.contains(law)), "{law} in\n{page}");
    }
}

/// F = sqrt(I (1-R) rho c a) with R = (17/19)² = 0.80055, by hand: sqrt(4.712e6 x 0.19945 x 2.7e7 x 3.1416e-4).
#[test]
fn the_force_of_a_ray() {
    let scenario = Scenario::from_toml(template("acoustic-sound")).unwrap();
    let push = &push::all(&scenario)[0];
    assert!((push.power / 4.712_389e10 - 1.0).abs() < 1e-6);
    let by_hand = (4.712_389e6_f64 * (1.0 - 289.0 / 361.0) * 2.7e7 * 3.141_593e-4).sqrt();
    assert!((push.force / by_hand - 1.0).abs() < 1e-6, "{}", push.force);
    // 10,000 rays x (0.05 m / 1 m)² = 25 hits.
    assert!((push.hits - 25.0).abs() < 1e-9);
    let mass = 6000.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.05_f64.powi(3);
    assert!((push.per_hit / (by_hand * 1e-5 / mass) - 1.0).abs() < 1e-6);
    assert!((push.speed[0] / (5.0 * push.per_hit) - 1.0).abs() < 1e-9);
}

/// Overlap of a Hertz impact against the energy balance m* v²/2 = (8/15) E* sqrt(R*) delta^(5/2).
#[test]
fn the_overlap_of_an_impact() {
    let scenario = Scenario::from_toml(template("acoustic-sound")).unwrap();
    let push = &push::all(&scenario)[0];
    let mass = 6000.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.05_f64.powi(3);
    let overlap = push.strain.unwrap() * 0.1;
    let stored = 8.0 / 15.0 * (0.5e9 / (1.0 - 0.0625)) * 0.025_f64.sqrt() * overlap.powf(2.5);
    assert!((stored / (0.25 * mass * push.speed[0].powi(2)) - 1.0).abs() < 1e-9);
}

#[test]
fn low_frequencies_are_noted() {
    let audible = template("microscale").replace("250 MHz", "20 kHz");
    let plan = plan_of(&audible);
    // The radius of mean volume of the uncut lognormal is 20 um exp(1.5 s²) = 22.176 um, s = ln 1.3. The cuts lie at
    // ±y, y = ln 2/s = 2.6419; between them the mean cube is that of the uncut one times
    // (Φ(y - 3s) - Φ(-y - 3s))/(Φ(y) - Φ(-y)) = 0.96788/0.99176, so the radius is 21.996 um and
    // k a = 2 pi 2e4 Hz x 21.996 um / 1500 m/s = 0.0018427.
    assert!(plan.notes.iter().any(|note| note.contains("k a = 0.001843")), "{:?}", plan.notes);
    assert!(!plan_of(template("microscale")).notes.iter().any(|note| note.contains("k a")));
    let silent = template("microscale").replace("frequency = \"250 MHz\"", "");
    assert!(plan_of(&silent).notes.iter().any(|note| note.contains("no frequency")));
}

/// The plan counts the grains that are placed, cuts of a lognormal included: 0.25 (300 um)³/(21.996 um)³ = 634.
#[test]
fn the_plan_counts_what_is_placed() {
    let scenario = Scenario::from_toml(template("microscale")).unwrap();
    let placed = crate::packing::place(&scenario, Path::new("")).unwrap().len() as u64;
    assert_eq!((Plan::new(&scenario, Path::new("")).grains, placed), (634, 634));
}

#[test]
fn lattices_are_counted() {
    let text = include_str!("../../../tests/scenario/good/a_single_grain.toml").replace(
        "placement.list.positions = [[\"0 m\", \"0 m\", \"0 m\"]]",
        "placement.lattice = { kind = \"cubic\", spacing = \"80 um\", region.box = { lower = [\"0 m\", \"0 m\", \"0 m\"], upper = [\"0.88 mm\", \"0.88 mm\", \"0.88 mm\"] } }",
    );
    // Centres fill a cube of 0.8 mm: ten spacings along each edge.
    assert_eq!(plan_of(&text).grains, 1000);
}

#[test]
fn a_beam_that_misses_is_noted() {
    let misses = |text: &str| plan_of(text).notes.iter().any(|note| note.contains("misses all grains"));
    let text = template("microscale");
    assert!(!misses(text));
    assert!(misses(&text.replace("direction = [1.0, 0.0, 0.0]", "direction = [-1.0, 0.0, 0.0]")));
    // Grains reach to 0.3 mm and the beam is as wide: it misses them from 0.6 mm on.
    assert!(misses(&text.replace("\"-0.33 mm\", \"0 mm\"", "\"-0.33 mm\", \"0.61 mm\"")));
    assert!(!misses(&text.replace("\"-0.33 mm\", \"0 mm\"", "\"-0.33 mm\", \"0.59 mm\"")));
}

#[test]
fn a_plan_says_what_has_no_effect() {
    let text = template("acoustic").replace("end = \"2 s\"", "end = \"0.6 s\"");
    let notes = plan_of(&text).notes;
    assert!(notes.iter().any(|note| note.contains("only 2 of 4 pulses")), "{notes:?}");
}
