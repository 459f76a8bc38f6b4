//! Relations between runs that must agree: in which order grains stand in memory, how often they are sorted and when
//! lists of pairs are built is not physics.
//!
//! Another order adds the same forces in another order, which rounds otherwise: such runs agree to round-off and what
//! collisions make of it. Lists only say which pairs to look at; pairs that do not touch add nothing, and those that do
//! keep their order: such runs agree to the bit.

use std::fmt::Write as _;
use std::ops::ControlFlow;

use super::simulation::Simulation;
use super::skin::Skin;
use crate::contact::pass::Remembered;
use crate::math::Vec3;
use crate::math::rng::{Purpose, Stream};
use crate::particles::Particles;
use crate::testing::Scenario;

const VERLET: &str = "[engine.verlet]\nsafety = 0.2\n";
const ADAPTIVE: &str = "[engine.staggered]\ninitial_step = \"20 ns\"\nlargest_step = \"80 ns\"\n\
                        tolerance = 1e-5\ntarget_iterations = 8\n";
/// Tries that go too far, so that many are rejected.
const REJECTING: &str = "[engine.staggered]\ninitial_step = \"20 ns\"\nlargest_step = \"2 us\"\n\
                         tolerance = 1e-6\ntarget_iterations = 4\n";
const RELAXED: &str = "[start.relax]\nspeed = \"5 cm/s\"\nlongest = \"1 ms\"\ndamping_time = \"5 us\"\n";

/// Two materials, many sizes, charges of both signs, two beams; every law that can act beside the others.
const CROWD: &str = r#"
version = 1
seed = 7
[time]
end = "1 s"
[limits]
strain = 0.4
displacement = 1e3
[medium]
density = "1000 kg/m3"
sound_speed = "1500 m/s"
viscosity = "1 mPa s"
[materials.pigment]
density = "4000 kg/m3"
sound_speed = "5000 m/s"
youngs_modulus = "1 GPa"
poisson_ratio = 0.25
[materials.resin]
density = "1300 kg/m3"
sound_speed = "2300 m/s"
shear_sound_speed = "1100 m/s"
youngs_modulus = "0.4 GPa"
poisson_ratio = 0.35
[[grains]]
material = "pigment"
charge = "1e-12 C"
size.lognormal = { median = "20 um", geometric_deviation = 1.3, smallest = "10 um", largest = "40 um" }
placement.random = { count = 30, region.sphere.radius = "120 um" }
[[grains]]
material = "resin"
charge = "4e-13 C"
size.constant.radius = "17 um"
placement.random = { count = 30, region.sphere.radius = "120 um" }
[contact.normal.hertz]
[contact.damping.restitution]
restitution = 0.5
[contact.friction.mindlin]
static_friction = 0.4
dynamic_friction = 0.3
dashpot = 0.2
[bonds.beam]
youngs_modulus = "100 MPa"
tensile_strength = "1 MPa"
shear_strength = "1 MPa"
radius_ratio = 0.5
gap = 0.3
forming_strain = 0.01
damping_ratio = 0.05
[fields.gravity]
acceleration = ["0 m/s2", "-9.81 m/s2", "0 m/s2"]
buoyancy = true
[fields.drag]
law = "schiller_naumann"
added_mass = 0.5
medium_velocity = ["100*y*cos(1e6*t)", "0.02*sin(2e6*t)", "0 m/s"]
# A trap, so that grains keep colliding.
[fields.lorentz]
electric_field = ["-3e12*x", "-3e12*y + 1e5*sin(1e6*t)", "-3e12*z"]
magnetic_flux_density = ["0 T", "0 T", "1e7 T"]
[fields.magnetic]
magnetizability = "1e-9 J/T2"
magnetic_flux_density = ["1 T", "0 T", "1e4*z"]
[fields.near_field]
cutoff = "100 um"
truncation = 10.0
law.coulomb.relative_permittivity = 80.0
# Each bounce multiplies what rounding made of a ray's direction; six leave it small.
[acoustics]
bounces = 6
force.impulse.duration = "50 ns"
[[acoustics.beams]]
start = ["-200 um", "0 m", "0 m"]
direction = [1.0, 0.0, 0.0]
radius = "0.15 mm"
rays = 300
strength.pressure = "2 MPa"
pulses = { period = "0.4 us", count = 1000 }
[[acoustics.beams]]
start = ["0 m", "300 um", "0 m"]
direction = [0.2, -1.0, 0.1]
radius = "0.1 mm"
rays = 150
strength.pressure = "3 MPa"
pulses = { period = "0.3 us", count = 1000 }
"#;

