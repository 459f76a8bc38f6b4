//! Hard spheres, both drivers: the same bits across a restart, whatever output is asked for and in whatever pieces time
//! is cut, for any number of threads and any order of the input; and a ledger that closes.

use agglo::engine::hard::{Descent, GrainEvent, Simulation, SimulationState};
use agglo::math::rng::{Purpose, Stream};
use agglo::particles::Particles;
use agglo::scenario::Scenario;
use rayon::ThreadPoolBuilder;

use crate::common;

const EVENTS: &str = "[engine.event_driven]";
const STEPS: &str = "[engine.time_stepped]\nshortest_step = \"0.1 us\"";
const NEAREST: &str =
    "[engine.time_stepped]\nshortest_step = \"1 us\"\npairs = \"nearest\"\ndistance = \"centers\"";

/// What goes on in a run.
#[derive(Clone, Copy, Debug)]
struct Case {
    name: &'static str,
    engine: &'static str,
    boundary: &'static str,
    /// γ [J/m²]: what agglomerates break by.
    surface_energy: &'static str,
    size: &'static str,
    impact: &'static str,
    end: &'static str,
}

const REACTING: Case = Case {
    name: "reacting",
    engine: EVENTS,
    boundary: "periodic",
    surface_energy: "8.3685e15 J/m2",
    size: "size.constant.radius = \"0.79 mm\"",
    impact: "[impact.restitution.hardness]\n[impact.tangential]\nfriction = 0.0013456\n[impact.fragmentation]\n\
             [impact.cooling]\nsurroundings = \"300 K\"",
    end: "1 ms",
};
/// Like it, but what has grown breaks again; reflecting walls.
const BREAKING: Case = Case {
    name: "breaking",
    boundary: "reflecting",
    surface_energy: "2e3 J/m2",
    impact: "[impact.restitution.hardness]\n[impact.tangential]\nfriction = 0.1\n[impact.fragmentation]\n\
             [impact.fragmentation.fragments.power_law]\nexponent = 1.5\n[impact.cooling]\nsurroundings = \"300 K\"",
    ..REACTING
};
/// No merges, for long: each sphere has dozens of impacts, so that memory is sorted; the fast become slow.
const BOUNCING: Case = Case {
    name: "bouncing",
    size: "size.uniform = { smallest = \"0.1 mm\", largest = \"1.5 mm\" }",
    impact: "[impact.restitution.constant]\nrestitution = 0.8\n[impact.tangential]\nfriction = 0.3",
    end: "3 ms",
    ..REACTING
};
const CASES: [Case; 8] = [
    REACTING,
    Case { boundary: "antipodal", ..REACTING },
    Case { engine: STEPS, end: "0.3 ms", ..REACTING },
    Case { engine: NEAREST, boundary: "antipodal", ..REACTING },
    BREAKING,
    Case { engine: STEPS, boundary: "periodic", end: "0.3 ms", ..BREAKING },
    BOUNCING,
    Case { engine: STEPS, end: "0.3 ms", ..BOUNCING },
];

impl Case {
    /// What the laws of grains that soften, break and cool read of the material.
    fn softening(&self) -> String {
        if !self.impact.contains("hardness") {
            return String::new();
        }
        format!(
            "hardness = \"0.26548 MPa\"\nactivation_energy = \"352.41 J/mol\"\nsurface_energy = \"{}\"\n\
             emissivity = 0.5\n",
            self.surface_energy
        )
    }

    fn scenario(&self) -> Scenario {
        common::scenario(&format!(
            "version = 1\nseed = 5\ntime.end = \"{end}\"\n{engine}\n[volume]\nlower = [\"-7 mm\", \"-7 mm\", \"-7 mm\"]\n\
             upper = [\"7 mm\", \"7 mm\", \"7 mm\"]\nboundary = \"{boundary}\"\n[materials.grain]\n\
             density = \"6652.7 kg/m3\"\nheat_capacity = \"1796.3 J/(kg K)\"\nreaction_heat = \"1.7765e13 J/m2\"\n\
             {softening}[[grains]]\nmaterial = \"grain\"\n\
             temperature = \"502.18 K\"\nvelocity = [\"10 m/s\", \"10 m/s\", \"30 m/s\"]\n{size}\n\
             placement.fill.count = 250\n[grains.velocity_spread.uniform]\n\
             bounds = [\"185 m/s\", \"90 m/s\", \"50 m/s\"]\n{impact}\n",
            end = self.end,
            engine = self.engine,
            boundary = self.boundary,
            softening = self.softening(),
            size = self.size,
            impact = self.impact,
        ))
    }

