//! The tables of hard spheres: a line declares a column, with all that is told of it anywhere.

use crate::engine::hard::{Descent, EventKind, GrainEvent};
use crate::folder::names;
use crate::ledger::{Entry, entry::hard as told};
use crate::measure::{BreakageRow, DaughterRow, KernelRow, end_of_class as end};
use crate::record::columns::{
    Column, Table, Tables, count, count_or_none, entry, number, number_or_none, word,
};

use super::now::{ClassNow, Now};
use super::panels;

const TIME: Column<Now> = number("time_s", "s", "time", "simulated", |now: &Now| now.clock.time);

/// The grains.
#[rustfmt::skip]
pub static GRAINS: Table<Now> = Table { file: names::GRAINS, columns: &[
    TIME,
    count("grains", "grains", "how many", |now: &Now| now.growth.grains as u64).on(&panels::GRAINS).glance_with_curve(1),
    number("mean_radius_m", "m", "mean radius", "by number", |now: &Now| now.growth.mean_radius).glance_with_curve(2),
    number("deviation_radius_m", "m", "standard deviation of the radius", "", |now: &Now| now.growth.deviation_radius),
    number("radius_ratio", "", "radius ratio", "mean radius over that at the start", |now: &Now| now.radius_ratio).on(&panels::GROWTH),
    number("n_f", "", "growth", "the cube of `radius_ratio` ([B] 7.2)", Now::n_f),
    number("growth_deficit", "", "growth deficit", "Π = 1 - mean radius over the radius of one sphere of all the solid ([B] 7.1)", |now: &Now| now.growth.cost()),
    number("largest_radius_m", "m", "largest radius", "", |now: &Now| now.growth.largest_radius).glance(3),
    count("largest_primaries", "primaries of the largest grain", "", |now: &Now| u64::from(now.growth.largest_primaries)).on(&panels::LARGEST),
    number("largest_fraction", "", "largest grain", "its part of the mass", |now: &Now| now.growth.largest_fraction).part().glance(4),
    number("mean_temperature_K", "K", "mean temperature", "by mass", |now: &Now| now.growth.mean_temperature).on(&panels::TEMPERATURE).glance_with_curve(5),
    number("lowest_temperature_K", "K", "lowest temperature", "", |now: &Now| now.growth.lowest_temperature).on(&panels::TEMPERATURE),
    number("highest_temperature_K", "K", "highest temperature", "", |now: &Now| now.growth.highest_temperature).on(&panels::TEMPERATURE),
    number("mean_vx_m_s", "m/s", "velocity along x", "of the center of mass", |now: &Now| now.growth.mean_velocity.x),
    number("mean_vy_m_s", "m/s", "velocity along y", "of the center of mass", |now: &Now| now.growth.mean_velocity.y),
    number("mean_vz_m_s", "m/s", "velocity along z", "of the center of mass", |now: &Now| now.growth.mean_velocity.z),
    number("mean_speed_m_s", "m/s", "mean speed", "by number, as seen from the box", |now: &Now| now.growth.mean_speed).on(&panels::SPEEDS).glance(6),
    number("largest_speed_m_s", "m/s", "largest speed", "as seen from the box", |now: &Now| now.growth.largest_speed).on(&panels::SPEEDS),
    number("granular_temperature_m2_s2", "m2/s2", "granular temperature", "mean of (v - V)²/3 by number, V the velocity of the center of mass", |now: &Now| now.growth.granular_temperature),
] };

const fn energy(told: &Entry) -> Column<Now> {
    entry(told, |now: &Now| &now.balance)
}

/// The ledger.
#[rustfmt::skip]
pub static ENERGY: Table<Now> = Table { file: names::ENERGY, columns: &[
    TIME,
    energy(&told::KINETIC).on(&panels::ENERGY),
    energy(&told::THERMAL).on(&panels::HEAT),
    energy(&told::NORMAL).on(&panels::ENERGY),
    energy(&told::FRICTION).on(&panels::ENERGY),
    energy(&told::REACTION).on(&panels::HEAT),
    energy(&told::SURFACE).on(&panels::ENERGY),
    energy(&told::HEAT).on(&panels::HEAT),
    energy(&told::UNBALANCED).on(&panels::HEAT),
    energy(&told::COOLED).on(&panels::HEAT),
    energy(&told::KINETIC_DRIFT_RELATIVE),
    energy(&told::DRIFT),
    energy(&told::DRIFT_RELATIVE).glance(11),
] };