/// Grains that fall in on one another and spin.
fn falling_in(grains: &mut Particles) {
    let mut stream = Stream::new(11, Purpose::Sampling, 0);
    for at in 0..grains.len() {
        grains.velocity[at] = grains.position[at] * -2e4 + stream.direction();
        grains.angular_velocity[at] = Vec3::new(stream.normal(), stream.normal(), stream.normal()) * 1e4;
    }
}

fn scenario(engine: &str) -> Scenario {
    Scenario::from_toml(&format!("{CROWD}{engine}")).unwrap_or_else(|faults| panic!("{faults}"))
}

fn placed(scenario: &Scenario) -> Particles {
    let mut grains = crate::testing::place(scenario).unwrap();
    falling_in(&mut grains);
    grains
}

fn steps(simulation: &mut Simulation, count: u32) {
    for step in 0..count {
        simulation.step().unwrap_or_else(|error| panic!("step {step}: {error}"));
    }
}

/// A crowd in which everything has a memory: sheared contacts, loaded bonds, some broken, some made, rays that bounced.
fn busy(scenario: &Scenario) -> Simulation {
    let mut simulation = Simulation::start(scenario, placed(scenario)).unwrap();
    steps(&mut simulation, 200);
    let bounced = |simulation: &Simulation| {
        simulation.pulses.flight().rays().iter().filter(|ray| ray.bounces > 1).count()
    };
    // Pulses come and go.
    while bounced(&simulation) < 5 && simulation.clock().step < 1000 {
        steps(&mut simulation, 1);
    }
    assert_busy(&simulation);
    simulation
}

fn assert_busy(simulation: &Simulation) {
    let loaded =
        |found: &[Remembered]| found.iter().filter(|(_, _, spring)| spring.force != Vec3::ZERO).count();
    let touching = simulation.system.remembered();
    assert!(loaded(&touching) > 5, "{} of {} contacts are sheared", loaded(&touching), touching.len());
    let bonds = simulation.system.network.bonds();
    assert!(bonds.iter().any(|bond| bond.state.twist != 0.0), "none of {} bonds is twisted", bonds.len());
    let rays = simulation.pulses.flight().rays();
    assert!(rays.iter().any(|ray| ray.bounces > 1), "none of {} rays bounced", rays.len());
}

/// The same state in a simulation of its own.
fn copy(scenario: &Scenario, of: &Simulation) -> Simulation {
    copy_at_step(scenario, of, of.clock().step)
}

/// The same, after so many steps in the count of the clock.
fn copy_at_step(scenario: &Scenario, of: &Simulation, step: u64) -> Simulation {
    let bytes = postcard::to_stdvec(&of.state()).unwrap();
    let mut state: super::SimulationState<'static> = postcard::from_bytes(&bytes).unwrap();
    state.clock.step = step;
    Simulation::resume(scenario, state).unwrap_or_else(|error| panic!("{error}"))
}

/// Values of one kind, each under the name of what it belongs to.
struct Kind {
    name: &'static str,
    unit: &'static str,
    values: Vec<(String, Vec3)>,
}

fn kind(name: &'static str, unit: &'static str, values: impl Iterator<Item = (String, Vec3)>) -> Kind {
    let mut values: Vec<(String, Vec3)> = values.collect();
    values.sort_by(|a, b| a.0.cmp(&b.0));
    Kind { name, unit, values }
}

fn scalar(value: f64) -> Vec3 {
    Vec3::AXES[0] * value
}

/// All that a simulation is, by the names of grains; forces of a pair are those on the grain of the lower name.
fn kinds(simulation: &Simulation) -> Vec<Kind> {
    let system = &simulation.system;
    let grains = &system.grains;
    let by_grain = |name, unit, value: &dyn Fn(usize) -> Vec3| {
        kind(name, unit, (0..grains.len()).map(|at| (format!("grain {:03}", grains.id[at]), value(at))))
    };
    let mut kinds = vec![
        by_grain("position", "m", &|at| grains.position[at]),
        by_grain("velocity", "m/s", &|at| grains.velocity[at]),
        by_grain("angular_velocity", "rad/s", &|at| grains.angular_velocity[at]),
        by_grain("mass", "kg", &|at| scalar(grains.mass[at])),
        by_grain("inertial mass", "kg", &|at| scalar(system.inertial_mass[at])),
        by_grain("charge", "C", &|at| scalar(grains.charge[at])),
        by_grain("absorbed power", "W", &|at| scalar(grains.absorbed_power[at])),
        by_grain("force", "N", &|at| system.loads.force[at]),
        by_grain("torque", "N m", &|at| system.loads.torque[at]),
    ];
    kinds.extend(of_pairs(simulation));
    kinds.extend(of_rays(simulation));
    kinds.extend(of_books(simulation));
    kinds
}