    fn start(&self) -> (Scenario, Simulation) {
        let scenario = self.scenario();
        let simulation = Simulation::start(&scenario, &common::grains(&scenario, |_| {})).unwrap();
        (scenario, simulation)
    }
}

fn finish(simulation: &mut Simulation) {
    let mut turns = agglo_testing::Turns::at_most(10_000_000, "the time that is due");
    while !simulation.is_finished() {
        turns.take();
        simulation.advance(f64::INFINITY).unwrap_or_else(|error| panic!("{error}"));
    }
}

/// Whether a run has what its contracts are to be tested with.
fn assert_busy(simulation: &Simulation, case: Case) {
    let counts = &simulation.system().state.counts;
    let (name, engine) = (case.name, case.engine);
    assert!(counts.collisions > 150, "{name} {engine}: {counts:?}");
    assert!((counts.merges > 80) == (name != "bouncing"), "{name} {engine}: {counts:?}");
    assert!((counts.fragmentations > 20) == (name == "breaking"), "{name} {engine}: {counts:?}");
}

/// All that is seen of a run in the end, to the bit.
struct Seen {
    parts: [(&'static str, Part); 4],
}

/// What is held to the same bits, and as a document that tells where it is not.
#[derive(PartialEq)]
struct Part {
    bits: Vec<u8>,
    document: serde_json::Value,
}

impl Part {
    fn of(what: &impl serde::Serialize) -> Self {
        // Tables by pairs of sizes have no place in such a document.
        let document = serde_json::to_value(what).unwrap_or_default();
        Self { bits: postcard::to_stdvec(what).unwrap(), document }
    }
}

fn seen(simulation: &mut Simulation, before: (Vec<GrainEvent>, Vec<Descent>)) -> Seen {
    let now = simulation.snapshot();
    let grains = &now.grains;
    let (mut events, mut descents) = before;
    let system = simulation.system_mut();
    events.append(&mut system.events);
    descents.append(&mut system.descents);
    let (state, clock) = (&simulation.system().state, simulation.clock());
    let ledger = (clock, &state.ledger, &state.counts, &state.warnings);
    Seen {
        parts: [
            ("grains and primaries", Part::of(&(grains, &now.primaries))),
            ("clock, ledger, counts and warnings", Part::of(&ledger)),
            ("rates", Part::of(&state.rates)),
            ("events and descents", Part::of(&(events, descents))),
        ],
    }
}

fn assert_same(found: &Seen, wanted: &Seen, case: Case, what: &str) {
    for ((part, found), (_, wanted)) in found.parts.iter().zip(&wanted.parts) {
        let differs = || common::first_difference(&found.document, &wanted.document);
        assert!(found.bits == wanted.bits, "{what}: {part}: {}, {case:?}", differs());
    }
}

fn whole(case: Case) -> Seen {
    let (_, mut simulation) = case.start();
    finish(&mut simulation);
    assert_busy(&simulation, case);
    seen(&mut simulation, Default::default())
}

fn state_of(bytes: &[u8]) -> SimulationState<'_> {
    postcard::from_bytes(bytes).unwrap()
}

/// Written, read and gone on with at many places: time cut at random, now and then after a single step.
#[test]
fn resumed_is_the_same() {
    for case in CASES {
        let wanted = whole(case);
        let (scenario, mut simulation) = case.start();
        let mut stream = Stream::new(3, Purpose::Sampling, 0);
        let mut genealogy = (Vec::new(), Vec::new());
        let mut resumed = 0;
        let mut turns = agglo_testing::Turns::at_most(10_000_000, "the time that is due");
        while !simulation.is_finished() {
            turns.take();
            let until = simulation.clock().time + 0.06 * stream.uniform() * simulation.end();
            let mut turns = agglo_testing::Turns::at_most(10_000_000, "the time that is due");
            while simulation.clock().time < until && !simulation.is_finished() {
                turns.take();
                simulation.advance(until).unwrap();
            }
            let system = simulation.system_mut();
            genealogy.0.append(&mut system.events);
            genealogy.1.append(&mut system.descents);
            let bytes = postcard::to_stdvec(&simulation.state()).unwrap();
            simulation = Simulation::resume(&scenario, state_of(&bytes)).unwrap();
            let (before, again) = (Part::of(&state_of(&bytes)), Part::of(&simulation.state()));
            let differs = || common::first_difference(&again.document, &before.document);
            assert!(again.bits == bytes, "read again: {}, {case:?}", differs());
            resumed += 1;
        }
        // With the printed distance there are some ten steps in all.
        assert!(resumed > if case.engine == NEAREST { 5 } else { 15 }, "{resumed} {case:?}");
        assert_same(&seen(&mut simulation, genealogy), &wanted, case, "resumed");
    }
}

/// Looked at all the time, in pieces cut at random, some of them of no length.
#[test]
fn output_changes_nothing() {
    for case in CASES {
        let wanted = whole(case);
        let (_, mut simulation) = case.start();
        let mut stream = Stream::new(4, Purpose::Sampling, 0);
        let mut turns = agglo_testing::Turns::at_most(10_000_000, "the time that is due");
        while !simulation.is_finished() {
            turns.take();
            let now = simulation.clock().time;
            let piece = (0.01 * stream.uniform() - 0.002).max(0.0);
            simulation.advance(now + piece * simulation.end()).unwrap();
            let (snapshot, balance) = (simulation.snapshot(), simulation.balance());
            assert_eq!(snapshot.grains.len(), simulation.grains());
            assert_finite!(balance.drift_relative);
            assert_true!(simulation.momentum().is_finite(), "{:?} kg m/s", simulation.momentum());
            assert_filled!(postcard::to_stdvec(&simulation.state()).unwrap());
        }
        // How many events were dealt with between two looks is no quantity of the simulation, all else is.
        assert_same(&seen(&mut simulation, Default::default()), &wanted, case, "watched");
    }
}

#[test]
fn same_bits_on_1_2_and_7_threads() {
    for case in CASES {
        let on = |threads: usize| {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| whole(case))
        };
        let alone = on(1);
        for threads in [2, 7] {
            assert_same(&on(threads), &alone, case, "threads");
        }
    }
}

