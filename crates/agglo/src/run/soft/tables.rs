//! The tables of soft spheres: a line declares a column, with all that is told of it anywhere.

use crate::contact::bond::Break;
use crate::contact::network::BondEvent;
use crate::folder::names;
use crate::ledger::{Entry, entry::soft as told};
use crate::record::columns::{
    Column, Table, Tables, count, count_or_none, entry, number, number_or_none, word,
};

use super::now::{Now, WallNow};
use super::panels::{
    BEAM, CLUSTERS, DISPERSION, FLOWS, FLYING, ITERATIONS, POWER, RAYS, SPEED, STEP, STORES, STRAIN,
};

const TIME: Column<Now> = number("time_s", "s", "time", "simulated", |now: &Now| now.clock.time);

const fn energy(told: &Entry) -> Column<Now> {
    entry(told, |now: &Now| &now.balance)
}

/// The ledger.
#[rustfmt::skip]
pub static ENERGY: Table<Now> = Table { file: names::ENERGY, columns: &[
    TIME,
    energy(&told::KINETIC).on(&STORES).glance(9),
    energy(&told::ROTATIONAL).on(&STORES),
    energy(&told::ELASTIC).on(&STORES),
    energy(&told::TANGENTIAL_SPRING).on(&STORES),
    energy(&told::BONDS).on(&STORES),
    energy(&told::NEAR_FIELD).on(&STORES),
    energy(&told::FIELD_ENERGY).on(&STORES),
    energy(&told::RAYS).on(&FLOWS),
    energy(&told::GRAVITY).on(&FLOWS),
    energy(&told::FIELDS).on(&FLOWS),
    energy(&told::STRAINED).on(&FLOWS),
    energy(&told::CUSTOM).on(&FLOWS),
    energy(&told::WALLS).on(&FLOWS),
    energy(&told::DRAG).on(&FLOWS),
    energy(&told::DAMPING).on(&FLOWS),
    energy(&told::FRICTION).on(&FLOWS),
    energy(&told::BOND_DAMPING).on(&FLOWS),
    energy(&told::BROKEN_BONDS).on(&FLOWS),
    energy(&told::ABSORBED).on(&FLOWS),
    energy(&told::DRIFT).on(&FLOWS),
    energy(&told::DRIFT_RELATIVE).glance(11),
] };

/// Momenta.
#[rustfmt::skip]
pub static MOMENTUM: Table<Now> = Table { file: names::MOMENTUM, columns: &[
    TIME,
    number("px_kg_m_s", "kg m/s", "momentum along x", "", |now: &Now| now.momentum.linear.x),
    number("py_kg_m_s", "kg m/s", "momentum along y", "", |now: &Now| now.momentum.linear.y),
    number("pz_kg_m_s", "kg m/s", "momentum along z", "", |now: &Now| now.momentum.linear.z),
    number("lx_kg_m2_s", "kg m2/s", "angular momentum about x", "through the origin", |now: &Now| now.momentum.angular.x),
    number("ly_kg_m2_s", "kg m2/s", "angular momentum about y", "through the origin", |now: &Now| now.momentum.angular.y),
    number("lz_kg_m2_s", "kg m2/s", "angular momentum about z", "through the origin", |now: &Now| now.momentum.angular.z),
    number("drift_px_kg_m_s", "kg m/s", "momentum along x that is not explained", "by impulses", |now: &Now| now.drift.linear.x),
    number("drift_py_kg_m_s", "kg m/s", "momentum along y that is not explained", "by impulses", |now: &Now| now.drift.linear.y),
    number("drift_pz_kg_m_s", "kg m/s", "momentum along z that is not explained", "by impulses", |now: &Now| now.drift.linear.z),
    number("drift_lx_kg_m2_s", "kg m2/s", "angular momentum about x that is not explained", "by impulses", |now: &Now| now.drift.angular.x),
    number("drift_ly_kg_m2_s", "kg m2/s", "angular momentum about y that is not explained", "by impulses", |now: &Now| now.drift.angular.y),
    number("drift_lz_kg_m2_s", "kg m2/s", "angular momentum about z that is not explained", "by impulses", |now: &Now| now.drift.angular.z),
] };

