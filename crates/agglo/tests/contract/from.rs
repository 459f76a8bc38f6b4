//! A run that starts from where another one stood goes on as that one did.

use agglo::engine::Start;
use agglo::engine::soft::Simulation;
use agglo::math::Vec3;
use agglo::scenario::Scenario;

use crate::{common, crowd};

/// Takes away what a start brings along.
type Forget = fn(&mut Start);

/// The crowd with steps of one length, without pulses, whose time would begin anew, and without forces that depend on
/// velocities: within a step these see others than at its end, where a start sees them.
fn scenario() -> Scenario {
    let mut text = crowd::text("[engine.verlet]\nstep = \"2 ns\"\n", 300);
    for (damped, free) in [
        ("[contact.damping.restitution]\nrestitution = 0.5\n", ""),
        ("damping_ratio = 0.05\n", "damping_ratio = 0.0\n"),
        ("[fields.drag]\nlaw = \"schiller_naumann\"\nadded_mass = 0.5\n", ""),
    ] {
        assert!(text.contains(damped), "{damped}");
        text = text.replace(damped, free);
    }
    let mut scenario = common::scenario(&text);
    scenario.soft_mut().unwrap().acoustics = None;
    scenario
}

/// Places, velocities and angular velocities in the order of names.
fn motion(simulation: &Simulation) -> Vec<[Vec3; 3]> {
    let grains = &simulation.system.grains;
    let mut all = vec![[Vec3::ZERO; 3]; grains.len()];
    for at in 0..grains.len() {
        all[grains.id[at] as usize] = [grains.position[at], grains.velocity[at], grains.angular_velocity[at]];
    }
    all
}

/// Largest differences of places, velocities and angular velocities over the largest of each.
fn apart(a: &Simulation, b: &Simulation) -> [f64; 3] {
    let (a, b) = (motion(a), motion(b));
    [0, 1, 2].map(|which| {
        let largest = a.iter().map(|grain| grain[which].norm()).fold(0.0, f64::max);
        let differences = a.iter().zip(&b).map(|(a, b)| (a[which] - b[which]).norm());
        differences.fold(0.0, f64::max) / largest
    })
}

/// Only sums are made in another order, since grains are sorted at the start: round-off, which collisions amplify. Grains
/// that forget a spring, a bond or a bond's load are farther off by orders of magnitude, which the test shows too.
#[test]
fn grains_go_on_with_their_springs_and_bonds() {
    const BEFORE: usize = 800;
    const STEPS: usize = 200;
    let scenario = scenario();
    let begin = || {
        let grains = common::grains(&scenario, crowd::falling_in);
        Simulation::start(&scenario, grains).unwrap()
    };
    let (mut whole, mut first) = (begin(), begin());
    common::steps(&mut whole, BEFORE);
    common::steps(&mut first, BEFORE);
    let made = first.system.network.made_at_start();
    let start = first.into_start();
    let loaded = start.contacts.iter().filter(|(.., spring)| spring.force.norm() > 0.0).count();
    let held = start.bonds.as_ref().unwrap().len();
    assert!(loaded > 10 && held > 50 && held != made, "{loaded} springs, {held} of {made} bonds");

    let mut next = Simulation::start(&scenario, start.clone()).unwrap();
    assert_eq!(next.clock().time, 0.0);
    assert_eq!(next.system.network.bonds().len(), held);
    let energies = [&whole, &next].map(|simulation| {
        let stored = simulation.stored_energy();
        [stored.kinetic, stored.elastic, stored.tangential_spring, stored.bonds]
    });
    for (before, after) in energies[0].iter().zip(energies[1]) {
        assert!((after / before - 1.0).abs() < 1e-12, "energies {energies:?} [J]");
    }
    common::steps(&mut whole, STEPS);
    common::steps(&mut next, STEPS);
    let found = apart(&whole, &next);
    assert!(found.iter().all(|part| *part < 1e-12), "relative differences {found:?}");

    let forgets: [Forget; 4] = [
        |start| start.contacts.clear(),
        |start| start.contacts.iter_mut().for_each(|(.., spring)| spring.sliding = false),
        |start| start.bonds = None,
        |start| {
            for bond in start.bonds.iter_mut().flatten() {
                bond.state.shear = Vec3::ZERO;
            }
        },
    ];
    for (number, forget) in forgets.into_iter().enumerate() {
        let mut start = start.clone();
        forget(&mut start);
        let mut other = Simulation::start(&scenario, start).unwrap();
        common::steps(&mut other, STEPS);
        let found = apart(&whole, &other);
        assert!(found[1] > 1e-4, "what number {number} forgets makes no difference: {found:?}");
    }
}

/// Names are kept where grains have been sorted, and relaxation gives each grain its own velocity back.
#[test]
fn grains_that_come_to_rest_first_get_their_own_velocities_back() {
    let mut scenario = scenario();
    let soft = scenario.soft_mut().unwrap();
    (soft.contact, soft.bonds, soft.fields) = (None, None, agglo::fields::Fields::default());
    let grains = common::grains(&scenario, |grains| {
        crowd::falling_in(grains);
        let order: Vec<u32> = (0..grains.len() as u32).rev().collect();
        grains.reorder(&order);
    });
    let free = Simulation::start(&scenario, grains.clone()).unwrap();
    scenario.soft_mut().unwrap().relax =
        Some(toml::from_str("speed = \"1 mm/s\"\nlongest = \"1 s\"\ndamping_time = \"1 ms\"\n").unwrap());
    let rested = Simulation::start(&scenario, grains).unwrap();
    assert_eq!(motion(&free), motion(&rested));
}
