//! The contracts where space repeats itself and is pressed together: grains cross faces while they touch, are bonded and attract.

use agglo::engine::soft::Simulation;
use rayon::ThreadPoolBuilder;

use crate::{common, crowd};

/// A crowd in a box two of whose axes have periodic faces, or all three.
fn text(engine: &str, count: u32, faces: &str) -> String {
    let edge = 20e-6 * (4.2 * f64::from(count) / 0.16).cbrt();
    format!(
        r#"
version = 1
seed = 7
time.end = "1 s"
{engine}
[limits]
strain = 0.4
[volume]
lower = ["0 m", "0 m", "0 m"]
upper = ["{edge:e} m", "{edge:e} m", "{edge:e} m"]
{faces}
deformation = {{ strain_rate = ["-2e4 1/s", "-1e4 1/s", "0 1/s"] }}
[materials.pigment]
density = "4000 kg/m3"
youngs_modulus = "1 GPa"
poisson_ratio = 0.25
[[grains]]
material = "pigment"
size.uniform = {{ smallest = "12 um", largest = "24 um" }}
placement.fill.count = {count}
velocity_spread.maxwell.deviation = "1.5 m/s"
[contact.normal.hertz]
[contact.damping.restitution]
restitution = 0.5
[contact.friction.mindlin]
static_friction = 0.4
dynamic_friction = 0.3
[bonds.beam]
youngs_modulus = "100 MPa"
tensile_strength = "2 MPa"
shear_strength = "2 MPa"
radius_ratio = 0.5
gap = 0.1
forming_strain = 0.01
damping_ratio = 0.05
[fields.near_field]
cutoff = "60 um"
truncation = 10.0
law.van_der_waals = {{ hamaker = "1e-16 J", smallest_gap = "40 nm" }}
"#
    )
}

const ALL: &str = "boundary = \"periodic\"";
const TWO: &str = "faces.z = \"open\"";

/// Everything that a contract is to be tested with has happened.
fn assert_busy(simulation: &Simulation) {
    let system = &simulation.system;
    let across = |a: u32, b: u32| {
        let between = system.grains.position[a as usize] - system.grains.position[b as usize];
        system.space.shortest(between) != between
    };
    let contacts = system.remembered();
    assert_above!(contacts.iter().filter(|(a, b, _)| across(*a, *b)).count(), 0, "contacts across faces");
    let bonds = system.network.bonds();
    assert_above!(
        bonds.iter().filter(|bond| across(bond.grains[0], bond.grains[1])).count(),
        0,
        "bonds across faces"
    );
    assert_above!(system.images.iter().filter(|image| **image != [0; 3]).count(), 0, "grains that went out");
    assert_above!(
        simulation.events.iter().filter(|event| event.broke.is_some()).count(),
        0,
        "bonds that broke"
    );
}

fn started(text: &str) -> Simulation {
    common::start(text, |_| {})
}

#[test]
fn same_bits_on_1_2_3_and_7_threads() {
    for (engine, faces) in [(crowd::VERLET, ALL), (crowd::ADAPTIVE, TWO)] {
        let after = |threads: usize| {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut simulation = started(&text(engine, 1300, faces));
                common::steps(&mut simulation, 400);
                assert_busy(&simulation);
                common::bytes(&simulation)
            })
        };
        let alone = after(1);
        for threads in [2, 3, 7] {
            let when = format!("{threads} threads and one, {engine}");
            common::assert_same_state(&after(threads), &alone, &when);
        }
    }
}

/// Also over the sorting after 2,000 steps.
#[test]
fn a_run_goes_on_with_the_same_bits() {
    for (engine, faces) in [(crowd::VERLET, TWO), (crowd::ADAPTIVE, ALL)] {
        let text = text(engine, 80, faces);
        let mut whole = started(&text);
        common::steps(&mut whole, 1985);
        assert_busy(&whole);
        let scenario = common::scenario(&text);
        let mut resumed = Simulation::resume(&scenario, common::written_and_read(&whole)).unwrap();
        for step in 0..30 {
            common::steps(&mut whole, 1);
            common::steps(&mut resumed, 1);
            let when = format!("resumed, after {} steps", step + 1);
            common::assert_same_state(&common::bytes(&resumed), &common::bytes(&whole), &when);
        }
    }
}
