//! The ledger, one channel at a time: an experiment whose energies are known by hand, and every entry held to its number. An
//! entry that is not part of the experiment must be 0, so that nothing is booked twice or under another's name.

use std::f64::consts::PI;

use agglo::constants::VACUUM_PERMITTIVITY;
use agglo::engine::soft::Simulation;
use agglo::math::Vec3;

use crate::common::{self, grain};
use crate::unlike::Unlike;

const DENSITIES: [f64; 2] = [2600.0, 1100.0];

fn unlike(end: f64, step: f64, distance: f64, more: &str) -> Unlike {
    Unlike {
        materials: [
            "density = \"2600 kg/m3\"\nyoungs_modulus = \"1 GPa\"\npoisson_ratio = 0.2\ncontact_stiffness = \"8 MPa\"",
            "density = \"1100 kg/m3\"\nyoungs_modulus = \"0.5 GPa\"\npoisson_ratio = 0.3\ncontact_stiffness = \"4 MPa\"",
        ],
        radii: [1e-3, 2e-3],
        temperatures: [300.0; 2],
        distance,
        end,
        engine: common::verlet(step),
        limits: String::new(),
        more: more.to_owned(),
    }
}

fn masses() -> [f64; 2] {
    [0, 1].map(|k| DENSITIES[k] * 4.0 / 3.0 * PI * [1e-3_f64, 2e-3][k].powi(3))
}

fn reduced_mass() -> f64 {
    let [a, b] = masses();
    a * b / (a + b)
}

