//! Space that repeats itself: grains go on across its faces as they would in open space.

use super::simulation::Simulation;
use crate::engine::SimError;
use crate::math::Vec3;
use crate::math::rng::{Purpose, Stream};
use crate::testing::{Scenario, place};

const CUBE: &str =
    "[volume]\nlower = [\"-80 um\", \"-80 um\", \"-80 um\"]\nupper = [\"80 um\", \"80 um\", \"80 um\"]\n";
const OPEN_ABOVE: &str = "[volume]\nlower = [\"-80 um\", \"-80 um\", \"-80 um\"]\nupper = [\"80 um\", \"80 um\", \"80 um\"]\n\
                          faces.z = \"open\"\n";
const VERLET: &str = "[engine.verlet]\nstep = \"4 ns\"\n";
const STAGGERED: &str =
    "[engine.staggered]\ninitial_step = \"4 ns\"\nlargest_step = \"4 ns\"\ntolerance = 1e-13\n";
const BONDS: &str = "[bonds.beam]\nyoungs_modulus = \"20 MPa\"\ntensile_strength = \"1 GPa\"\nshear_strength = \"1 GPa\"\n\
                     gap = 0.3\nradius_ratio = 0.4\ndamping_ratio = 0.02\n";
const ATTRACTION: &str = "[fields.near_field]\ncutoff = \"50 um\"\ntruncation = 10.0\n\
                          law.van_der_waals = { hamaker = \"1e-16 J\", smallest_gap = \"40 nm\" }\n";
const DRIFT: Vec3 = Vec3::new(2.0, -1.4, 0.9);

/// A heap of 60 grains that fall in on one another, spin, and fly off together.
fn heap(more: &str) -> Simulation {
    started(more).unwrap()
}

fn started(more: &str) -> Result<Simulation, SimError> {
    let text = format!(
        r#"
version = 1
seed = 3
time.end = "1 s"
[materials.pigment]
density = "4000 kg/m3"
contact_stiffness = "1 GPa"
[[grains]]
material = "pigment"
size.uniform = {{ smallest = "6 um", largest = "11 um" }}
placement.random = {{ count = 60, region.sphere.radius = "60 um" }}
[contact.normal.strain_power]
exponent = 1.5
[contact.damping.restitution]
restitution = 0.7
[contact.friction.mindlin]
static_friction = 0.4
stiffness_ratio = 0.8
[limits]
strain = 0.2
{more}
"#
    );
    let scenario = Scenario::from_toml(&text).unwrap_or_else(|faults| panic!("{faults}"));
    let mut grains = place(&scenario).unwrap();
    let mut stream = Stream::new(11, Purpose::Sampling, 0);
    for at in 0..grains.len() {
        grains.velocity[at] = grains.position[at] * -1e4 + stream.direction() * 0.1 + DRIFT;
        grains.angular_velocity[at] = Vec3::new(stream.normal(), stream.normal(), stream.normal()) * 1e4;
    }
    Simulation::start(&scenario, grains)
}

/// Places [n] [m] by id, put together from where grains are inside and how often they went through faces.
fn traveled(simulation: &Simulation) -> Vec<Vec3> {
    let system = &simulation.system;
    let periods = system.space.periods();
    let mut places = vec![Vec3::ZERO; system.grains.len()];
    for (at, &id) in system.grains.id.iter().enumerate() {
        let [x, y, z] = system.images.get(at).copied().unwrap_or_default().map(f64::from);
        places[id as usize] =
            system.grains.position[at] + Vec3::new(x * periods.x, y * periods.y, z * periods.z);
    }
    places
}

/// Contacts of grains that lie on two sides of a face.
fn contacts_across(simulation: &Simulation) -> usize {
    let (system, places) = (&simulation.system, &simulation.system.grains.position);
    let is_across = |a: u32, b: u32| {
        let between = places[a as usize] - places[b as usize];
        system.space.shortest(between) != between
    };
    system.remembered().iter().filter(|(a, b, _)| is_across(*a, *b)).count()
}

