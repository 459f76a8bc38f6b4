//! Small systems of hard spheres for tests of the engines, in a cube of 2 cm about the origin.

use super::Simulation;
use crate::math::Vec3;
use crate::math::rng::{Purpose, Stream};
use crate::particles::{Particles, Row};
use crate::testing::Scenario;

/// Density of all grains [kg/m³].
pub const DENSITY: f64 = 1000.0;
/// The four kinds of faces.
pub const BOUNDARIES: [&str; 4] = ["periodic", "antipodal", "reflecting", "open"];
/// The engine from collision to collision without a guard against collapse, which a brute force does not know.
pub const EVENTS: &str = "[engine.event_driven]\ncontact_duration = \"0 s\"";

/// A scenario of this engine, these laws and this kind of faces.
pub fn scenario(engine: &str, boundary: &str, impact: &str) -> Scenario {
    let text = format!(
        "version = 1\ntime.end = \"1 s\"\n{engine}\n\
         [materials.stone]\ndensity = \"1000 kg/m3\"\nheat_capacity = \"1000 J/kg/K\"\nsurface_energy = \"1 J/m^2\"\n\
         emissivity = 0.5\n\
         [[grains]]\nmaterial = \"stone\"\nsize.constant.radius = \"1 mm\"\nplacement.table.file = \"none\"\n\
         [volume]\nlower = [\"-1 cm\", \"-1 cm\", \"-1 cm\"]\nupper = [\"1 cm\", \"1 cm\", \"1 cm\"]\n\
         boundary = \"{boundary}\"\n{impact}\n"
    );
    toml::from_str(&text).unwrap()
}

/// The law of a constant restitution.
pub fn restitution(e: f64) -> String {
    format!("[impact.restitution.constant]\nrestitution = {e}")
}

/// A grain: position [m], velocity [m/s], radius [m].
pub type Grain = ([f64; 3], [f64; 3], f64);

/// Grains with ids in their order.
pub fn particles(grains: &[Grain]) -> Particles {
    let mut particles = Particles::default();
    for (&(position, velocity, radius), id) in grains.iter().zip(0..) {
        particles.push(Row {
            id,
            position: position.into(),
            velocity: velocity.into(),
            radius,
            mass: DENSITY * 4.0 / 3.0 * std::f64::consts::PI * radius * radius * radius,
            temperature: 300.0,
            polarity: 1.0,
            ..Row::default()
        });
    }
    particles
}

/// A simulation of these grains.
pub fn start(scenario: &Scenario, grains: &[Grain]) -> Simulation {
    Simulation::start(scenario, &particles(grains)).unwrap()
}

/// Advances to a time [s].
pub fn advance_to(simulation: &mut Simulation, until: f64) {
    let mut turns = agglo_testing::Turns::at_most(10_000_000, "the time that is due");
    while simulation.clock().time < until {
        turns.take();
        simulation.advance(until).unwrap_or_else(|error| panic!("{error}"));
    }
}

/// Grains wholly inside the cube that do not overlap, radii from `largest` [m] down to `largest`/`ratio`, evenly by their
/// logarithm; each component of a velocity up to 20 m/s, and `inwards` [1/s] times the place toward the middle.
pub fn crowd(n: usize, largest: f64, ratio: f64, inwards: f64, seed: u64) -> Vec<Grain> {
    let mut stream = Stream::new(seed, Purpose::Sampling, 0);
    let mut grains: Vec<Grain> = Vec::new();
    while grains.len() < n {
        let mut between = |low: f64, high: f64| low + (high - low) * stream.uniform();
        let radius = largest * ratio.powf(-between(0.0, 1.0));
        let position = [(); 3].map(|()| between(-0.01 + radius, 0.01 - radius));
        let velocity = position.map(|along| between(-20.0, 20.0) - inwards * along);
        let clear = |other: &Grain| (Vec3::from(other.0) - Vec3::from(position)).norm() > other.2 + radius;
        if grains.iter().all(clear) {
            grains.push((position, velocity, radius));
        }
    }
    grains
}
