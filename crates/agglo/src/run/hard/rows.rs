//! The tables of hard spheres.

use serde::{Deserialize, Serialize};

use crate::engine::hard::{Balance, Clock, Counts, Descent, EventKind, GrainEvent, Simulation, Snapshot};
use crate::math::Vec3;
use crate::measure::size_classes;
use crate::record::Cell;
use crate::run::tables::Layout;

use super::growth::Growth;

const GRAINS: &[&str] = &[
    "time_s",
    "grains",
    "mean_radius_m",
    "deviation_radius_m",
    "radius_ratio",
    "n_f",
    "growth_deficit",
    "largest_radius_m",
    "largest_primaries",
    "largest_fraction",
    "mean_temperature_K",
    "lowest_temperature_K",
    "highest_temperature_K",
    "mean_vx_m_s",
    "mean_vy_m_s",
    "mean_vz_m_s",
    "mean_speed_m_s",
    "largest_speed_m_s",
    "granular_temperature_m2_s2",
];
const ENERGY: &[&str] = &[
    "time_s",
    "kinetic_J",
    "thermal_J",
    "lost_normal_J",
    "lost_friction_J",
    "reaction_J",
    "surface_J",
    "heat_J",
    "unbalanced_J",
    "cooled_J",
    "kinetic_drift_relative",
    "drift_J",
    "drift_relative",
];
const MOMENTUM: &[&str] = &[
    "time_s",
    "px_kg_m_s",
    "py_kg_m_s",
    "pz_kg_m_s",
    "walls_px_kg_m_s",
    "walls_py_kg_m_s",
    "walls_pz_kg_m_s",
    "drift_px_kg_m_s",
    "drift_py_kg_m_s",
    "drift_pz_kg_m_s",
];
const IMPACTS: &[&str] = &[
    "time_s",
    "impacts",
    "bounces",
    "merges",
    "fragmentations",
    "fragmentations_without_room",
    "guarded",
    "overlapping",
    "walls",
    "iterations",
    "most_iterations",
    "not_converged",
    "mean_free_time_s",
];
const STEPS: &[&str] = &["time_s", "step", "step_size_s"];
const SIZES: &[&str] =
    &["time_s", "lower_primaries", "upper_primaries", "grains", "mass_kg", "mass_fraction"];
const EVENTS: &[&str] = &[
    "event",
    "time_s",
    "kind",
    "grain_i",
    "grain_j",
    "mass_i_kg",
    "mass_j_kg",
    "approach_speed_m_s",
    "restitution",
    "lost_normal_J",
    "lost_friction_J",
    "reaction_J",
    "surface_J",
    "heat_J",
];
const GENEALOGY: &[&str] = &["event", "parent", "child", "primaries", "mass_kg"];

/// The tables; those with a row at each time come first, in the order of [`rows`].
pub const TABLES: Layout = &[
    ("series/grains.csv", GRAINS),
    ("series/energy.csv", ENERGY),
    ("series/momentum.csv", MOMENTUM),
    ("series/impacts.csv", IMPACTS),
    ("series/steps.csv", STEPS),
    ("series/sizes.csv", SIZES),
    ("events.csv", EVENTS),
    ("genealogy.csv", GENEALOGY),
];
/// Number of the table of sizes.
pub const SIZES_TABLE: usize = 5;
/// Number of the table of events.
pub const EVENTS_TABLE: usize = 6;
/// Number of the table of descents.
pub const GENEALOGY_TABLE: usize = 7;

/// What was so at the last row.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LastRow {
    time: f64,
    grains: f64,
    impacts: u64,
}

impl LastRow {
    /// What is so now.
    pub fn of(simulation: &Simulation) -> Self {
        let impacts = simulation.system().state.counts.collisions;
        Self { time: simulation.clock().time, grains: simulation.grains() as f64, impacts }
    }

    /// Mean time [s] between two impacts of one grain since the last row: n dt/(2 impacts), with n the mean of the
    /// two rows; not a number without impacts.
    fn mean_free_time(&self, now: &Self) -> f64 {
        let impacts = now.impacts.saturating_sub(self.impacts) as f64;
        let grains = 0.5 * (self.grains + now.grains);
        if impacts > 0.0 { grains * (now.time - self.time) / (2.0 * impacts) } else { f64::NAN }
    }
}