/// Momenta.
#[rustfmt::skip]
pub static MOMENTUM: Table<Now> = Table { file: names::MOMENTUM, columns: &[
    TIME,
    number("px_kg_m_s", "kg m/s", "momentum along x", "", |now: &Now| now.momentum.x),
    number("py_kg_m_s", "kg m/s", "momentum along y", "", |now: &Now| now.momentum.y),
    number("pz_kg_m_s", "kg m/s", "momentum along z", "", |now: &Now| now.momentum.z),
    number("walls_px_kg_m_s", "kg m/s", "momentum along x from walls", "since the start", |now: &Now| now.walls.x),
    number("walls_py_kg_m_s", "kg m/s", "momentum along y from walls", "since the start", |now: &Now| now.walls.y),
    number("walls_pz_kg_m_s", "kg m/s", "momentum along z from walls", "since the start", |now: &Now| now.walls.z),
    number("drift_px_kg_m_s", "kg m/s", "momentum along x that is not explained", "by walls", |now: &Now| now.drift.x),
    number("drift_py_kg_m_s", "kg m/s", "momentum along y that is not explained", "by walls", |now: &Now| now.drift.y),
    number("drift_pz_kg_m_s", "kg m/s", "momentum along z that is not explained", "by walls", |now: &Now| now.drift.z),
] };

/// What happened since the start.
#[rustfmt::skip]
pub static IMPACTS: Table<Now> = Table { file: names::IMPACTS, columns: &[
    TIME,
    count("impacts", "impacts", "since the start, as all counts of this table", |now: &Now| now.counts.collisions).on(&panels::IMPACTS).glance(7),
    count("bounces", "bounces", "impacts after which both went on", |now: &Now| now.counts.bounces).on(&panels::IMPACTS),
    count("merges", "merges", "impacts after which the two were one", |now: &Now| now.counts.merges).on(&panels::IMPACTS).glance(8),
    count("fragmentations", "breakages", "grains that broke", |now: &Now| now.counts.fragmentations).on(&panels::IMPACTS).glance(9),
    count("fragmentations_without_room", "breakages without room", "grains that stayed whole since there was no room for their fragments", |now: &Now| now.counts.no_room),
    count("tc_bounces", "bounces made elastic", "by the TC model, since their pair had bounced again and again just before", |now: &Now| now.counts.tc_bounces),
    count("overlapping", "impacts of spheres that overlapped", "after a merge, a step, or at a face", |now: &Now| now.counts.overlapping),
    count("walls", "bounces off walls", "", |now: &Now| now.counts.walls).on(&panels::IMPACTS),
    count("iterations", "iterations", "of all coupled solves", |now: &Now| now.counts.iterations),
    count("most_iterations", "most iterations", "of one solve", |now: &Now| u64::from(now.counts.most_iterations)).on(&panels::ITERATIONS),
    count("not_converged", "not converged, in all", "solves that did not end within their tolerance", |now: &Now| now.counts.not_converged).on(&panels::ITERATIONS),
    number_or_none("mean_free_time_s", "s", "mean free time", "between two impacts of a grain since the row before; none without impacts", |now: &Now| now.free_time),
] };

/// Steps.
#[rustfmt::skip]
pub static STEPS: Table<Now> = Table { file: names::STEPS, columns: &[
    TIME,
    count("step", "steps", "or events of the engine", |now: &Now| now.clock.step),
    number("step_size_s", "s", "time between steps", "length of the last step; for `event_driven` the mean time between two impacts", |now: &Now| now.clock.last_step).on(&panels::STEP).glance(10),
] };