fn of_pairs(simulation: &Simulation) -> Vec<Kind> {
    let grains = &simulation.system.grains;
    let touching = simulation.system.remembered();
    let contacts = |value: &dyn Fn(&Remembered, f64) -> Vec3| -> Vec<(String, Vec3)> {
        let of = |contact: &Remembered| {
            let (a, b) = (grains.id[contact.0 as usize], grains.id[contact.1 as usize]);
            let sign = if a < b { 1.0 } else { -1.0 };
            (format!("contact {:03}-{:03}", a.min(b), a.max(b)), value(contact, sign))
        };
        touching.iter().map(of).collect()
    };
    let bonds = simulation.system.network.bonds();
    let of_bonds = |value: &dyn Fn(&crate::contact::bond::BeamState) -> Vec3| -> Vec<(String, Vec3)> {
        let of = |bond: &crate::contact::network::Bond| {
            (format!("bond {:03}-{:03}", bond.ids[0], bond.ids[1]), value(&bond.state))
        };
        bonds.iter().map(of).collect()
    };
    vec![
        kind("spring", "N", contacts(&|contact, sign| contact.2.force * sign).into_iter()),
        kind("stiffness", "N/m", contacts(&|contact, _| scalar(contact.2.stiffness)).into_iter()),
        kind(
            "sliding",
            "",
            contacts(&|contact, _| scalar(f64::from(u8::from(contact.2.sliding)))).into_iter(),
        ),
        kind("shear", "N", of_bonds(&|state| state.shear).into_iter()),
        kind("bending", "N m", of_bonds(&|state| state.bending).into_iter()),
        kind("twist", "N m", of_bonds(&|state| scalar(state.twist)).into_iter()),
    ]
}

fn of_rays(simulation: &Simulation) -> Vec<Kind> {
    let flight = simulation.pulses.flight();
    let by_ray = |name, unit, value: &dyn Fn(&crate::acoustics::Ray) -> Vec3| {
        kind(
            name,
            unit,
            flight.rays().iter().enumerate().map(|(at, ray)| (format!("ray {at:05}"), value(ray))),
        )
    };
    let id = |place: u32| simulation.system.grains.id.get(place as usize).map_or(-1.0, |id| f64::from(*id));
    let by_pulse = |name, unit, value: &dyn Fn(&crate::acoustics::PulseCount) -> f64| {
        let named = |(at, pulse)| (format!("pulse {at:03}"), scalar(value(pulse)));
        kind(name, unit, flight.pulses().iter().enumerate().map(named))
    };
    vec![
        by_ray("place", "m", &crate::acoustics::Ray::position),
        by_ray("power", "W", &|ray| scalar(ray.power)),
        by_ray("grain hit last", "", &|ray| scalar(id(ray.last_hit))),
        by_pulse("reflections", "", &|pulse| pulse.reflections as f64),
        by_pulse("power absorbed", "W", &|pulse| pulse.power_absorbed),
    ]
}

