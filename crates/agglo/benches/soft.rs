//! Soft spheres: whole steps at three sizes, and the whole published sample problem.

use agglo::engine::soft::Simulation;
use agglo::math::rng::{Purpose, Stream};
use agglo::packing::place;
use agglo::particles::Particles;
use agglo::scenario::Scenario;
use divan::Bencher;
use divan::counter::ItemsCount;
use std::path::Path;

fn main() {
    divan::main();
}

/// Steps per sample of the lattice.
const STEPS: u64 = 20;

/// Laws of contact with friction, in steps of 5 ns.
const LAWS: &str = r#"
version = 1
time.end = "1 s"
engine.verlet.step = "5 ns"
medium.density = "1 kg/m3"
[materials.glass]
density = "2500 kg/m3"
youngs_modulus = "10 MPa"
poisson_ratio = 0.3
[contact.normal.hertz]
[contact.damping.restitution]
restitution = 0.5
[contact.friction.mindlin]
static_friction = 0.5
"#;

/// A cubic lattice of `edge`³ grains that overlap by 1 % and shake: six contacts a grain, with friction.
fn shaking_lattice(edge: u32) -> Simulation {
    let lattice = format!(
        r#"
        [[grains]]
        material = "glass"
        size.constant.radius = "1 um"
        [grains.placement.lattice]
        kind = "cubic"
        spacing = "2 um"
        [grains.placement.lattice.region.box]
        lower = ["0 m", "0 m", "0 m"]
        upper = ["{side} um", "{side} um", "{side} um"]
        "#,
        side = 2.0 * f64::from(edge) + 0.01
    );
    let scenario =
        Scenario::from_toml(&(LAWS.to_owned() + &lattice)).unwrap_or_else(|faults| panic!("{faults}"));
    let mut grains = place(&scenario, Path::new(".")).unwrap_or_else(|error| panic!("{error}"));
    grains.position.iter_mut().for_each(|position| *position *= 0.99);
    shaken(&scenario, grains)
}

/// Grains with velocities of 0.1 m/s in all directions, after their first step.
fn shaken(scenario: &Scenario, mut grains: Particles) -> Simulation {
    let mut stream = Stream::new(1, Purpose::Velocity, 0);
    grains.velocity.iter_mut().for_each(|velocity| *velocity = stream.direction() * 0.1);
    let mut simulation = Simulation::start(scenario, grains).unwrap_or_else(|error| panic!("{error}"));
    simulation.step().unwrap_or_else(|error| panic!("{error}"));
    simulation
}

fn steps(simulation: &mut Simulation) {
    let clock = simulation.clock();
    let until = clock.time + (STEPS as f64 - 0.5) * clock.next_step;
    while simulation.clock().time < until {
        simulation.advance(until).unwrap_or_else(|error| panic!("{error}"));
    }
}

/// Grain-steps per second, Hertz and Mindlin; `edge`³ grains.
#[divan::bench(args = [21, 46, 100], sample_count = 5, sample_size = 1)]
fn grain_steps(bencher: Bencher, edge: u32) {
    let mut simulation = shaking_lattice(edge);
    let grains = simulation.system.grains.len();
    bencher.counter(ItemsCount::new(grains as u64 * STEPS)).bench_local(|| steps(&mut simulation));
}

/// Small grains of the bench of sizes.
const SMALL: usize = 100_000;

/// Centers and radii [um] of large spheres that are coated with layers of small ones, `ratio` times smaller, of which there are as
/// many as take the same volume, or all.
fn coated(ratio: f64) -> Vec<([f64; 3], f64)> {
    let each = (ratio.powi(3) as usize).clamp(1, SMALL);
    // A layer that touches the large sphere, even over its surface (Fibonacci's spiral), and a lattice about it.
    let layer = (0.74 * std::f64::consts::PI * (ratio + 1.0).powi(2)) as usize;
    let turn = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let on_layer = |k: usize| {
        let z = 1.0 - (2 * k + 1) as f64 / layer as f64;
        let (sin, cos) = (turn * k as f64).sin_cos();
        [(1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z].map(|part| part * (ratio + 0.99))
    };
    let norm = |place: &[f64; 3]| place.iter().map(|part| part * part).sum::<f64>().sqrt();
    let reach = (ratio + 3.0).max(((each as f64).cbrt() + ratio) * 1.3) as i32;
    let row = || (-reach..=reach).map(|at| f64::from(at) * 1.98);
    let sites = row().flat_map(|x| row().flat_map(move |y| row().map(move |z| [x, y, z])));
    let mut about: Vec<[f64; 3]> = sites.filter(|site| norm(site) > ratio + 3.0).collect();
    about.sort_by(|a, b| norm(a).total_cmp(&norm(b)));
    about.truncate(each.saturating_sub(layer));
    let width = 2.0 * about.iter().map(norm).fold(ratio + 2.0, f64::max) + 2.0;
    let mut all = Vec::new();
    for number in 0..(SMALL / each) as u32 {
        let corner = [number % 3, number / 3 % 3, number / 9].map(|at| f64::from(at) * width);
        let moved = |place: [f64; 3]| [0, 1, 2].map(|axis| place[axis] + corner[axis]);
        all.push((corner, ratio));
        all.extend((0..layer).map(on_layer).chain(about.iter().copied()).map(|place| (moved(place), 1.0)));
    }
    all
}

/// Contacts per second among large grains and small ones of the same volume (at a hundredth: a tenth of that).
#[divan::bench(args = [20, 100], sample_count = 5, sample_size = 1)]
fn contacts_of_two_sizes(bencher: Bencher, ratio: u32) {
    let places = coated(f64::from(ratio));
    let text = LAWS.to_owned() + "[[grains]]\nmaterial = \"glass\"\nplacement.table.file = \"grains.csv\"\n";
    let rows: String =
        places.iter().fold("x_m,y_m,z_m,radius_m\n".to_owned(), |text, ([x, y, z], radius)| {
            text + &format!("{x}e-6,{y}e-6,{z}e-6,{radius}e-6\n")
        });
    let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
    std::fs::write(folder.path().join("grains.csv"), rows).unwrap_or_else(|error| panic!("{error}"));
    let scenario = Scenario::from_toml(&text).unwrap_or_else(|faults| panic!("{faults}"));
    let grains = place(&scenario, folder.path()).unwrap_or_else(|error| panic!("{error}"));
    contacts(bencher, shaken(&scenario, grains));
}

/// The same among equal grains.
#[divan::bench(sample_count = 5, sample_size = 1)]
fn contacts_of_one_size(bencher: Bencher) {
    contacts(bencher, shaking_lattice(46));
}

fn contacts(bencher: Bencher, mut simulation: Simulation) {
    let touching = simulation.system.remembered().len();
    bencher.counter(ItemsCount::new(touching as u64 * STEPS)).bench_local(|| steps(&mut simulation));
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