/// Classes of sizes over time.
#[rustfmt::skip]
pub static SIZES: Table<ClassNow> = Table { file: names::SIZES, columns: &[
    number("time_s", "s", "time", "simulated", |now: &ClassNow| now.time),
    count("lower_primaries", "fewest primaries", "of the class: 1, 2, 4, ... or those of `output.size_classes`", |now: &ClassNow| u64::from(now.class.lower)),
    count_or_none("upper_primaries", "most primaries", "of the class; none if it has no end", |now: &ClassNow| end(now.class.upper)),
    count("grains", "grains", "in the class", |now: &ClassNow| now.class.grains),
    number("mass_kg", "kg", "mass", "of the class", |now: &ClassNow| now.class.mass),
    number("mass_fraction", "", "part of the mass", "of all grains", |now: &ClassNow| now.class.mass / now.mass_of_all).part(),
] };

/// Impacts that merged two grains or broke one.
#[rustfmt::skip]
pub static EVENTS: Table<GrainEvent> = Table { file: names::EVENTS, columns: &[
    count("event", "event", "its number, from 1", |event: &GrainEvent| event.number),
    number("time_s", "s", "time", "when it happened", |event: &GrainEvent| event.time),
    word("kind", "what happened", "`merge` or `break`", what_happened),
    count("grain_i", "first partner", "the lower id of the two", |event: &GrainEvent| u64::from(event.grains[0])),
    count("grain_j", "second partner", "the higher id of the two", |event: &GrainEvent| u64::from(event.grains[1])),
    number("mass_i_kg", "kg", "mass of the first partner", "before", |event: &GrainEvent| event.masses[0]),
    number("mass_j_kg", "kg", "mass of the second partner", "before", |event: &GrainEvent| event.masses[1]),
    number("approach_speed_m_s", "m/s", "approach speed", "along the normal, before", |event: &GrainEvent| event.speed),
    number("restitution", "", "restitution", "of the impact", |event: &GrainEvent| event.restitution),
    number("lost_normal_J", "J", "lost along the normal", "kinetic energy", |event: &GrainEvent| event.energy.normal),
    number("lost_friction_J", "J", "lost to friction", "kinetic energy", |event: &GrainEvent| event.energy.tangential),
    number("reaction_J", "J", "set free by reactions", "", |event: &GrainEvent| event.energy.reaction),
    number("surface_J", "J", "new surfaces", "their energy", |event: &GrainEvent| event.energy.surface),
    number("heat_J", "J", "heat of the pair", "", |event: &GrainEvent| event.energy.heat),
] };

fn what_happened(event: &GrainEvent) -> &str {
    match event.kind {
        EventKind::Merge => "merge",
        EventKind::Break => "break",
    }
}

/// Parents and children of events.
#[rustfmt::skip]
pub static GENEALOGY: Table<Descent> = Table { file: names::GENEALOGY, columns: &[
    count("event", "event", "its number in the table of events", |line: &Descent| line.event),
    count("parent", "parent", "its id", |line: &Descent| u64::from(line.parent)),
    count("child", "child", "its id; a merged grain keeps the heavier partner's (of equal ones, of the one that comes first in space), fragments get new ones", |line: &Descent| u64::from(line.child)),
    count("primaries", "primaries", "that go from parent to child", |line: &Descent| u64::from(line.primaries)),
    number("mass_kg", "kg", "mass", "that goes from parent to child", |line: &Descent| line.mass),
] };

