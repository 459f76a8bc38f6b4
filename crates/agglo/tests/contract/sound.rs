//! The contracts of rays among walls and across faces: a crowd between a floor and a moving lid, in space that repeats itself along x and y.

use agglo::engine::soft::Simulation;
use agglo::particles::Particles;
use rayon::ThreadPoolBuilder;

use crate::{common, crowd};

/// Grains of 4 % beside others, hit by rays that no side lets out.
fn text(engine: &str, count: u32) -> String {
    let edge = 20e-6 * (4.2 * f64::from(count) / 0.12).cbrt();
    let (low, high) = (25e-6, edge - 25e-6);
    format!(
        r#"
version = 1
seed = 7
time.end = "1 s"
{engine}
[limits]
strain = 0.4
[volume]
lower = ["0 m", "0 m", "0 m"]
upper = ["{edge:e} m", "{edge:e} m", "{edge:e} m"]
faces.z = "open"
[materials.pigment]
density = "4000 kg/m3"
sound_speed = "5000 m/s"
youngs_modulus = "1 GPa"
poisson_ratio = 0.25
[[grains]]
material = "pigment"
size.uniform = {{ smallest = "12 um", largest = "24 um" }}
placement.random.count = {count}
placement.random.region.box = {{ lower = ["0 m", "0 m", "{low:e} m"], upper = ["{edge:e} m", "{edge:e} m", "{high:e} m"] }}
velocity_spread.maxwell.deviation = "1.5 m/s"
[contact.normal.hertz]
[[walls]]
name = "floor"
material = "pigment"
shape.plane = {{ point = ["0 m", "0 m", "0 m"], normal = [0.0, 0.0, 1.0] }}
[[walls]]
name = "lid"
material = "pigment"
shape.plane = {{ point = ["0 m", "0 m", "{edge:e} m"], normal = [0.0, 0.0, -1.0] }}
motion.oscillating = {{ amplitude = ["0 m", "0 m", "1 um"], frequency = "0.2 MHz" }}
[acoustics]
truncation = 0.05
[acoustics.force.radiation_pressure]
duration = "50 ns"
[[acoustics.beams]]
start = ["{middle:e} m", "{middle:e} m", "10 um"]
direction = [0.6, 0.3, 1.0]
radius = "5 um"
rays = 600
strength.pressure = "20 MPa"
pulses = {{ first = "0 s", period = "0.4 us", count = 1000 }}
"#,
        middle = 0.5 * edge
    )
}

/// Grains are placed wholly inside; moved until the foremost is about to go out of a face, which it does soon.
fn to_the_faces(grains: &mut Particles) {
    let nearer = |a: &usize, b: &usize| grains.position[*a].x.total_cmp(&grains.position[*b].x);
    let foremost = (0..grains.len()).min_by(nearer).unwrap();
    let way = grains.position[foremost].x - 1e-8;
    grains.position.iter_mut().for_each(|place| place.x -= way);
    grains.velocity[foremost].x = -2.0;
}

fn assert_busy(simulation: &Simulation) {
    let count = |of: fn(&agglo::acoustics::PulseCount) -> u64| -> u64 {
        simulation.pulses.counts().iter().map(of).sum()
    };
    assert_above!(count(|pulse| pulse.reflections_at_walls), 300, "bounces at walls");
    assert_above!(count(|pulse| pulse.reflections - pulse.reflections_at_walls), 300, "bounces at grains");
    let images = &simulation.system.images;
    assert_above!(images.iter().filter(|image| **image != [0; 3]).count(), 0, "grains that went out");
    let space = &simulation.system.space;
    let is_out = |place| space.home(place).0 != place;
    let rays = simulation.pulses.flight().rays();
    assert_above!(
        rays.iter().filter(|ray| is_out(ray.position())).count(),
        0,
        "rays that have crossed faces"
    );
}

#[test]
fn same_bits_on_1_and_5_threads() {
    for engine in [crowd::VERLET, crowd::ADAPTIVE] {
        let after = |threads: usize| {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut simulation = common::start(&text(engine, 200), to_the_faces);
                common::steps(&mut simulation, 180);
                assert_busy(&simulation);
                common::bytes(&simulation)
            })
        };
        common::assert_same_state(&after(5), &after(1), &format!("5 threads and one, {engine}"));
    }
}

#[test]
fn a_run_goes_on_with_the_same_bits() {
    for engine in [crowd::VERLET, crowd::ADAPTIVE] {
        let text = text(engine, 80);
        let scenario = common::scenario(&text);
        let mut whole = common::start(&text, to_the_faces);
        for stop in 0..5 {
            common::steps(&mut whole, 80);
            let mut resumed = Simulation::resume(&scenario, common::written_and_read(&whole)).unwrap();
            common::steps(&mut whole, 5);
            common::steps(&mut resumed, 5);
            let when = format!("resumed, stop {stop}");
            common::assert_same_state(&common::bytes(&resumed), &common::bytes(&whole), &when);
        }
        assert_busy(&whole);
    }
}

/// All that rays lose, grains and walls get: momentum of grains closes in the ledger, and with the impulses of walls it is that of the
/// beam, P/c for the time that a hit presses, but for what rays still carry or took with them.
#[test]
fn momentum_of_rays_goes_to_grains_and_walls() {
    let text = text(crowd::VERLET, 80).replace("count = 1000", "count = 1");
    let mut simulation = common::start(&text, |_| {});
    common::steps(&mut simulation, 200);
    let flight = simulation.pulses.flight();
    let pulse = flight.pulses()[0];
    let carried = flight.rays().iter().fold(pulse.flow_ended, |sum, ray| sum + ray.direction * ray.power);
    let scale = 50e-9 / 1500.0;
    let beam = agglo::math::Vec3::new(0.6, 0.3, 1.0).normalized() * (pulse.power_in * scale);
    let on_walls = simulation.pulses.given_to(0).impulse + simulation.pulses.given_to(1).impulse;
    let on_grains = simulation.ledger.flows.rays.force;
    assert_above!(on_walls.norm(), 1e-3 * beam.norm(), "N s on walls");
    // Sums of some ten thousand hits.
    assert_near_vector!(on_grains + on_walls + carried * scale, beam, 1e-10 * beam.norm(), "N s");
    let momentum = simulation.momentum();
    let drift = simulation.momentum_drift(&momentum).linear.norm();
    assert_below!(drift, 1e-6 * beam.norm(), "kg m/s that no impulse explains");
    let energy: f64 = (0..2).map(|wall| simulation.pulses.given_to(wall).energy).sum();
    assert_close!(energy, pulse.power_into_walls * 50e-9, 1e-12, "J");
}
