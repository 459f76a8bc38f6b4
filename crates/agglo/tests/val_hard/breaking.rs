//! Grains that stick and break at high speed: what they are made of is kept exactly, the energy of new surfaces is booked,
//! fragments do not overlap.

use std::collections::BTreeSet;

use agglo::engine::hard::{EventKind, Simulation};

use crate::common;
use crate::support::{self, EVENTS, Gas, STEPS};

const COUNT: u32 = 400;
const MATERIAL: &str = "surface_energy = \"0.05 J/m2\"\nheat_capacity = \"800 J/(kg K)\"\n";

/// Names of grains that have grown by a merge, which may overlap others for a while.
fn note_merges(simulation: &mut Simulation, merged: &mut BTreeSet<u32>) -> usize {
    let system = simulation.system_mut();
    let (events, descents) = (std::mem::take(&mut system.events), std::mem::take(&mut system.descents));
    let breaks = events.iter().filter(|event| event.kind == EventKind::Break);
    let numbers: BTreeSet<u64> =
        events.iter().filter(|event| event.kind == EventKind::Merge).map(|event| event.number).collect();
    merged.extend(descents.iter().filter(|line| numbers.contains(&line.event)).map(|line| line.child));
    breaks.count()
}

/// Deepest overlap of two grains that did not grow, over the sum of their radii.
fn deepest(simulation: &Simulation, merged: &BTreeSet<u32>, edge: f64) -> f64 {
    let grains = simulation.snapshot().grains;
    let whole: Vec<usize> = (0..grains.len()).filter(|&at| !merged.contains(&grains.id[at])).collect();
    let mut deepest = 0.0_f64;
    for (k, &a) in whole.iter().enumerate() {
        for &b in &whole[..k] {
            let apart = (grains.position[a] - grains.position[b]).to_array();
            let nearest = apart.map(|along| along - (along / edge).round() * edge);
            let distance = nearest.iter().map(|along| along * along).sum::<f64>().sqrt();
            let reach = grains.radius[a] + grains.radius[b];
            deepest = deepest.max(1.0 - distance / reach);
        }
    }
    deepest
}

fn break_and_merge(engine: &str, fragments: &str) -> Simulation {
    let impact = format!("{}[impact.fragmentation]\n{fragments}\n", support::STICKY);
    let gas = Gas {
        count: COUNT,
        solid_fraction: 0.05,
        engine,
        material: MATERIAL,
        impact: &impact,
        ..Gas::default()
    };
    let mut simulation = gas.start();
    simulation.system_mut().keeps_events = true;
    let (mut merged, mut broken) = (BTreeSet::new(), 0);
    let mass = simulation.system().state.ledger.start.mass;
    let single = mass / f64::from(COUNT);
    for look in 1..=200 {
        support::run_until(&mut simulation, 2e-4 * f64::from(look));
        broken += note_merges(&mut simulation, &mut merged);
        let now = simulation.snapshot();
        assert_eq!(now.primaries.iter().sum::<u32>(), COUNT);
        for (&mass, &primaries) in now.grains.mass.iter().zip(&now.primaries) {
            // Each break and merge rounds once or twice.
            assert_close!(mass, single * f64::from(primaries), 1e-12, "in kg");
        }
        if engine == EVENTS {
            let overlap = deepest(&simulation, &merged, gas.edge());
            assert!(overlap < 1e-12, "{overlap:e} at {look}");
        }
    }
    let counts = &simulation.system().state.counts;
    support::report(&format!(
        "breaking: {} merges, {} breakages in {broken} impacts, {} without room, {} grains in the end",
        counts.merges,
        counts.fragmentations,
        counts.no_room,
        simulation.grains()
    ));
    common::found("breaking", &[("impacts", broken as f64)]);
    assert!(broken > 100 && counts.merges > 100, "{counts:?}");
    support::assert_ledger(&simulation);
    let balance = simulation.balance();
    // New surface less the surface that merges have made disappear does not enter: surfaces are booked where made.
    assert_above!(balance.surface, 0.0, "in J");
    assert_below!(balance.surface, balance.normal + balance.friction, "in J");
    let booked = balance.heat + balance.surface;
    assert!((booked / (balance.normal + balance.friction) - 1.0).abs() < 1e-12, "{balance:?}");
    assert_near!(mass, simulation.snapshot().grains.mass.iter().sum::<f64>(), 1e-12 * mass, "in kg");
    simulation
}

#[test]
fn breaking_keeps_mass_momentum_and_energy() {
    for engine in [EVENTS, STEPS] {
        for fragments in ["", "fragments.power_law.exponent = 1.5"] {
            break_and_merge(engine, fragments);
        }
    }
}