/// All grains without their names, sorted.
/// What comes out of a run starts another one as it is, whatever grew; masses and primary grains are kept to the end, and
/// the run can be stopped and resumed.
#[test]
fn grown_grains_start_another_run() {
    for case in CASES {
        let what = format!("{} {} {}", case.name, case.engine, case.boundary);
        let (mut scenario, mut first) = case.start();
        let half = 0.5 * scenario.time.end.si();
        let mut turns = agglo_testing::Turns::at_most(10_000_000, "the time that is due");
        while first.clock().time < half {
            turns.take();
            first.advance(half).unwrap();
        }
        let before = first.snapshot();
        let start = first.clone().into_start();
        scenario.time.end = agglo::units::Quantity(half);
        let mut next = Simulation::start(&scenario, start.clone()).unwrap();
        assert_eq!(next.snapshot(), before, "{what}");
        let energies = [&first, &next].map(|simulation| simulation.balance().stored.kinetic);
        assert!((energies[1] / energies[0] - 1.0).abs() < 1e-12, "{what}: {energies:?} J");
        let mut turns = agglo_testing::Turns::at_most(10_000_000, "the time that is due");
        while next.clock().time < 0.5 * half {
            turns.take();
            next.advance(0.5 * half).unwrap();
        }
        let bytes = postcard::to_stdvec(&next.state()).unwrap();
        let state: SimulationState<'_> = postcard::from_bytes(&bytes).unwrap();
        let mut next = Simulation::resume(&scenario, state).unwrap_or_else(|error| panic!("{what}: {error}"));
        finish(&mut next);
        let after = next.snapshot();
        let sums = [&before, &after].map(|snapshot| {
            let mass: f64 = snapshot.grains.mass.iter().sum();
            (mass, snapshot.primaries.iter().sum::<u32>())
        });
        assert_eq!(sums[0].1, sums[1].1, "{what}: primary grains");
        assert!((sums[1].0 / sums[0].0 - 1.0).abs() < 1e-12, "{what}: masses {sums:?} kg");
    }
}