/// Over 60 us the heap flies 120 um and more along x, so that all of it goes through a face while it collides; nothing else is near
/// enough to be met. What differs from open space is rounding, 1e-16 of 80 um, that collisions of some 60 grains multiply.
#[test]
fn grains_go_on_across_faces_as_in_open_space() {
    for laws in
        [VERLET.to_owned(), STAGGERED.to_owned(), format!("{VERLET}{BONDS}"), format!("{VERLET}{ATTRACTION}")]
    {
        for volume in [CUBE, OPEN_ABOVE] {
            let (mut open, mut repeating) = (heap(&laws), heap(&format!("{laws}{volume}")));
            let mut across = 0;
            for simulation in [&mut open, &mut repeating] {
                simulation.sort_every = 700;
                while simulation.clock().time < 60e-6 {
                    simulation.advance(60e-6).unwrap();
                    across = across.max(contacts_across(simulation));
                }
            }
            assert_above!(across, 2, "contacts through faces at one time");
            assert_all!(repeating.system.grains.position.iter(), |place| repeating
                .system
                .space
                .home(*place)
                .0
                == *place);
            let out = repeating.system.images.iter().filter(|image| image[0] == 1).count();
            assert_above!(out, 50, "grains of 60 went out along x");
            assert_eq!(repeating.system.images.iter().all(|image| image[2] == 0), volume == OPEN_ABOVE);
            for (found, wanted) in traveled(&repeating).into_iter().zip(traveled(&open)) {
                assert_near_vector!(found, wanted, 1e-12, "m, {laws}{volume}");
            }
            let [energy, wanted] =
                [&repeating, &open].map(|simulation| simulation.balance().stored.mechanical());
            assert_close!(energy, wanted, 1e-7, "J, {laws}{volume}");
        }
    }
}

/// A gas in a box so small that grains meet across all faces: momentum to rounding, energy to the order of the step.
#[test]
fn a_gas_in_a_small_box_keeps_its_books() {
    let at = |step: &str| {
        let narrow = "[volume]\nlower = [\"-62 um\", \"-62 um\", \"-62 um\"]\nupper = [\"62 um\", \"62 um\", \"62 um\"]\n";
        let mut gas = heap(&format!("{narrow}[engine.verlet]\nstep = \"{step}\"\n"));
        while gas.clock().time < 40e-6 {
            gas.advance(40e-6).unwrap();
        }
        assert_below!(gas.momentum_drift_relative(), 1e-13);
        assert_above!(gas.system.images.iter().filter(|image| **image != [0; 3]).count(), 40);
        gas.balance().drift_relative.abs()
    };
    let (coarse, fine) = (at("4 ns"), at("2 ns"));
    assert_below!(coarse, 1e-3);
    assert_below!(
        fine,
        0.5 * coarse,
        "half the step leaves a quarter, for contacts that begin anywhere in a step less of it"
    );
}

/// All of a list in one text.
fn joined(parts: impl Iterator<Item = String>) -> String {
    parts.collect::<Vec<String>>().concat()
}