fn of_books(simulation: &Simulation) -> Vec<Kind> {
    let (flows, stored) = (&simulation.ledger.flows, simulation.stored_energy());
    let energies = [
        ("rays", flows.rays.power),
        ("drag", flows.supplies.drag.power),
        ("gravity", flows.supplies.gravity.power),
        ("fields", flows.supplies.field.power),
        ("damping", flows.damping),
        ("tangential", flows.tangential),
        ("bond damping", flows.bond_damping),
        ("broken bonds", flows.broken_bonds),
        ("elastic", stored.elastic),
        ("springs", stored.tangential_spring),
        ("bonds", stored.bonds),
        ("near field", stored.near_field),
        ("kinetic", stored.kinetic),
    ];
    // One kind each: none is measured by the size of another.
    let of_energy =
        |(name, value): (&'static str, f64)| kind(name, "J", std::iter::once((String::new(), scalar(value))));
    let mut kinds: Vec<Kind> = energies.into_iter().map(of_energy).collect();
    let events = simulation.events.iter().map(|event| {
        let what = if event.broke.is_some() { "broke" } else { "was made" };
        (format!("bond {:03}-{:03} {what}", event.ids[0], event.ids[1]), scalar(event.time))
    });
    kinds.push(kind("event", "s", events));
    kinds.push(kind("clock", "s", std::iter::once((String::new(), scalar(simulation.clock().time)))));
    kinds
}

/// Asserts that two runs agree to a part of the largest value of each kind.
fn assert_agree(found: &Simulation, wanted: &Simulation, tolerance: f64, what: &str) {
    let mut faults = String::new();
    for (found, wanted) in kinds(found).iter().zip(kinds(wanted)) {
        let (name, unit) = (wanted.name, wanted.unit);
        let names = |kind: &Kind| kind.values.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
        if names(found) != names(&wanted) {
            let _ = writeln!(faults, "{name}: of {:?}, expected of {:?}", names(found), names(&wanted));
            continue;
        }
        let size = wanted.values.iter().map(|(_, value)| value.norm()).fold(0.0, f64::max);
        let apart = found.values.iter().zip(&wanted.values);
        let worst = apart.max_by(|a, b| (a.0.1 - a.1.1).norm().total_cmp(&(b.0.1 - b.1.1).norm()));
        let Some((found, wanted)) = worst else { continue };
        let differ = (found.1 - wanted.1).norm();
        // What is not a number does not agree.
        let agrees = differ <= tolerance * size;
        if !agrees {
            let (found, wanted, whose) = (found.1.to_array(), wanted.1.to_array(), &wanted.0);
            let part = differ / size;
            let _ = writeln!(
                faults,
                "{name} of {whose}: expected {wanted:?} {unit}, found {found:?} {unit}: off by {part:.1e} of the largest"
            );
        }
    }
    assert!(faults.is_empty(), "{what}: these must agree to {tolerance:e}:\n{faults}");
}

/// Rounding, 1e-16 of each sum, as collisions and bounces of rays amplify it over some thirty steps. A wrong sign or place
/// shows in the fourth digit or before.
const ROUND_OFF: f64 = 1e-6;
/// Steps that are compared; ten of them amplify a difference some tenfold.
const STEPS: u32 = 30;

/// Contacts that have a spring and another owner than before: the one who owned it is the partner now.
fn turned_over(a: &Simulation, b: &Simulation) -> usize {
    let owners = |simulation: &Simulation| -> Vec<(u32, u32)> {
        let id = |place: u32| simulation.system.grains.id[place as usize];
        let loaded =
            simulation.system.remembered().into_iter().filter(|(_, _, spring)| spring.force != Vec3::ZERO);
        loaded.map(|(a, b, _)| (id(a), id(b))).collect()
    };
    let other = owners(b);
    owners(a).iter().filter(|(owner, partner)| other.contains(&(*partner, *owner))).count()
}

impl Simulation {
    /// Puts the grains into another order in memory, as a sorting does.
    fn reorder(&mut self, order: &[u32]) {
        let place = self.system.reorder(order);
        self.pulses.reindex(&place);
    }
}

/// Grains put into the opposite order, then moved up by seven places at every step: every contact, bond and ray meets
/// its grains at new places, and every owner of a contact is its partner at times.
#[test]
fn the_order_in_memory_is_not_physics() {
    for engine in [VERLET, ADAPTIVE] {
        let scenario = scenario(engine);
        let mut plain = busy(&scenario);
        let mut moved = copy(&scenario, &plain);
        plain.events.clear();
        plain.sort_every = u64::MAX;
        moved.sort_every = u64::MAX;
        let n = plain.system.grains.len() as u32;
        let backwards: Vec<u32> = (0..n).rev().collect();
        let onwards: Vec<u32> = (0..n).map(|at| (at + 7) % n).collect();
        moved.reorder(&backwards);
        assert!(turned_over(&plain, &moved) > 5, "no contact changed its owner");
        assert_agree(&moved, &plain, 1e-13, "right after the reordering");
        for step in 1..=STEPS {
            steps(&mut plain, 1);
            steps(&mut moved, 1);
            assert_agree(&moved, &plain, ROUND_OFF, &format!("step {step} after a reordering: {engine}"));
            moved.reorder(&onwards);
        }
    }
}

/// What a user has is a sorting every 2000 steps; it must give the same as one at every step and as none at all.
#[test]
fn sorted_at_every_step_at_step_2000_or_never() {
    for start in ["", RELAXED] {
        let scenario = scenario(&format!("{VERLET}{start}"));
        let mut begun = busy(&scenario);
        // Far from the order of a sorting, which then has much to do.
        begun.reorder(&(0..60).rev().collect::<Vec<u32>>());
        let mut never = copy_at_step(&scenario, &begun, 1990);
        never.sort_every = u64::MAX;
        let mut always = copy_at_step(&scenario, &begun, 1990);
        always.sort_every = 1;
        let mut shipped = copy_at_step(&scenario, &begun, 1990);
        for step in 1991..=2020 {
            for simulation in [&mut never, &mut always, &mut shipped] {
                steps(simulation, 1);
            }
            assert_agree(&always, &never, ROUND_OFF, &format!("step {step}, sorted at every step {start}"));
            assert_agree(&shipped, &never, ROUND_OFF, &format!("step {step}, sorted at step 2000 {start}"));
        }
        assert!(turned_over(&never, &always) > 0, "sorting at every step turned no sheared contact over");
        assert!(turned_over(&never, &shipped) > 0, "sorting at step 2000 turned no sheared contact over");
    }
}

/// Lists built at every evaluation, when a skin that adapts is used up, and never again: the same bits. Tries that are
/// rejected go there and back again.
#[test]
fn lists_built_always_or_never_give_the_same_bits() {
    for engine in [VERLET, REJECTING] {
        let scenario = scenario(engine);
        let mut plain = busy(&scenario);
        plain.events.clear();
        let with_skin = |thickness, part| {
            let mut other = copy(&scenario, &plain);
            other.system.skin = Skin::fixed(thickness, part);
            let remembered = other.system.remembered();
            other.system.remember(&remembered);
            other
        };
        // Grains move by 10 um in all.
        let (mut always, mut never) = (with_skin(0.0, 0.0), with_skin(1e-3, 10.0));
        let bytes = |simulation: &Simulation| postcard::to_stdvec(&simulation.state()).unwrap();
        for step in 1..=60 {
            for simulation in [&mut plain, &mut always, &mut never] {
                steps(simulation, 1);
            }
            for (other, what) in [(&always, "at every evaluation"), (&never, "once")] {
                assert_agree(other, &plain, 0.0, &format!("step {step}, lists built {what}: {engine}"));
                assert!(
                    bytes(other) == bytes(&plain),
                    "step {step}, lists built {what}: states differ: {engine}"
                );
            }
        }
        let listed = |simulation: &Simulation| simulation.system.near_list().unwrap().len();
        assert_eq!(listed(&never), 60 * 59 / 2, "the list that never ends holds all pairs");
        assert!(listed(&always) < listed(&plain), "a list without a skin is the shortest");
        let rejected = never.clock().rejected;
        assert!(engine == VERLET || rejected > 10, "{rejected} tries were rejected");
    }
}

/// Grains that came to rest before the clock starts have the linear and angular velocities that the scenario gave to
/// each by its name, wherever sorting has put it.
#[test]
fn a_relaxed_start_gives_each_grain_its_own_motion() {
    let scenario = scenario(&format!("{VERLET}{RELAXED}"));
    let placed = placed(&scenario);
    let mut told = 0;
    let simulation = Simulation::start_watched(&scenario, placed.clone(), &mut |_| {
        told += 1;
        ControlFlow::Continue(())
    });
    let simulation = simulation.unwrap_or_else(|error| panic!("{error}"));
    assert!(told > 10, "came to rest in {told} steps");
    let grains = &simulation.system.grains;
    let at_home = grains.id.iter().zip(0..).filter(|(id, at)| **id == *at).count();
    assert!(at_home < 10, "{at_home} of 60 grains stand where they were placed");
    for at in 0..grains.len() {
        let id = grains.id[at] as usize;
        let (velocity, angular_velocity) = (placed.velocity[id], placed.angular_velocity[id]);
        assert!(
            grains.velocity[at] == velocity,
            "grain {id}: {:?} m/s, expected {velocity:?}",
            grains.velocity[at]
        );
        assert!(
            grains.angular_velocity[at] == angular_velocity,
            "grain {id}: {:?} rad/s, expected {angular_velocity:?}",
            grains.angular_velocity[at]
        );
        assert!(grains.mass[at] == placed.mass[id], "grain {id}: {:e} kg", grains.mass[at]);
    }
}
