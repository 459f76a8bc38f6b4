//! Hard spheres: impacts of an elastic gas, and the whole of a published set of parameters.

mod gas;

use std::path::Path;

use agglo::engine::hard::Simulation;
use agglo::packing::place;
use agglo::scenario::Scenario;
use divan::Bencher;
use divan::counter::ItemsCount;

fn main() {
    divan::main();
}

/// Spheres, and the part of the volume that they fill.
const GASES: [(u32, f64); 8] = [
    (1_400, 0.05),
    (10_000, 0.05),
    (100_000, 0.05),
    (1_000_000, 0.05),
    (1_400, 0.25),
    (10_000, 0.25),
    (100_000, 0.25),
    (1_000_000, 0.25),
];
/// Impacts per sample at the least.
const LEAST: u64 = 100_000;

/// Impacts per second on one thread, after one impact for each sphere. Every sample is the same stretch of time.
#[divan::bench(args = GASES, sample_count = 3, sample_size = 1)]
fn elastic_gas(bencher: Bencher, (spheres, solid_fraction): (u32, f64)) {
    let wanted = u64::from(spheres / 2).max(LEAST);
    let mut warm = gas::start(spheres, solid_fraction);
    gas::collide(&mut warm, u64::from(spheres / 2));
    let mut once = warm.clone();
    gas::collide(&mut once, wanted);
    let (done, until) = (gas::impacts(&once) - gas::impacts(&warm), once.clock().time);
    drop(once);
    bencher.counter(ItemsCount::new(done)).with_inputs(|| warm.clone()).bench_local_refs(|simulation| {
        while simulation.clock().time < until {
            simulation.advance(until).unwrap_or_else(|error| panic!("{error}"));
        }
    });
}

/// The best set of the published search from placement to its end, without files.
#[divan::bench(sample_count = 5, sample_size = 1)]
fn published_set_1(bencher: Bencher) {
    let text = include_str!("../../../scenarios/reacting-set-1.toml");
    let scenario = Scenario::from_toml(text).unwrap_or_else(|faults| panic!("{faults}"));
    bencher.bench_local(|| {
        let grains = place(&scenario, Path::new(".")).unwrap_or_else(|error| panic!("{error}"));
        let mut simulation = Simulation::start(&scenario, &grains).unwrap_or_else(|error| panic!("{error}"));
        simulation.system_mut().keeps_events = false;
        while !simulation.is_finished() {
            simulation.advance(f64::INFINITY).unwrap_or_else(|error| panic!("{error}"));
        }
        simulation.grains()
    });
}