/// A ring of N grains on springs k that closes through a face: the mode of wave number j has ω² = 4 k/m sin²(π j/N). Grains are
/// pressed together by 1e-3 of their diameter and swing by 1e-7 of it, so that all contacts stay closed and the law is linear; after
/// a period in 2,000 steps Verlet's own error of the frequency is (ω Δt)²/24, 4e-7, which shifts the phase by 3e-6.
#[test]
fn a_ring_of_springs_swings_as_by_hand() {
    const N: u32 = 12;
    let (radius, stiffness) = (1e-3, 1e4);
    let spacing = 2.0 * radius * (1.0 - 1e-3);
    let mass = 2500.0 * 4.0 / 3.0 * std::f64::consts::PI * radius * radius * radius;
    for wave in [1, 5] {
        let phase = std::f64::consts::PI * f64::from(wave) / f64::from(N);
        let omega = (4.0 * stiffness / mass).sqrt() * phase.sin();
        let period = std::f64::consts::TAU / omega;
        let text = format!(
            "version = 1\ntime.end = \"1 s\"\nengine.verlet.step = \"{step:e} s\"\nmaterials.glass.density = \"2500 kg/m3\"\n\
             [volume]\nlower = [\"0 m\", \"-1 m\", \"-1 m\"]\nupper = [\"{edge:e} m\", \"1 m\", \"1 m\"]\n\
             [contact.normal.hooke]\nstiffness = \"{stiffness} N/m\"\n[[grains]]\nmaterial = \"glass\"\n\
             size.constant.radius = \"1 mm\"\nplacement.list.positions = [{places}]\n",
            step = period / 2000.0,
            edge = spacing * f64::from(N),
            places =
                joined((0..N).map(|k| format!("[\"{:e} m\", \"0 m\", \"0 m\"],", spacing * f64::from(k)))),
        );
        let scenario = Scenario::from_toml(&text).unwrap_or_else(|faults| panic!("{faults}"));
        let mut grains = place(&scenario).unwrap();
        let swing = |k: u32| 1e-7 * radius * (2.0 * phase * f64::from(k)).cos();
        for k in 0..N {
            grains.position[k as usize].x += swing(k);
        }
        let mut ring = Simulation::start(&scenario, grains).unwrap();
        for quarter in 1..=4 {
            for _ in 0..500 {
                ring.step().unwrap();
            }
            let due = (std::f64::consts::FRAC_PI_2 * f64::from(quarter)).cos();
            for (k, found) in (0..).zip(traveled(&ring)) {
                let moved = found.x - spacing * f64::from(k);
                assert_near!(moved, due * swing(k), 2e-5 * 1e-7 * radius, "m, grain {k}, mode {wave}");
            }
        }
    }
}

/// Half a period must be above a diameter.
#[test]
fn space_too_narrow_is_refused() {
    let text = |edge: f64| {
        format!(
            "version = 1\ntime.end = \"1 s\"\n[engine.verlet]\n[materials.glass]\ndensity = \"2500 kg/m3\"\n[volume]\n\
             lower = [\"0 m\", \"0 m\", \"0 m\"]\nupper = [\"1 m\", \"{edge} m\", \"1 m\"]\n[[grains]]\nmaterial = \"glass\"\n\
             size.constant.radius = \"1 cm\"\nplacement.list.positions = [[\"0 m\", \"1 mm\", \"0 m\"]]\n"
        )
    };
    let start = |edge: f64| {
        let scenario = Scenario::from_toml(&text(edge)).unwrap();
        Simulation::start(&scenario, place(&scenario).unwrap()).map(|_| ())
    };
    assert_ok!(start(0.041));
    let SimError::NarrowSpace { period, reach } = start(0.039).unwrap_err() else { panic!("another error") };
    assert_eq!((period, reach), (0.039, 0.02));
}

/// 60 grains fill 3.7 % of the cube: pressed together it never comes to 2 %, drawn out never to 10 %; and nothing presses where space
/// is open.
#[test]
fn a_deformation_that_leads_nowhere_is_refused() {
    let refused = |rates: [i32; 3], more: &str| {
        let [x, y, z] = rates.map(|rate| format!("\"{rate} 1/s\""));
        let text = format!("{VERLET}{CUBE}{more}deformation.strain_rate = [{x}, {y}, {z}]\n");
        started(&text).unwrap_err().to_string()
    };
    let fraction = |wanted: f64| format!("deformation.solid_fraction = {wanted}\n");
    for (rates, wanted) in [([-1; 3], 0.02), ([1; 3], 0.1), ([1, 1, -2], 0.1)] {
        assert_contains!(refused(rates, &fraction(wanted)), "leads away from solid_fraction");
    }
    assert_contains!(refused([-1; 3], "faces.z = \"open\"\n"), "along z");
}