/// How grains hang together.
#[rustfmt::skip]
pub static TOGETHER: Table<Now> = Table { file: names::CLUSTERS, columns: &[
    TIME,
    count("clusters", "clusters", "single grains included", |now: &Now| now.clusters.count as u64).on(&CLUSTERS).glance(2),
    number("largest_fraction", "", "largest cluster", "mass of the heaviest cluster over all", |now: &Now| now.clusters.largest_mass_fraction).on(&DISPERSION).part().glance(3),
    count("largest_grains", "grains of the largest cluster", "", |now: &Now| u64::from(now.clusters.largest_size)),
    number("dispersion_degree", "", "dispersion degree", "D = 1 - f, with f the `largest_fraction`", |now: &Now| now.clusters.dispersion_degree).on(&DISPERSION).part().glance_with_curve(1),
    number("radius_of_gyration_m", "m", "radius of gyration", "of all grains", |now: &Now| now.clusters.radius_of_gyration),
    number("largest_radius_of_gyration_m", "m", "radius of gyration of the largest cluster", "", |now: &Now| now.clusters.largest_radius_of_gyration),
    number_or_none("fractal_dimension", "", "fractal dimension", "of the heaviest cluster; none where it is too small to have one", |now: &Now| now.clusters.largest_fractal_dimension),
    count("contacts", "contacts", "pairs whose surfaces are no farther apart than a thousandth of the smaller radius", |now: &Now| now.contacts).on(&CLUSTERS).glance(4),
    count("bonds", "bonds", "that hold", |now: &Now| now.bonds).on(&CLUSTERS).glance(5),
    number("mean_nearest_distance_m", "m", "mean distance to the nearest grain", "from center to center (of more than 20,000 grains, an even sample)", |now: &Now| now.nearest),
    number("dispersion_degree_relative", "", "dispersion degree relative to the start", "1 - f/f_0, with f_0 the `largest_fraction` at the start", |now: &Now| now.dispersion_since).on(&DISPERSION).part(),
    count("grains", "grains", "in the run", |now: &Now| now.grains),
    count("absorbed", "grains that left", "through absorbing faces since the start", |now: &Now| now.absorbed.grains),
    number("absorbed_kg", "kg", "mass that left", "the mass of those grains", |now: &Now| now.absorbed.mass),
] };

/// Places and speeds, weighted by mass.
#[rustfmt::skip]
pub static MOTION: Table<Now> = Table { file: names::MOMENTS, columns: &[
    TIME,
    number("mean_x_m", "m", "mean place along x", "by mass, as all of this table", |now: &Now| now.places[0].mean),
    number("mean_y_m", "m", "mean place along y", "", |now: &Now| now.places[1].mean),
    number("mean_z_m", "m", "mean place along z", "", |now: &Now| now.places[2].mean),
    number("deviation_x_m", "m", "standard deviation along x", "", |now: &Now| now.places[0].deviation),
    number("deviation_y_m", "m", "standard deviation along y", "", |now: &Now| now.places[1].deviation),
    number("deviation_z_m", "m", "standard deviation along z", "", |now: &Now| now.places[2].deviation),
    number("mean_speed_m_s", "m/s", "mean speed", "", |now: &Now| now.speed.mean).on(&SPEED).glance_with_curve(6),
    number("deviation_speed_m_s", "m/s", "standard deviation of the speed", "", |now: &Now| now.speed.deviation),
    number("skewness_speed", "", "skewness of the speed", "", |now: &Now| now.speed.skewness),
    number("kurtosis_speed", "", "kurtosis of the speed", "3 for a normal distribution", |now: &Now| now.speed.kurtosis),
    number("largest_speed_m_s", "m/s", "largest speed", "", |now: &Now| now.fastest).on(&SPEED),
] };