/// All entries of the books now [J], by name.
fn entries(simulation: &Simulation) -> [(&'static str, f64); 15] {
    let books = simulation.balance();
    let stored = books.stored;
    [
        ("kinetic", stored.kinetic),
        ("rotational", stored.rotational),
        ("elastic", stored.elastic),
        ("tangential_spring", stored.tangential_spring),
        ("bonds", stored.bonds),
        ("near_field", stored.near_field),
        ("rays", books.rays),
        ("gravity", books.gravity),
        ("fields", books.fields),
        ("drag", books.drag),
        ("damping", books.damping),
        ("friction", books.friction),
        ("bond_damping", books.bond_damping),
        ("broken_bonds", books.broken_bonds),
        ("drift", books.drift),
    ]
}

/// Asserts each entry, to a part of the largest; those that are not named are 0.
#[track_caller]
fn assert_ledger(simulation: &Simulation, wanted: &[(&str, f64)], tolerance: f64) {
    let found = entries(simulation);
    let unknown = wanted.iter().find(|(name, _)| found.iter().all(|(known, _)| known != name));
    assert!(unknown.is_none(), "no such entry: {unknown:?}");
    let size = wanted.iter().map(|(_, energy)| energy.abs()).fold(0.0, f64::max);
    let off = |(name, found): &(&str, f64)| {
        let wanted = wanted.iter().find(|(known, _)| known == name).map_or(0.0, |(_, energy)| *energy);
        // What is not a number is not close.
        let is_close = (found - wanted).abs() <= tolerance * size;
        (!is_close).then(|| format!("{name}: found {found:e} J, expected {wanted:e} J"))
    };
    let faults: Vec<String> = found.iter().filter_map(off).collect();
    assert!(faults.is_empty(), "the books, to {tolerance:e} of {size:e} J:\n{}", faults.join("\n"));
}

/// Simpson's rule with a thousand pieces.
fn integral(from: f64, to: f64, of: impl Fn(f64) -> f64) -> f64 {
    let pieces = 1000;
    let width = (to - from) / f64::from(pieces);
    let at = |k: i32| of(from + width * 0.5 * f64::from(k));
    (0..pieces).map(|k| (at(2 * k) + 4.0 * at(2 * k + 1) + at(2 * k + 2)) * width / 6.0).sum()
}

/// Two grains pressed together let go: ∫ K E^p A dδ becomes motion, less what the bond holds back from its threshold on.
#[test]
fn a_strain_bond() {
    let (overlap, threshold) = (60e-6, 20e-6);
    let laws = format!(
        "[contact.normal.strain_power]\nexponent = 1.5\n[bonds.strain_bond]\nstiffness = \"2 MPa\"\nexponent = 2.0\n\
         tangential_stiffness = \"0 Pa/m\"\nthreshold_strain = {}",
        threshold / 3e-3
    );
    let mut simulation = unlike(8e-3, 1e-6, 3e-3 - overlap, &laws).start(|_| {});
    let area = |overlap: f64| {
        let distance = 3e-3 - overlap;
        let first = (distance * distance + 1e-6 - 4e-6) / (2.0 * distance);
        PI * (1e-6 - first * first)
    };
    let elastic = integral(0.0, overlap, |x| 6e6 * (x / 3e-3).powf(1.5) * area(x));
    let bond = integral(threshold, overlap, |x| 2e6 * (x / 3e-3).powi(2) * area(x));
    // Simpson at the root of the power: 1e-9.
    assert_ledger(&simulation, &[("elastic", elastic), ("bonds", -bond)], 1e-8);
    common::finish(&mut simulation);
    assert!(common::relative_velocity(&simulation).x > 0.0, "grains have not parted");
    // The bond's force jumps at the threshold, in one of some thousand steps.
    assert_ledger(&simulation, &[("kinetic", elastic - bond)], 2e-4);
}

/// Charges that part: q²/(4 π ε d) becomes motion; with a cut-off r_c, all that there was above its value at r_c, and nothing
/// beyond. Masses share it by momentum.
#[test]
fn a_near_field_with_and_without_a_cut_off() {
    for cutoff in [None, Some(6e-3)] {
        let cut = cutoff
            .map_or(String::new(), |cutoff: f64| format!("cutoff = \"{cutoff:e} m\"\ntruncation = 1e9\n"));
        let field = format!("[fields.near_field]\n{cut}law.coulomb.relative_permittivity = 2.0");
        let mut simulation =
            unlike(1.0, 0.2e-6, 3.2e-3, &field).start(|grains| grains.charge = vec![1e-8, 2e-8]);
        let potential = |distance: f64| 2e-16 / (4.0 * PI * VACUUM_PERMITTIVITY * 2.0 * distance);
        let at_cut = cutoff.map_or(0.0, potential);
        let store = |distance: f64| {
            if cutoff.is_some_and(|cutoff| distance > cutoff) { 0.0 } else { potential(distance) - at_cut }
        };
        assert_ledger(&simulation, &[("near_field", store(3.2e-3))], 1e-13);
        let distance =
            |simulation: &Simulation| (grain(simulation, 1).position - grain(simulation, 0).position).norm();
        let mut turns = agglo_testing::Turns::at_most(10_000_000, "the grains to part");
        while distance(&simulation) < 8e-3 {
            turns.take();
            common::steps(&mut simulation, 1);
        }
        let left = store(distance(&simulation));
        // Some 5,000 steps of second order; the force jumps by a quarter at the cut-off, in one of them.
        let tolerance = if cutoff.is_some() { 1e-3 } else { 1e-5 };
        assert_ledger(&simulation, &[("kinetic", store(3.2e-3) - left), ("near_field", left)], tolerance);
        let [a, b] = [0, 1].map(|id| grain(&simulation, id).velocity.x * masses()[id as usize]);
        assert_close!(a, -b, 1e-10, "momentum of the first, kg m/s");
    }
}

/// A grain drawn by a field through a liquid that hardly rubs: v = q E t/(m + m_f/2), and all work is in both masses' motion.
#[test]
fn added_mass() {
    let more = "[medium]\ndensity = \"1500 kg/m3\"\nviscosity = \"1e-12 Pa s\"\n[fields.drag]\nlaw = \"stokes\"\n\
                added_mass = 0.5\n[fields.lorentz]\nelectric_field = [\"1e6 V/m\", \"0 V/m\", \"0 V/m\"]";
    let mut simulation = unlike(2e-3, 2e-6, 1.0, more).start(|grains| grains.charge[0] = 1e-9);
    common::finish(&mut simulation);
    let heavy = masses()[0] + 0.5 * 1500.0 * 4.0 / 3.0 * PI * 1e-9;
    let speed = 1e-3 * 2e-3 / heavy;
    assert_close!(grain(&simulation, 0).velocity.x, speed, 1e-9, "speed, m/s");
    let work = 0.5 * heavy * speed * speed;
    assert_ledger(&simulation, &[("kinetic", work), ("fields", work)], 1e-9);
}

/// A grain that moves and spins comes to rest in a liquid: all that it had is lost to drag, with what moved with it.
#[test]
fn drag() {
    let more = "[medium]\ndensity = \"1500 kg/m3\"\nviscosity = \"20 Pa s\"\n[fields.drag]\nlaw = \"stokes\"\n\
                added_mass = 0.5";
    let mut simulation = unlike(4e-3, 0.5e-6, 1.0, more).start(|grains| {
        grains.velocity[0] = Vec3::new(0.3, -0.4, 0.0);
        grains.angular_velocity[0] = Vec3::new(0.0, 100.0, 50.0);
    });
    let heavy = masses()[0] + 0.5 * 1500.0 * 4.0 / 3.0 * PI * 1e-9;
    let (motion, rotation) = (0.5 * heavy * 0.25, 0.5 * 0.4 * masses()[0] * 1e-6 * 12500.0);
    assert_ledger(&simulation, &[("kinetic", motion), ("rotational", rotation)], 1e-13);
    common::finish(&mut simulation);
    assert_ledger(&simulation, &[("drag", motion + rotation)], 1e-10);
}

/// A fall of both grains: m g h less the weight of the liquid that they displace.
#[test]
fn gravity_and_buoyancy() {
    let more = "[medium]\ndensity = \"900 kg/m3\"\n[fields.gravity]\nacceleration = [\"0 m/s2\", \"0 m/s2\", \"-9.81 m/s2\"]\n\
                buoyancy = true";
    let mut simulation = unlike(0.1, 1e-4, 1.0, more).start(|_| {});
    common::finish(&mut simulation);
    let fall = |k: usize| {
        let pull = 9.81 * (1.0 - 900.0 / DENSITIES[k]);
        masses()[k] * pull * (0.5 * pull * 0.01)
    };
    let work = fall(0) + fall(1);
    assert_ledger(&simulation, &[("kinetic", work), ("gravity", work)], 1e-10);
}

/// Up the gradient of B·B from 0 to z: γ B² = γ (b z)².
#[test]
fn a_magnetic_force() {
    let more = "[fields.magnetic]\nmagnetizability = \"1e-6 J/T2\"\nmagnetic_flux_density = [\"0 T\", \"0 T\", \"1 + 100*z\"]";
    let mut simulation = unlike(0.1, 1e-4, 1.0, more).start(|grains| grains.position[1].z = -0.3);
    common::finish(&mut simulation);
    let work = |id: u32, from: f64| {
        let square = |z: f64| (1.0 + 100.0 * z).powi(2);
        1e-6 * (square(grain(&simulation, id).position.z) - square(from))
    };
    let work = work(0, 0.0) + work(1, -0.3);
    assert_above!(work.abs(), 1e-9, "in J");
    assert_ledger(&simulation, &[("kinetic", work), ("fields", work)], 1e-4);
}

const HOOKE: &str = "[contact.normal.hooke]\nstiffness = \"200 kN/m\"\n";

/// Head-on with a restitution e: (1 - e²) m* v²/2 is lost in the dashpot and nowhere else.
#[test]
fn contact_damping() {
    let laws = format!("{HOOKE}[contact.damping.restitution]\nrestitution = 0.5");
    let mut simulation = unlike(0.1e-3, 0.01e-6, 3.001e-3, &laws).start(|grains| {
        grains.velocity = vec![Vec3::AXES[0] * 0.7, Vec3::AXES[0] * -0.3];
    });
    let [a, b] = masses();
    let at_start = 0.5 * (a * 0.49 + b * 0.09);
    assert_ledger(&simulation, &[("kinetic", at_start)], 1e-13);
    common::finish(&mut simulation);
    let lost = 0.75 * 0.5 * reduced_mass();
    assert_ledger(&simulation, &[("kinetic", at_start - lost), ("damping", lost)], 1e-3);
}

/// A slanted impact that slides all the time, since the spring across rises faster than its limit: J = 2 m* v_n, and
/// μ J u - (μ J)²/(2 (2/7) m*) is lost to friction.
#[test]
fn friction() {
    let laws = format!(
        "{HOOKE}[contact.friction.mindlin]\nstatic_friction = 0.1\ndynamic_friction = 0.1\nstiffness_ratio = 0.8"
    );
    let mut simulation = unlike(0.1e-3, 0.01e-6, 3.0e-3 + 1e-9, &laws).start(|grains| {
        grains.velocity = vec![Vec3::new(0.7, 0.4, 0.0), Vec3::new(-0.3, -0.6, 0.0)];
    });
    let [a, b] = masses();
    let at_start = 0.5 * (a * 0.65 + b * 0.45);
    common::finish(&mut simulation);
    let across = 0.1 * 2.0 * reduced_mass();
    let lost = across - across * across / (2.0 * 2.0 / 7.0 * reduced_mass());
    // Angular velocity of each: μ J R/I.
    let rotation: f64 = [0, 1]
        .map(|k| {
            let radius = [1e-3, 2e-3][k];
            let inertia = 0.4 * masses()[k] * radius * radius;
            0.5 * (across * radius).powi(2) / inertia
        })
        .iter()
        .sum();
    // The overlap of 2e-3 of the radii shortens the lever arms.
    assert_ledger(
        &simulation,
        &[("kinetic", at_start - lost - rotation), ("rotational", rotation), ("friction", lost)],
        5e-3,
    );
}

const BEAM: &str =
    "[bonds.beam]\nyoungs_modulus = \"1 GPa\"\nradius_ratio = 0.5\nshear_strength = \"1 GPa\"\n";

/// A bonded pair that parts rings down: the energy of its relative motion is lost in the bond's dashpot.
#[test]
fn bond_damping() {
    let laws = format!("{BEAM}tensile_strength = \"10 GPa\"\ndamping_ratio = 0.1");
    let mut simulation = unlike(3e-3, 0.05e-6, 3e-3, &laws).start(|grains| {
        grains.velocity = vec![Vec3::AXES[0] * -1e-2, Vec3::AXES[0] * 3e-2];
    });
    common::finish(&mut simulation);
    let [a, b] = masses();
    let mean = (a * -1e-2 + b * 3e-2) / (a + b);
    let lost = 0.5 * reduced_mass() * 16e-4;
    let left = 0.5 * (a + b) * mean * mean;
    // 2e-4: the dashpot's power is that of full-step velocities, first order at the start.
    assert_ledger(&simulation, &[("kinetic", left), ("bond_damping", lost)], 2e-4);
}

/// A bonded pair is torn apart: at σ A the bond held (σ A)²/(2 k), which is lost with it.
#[test]
fn broken_bonds() {
    let laws = format!("{BEAM}tensile_strength = \"1 MPa\"");
    let mut simulation = unlike(0.2e-3, 2e-9, 3e-3, &laws).start(|grains| {
        grains.velocity = vec![Vec3::AXES[0] * -0.6, Vec3::AXES[0] * 0.4];
    });
    let [a, b] = masses();
    let at_start = 0.5 * (a * 0.36 + b * 0.16);
    common::finish(&mut simulation);
    let area = PI * 0.25e-6;
    let lost = (1e6 * area).powi(2) / (2.0 * 1e9 / 3e-3 * area);
    assert_eq!(simulation.events.len(), 1, "one bond broke");
    // It breaks at the end of the step in which it is overloaded, 5 nm of 3 um: 1e-3 of a small part of the energy.
    assert_close!(simulation.balance().broken_bonds, lost, 3e-3, "lost with the bond, J");
    assert_close!(
        simulation.events[0].energy,
        simulation.balance().broken_bonds,
        1e-13,
        "the event's energy, J"
    );
    assert_ledger(&simulation, &[("kinetic", at_start - lost), ("broken_bonds", lost)], 1e-4);
}

/// A pair cemented under pressure comes to rest where Hertz's repulsion is the cement's tension, F(δ) = k (δ_0 - δ), and then
/// gets its velocities: the books open with these three energies and stay.
#[test]
fn a_relaxed_start() {
    let (pressed, reach) = (20e-6, 3e-3);
    let laws = "[contact.normal.hertz]\n[bonds.beam]\nyoungs_modulus = \"1 GPa\"\nradius_ratio = 0.5\n\
                tensile_strength = \"10 GPa\"\nshear_strength = \"10 GPa\"\n[start.relax]\nspeed = \"1 um/s\"\nlongest = \"1 s\"\n\
                damping_time = \"10 us\"";
    let mut simulation = unlike(2e-3, 0.5e-6, reach - pressed, laws).start(|grains| {
        grains.velocity = vec![Vec3::AXES[1] * 0.02; 2];
    });
    let modulus = 1.0 / (0.96 / 1e9 + 0.91 / 0.5e9);
    let root = (2e-3_f64 / 3.0).sqrt();
    let stiffness = 1e9 / (reach - pressed) * PI * 0.25e-6;
    let surplus =
        |overlap: f64| 4.0 / 3.0 * root * modulus * overlap.powf(1.5) - stiffness * (pressed - overlap);
    let (mut low, mut high) = (0.0, pressed);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if surplus(middle) < 0.0 { low = middle } else { high = middle }
    }
    let elastic = 8.0 / 15.0 * root * modulus * low.powf(2.5);
    let bonds = 0.5 * stiffness * (pressed - low).powi(2);
    let [a, b] = masses();
    let kinetic = 0.5 * (a + b) * 4e-4;
    let wanted = [("kinetic", kinetic), ("elastic", elastic), ("bonds", bonds)];
    // Rest to 1 um/s of 3 m/s that its energy would make.
    assert_ledger(&simulation, &wanted, 1e-5);
    assert_close!(
        simulation.balance().mechanical_at_start,
        kinetic + elastic + bonds,
        1e-5,
        "energy at the start, J"
    );
    common::finish(&mut simulation);
    assert_ledger(&simulation, &wanted, 1e-5);
}
