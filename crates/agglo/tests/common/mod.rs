//! Small scenarios for tests: one or two lines of law over a fixed frame, and grains set as a test wants them.

#![allow(dead_code, reason = "each test program uses its own part of it")]

mod figures;

use std::path::Path;

use agglo::engine::soft::{Simulation, SimulationState};
use agglo::math::Vec3;
use agglo::packing;
use agglo::particles::{Particles, Row};
use agglo::scenario::Scenario;
use serde_json::Value as Json;

pub use figures::found;

/// A scenario of text, which must be valid.
pub fn scenario(text: &str) -> Scenario {
    Scenario::from_toml(text).unwrap_or_else(|faults| panic!("{faults}\n{text}"))
}

/// The grains that a scenario places, changed as wanted.
pub fn grains(scenario: &Scenario, change: impl FnOnce(&mut Particles)) -> Particles {
    let mut grains = packing::place(scenario, Path::new(".")).unwrap();
    change(&mut grains);
    grains
}

/// A simulation of a scenario of text with its grains changed as wanted.
pub fn start(text: &str, change: impl FnOnce(&mut Particles)) -> Simulation {
    let scenario = scenario(text);
    let grains = grains(&scenario, change);
    Simulation::start(&scenario, grains).unwrap_or_else(|error| panic!("{error}"))
}

/// Steps to the end.
pub fn finish(simulation: &mut Simulation) {
    watch(simulation, |_| {});
}

/// Steps to the end; `look` sees the simulation after every step.
pub fn watch(simulation: &mut Simulation, mut look: impl FnMut(&Simulation)) {
    let mut turns = agglo_testing::Turns::at_most(50_000_000, "the end of the run");
    while !simulation.is_finished() {
        turns.take();
        simulation.step().unwrap_or_else(|error| panic!("{error}"));
        look(simulation);
    }
}

/// Makes a number of steps.
pub fn steps(simulation: &mut Simulation, count: usize) {
    for _ in 0..count {
        simulation.step().unwrap_or_else(|error| panic!("{error}"));
    }
}

/// Place of the grain with this name.
pub fn place(simulation: &Simulation, id: u32) -> usize {
    simulation.system.grains.id.iter().position(|name| *name == id).unwrap()
}

/// The grain with this name.
pub fn grain(simulation: &Simulation, id: u32) -> Row {
    simulation.system.grains.row(place(simulation, id))
}

/// Velocity of grain 1 relative to grain 0.
pub fn relative_velocity(simulation: &Simulation) -> Vec3 {
    grain(simulation, 1).velocity - grain(simulation, 0).velocity
}

/// Kinetic energy of motion and rotation [J].
pub fn kinetic(simulation: &Simulation) -> f64 {
    let stored = simulation.stored_energy();
    stored.kinetic + stored.rotational
}

/// The whole state as bytes.
pub fn bytes(simulation: &Simulation) -> Vec<u8> {
    postcard::to_stdvec(&simulation.state()).unwrap()
}

/// The state after writing and reading.
pub fn written_and_read(simulation: &Simulation) -> SimulationState<'static> {
    postcard::from_bytes(&bytes(simulation)).unwrap()
}

/// A scenario of two or more grains of one material written out one by one.
#[derive(Clone)]
pub struct Listed {
    pub material: &'static str,
    pub radius: f64,
    pub positions: Vec<[f64; 3]>,
    pub end: f64,
    pub engine: String,
    /// Further tables.
    pub more: String,
}

/// The engine of explicit steps of this length [s].
pub fn verlet(step: f64) -> String {
    format!("[engine.verlet]\nstep = \"{step:e} s\"\n")
}

/// The staggered engine with steps of at most this length [s], iterated to this tolerance.
pub fn staggered(step: f64, tolerance: f64, implicitness: f64) -> String {
    format!(
        "[engine.staggered]\ninitial_step = \"{step:e} s\"\nlargest_step = \"{step:e} s\"\n\
         tolerance = {tolerance:e}\ntarget_iterations = 60\nimplicitness = {implicitness}\n"
    )
}

/// The lines of a material that these laws read: what no law reads is refused.
pub fn as_read(material: &str, laws: &str) -> String {
    let is_read = |line: &&str| match line.split_once(" = ").map(|(key, _)| key) {
        Some("youngs_modulus" | "poisson_ratio") => {
            let springs = laws.contains("[contact.friction.mindlin]") && !laws.contains("stiffness_ratio");
            springs || laws.contains("[contact.normal.hertz]")
        }
        Some("contact_stiffness" | "softening") => laws.contains("[contact.normal.strain_power]"),
        _ => true,
    };
    material.lines().filter(is_read).flat_map(|line| [line, "\n"]).collect()
}

impl Listed {
    /// The scenario's text.
    pub fn text(&self) -> String {
        let at = |[x, y, z]: &[f64; 3]| format!("[\"{x:e} m\", \"{y:e} m\", \"{z:e} m\"]");
        let positions: Vec<String> = self.positions.iter().map(at).collect();
        format!(
            "version = 1\n[time]\nend = \"{:e} s\"\n{}\n[materials.only]\n{}\n[[grains]]\nmaterial = \"only\"\n\
             [grains.size.constant]\nradius = \"{:e} m\"\n[grains.placement.list]\npositions = [{}]\n{}\n",
            self.end,
            self.engine,
            as_read(self.material, &self.more),
            self.radius,
            positions.join(", "),
            self.more
        )
    }

    /// A simulation with its grains changed as wanted.
    pub fn start(&self, change: impl FnOnce(&mut Particles)) -> Simulation {
        start(&self.text(), change)
    }
}

/// Holds two states to the same bits; what differs first is told by its name in the state.
pub fn assert_same_state(found: &[u8], wanted: &[u8], when: &str) {
    if found == wanted {
        return;
    }
    let [found, wanted] = [found, wanted].map(|bytes| {
        let state: SimulationState<'_> = postcard::from_bytes(bytes).unwrap();
        serde_json::to_value(&state).unwrap()
    });
    panic!("{when}: {}", first_difference(&found, &wanted));
}

/// The first place in which two documents differ, with both values.
pub fn first_difference(found: &Json, wanted: &Json) -> String {
    fn walk(found: &Json, wanted: &Json, path: &str) -> Option<String> {
        match (found, wanted) {
            (Json::Object(a), Json::Object(b)) if a.keys().eq(b.keys()) => {
                a.iter().find_map(|(key, value)| walk(value, &b[key], &format!("{path}.{key}")))
            }
            (Json::Array(a), Json::Array(b)) if a.len() == b.len() => {
                (0..a.len()).find_map(|at| walk(&a[at], &b[at], &format!("{path}[{at}]")))
            }
            (Json::Array(a), Json::Array(b)) => {
                Some(format!("{path} has {} entries, expected {}", a.len(), b.len()))
            }
            // As text, so that a negative zero is another number than zero.
            _ => {
                let [found, wanted] = [found, wanted].map(Json::to_string);
                (found != wanted).then(|| format!("{path} is {found}, expected {wanted}"))
            }
        }
    }
    walk(found, wanted, "state").unwrap_or_else(|| "the field that differs cannot be shown".to_owned())
}