/// All pulses so far together.
#[rustfmt::skip]
pub static SOUND: Table<Now> = Table { file: names::RAYS, columns: &[
    TIME,
    count("pulses", "pulses", "launched so far", |now: &Now| now.pulses.len() as u64),
    count("in_flight", "rays in flight", "", |now: &Now| now.in_flight).on(&RAYS).glance(7),
    count("reflections", "reflections", "of all pulses so far", |now: &Now| now.count(|pulse| pulse.reflections)).on(&RAYS),
    count("reflections_at_walls", "reflections at walls", "of all pulses so far; among the reflections", |now: &Now| now.count(|pulse| pulse.reflections_at_walls)),
    count("segments", "segments", "finished straight pieces: reflections and the leaving legs", |now: &Now| now.count(|pulse| pulse.segments)).on(&RAYS),
    number("power_in_W", "W", "launched", "power of all pulses so far", |now: &Now| now.sum(|pulse| pulse.power_in)).on(&POWER),
    number("power_absorbed_W", "W", "taken up by grains", "", |now: &Now| now.sum(|pulse| pulse.power_absorbed)).on(&POWER),
    number("power_into_walls_W", "W", "taken up by walls", "", |now: &Now| now.sum(|pulse| pulse.power_into_walls)).on(&POWER),
    number("power_escaped_W", "W", "left for good", "", |now: &Now| now.sum(|pulse| pulse.power_escaped)).on(&POWER),
    number("power_truncated_W", "W", "dropped", "", |now: &Now| now.sum(|pulse| pulse.power_truncated)).on(&POWER),
    number("power_cut_off_W", "W", "cut off", "of rays that had come as far as rays are followed (`acoustics.way`)", |now: &Now| now.sum(|pulse| pulse.power_cut_off)).on(&POWER),
    number("beam_x", "", "beam power along x", "[A] 39: power times direction of all rays of the latest pulse of each beam, over the power of these pulses; rays that left or were dropped count as they were then", |now: &Now| now.beam.flow.x).on(&BEAM),
    number("beam_y", "", "beam power along y", "", |now: &Now| now.beam.flow.y).on(&BEAM),
    number("beam_z", "", "beam power along z", "", |now: &Now| now.beam.flow.z).on(&BEAM),
    number("beam_magnitude", "", "beam power in all", "power of the same rays, whatever their directions", |now: &Now| now.beam.magnitude).on(&BEAM),
    number("beam_root_of_squares", "", "root of the sum of squared powers", "of the same rays, over the same: the paper's fig. 10 d; 1/√rays at the start", |now: &Now| now.beam.root_of_squares),
    number("flying_x", "", "power in flight along x", "of the rays in flight alone, those of earlier pulses too", |now: &Now| now.flying.flow.x).on(&FLYING),
    number("flying_y", "", "power in flight along y", "", |now: &Now| now.flying.flow.y).on(&FLYING),
    number("flying_z", "", "power in flight along z", "", |now: &Now| now.flying.flow.z).on(&FLYING),
    number("flying_magnitude", "", "power in flight", "in all directions", |now: &Now| now.flying.magnitude).on(&FLYING).part().glance_with_curve(8),
] };

/// Steps.
#[rustfmt::skip]
pub static STEPS: Table<Now> = Table { file: names::STEPS, columns: &[
    TIME,
    count("step", "steps", "accepted so far", |now: &Now| now.clock.step),
    number("step_size_s", "s", "step", "length of the last", |now: &Now| now.clock.last_step).on(&STEP).glance(10),
    count("iterations", "iterations", "of the staggered scheme since the start", |now: &Now| now.clock.iterations).on(&ITERATIONS),
    count("rejected", "rejected tries", "of the staggered scheme since the start", |now: &Now| now.clock.rejected).on(&ITERATIONS),
    number("largest_strain", "", "largest overlap", "over the sum of the radii, at a wall over the radius; now", |now: &Now| now.largest_strain).on(&STRAIN),
] };

