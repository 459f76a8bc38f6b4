//! The contracts where space repeats itself and is pressed together: grains cross faces while they touch, are bonded and attract, are
//! turned back, and leave.

use agglo::engine::soft::Simulation;
use agglo::math::Vec3;
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

const ALL: &str =
    "boundary = \"periodic\"\ndeformation = { strain_rate = [\"-2e4 1/s\", \"-1e4 1/s\", \"0 1/s\"] }";
const TWO: &str =
    "faces.z = \"open\"\ndeformation = { strain_rate = [\"-2e4 1/s\", \"-1e4 1/s\", \"0 1/s\"] }";
const ENDS: &str = "faces = { x = \"periodic\", y = \"reflecting\", z = \"absorbing\" }";

/// Everything that a contract is to be tested with has happened.
fn assert_busy(simulation: &Simulation) {
    let system = &simulation.system;
    let across = |a: u32, b: u32| {
        let between = system.grains.position[a as usize] - system.grains.position[b as usize];
        system.space.shortest(between) != between
    };
    let ends = simulation.absorbed();
    let contacts = system.remembered();
    assert_above!(
        contacts.iter().filter(|(a, b, _)| ends.is_some() || across(*a, *b)).count(),
        0,
        "contacts"
    );
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
    if let Some(absorbed) = ends {
        assert_above!(absorbed.grains, 0, "grains that left");
        assert_true!(simulation.ledger.flows.supplies.walls.force.y != 0.0, "no grain was turned back");
    }
}

/// All grains are carried along at so much [m/s].
fn started(text: &str, carried: Vec3) -> Simulation {
    common::start(text, |grains| grains.velocity.iter_mut().for_each(|velocity| *velocity += carried))
}

#[test]
fn same_bits_on_1_2_3_and_7_threads() {
    for (engine, faces) in [(crowd::VERLET, ALL), (crowd::ADAPTIVE, TWO), (crowd::VERLET, ENDS)] {
        let after = |threads: usize| {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let up = if faces == ENDS { Vec3::AXES[2] * 40.0 } else { Vec3::ZERO };
                let mut simulation = started(&text(engine, 1300, faces), up);
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
    for (engine, count, faces) in
        [(crowd::VERLET, 80, TWO), (crowd::ADAPTIVE, 80, ALL), (crowd::ADAPTIVE, 300, ENDS)]
    {
        let text = text(engine, count, faces);
        let mut whole = started(&text, Vec3::ZERO);
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