/// How often grains collide, merge and break, by size.
#[rustfmt::skip]
pub static KERNELS: Table<KernelRow> = Table { file: names::KERNELS, columns: &[
    count("a_lower_primaries", "fewest primaries of the larger class", "", |row: &KernelRow| u64::from(row.a[0])),
    count_or_none("a_upper_primaries", "most primaries of the larger class", "none if it has no end", |row: &KernelRow| end(row.a[1])),
    count("b_lower_primaries", "fewest primaries of the smaller class", "", |row: &KernelRow| u64::from(row.b[0])),
    count_or_none("b_upper_primaries", "most primaries of the smaller class", "none if it has no end", |row: &KernelRow| end(row.b[1])),
    count("collisions", "collisions", "between the two since the start", |row: &KernelRow| row.collisions),
    count("merges", "merges", "", |row: &KernelRow| row.merges),
    count("breaking_collisions", "collisions that broke a grain", "", |row: &KernelRow| row.breaking),
    number("exposure_s_m3", "s/m3", "exposure", "pairs that could collide, integrated over time, over the volume", |row: &KernelRow| row.exposure),
    number_or_none("collision_kernel_m3_s", "m3/s", "collision kernel", "collisions over the exposure", |row: &KernelRow| row.collision_kernel),
    number_or_none("aggregation_kernel_m3_s", "m3/s", "aggregation kernel", "merges over the exposure", |row: &KernelRow| row.aggregation_kernel),
    number_or_none("breaking_kernel_m3_s", "m3/s", "breaking kernel", "collisions that broke a grain over the exposure", |row: &KernelRow| row.breaking_kernel),
    number_or_none("sticking_probability", "", "sticking probability", "merges over collisions", |row: &KernelRow| row.sticking_probability),
] };

/// How often grains break, by size.
#[rustfmt::skip]
pub static BREAKAGE: Table<BreakageRow> = Table { file: names::BREAKAGE, columns: &[
    count("lower_primaries", "fewest primaries", "of the class", |row: &BreakageRow| u64::from(row.class[0])),
    count_or_none("upper_primaries", "most primaries", "of the class; none if it has no end", |row: &BreakageRow| end(row.class[1])),
    count("grains", "grains", "in the class now", |row: &BreakageRow| row.grains),
    number("grain_time_s", "s", "grain time", "their number, integrated over time", |row: &BreakageRow| row.grain_time),
    number_or_none("mean_primaries", "", "mean primaries", "of a grain of the class, over time", |row: &BreakageRow| row.mean_primaries),
    count("breakages", "breakages", "grains of the class that broke", |row: &BreakageRow| row.breakages),
    number_or_none("breakage_rate_1_s", "1/s", "breakage rate", "breakages over the grain time", |row: &BreakageRow| row.breakage_rate),
] };

/// What they broke into.
#[rustfmt::skip]
pub static DAUGHTERS: Table<DaughterRow> = Table { file: names::DAUGHTERS, columns: &[
    count("parent_lower_primaries", "fewest primaries of the parents", "", |row: &DaughterRow| u64::from(row.parent[0])),
    count_or_none("parent_upper_primaries", "most primaries of the parents", "none if it has no end", |row: &DaughterRow| end(row.parent[1])),
    count("daughter_lower_primaries", "fewest primaries of the daughters", "", |row: &DaughterRow| u64::from(row.daughter[0])),
    count_or_none("daughter_upper_primaries", "most primaries of the daughters", "none if it has no end", |row: &DaughterRow| end(row.daughter[1])),
    count("breakages", "breakages", "of parents of the class, whatever into", |row: &DaughterRow| row.breakages),
    count("fragments", "fragments", "of the daughters' class", |row: &DaughterRow| row.fragments),
    count("primaries", "primaries", "in these fragments", |row: &DaughterRow| row.primaries),
    number("fragments_per_breakage", "", "fragments per breakage", "", |row: &DaughterRow| row.fragments_per_breakage),
    number("mass_fraction", "", "part of the mass", "of the parents that broke", |row: &DaughterRow| row.mass_fraction).part(),
] };

/// The tables with a row at each time.
pub const OVER_TIME: [&Table<Now>; 5] = [&GRAINS, &ENERGY, &MOMENTUM, &IMPACTS, &STEPS];

/// The tables that grow with a run.
pub const TABLES: Tables = &[&GRAINS, &ENERGY, &MOMENTUM, &IMPACTS, &STEPS, &SIZES, &EVENTS, &GENEALOGY];

/// The tables that are written at the end.
pub const AT_THE_END: Tables = &[&KERNELS, &BREAKAGE, &DAUGHTERS];