/// A simple cubic crystal of N grains, pressed together evenly: by symmetry no grain leaves its place in it, each of the 3 N contacts
/// holds k δ²/2 with δ = 2 R - d exp(e t), and a dashpot c takes c (e d)² of power. All work comes from the volume, entered by the
/// trapezoid rule over 2,000 steps: to Δt²/12 of the change of its slope, 1e-9 of the work.
#[test]
fn a_crystal_is_pressed_as_by_hand() {
    const ACROSS: u32 = 5;
    let (radius, spacing, stiffness, dashpot) = (1.001e-3, 2e-3, 1e4, 0.4);
    let (rate, end) = (-2.0_f64, 5e-3_f64);
    let edge = spacing * f64::from(ACROSS);
    let at = |k: u32| {
        let [x, y, z] = [k % ACROSS, k / ACROSS % ACROSS, k / ACROSS / ACROSS];
        let [x, y, z] = [x, y, z].map(|along| spacing * (f64::from(along) + 0.5));
        format!("[\"{x:e} m\", \"{y:e} m\", \"{z:e} m\"],")
    };
    let text = format!(
        "version = 1\ntime.end = \"{end} s\"\nengine.verlet.step = \"2.5 us\"\nmaterials.glass.density = \"2500 kg/m3\"\n\
         [volume]\nlower = [\"0 m\", \"0 m\", \"0 m\"]\nupper = [\"{edge:e} m\", \"{edge:e} m\", \"{edge:e} m\"]\n\
         deformation.strain_rate = [\"{rate} 1/s\", \"{rate} 1/s\", \"{rate} 1/s\"]\n\
         [contact.custom]\nforce = \"{stiffness}*overlap + {dashpot}*speed\"\n[[grains]]\nmaterial = \"glass\"\n\
         size.constant.radius = \"{radius} m\"\n\
         placement.list.positions = [{}]\n",
        joined((0..ACROSS.pow(3)).map(at))
    );
    let scenario = Scenario::from_toml(&text).unwrap_or_else(|faults| panic!("{faults}"));
    let grains = place(&scenario).unwrap();
    let mut crystal = Simulation::start(&scenario, grains).unwrap();
    while !crystal.is_finished() {
        crystal.step().unwrap();
    }
    let factor = (rate * end).exp();
    let contacts = f64::from(3 * ACROSS.pow(3));
    let elastic = |distance: f64| contacts * 0.5 * stiffness * (2.0 * radius - distance).powi(2);
    let (before, after) = (elastic(spacing), elastic(spacing * factor));
    // Of d exp(e t) the integral of (e d)² exp(2 e t) is e d² (exp(2 e t) - 1)/2.
    let lost = contacts * dashpot * rate * 0.5 * spacing * spacing * (factor * factor - 1.0);
    let balance = crystal.balance();
    assert_close!(crystal.system.space.periods().x, edge * factor, 1e-14, "m");
    assert_close!(balance.stored.elastic, after, 1e-9, "J");
    assert_close!(balance.damping, lost, 1e-9, "J");
    assert_close!(balance.strained, after - before + lost, 2e-9, "J");
    assert_below!(balance.stored.kinetic, 1e-20 * after);
}

/// Everything at once in a box that is pressed together along two axes and drawn out along the third, until it is as full as it is
/// to be: what the ledger does not explain falls with the square of the step.
#[test]
fn the_work_of_a_volume_stands_in_the_ledger() {
    let narrow = "[volume]\nlower = [\"-64 um\", \"-64 um\", \"-64 um\"]\nupper = [\"64 um\", \"64 um\", \"64 um\"]\n\
                  deformation = { strain_rate = [\"-4e4 1/s\", \"-3e4 1/s\", \"1e4 1/s\"], solid_fraction = 0.3 }\n";
    let attraction = ATTRACTION.replace("50 um", "25 um");
    for laws in ["", BONDS, &attraction] {
        let at = |step: &str| {
            let mut heap = heap(&format!("{laws}{narrow}[engine.verlet]\nstep = \"{step}\"\n"));
            while heap.clock().time < 30e-6 {
                heap.advance(30e-6).unwrap();
            }
            assert_below!(heap.momentum_drift_relative(), 1e-12);
            let balance = heap.balance();
            assert_above!(balance.strained.abs(), 0.01 * balance.stored.mechanical().abs(), "J, {laws}");
            let grains = &heap.system.grains;
            let solid: f64 =
                grains.radius.iter().map(|radius| 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3)).sum();
            let Vec3 { x, y, z } = heap.system.space.periods();
            assert_close!(solid / (x * y * z), 0.3, 1e-12, "it stopped there");
            balance.drift / balance.strained
        };
        let (coarse, fine) = (at("8 ns").abs(), at("2 ns").abs());
        assert_below!(coarse, 5e-3, "{laws}");
        assert_below!(fine, 0.2 * coarse, "a quarter of the step leaves a sixteenth, {laws}");
    }
}

