//! Soft spheres: whole steps at three sizes, and the whole published sample problem.

use agglo::engine::soft::Simulation;
use agglo::math::rng::{Purpose, Stream};
use agglo::packing::place;
use agglo::scenario::Scenario;
use divan::Bencher;
use divan::counter::ItemsCount;
use std::path::Path;

fn main() {
    divan::main();
}

/// Steps per sample of the lattice.
const STEPS: u64 = 20;

/// A cubic lattice of `edge`³ grains that overlap by 1 % and shake: six contacts a grain, with friction.
fn shaking_lattice(edge: u32) -> Simulation {
    let text = format!(
        r#"
        version = 1
        time.end = "1 s"
        engine.verlet.step = "5 ns"
        medium.density = "1 kg/m3"
        [materials.glass]
        density = "2500 kg/m3"
        youngs_modulus = "10 MPa"
        poisson_ratio = 0.3
        [[grains]]
        material = "glass"
        size.constant.radius = "1 um"
        [grains.placement.lattice]
        kind = "cubic"
        spacing = "2 um"
        [grains.placement.lattice.region.box]
        lower = ["0 m", "0 m", "0 m"]
        upper = ["{side} um", "{side} um", "{side} um"]
        [contact.normal.hertz]
        [contact.damping.restitution]
        restitution = 0.5
        [contact.friction.mindlin]
        static_friction = 0.5
        "#,
        side = 2.0 * f64::from(edge) + 0.01
    );
    let scenario = Scenario::from_toml(&text).unwrap_or_else(|faults| panic!("{faults}"));
    let mut grains = place(&scenario, Path::new(".")).unwrap_or_else(|error| panic!("{error}"));
    let mut stream = Stream::new(1, Purpose::Velocity, 0);
    grains.position.iter_mut().for_each(|position| *position *= 0.99);
    grains.velocity.iter_mut().for_each(|velocity| *velocity = stream.direction() * 0.1);
    let mut simulation = Simulation::start(&scenario, grains).unwrap_or_else(|error| panic!("{error}"));
    simulation.step().unwrap_or_else(|error| panic!("{error}"));
    simulation
}

/// Grain-steps per second, Hertz and Mindlin; `edge`³ grains.
#[divan::bench(args = [21, 46, 100], sample_count = 5, sample_size = 1)]
fn grain_steps(bencher: Bencher, edge: u32) {
    let mut simulation = shaking_lattice(edge);
    let grains = simulation.system.grains.len();
    bencher.counter(ItemsCount::new(grains as u64 * STEPS)).bench_local(|| {
        let clock = simulation.clock();
        let until = clock.time + (STEPS as f64 - 0.5) * clock.next_step;
        while simulation.clock().time < until {
            simulation.advance(until).unwrap_or_else(|error| panic!("{error}"));
        }
    });
}

/// The published sample problem from placement to its end, without files.
#[divan::bench(sample_count = 3, sample_size = 1)]
fn published_sample_problem(bencher: Bencher) {
    let text = include_str!("../../../scenarios/acoustic-dispersal-published.toml");
    let scenario = Scenario::from_toml(text).unwrap_or_else(|faults| panic!("{faults}"));
    bencher.bench_local(|| {
        rayon::scope(|_| {
            let grains = place(&scenario, Path::new(".")).unwrap_or_else(|error| panic!("{error}"));
            let mut simulation =
                Simulation::start(&scenario, grains).unwrap_or_else(|error| panic!("{error}"));
            while !simulation.is_finished() {
                simulation.advance(simulation.end()).unwrap_or_else(|error| panic!("{error}"));
            }
        });
    });
}
