//! Pictures: one of 1280 x 720 pixels of agglomerates of three sizes, on all processors.

use agglo::math::Vec3;
use agglo::math::rng::{Purpose, Stream};
use agglo_view::render::{Camera, Scene, Side, Sphere};

fn main() {
    divan::main();
}

/// `count` spheres strewn over the unit ball, as large as a quarter of its volume allows.
fn agglomerate(count: usize) -> Scene {
    let radius = (0.25 / count as f64).cbrt();
    let mut stream = Stream::new(1, Purpose::Sampling, 0);
    let sphere = |_| {
        let center: Vec3 = stream.direction() * stream.uniform().cbrt();
        Sphere { center, radius, color: [0.3, 0.5, 0.8] }
    };
    Scene { spheres: (0..count).map(sphere).collect(), ..Scene::default() }
}

#[divan::bench(args = [2_000, 20_000, 200_000], sample_count = 10)]
fn picture(bencher: divan::Bencher<'_, '_>, count: usize) {
    let scene = agglomerate(count);
    let camera = Camera::framing(Vec3::ZERO, [1.1; 3], Side::default(), [1280, 720]);
    bencher.bench_local(|| scene.draw(&camera));
}