/// Two grains that touch askew, through a face, and are bonded: what they slip as space is drawn out loads springs of contact and bond
/// as the same motion does in open space. Forces move the grains by less than 1e-4 of that way, and of squares of the strain, 1e-4,
/// as much is left.
#[test]
fn springs_see_the_flow_of_space() {
    let (rate, end) = (1.0, 1e-4);
    let text = |more: &str| {
        format!(
            "version = 1\ntime.end = \"{end} s\"\nengine.verlet.step = \"1 us\"\nmaterials.glass.density = \"2500 kg/m3\"\n\
             [contact.normal.hooke]\nstiffness = \"1e-3 N/m\"\n\
             [contact.friction.mindlin]\nstatic_friction = 0.5\nstiffness_ratio = 0.8\n\
             [bonds.beam]\nyoungs_modulus = \"1 Pa\"\ntensile_strength = \"1 GPa\"\nshear_strength = \"1 GPa\"\n\
             radius_ratio = 0.5\ngap = 0.3\n[[grains]]\nmaterial = \"glass\"\nsize.constant.radius = \"1 mm\"\n{more}"
        )
    };
    let apart = (2e-3 - 1e-6) / 2.0_f64.sqrt();
    let started = |more: &str, speed: f64| {
        let scenario = Scenario::from_toml(&text(more)).unwrap_or_else(|faults| panic!("{faults}"));
        let mut grains = place(&scenario).unwrap();
        grains.velocity[1].x = speed;
        let mut pair = Simulation::start(&scenario, grains).unwrap();
        while !pair.is_finished() {
            pair.step().unwrap();
        }
        // On the grain of the lower name, whoever owns the contact.
        let (owner, _, spring) = pair.system.remembered()[0];
        let sign = if pair.system.grains.id[owner as usize] == 0 { 1.0 } else { -1.0 };
        (spring.force * sign, pair.system.network.bonds()[0].state.shear)
    };
    let (right, up) = (9.5e-3 + apart, 5e-3 + apart);
    let list = |x: f64| {
        format!(
            "placement.list.positions = [[\"9.5 mm\", \"5 mm\", \"5 mm\"], [\"{x:e} m\", \"{up:e} m\", \"5 mm\"]]\n"
        )
    };
    let volume = format!(
        "[volume]\nlower = [\"0 m\", \"0 m\", \"0 m\"]\nupper = [\"10 mm\", \"10 mm\", \"10 mm\"]\n\
         deformation.strain_rate = [\"{rate} 1/s\", \"0 1/s\", \"0 1/s\"]\n"
    );
    let by_space = started(&format!("{}{volume}", list(right - 10e-3)), 0.0);
    let by_motion = started(&list(right), rate * apart);
    // k_t times the way across the normal, half of that along x.
    let by_hand = 0.8 * 1e-3 * rate * end * apart / 2.0_f64.sqrt();
    assert_close!(by_motion.0.norm(), by_hand, 1e-3, "N");
    assert_close_vector!(by_space.0, by_motion.0, 1e-3, "N");
    assert_close_vector!(by_space.1, by_motion.1, 1e-3, "N");
}
