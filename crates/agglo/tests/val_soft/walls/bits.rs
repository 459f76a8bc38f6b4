//! Bits at walls: after a resume, for any number of threads, step by step and in flight.

use agglo::engine::soft::Simulation;
use agglo::math::Vec3;

use crate::common::{bytes, scenario, steps, written_and_read};
use crate::walls::ledger::{DRUM, SHAKEN_SPHERE, shaken};
use crate::walls::wall;

const RUBBED: &str = "[contact.normal.hertz]\n[contact.damping.restitution]\nrestitution = 0.7\n\
                      [contact.friction.mindlin]\nstatic_friction = 0.4\ndashpot = 0.3\n";

/// Over sortings in space, which come every 2,000 steps, with springs loaded at the walls.
#[test]
fn a_resumed_run_has_the_same_bits() {
    let oscillating = "shape.sphere = { center = [\"0 m\", \"0 m\", \"0 m\"], radius = \"6 mm\" }\n\
                       motion.formula.velocity = [\"0.1*cos(300*t)\", \"0\", \"0.2*sin(500*t)\"]";
    for container in [DRUM, oscillating] {
        let mut whole = shaken(container, RUBBED, 4e-6, 50e-3);
        for _ in 0..5 {
            steps(&mut whole, 1100);
            press_on_walls(&mut whole);
            let state = written_and_read(&whole);
            let mut resumed = Simulation::resume(&scenario(&text(container)), state).unwrap();
            assert_true!(bytes(&resumed) == bytes(&whole), "what was saved and read");
            steps(&mut whole, 300);
            steps(&mut resumed, 300);
            assert_true!(bytes(&resumed) == bytes(&whole), "step {}", whole.clock().step);
        }
    }
}

/// Steps until a grain presses on a wall with a loaded spring.
fn press_on_walls(simulation: &mut Simulation) {
    let mut turns = agglo_testing::Turns::at_most(3000, "a grain to press on a wall");
    let presses = |simulation: &Simulation| {
        let wall = simulation.system.wall_states(simulation.clock().time).next().unwrap();
        wall.contacts > 0 && simulation.system.spring_energy() > 0.0
    };
    while !presses(simulation) {
        turns.take();
        steps(simulation, 1);
    }
}

/// The scenario of `shaken`, whose grains are not asked for.
fn text(container: &str) -> String {
    let elastic = "density = \"2500 kg/m3\"\nyoungs_modulus = \"10 MPa\"\npoisson_ratio = 0.25";
    crate::walls::grains_at(
        &[[0.0; 3]],
        50e-3,
        &crate::common::verlet(4e-6),
        &format!(
            "[[walls]]\nname = \"container\"\nmaterial = \"glass\"\n{container}\n{RUBBED}{}",
            crate::walls::GRAVITY
        ),
    )
    .replace("density = \"2500 kg/m3\"", elastic)
}

/// Three layers of 29 by 29 grains that fall onto the bottom of a box; its candidates are several leaves of the parallel loop.
#[test]
fn threads_change_no_bit() {
    let text = "version = 1\ntime.end = \"1 s\"\nengine.verlet = {}\n[materials.glass]\ndensity = \"2500 kg/m3\"\n\
                youngs_modulus = \"10 MPa\"\npoisson_ratio = 0.25\n[[grains]]\nmaterial = \"glass\"\n\
                size.constant.radius = \"1 mm\"\nvelocity = [\"0.2 m/s\", \"0.1 m/s\", \"-0.5 m/s\"]\n\
                angular_velocity = [\"100 rad/s\", \"0 rad/s\", \"50 rad/s\"]\n\
                [grains.placement.lattice]\nkind = \"cubic\"\nspacing = \"2.01 mm\"\n\
                region.box = { lower = [\"0 m\", \"0 m\", \"0 m\"], upper = [\"60.3 mm\", \"60.3 mm\", \"8.04 mm\"] }\n\
                [[walls]]\nname = \"box\"\nmaterial = \"glass\"\n\
                shape.box = { lower = [\"1 mm\", \"1 mm\", \"1 mm\"], upper = [\"59.3 mm\", \"59.3 mm\", \"20 mm\"] }\n\
                motion.oscillating = { amplitude = [\"0 m\", \"0 m\", \"10 um\"], frequency = \"1 kHz\" }\n";
    let text = format!("{text}{RUBBED}");
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut simulation = crate::common::start(&text, |_| {});
            let contacts = |simulation: &Simulation| {
                simulation.system.wall_states(simulation.clock().time).next().unwrap().contacts
            };
            let mut turns = agglo_testing::Turns::at_most(100, "700 grains to press on the box");
            while contacts(&simulation) < 700 {
                turns.take();
                steps(&mut simulation, 10);
            }
            steps(&mut simulation, 50);
            bytes(&simulation)
        })
    };
    let one = run(1);
    for threads in [2, 3, 7] {
        assert_true!(run(threads) == one, "{threads} threads");
    }
}

/// Steps that begin in the pass in which the one before ends have the bits of single steps.
#[test]
fn flights_have_the_bits_of_steps() {
    let [mut flown, mut stepped] = [(); 2].map(|()| shaken(DRUM, RUBBED, 4e-6, 50e-3));
    let mut longest = 0;
    while flown.clock().step < 1500 {
        let before = flown.clock().step;
        flown.advance(f64::INFINITY).unwrap();
        longest = longest.max(flown.clock().step - before);
        let count = flown.clock().step - stepped.clock().step;
        steps(&mut stepped, count as usize);
        assert_true!(bytes(&flown) == bytes(&stepped), "step {}", flown.clock().step);
    }
    assert_above!(longest, 10, "steps in one flight");
}

/// A simulation that starts from another one has its springs at walls of the same names, and none at others.
#[test]
fn springs_at_walls_are_taken_over() {
    let mut first = shaken(DRUM, RUBBED, 4e-6, 50e-3);
    steps(&mut first, 500);
    press_on_walls(&mut first);
    let (energy, time) = (first.system.spring_energy(), first.clock().time);
    // The drum has turned meanwhile, but stands as it did: it is round.
    assert_above!(time, 0.0, "in s");
    let start = first.into_start();
    assert_any!(start.walls.iter(), |of| of.wall == "container" && of.spring.force.norm() > 0.0);
    let kept =
        |text: String| Simulation::start(&scenario(&text), start.clone()).unwrap().system.spring_energy();
    // Springs turn with their normals, and are relaxed by no more than rounding.
    assert_close!(kept(text(DRUM)), energy, 1e-9, "in J");
    let lost = kept(text(DRUM).replace("\"container\"", "\"another\""));
    assert_below!(lost, 0.999_999 * energy, "in J");
}

/// At every step those grains touch a sphere that moves to and fro which overlap it where it is: none is left out by the list of those
/// that are near.
#[test]
fn no_contact_is_missed() {
    let mut simulation = shaken(SHAKEN_SPHERE, RUBBED, 4e-6, 50e-3);
    let mut most = 0;
    for _ in 0..8000 {
        steps(&mut simulation, 1);
        let angle = std::f64::consts::TAU * 80.0 * simulation.clock().time + 0.7;
        let center = Vec3::new(0.3e-3, 0.0, 0.2e-3) * (angle.sin() - 0.7_f64.sin());
        let grains = &simulation.system.grains;
        let touch = grains.position.iter().filter(|place| (**place - center).norm() > 5e-3).count() as u32;
        let found = wall(&simulation, "container").contacts;
        assert_eq!(found, touch, "contacts at step {}", simulation.clock().step);
        most = most.max(touch);
    }
    assert_above!(most, 2, "contacts at once");
}
