//! An elastic gas of hard spheres, for measuring the speed of the event-driven engine.

use std::path::Path;

use agglo::engine::hard::Simulation;
use agglo::packing::place;
use agglo::scenario::Scenario;

/// Radius of the spheres [m].
const RADIUS: f64 = 1e-3;

/// Spheres of radius 1 mm with a Maxwell distribution of 1 m/s along each axis in a periodic cube: nothing sticks,
/// nothing is lost.
pub fn start(spheres: u32, solid_fraction: f64) -> Simulation {
    let volume = f64::from(spheres) * 4.0 / 3.0 * std::f64::consts::PI * RADIUS.powi(3) / solid_fraction;
    let text = format!(
        r#"
        version = 1
        time.end = "1e6 s"
        [engine.event_driven]
        [volume]
        lower = ["0 m", "0 m", "0 m"]
        upper = ["{edge:?} m", "{edge:?} m", "{edge:?} m"]
        boundary = "periodic"
        [materials.glass]
        density = "2500 kg/m3"
        [[grains]]
        material = "glass"
        size.constant.radius = "{RADIUS:?} m"
        placement.fill.count = {spheres}
        velocity_spread.maxwell = {{ deviation = "1 m/s", centered = true }}
        [impact.restitution.constant]
        restitution = 1.0
        "#,
        edge = volume.cbrt()
    );
    let scenario = Scenario::from_toml(&text).unwrap_or_else(|faults| panic!("{faults}"));
    let grains = place(&scenario, Path::new(".")).unwrap_or_else(|error| panic!("{error}"));
    Simulation::start(&scenario, &grains).unwrap_or_else(|error| panic!("{error}"))
}

/// Impacts so far.
pub fn impacts(simulation: &Simulation) -> u64 {
    simulation.system().state.counts.collisions
}

/// Goes on for at least this many impacts, and some thousand events more.
pub fn collide(simulation: &mut Simulation, more: u64) {
    let goal = impacts(simulation) + more;
    while impacts(simulation) < goal {
        simulation.advance(f64::INFINITY).unwrap_or_else(|error| panic!("{error}"));
    }
}