/// A row of each table over time; `mean_radius_at_start` in [m].
pub fn rows(
    simulation: &Simulation,
    growth: &Growth,
    mean_radius_at_start: f64,
    last: &LastRow,
) -> [Vec<f64>; 5] {
    let time = simulation.clock().time;
    let free_time = last.mean_free_time(&LastRow::of(simulation));
    [
        grains(time, growth, mean_radius_at_start),
        energy(time, &simulation.balance()),
        momentum(simulation),
        impacts(time, &simulation.system().state.counts, free_time),
        steps(simulation.clock()),
    ]
}

fn grains(time: f64, growth: &Growth, mean_radius_at_start: f64) -> Vec<f64> {
    let ratio = growth.mean_radius / mean_radius_at_start;
    let velocity = growth.mean_velocity;
    vec![
        time,
        growth.grains as f64,
        growth.mean_radius,
        growth.deviation_radius,
        ratio,
        ratio * ratio * ratio,
        growth.cost(),
        growth.largest_radius,
        f64::from(growth.largest_primaries),
        growth.largest_fraction,
        growth.mean_temperature,
        growth.lowest_temperature,
        growth.highest_temperature,
        velocity.x,
        velocity.y,
        velocity.z,
        growth.mean_speed,
        growth.largest_speed,
        growth.granular_temperature,
    ]
}

fn energy(time: f64, balance: &Balance) -> Vec<f64> {
    vec![
        time,
        balance.stored.kinetic,
        balance.stored.thermal,
        balance.normal,
        balance.tangential,
        balance.reaction,
        balance.surface,
        balance.heat,
        balance.unbalanced,
        balance.cooled,
        balance.kinetic_drift_relative,
        balance.drift,
        balance.drift_relative,
    ]
}

fn momentum(simulation: &Simulation) -> Vec<f64> {
    let (now, ledger) = (simulation.momentum(), &simulation.system().state.ledger);
    let vectors = [now, ledger.flows.walls, ledger.momentum_drift(now)];
    std::iter::once(simulation.clock().time).chain(vectors.into_iter().flat_map(Vec3::to_array)).collect()
}

fn impacts(time: f64, counts: &Counts, free_time: f64) -> Vec<f64> {
    vec![
        time,
        counts.collisions as f64,
        counts.bounces as f64,
        counts.merges as f64,
        counts.fragmentations as f64,
        counts.no_room as f64,
        counts.guarded as f64,
        counts.overlapping as f64,
        counts.walls as f64,
        counts.iterations as f64,
        f64::from(counts.most_iterations),
        counts.not_converged as f64,
        free_time,
    ]
}

fn steps(clock: &Clock) -> Vec<f64> {
    vec![clock.time, clock.step as f64, clock.last_step]
}

/// Rows of the size distribution at `time` [s], one a class.
pub fn sizes(time: f64, now: &Snapshot, growth: &Growth) -> impl Iterator<Item = [Cell; 6]> {
    let (classes, all) = (size_classes(&now.primaries, &now.grains.mass), growth.mass);
    classes.into_iter().map(move |class| {
        [
            Cell::Number(time),
            Cell::Count(u64::from(class.lower)),
            Cell::Count(u64::from(class.upper)),
            Cell::Count(class.grains),
            Cell::Number(class.mass),
            Cell::Number(class.mass / all),
        ]
    })
}

/// The row of an event.
pub fn event(event: &GrainEvent) -> [Cell; 14] {
    let kind = match event.kind {
        EventKind::Merge => "merge",
        EventKind::Break => "break",
    };
    let ([i, j], [mass_i, mass_j], energy) = (event.grains, event.masses, &event.energy);
    [
        Cell::Count(event.number),
        Cell::Number(event.time),
        Cell::Word(kind),
        Cell::Count(u64::from(i)),
        Cell::Count(u64::from(j)),
        Cell::Number(mass_i),
        Cell::Number(mass_j),
        Cell::Number(event.speed),
        Cell::Number(event.restitution),
        Cell::Number(energy.normal),
        Cell::Number(energy.tangential),
        Cell::Number(energy.reaction),
        Cell::Number(energy.surface),
        Cell::Number(energy.heat),
    ]
}

/// The row of a line of descent.
pub fn descent(descent: &Descent) -> [Cell; 5] {
    [
        Cell::Count(descent.event),
        Cell::Count(u64::from(descent.parent)),
        Cell::Count(u64::from(descent.child)),
        Cell::Count(u64::from(descent.primaries)),
        Cell::Number(descent.mass),
    ]
}

#[cfg(test)]
#[path = "rows_tests.rs"]
mod tests;