/// Walls: a row for each at each time.
#[rustfmt::skip]
pub static WALLS: Table<WallNow> = Table { file: names::WALLS, columns: &[
    number("time_s", "s", "time", "simulated", |wall: &WallNow| wall.time),
    count("wall", "wall", "its number in the scenario's list, from 0", |wall: &WallNow| wall.number),
    count("contacts", "contacts", "with grains", |wall: &WallNow| wall.contacts),
    number("force_x_N", "N", "force on the wall along x", "of all grains", |wall: &WallNow| wall.force.x),
    number("force_y_N", "N", "force on the wall along y", "", |wall: &WallNow| wall.force.y),
    number("force_z_N", "N", "force on the wall along z", "", |wall: &WallNow| wall.force.z),
    number("torque_x_N_m", "N m", "torque on the wall about x", "through the point that it turns about", |wall: &WallNow| wall.torque.x),
    number("torque_y_N_m", "N m", "torque on the wall about y", "", |wall: &WallNow| wall.torque.y),
    number("torque_z_N_m", "N m", "torque on the wall about z", "", |wall: &WallNow| wall.torque.z),
    number("work_J", "J", "work of the wall", "that it has put in since the start; negative where grains drive it", |wall: &WallNow| wall.work),
    count_or_none("passed", "grains that passed", "whose centers are beyond a plane with an opening, on the side that its normal points away from; of other walls there are none", |wall: &WallNow| wall.passed.map(|passed| passed.grains)),
    number_or_none("passed_kg", "kg", "mass that passed", "the mass of those grains", |wall: &WallNow| wall.passed.map(|passed| passed.mass)),
    number("sound_impulse_x_N_s", "N s", "impulse of sound along x", "of the rays that hit the wall, since the start", |wall: &WallNow| wall.sound.impulse.x),
    number("sound_impulse_y_N_s", "N s", "impulse of sound along y", "", |wall: &WallNow| wall.sound.impulse.y),
    number("sound_impulse_z_N_s", "N s", "impulse of sound along z", "", |wall: &WallNow| wall.sound.impulse.z),
    number("sound_energy_J", "J", "energy of sound", "that went into the wall since the start: power times how long a hit presses", |wall: &WallNow| wall.sound.energy),
] };

/// Bonds that broke or were made.
#[rustfmt::skip]
pub static EVENTS: Table<BondEvent> = Table { file: names::EVENTS, columns: &[
    number("time_s", "s", "time", "when it happened", |event: &BondEvent| event.time),
    count("grain_i", "first grain", "the lower id of the two", |event: &BondEvent| u64::from(event.ids[0])),
    count("grain_j", "second grain", "the higher id of the two", |event: &BondEvent| u64::from(event.ids[1])),
    word("event", "what happened", "`broken_in_tension`, `broken_in_shear`, `made`, or `left` where one of the two left through an absorbing face", what_happened),
    number("energy_J", "J", "energy", "that the bond held", |event: &BondEvent| event.energy),
] };

fn what_happened(event: &BondEvent) -> &str {
    match event.broke {
        None => "made",
        Some(Break::Tension) => "broken_in_tension",
        Some(Break::Shear) => "broken_in_shear",
        Some(Break::Left) => "left",
    }
}

/// The tables with one row at each time.
pub const OVER_TIME: [&Table<Now>; 6] = [&ENERGY, &MOMENTUM, &TOGETHER, &MOTION, &SOUND, &STEPS];

/// All tables.
pub const TABLES: Tables = &[&ENERGY, &MOMENTUM, &TOGETHER, &MOTION, &SOUND, &STEPS, &WALLS, &EVENTS];
