//! Scenarios of hard spheres in few words, and means with their errors.

use std::f64::consts::PI;
use std::io::Write;

use agglo::engine::hard::Simulation;
use agglo::math::Vec3;
use agglo::particles::Particles;

use crate::common;

/// From impact to impact.
pub const EVENTS: &str = "[engine.event_driven]\n";
/// Step by step, with the shortest step that is asked for nowhere else.
pub const STEPS: &str = "[engine.time_stepped]\nshortest_step = \"1 ns\"\n";

/// Spheres of one size with Maxwell's velocities of 1 m/s along each axis, in a periodic cube.
#[derive(Clone, Copy, Debug)]
pub struct Gas<'a> {
    pub count: u32,
    pub solid_fraction: f64,
    pub seed: u64,
    /// Radius [m].
    pub radius: f64,
    /// Tables of the engine.
    pub engine: &'a str,
    /// Keys of the material besides its density of 2500 kg/m³.
    pub material: &'a str,
    /// Tables of the impacts.
    pub impact: &'a str,
}

impl Default for Gas<'_> {
    fn default() -> Self {
        Self {
            count: 4_000,
            solid_fraction: 0.05,
            seed: 1,
            radius: 1e-3,
            engine: EVENTS,
            material: "",
            impact: ELASTIC,
        }
    }
}

/// Nothing is lost.
pub const ELASTIC: &str = "[impact.restitution.constant]\nrestitution = 1.0\n";
/// Whatever meets becomes one.
pub const STICKY: &str = "[impact.restitution.constant]\nrestitution = 0.0\n";

impl Gas<'_> {
    /// Edge of the cube [m].
    pub fn edge(&self) -> f64 {
        (f64::from(self.count) * ball(self.radius) / self.solid_fraction).cbrt()
    }

    /// Its scenario.
    pub fn text(&self) -> String {
        let Self { count, seed, radius, engine, material, impact, .. } = self;
        let edge = self.edge();
        format!(
            "version = 1\nseed = {seed}\ntime.end = \"1e9 s\"\n{engine}\n\
             [volume]\nlower = [\"0 m\", \"0 m\", \"0 m\"]\n\
             upper = [\"{edge:?} m\", \"{edge:?} m\", \"{edge:?} m\"]\nboundary = \"periodic\"\n\
             [materials.glass]\ndensity = \"2500 kg/m3\"\n{material}\n\
             [[grains]]\nmaterial = \"glass\"\nsize.constant.radius = \"{radius:?} m\"\nplacement.fill.count = {count}\n\
             velocity_spread.maxwell = {{ deviation = \"1 m/s\", centered = true }}\n{impact}\n"
        )
    }

    /// At its start.
    pub fn start(&self) -> Simulation {
        start(&self.text(), |_| {})
    }

    /// At its start, with the grains of another simulation as they are now.
    pub fn start_with(&self, other: &Simulation) -> Simulation {
        Simulation::start(&common::scenario(&self.text()), &other.snapshot().grains).unwrap()
    }
}

/// Volume of a ball [m³].
pub fn ball(radius: f64) -> f64 {
    4.0 / 3.0 * PI * radius * radius * radius
}

/// A simulation of a scenario of text, its grains changed as wanted; events are not written down.
pub fn start(text: &str, change: impl FnOnce(&mut Particles)) -> Simulation {
    let scenario = common::scenario(text);
    let grains = common::grains(&scenario, change);
    let mut simulation = Simulation::start(&scenario, &grains).unwrap_or_else(|error| panic!("{error}"));
    simulation.system_mut().keeps_events = false;
    simulation
}

/// Goes on to a time [s] or the end.
pub fn run_until(simulation: &mut Simulation, until: f64) {
    let mut turns = agglo_testing::Turns::at_most(100_000_000, "the time or the impacts that are due");
    while simulation.clock().time < until && !simulation.is_finished() {
        turns.take();
        simulation.advance(until).unwrap_or_else(|error| panic!("{error}"));
    }
}

/// Goes on to the end.
pub fn finish(simulation: &mut Simulation) {
    run_until(simulation, f64::INFINITY);
}

/// Goes on for at least this many impacts.
pub fn collide(simulation: &mut Simulation, more: u64) {
    let goal = impacts(simulation) + more;
    let mut turns = agglo_testing::Turns::at_most(100_000_000, "the time or the impacts that are due");
    while impacts(simulation) < goal {
        turns.take();
        simulation.advance(f64::INFINITY).unwrap_or_else(|error| panic!("{error}"));
    }
}

/// Impacts so far.
pub fn impacts(simulation: &Simulation) -> u64 {
    simulation.system().state.counts.collisions
}

/// Kinetic energy [J] now.
pub fn kinetic(simulation: &Simulation) -> f64 {
    simulation.balance().stored.kinetic
}

/// Granular temperature k T/m [m²/s²] of equal spheres: the mean velocity is fixed and no degree of freedom.
pub fn temperature(simulation: &Simulation) -> f64 {
    let velocities = simulation.snapshot().grains.velocity;
    let n = velocities.len() as f64;
    let mean = velocities.iter().fold(Vec3::ZERO, |sum, velocity| sum + *velocity) / n;
    velocities.iter().map(|velocity| (*velocity - mean).norm_squared()).sum::<f64>() / (3.0 * (n - 1.0))
}

/// Carnahan and Starling's value of the pair distribution at contact.
pub fn carnahan_starling(solid_fraction: f64) -> f64 {
    (1.0 - 0.5 * solid_fraction) / (1.0 - solid_fraction).powi(3)
}

/// Enskog's rate of impacts of one sphere [1/s], 4 n σ² χ √(π k T/m), with the granular temperature [m²/s²].
pub fn enskog(gas: &Gas<'_>, contact_value: f64, temperature: f64) -> f64 {
    let density = gas.solid_fraction / ball(gas.radius);
    4.0 * density * (2.0 * gas.radius).powi(2) * contact_value * (PI * temperature).sqrt()
}

/// A mean and its standard error.
#[derive(Clone, Copy, Debug)]
pub struct Mean {
    pub mean: f64,
    pub error: f64,
}

impl Mean {
    /// Of values that do not depend on one another.
    pub fn of(values: &[f64]) -> Self {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let variance = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (n - 1.0);
        Self { mean, error: (variance / n).sqrt() }
    }

    /// How many combined standard errors lie between two means.
    pub fn apart(&self, other: &Self) -> f64 {
        (self.mean - other.mean).abs() / self.error.hypot(other.error)
    }
}

/// Books that hold but for rounding, which 1e-12 of the whole leaves ample room for: energy and momentum.
pub fn assert_ledger(simulation: &Simulation) {
    let (balance, momentum) = (simulation.balance(), simulation.momentum_drift_relative());
    assert!(balance.kinetic_drift_relative.abs() < 1e-12, "{balance:?}");
    assert!(balance.drift_relative.abs() < 1e-12, "{balance:?}");
    assert!(momentum < 1e-12, "{momentum:e}");
}

/// Says what was found, where tests are run with `--nocapture`.
pub fn report(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}