/// From event to event nothing but the times of last bounces is forgotten, which matter only in rushes of impacts: the same
/// impacts follow. They scatter what rounding parts, which is why this is held for a while only.
#[test]
fn from_event_to_event_the_course_is_the_same() {
    let (mut scenario, mut whole) = Case { end: "0.4 ms", ..BOUNCING }.start();
    let half = 0.5 * scenario.time.end.si();
    let mut turns = agglo_testing::Turns::at_most(10_000_000, "the time that is due");
    while whole.clock().time < half {
        turns.take();
        whole.advance(half).unwrap();
    }
    let start = whole.clone().into_start();
    let before = whole.system().state.counts.collisions;
    finish(&mut whole);
    scenario.time.end = agglo::units::Quantity(half);
    let mut next = Simulation::start(&scenario, start.clone()).unwrap();
    finish(&mut next);
    let impacts = [whole.system().state.counts.collisions - before, next.system().state.counts.collisions];
    assert!(impacts[0] > 100 && impacts[0] == impacts[1], "impacts {impacts:?}");
    let [a, b] = [&whole, &next].map(|simulation| simulation.snapshot().grains.position);
    let apart = a.iter().zip(&b).map(|(a, b)| (*a - *b).norm()).fold(0.0, f64::max);
    assert!(apart < 1e-9, "{apart} m apart");
}

fn nameless(simulation: &Simulation) -> Vec<([u64; 9], u32)> {
    let now = simulation.snapshot();
    let row = |at: usize| {
        let row = now.grains.row(at);
        let ([x, y, z], [u, v, w]) = (row.position.to_array(), row.velocity.to_array());
        ([x, y, z, u, v, w, row.radius, row.mass, row.temperature].map(f64::to_bits), now.primaries[at])
    };
    let mut rows: Vec<_> = (0..now.grains.len()).map(row).collect();
    rows.sort_unstable();
    rows
}

#[test]
fn order_of_the_input_is_not_physics() {
    for case in CASES {
        let scenario = case.scenario();
        let placed = common::grains(&scenario, |_| {});
        let orders: [fn(usize, usize) -> usize; 3] = [|k, _| k, |k, n| n - 1 - k, |k, n| k * 7 % n];
        let runs = orders.map(|order| {
            let mut grains = Particles::default();
            for k in 0..placed.len() {
                let mut row = placed.row(order(k, placed.len()));
                row.id = k as u32;
                grains.push(row);
            }
            let mut simulation = Simulation::start(&scenario, &grains).unwrap();
            finish(&mut simulation);
            assert_busy(&simulation, case);
            simulation
        });
        for other in &runs[1..] {
            assert_eq!(other.system().state.counts, runs[0].system().state.counts, "{case:?}");
            assert!(nameless(other) == nameless(&runs[0]), "other bits in another order: {case:?}");
            assert_eq!(other.clock(), runs[0].clock(), "{case:?}");
        }
    }
}

/// Energy, momentum, mass and primaries at many times on the way, and a genealogy that accounts for all primaries.
#[test]
fn books_close() {
    for case in CASES {
        let (_, mut simulation) = case.start();
        let start = simulation.grains_at_start();
        for part in 1..=20 {
            let until = simulation.end() * f64::from(part) / 20.0;
            let mut turns = agglo_testing::Turns::at_most(10_000_000, "the time that is due");
            while simulation.clock().time < until && !simulation.is_finished() {
                turns.take();
                simulation.advance(until).unwrap();
            }
            let (balance, ledger) = (simulation.balance(), &simulation.system().state.ledger);
            let now = simulation.snapshot();
            // Sums of 250 terms over some thousand impacts, each rounded at 1e-16.
            let mass: f64 = now.grains.mass.iter().sum();
            assert!((mass / ledger.start.mass - 1.0).abs() < 1e-12, "{case:?}");
            assert!(balance.kinetic_drift_relative.abs() < 1e-12, "{case:?} {balance:?}");
            assert!(balance.drift_relative.abs() < 1e-12, "{case:?} {balance:?}");
            assert!(simulation.momentum_drift_relative() < 1e-12, "{case:?}");
            assert_eq!(u64::from(now.primaries.iter().sum::<u32>()), start, "{case:?}");
            for (mass, primaries) in now.grains.mass.iter().zip(&now.primaries) {
                // Equal primaries, but where sizes are scattered.
                let whole = ledger.start.mass / start as f64 * f64::from(*primaries);
                assert!(
                    case.name == "bouncing" || (mass / whole - 1.0).abs() < 1e-12,
                    "{}: mass {mass:e} kg of {whole:e} kg",
                    case.name
                );
            }
        }
        assert_busy(&simulation, case);
        let system = simulation.system();
        for (event, number) in system.events.iter().zip(1..) {
            assert_eq!(event.number, number, "{case:?}");
            let energy = &event.energy;
            let explained = energy.normal + energy.tangential + energy.reaction - energy.surface;
            assert!((energy.heat / explained - 1.0).abs() < 1e-12, "{case:?} {event:?}");
        }
        assert_eq!(system.state.counts.events, system.events.len() as u64);
    }
}
