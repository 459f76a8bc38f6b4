//! Rays: the whole of a first pulse, and segments per second at three sizes, on one thread.

use agglo::acoustics::fresnel::Interface;
use agglo::acoustics::{Beam, Ends, Flight, Medium, Pattern, Profile, Pulses, Strength, Targets, Tracer};
use agglo::math::Vec3;
use agglo::math::rng::{Purpose, Stream};
use agglo::units::Quantity;
use divan::counter::ItemsCount;

const CERAMIC: Interface = Interface { impedance_ratio: 18.0, speed_ratio: 1.0 / 3.0, shear_ratio: 0.0 };

fn main() {
    // One thread for all: what is measured is the cost of a segment.
    match rayon::ThreadPoolBuilder::new().num_threads(1).build_global() {
        Ok(()) => divan::main(),
        Err(error) => unreachable!("no pool was built before: {error}"),
    }
}

/// `count` spheres in the unit ball at the packing fraction of the paper's problem (a quarter): points of a
/// jittered lattice, since only the spacing matters here.
fn packing(count: usize) -> (Vec<Vec3>, Vec<f64>, Vec<u32>) {
    let radius = (0.25 / count as f64).cbrt();
    let mut stream = Stream::new(1, Purpose::Sampling, 0);
    let spacing = (4.0 / 3.0 * std::f64::consts::PI / count as f64).cbrt();
    let layers = (1.0 / spacing).ceil() as i32;
    let mut positions = Vec::new();
    for x in -layers..=layers {
        for y in -layers..=layers {
            for z in -layers..=layers {
                let jitter = stream.direction() * (0.5 * (spacing - 2.0 * radius));
                let place = Vec3::new(x.into(), y.into(), z.into()) * spacing + jitter;
                if place.norm() + radius < 1.0 {
                    positions.push(place);
                }
            }
        }
    }
    let count = positions.len();
    (positions, vec![radius; count], vec![0; count])
}

fn beam() -> Beam {
    Beam {
        start: [0.0, 0.0, -1.0].map(Quantity),
        direction: [0.1, 0.2, 1.0],
        radius: Quantity(1.0),
        rays: 10_000,
        strength: Strength::Power(Quantity(4.7e10)),
        pattern: Pattern::Random,
        profile: Profile::Uniform,
        pulses: Pulses::default(),
        frequency: None,
    }
}

/// From nothing to the end of the pulse: grid, launch and tracing.
#[divan::bench]
fn first_pulse_of_10_000_rays_on_2_000_spheres(bencher: divan::Bencher<'_, '_>) {
    let (positions, radii, material) = packing(2000);
    let targets = Targets { positions: &positions, radii: &radii, material: &material, mach: 0.0 };
    bencher.bench_local(|| {
        let mut tracer = Tracer::new(Ends::default(), vec![CERAMIC]);
        let mut flight = Flight::default();
        flight.launch(&beam(), &Medium::default(), 1, 0, 0);
        tracer.trace(&mut flight, &targets).len()
    });
}

/// Segments per second, buffers warm; the items are segments.
#[divan::bench(args = [2_000, 20_000, 200_000])]
fn segments(bencher: divan::Bencher<'_, '_>, count: usize) {
    let (positions, radii, material) = packing(count);
    let targets = Targets { positions: &positions, radii: &radii, material: &material, mach: 0.0 };
    let mut tracer = Tracer::new(Ends::default(), vec![CERAMIC]);
    let mut start = Flight::default();
    start.launch(&beam(), &Medium::default(), 1, 0, 0);
    let mut end = start.clone();
    tracer.trace(&mut end, &targets);
    bencher
        .counter(ItemsCount::new(end.pulses()[0].segments))
        .with_inputs(|| start.clone())
        .bench_local_refs(|flight| tracer.trace(flight, &targets).len());
}

/// Building the grid, as when grains have moved by the margin.
#[divan::bench(args = [2_000, 20_000, 200_000])]
fn grid_build(bencher: divan::Bencher<'_, '_>, count: usize) {
    let (positions, radii, _) = packing(count);
    let mut moved = positions.clone();
    for place in &mut moved {
        *place += Vec3::AXES[0] * (0.2 * radii[0]);
    }
    let mut grid =
        agglo::neighbors::ray_grid::RayGrid::new(Vec3::new(-1.0, -1.0, -1.0), Vec3::new(1.0, 1.0, 1.0));
    let mut flip = false;
    bencher.counter(ItemsCount::new(count)).bench_local(|| {
        flip = !flip;
        grid.update(if flip { &positions } else { &moved }, &radii);
        grid.builds()
    });
}

/// The same pulse in steps of a tenth of a radius, as a run takes them, until all but one ray in a hundred is gone.
#[divan::bench]
fn pulse_in_steps(bencher: divan::Bencher<'_, '_>) {
    let (positions, radii, material) = packing(2000);
    let targets = Targets { positions: &positions, radii: &radii, material: &material, mach: 0.0 };
    let mut tracer = Tracer::new(Ends::default(), vec![CERAMIC]);
    let mut start = Flight::default();
    start.launch(&beam(), &Medium::default(), 1, 0, 0);
    bencher.with_inputs(|| start.clone()).bench_local_refs(|flight| {
        let mut steps = 0;
        while flight.rays().len() > 100 {
            tracer.advance(flight, &targets, 0.1 * radii[0], |hits| {
                divan::black_box(hits.len());
            });
            steps += 1;
        }
        steps
    });
}
