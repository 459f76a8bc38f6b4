//! Soft spheres at walls against closed forms and published numbers, through the whole engine.

mod bits;
mod impact;
mod ledger;
mod moving;
mod opening;
mod refused;
mod rolling;

use agglo::engine::soft::{Simulation, WallState};

/// Gravity along z [m/s²].
pub const G: f64 = 9.81;

/// A scenario of grains of one kind at places, radius 1 mm and 2500 kg/m³, under these tables.
pub fn grains_at(places: &[[f64; 3]], end: f64, engine: &str, more: &str) -> String {
    let places: Vec<String> =
        places.iter().map(|[x, y, z]| format!("[\"{x:e} m\", \"{y:e} m\", \"{z:e} m\"]")).collect();
    format!(
        "version = 1\ntime.end = \"{end:e} s\"\n{engine}\n[materials.glass]\ndensity = \"2500 kg/m3\"\n\
         [[grains]]\nmaterial = \"glass\"\nsize.constant.radius = \"1 mm\"\n\
         placement.list.positions = [{}]\n{more}",
        places.join(", ")
    )
}

/// Mass of such a grain [kg].
pub fn mass() -> f64 {
    2500.0 * 4.0 / 3.0 * std::f64::consts::PI * 1e-9
}

/// Gravity, as a table.
pub const GRAVITY: &str = "[fields.gravity]\nacceleration = [\"0 m/s2\", \"0 m/s2\", \"-9.81 m/s2\"]\n";

/// A plane through the origin with a normal, and more of its table.
pub fn plane(normal: [f64; 3], more: &str) -> String {
    format!(
        "[[walls]]\nname = \"floor\"\nmaterial = \"glass\"\n\
         shape.plane = {{ point = [\"0 m\", \"0 m\", \"0 m\"], normal = {normal:?} }}\n{more}\n"
    )
}

/// Springs of 10 kN/m with friction and dashpots that let oscillations die away.
pub fn damped(friction: f64) -> String {
    format!(
        "[contact.normal.hooke]\nstiffness = \"1e4 N/m\"\n[contact.damping.restitution]\nrestitution = 0.3\n\
         [contact.friction.mindlin]\nstatic_friction = {friction:?}\nstiffness_ratio = 0.8\ndashpot = 1.0\n"
    )
}

/// Overlap [m] at which a grain rests on such a spring, along whose normal this part of gravity acts.
pub fn at_rest(part: f64) -> f64 {
    mass() * G * part / 1e4
}

/// What a wall does and has done.
pub fn wall<'a>(simulation: &'a Simulation, name: &str) -> WallState<'a> {
    simulation.system.wall_states(simulation.clock().time).find(|wall| wall.name == name).unwrap()
}
