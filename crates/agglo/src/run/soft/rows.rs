//! The tables over time: energy, momentum, clusters, moments, rays, steps.

use crate::engine::soft::Simulation;
use crate::math::Vec3;
use crate::measure::{Moments, mean_nearest_distance, moments};
use crate::run::tables::Layout;

use super::summary::Clusters;
use super::together::{Together, dispersion_since};

const ENERGY: &[&str] = &[
    "time_s",
    "kinetic_J",
    "spin_J",
    "elastic_J",
    "tangential_spring_J",
    "bonds_J",
    "near_field_J",
    "work_rays_J",
    "work_gravity_J",
    "work_fields_J",
    "lost_drag_J",
    "lost_contact_damping_J",
    "lost_friction_J",
    "lost_bond_damping_J",
    "lost_broken_bonds_J",
    "drift_J",
    "drift_relative",
];
const MOMENTUM: &[&str] = &[
    "time_s",
    "px_kg_m_s",
    "py_kg_m_s",
    "pz_kg_m_s",
    "lx_kg_m2_s",
    "ly_kg_m2_s",
    "lz_kg_m2_s",
    "drift_px_kg_m_s",
    "drift_py_kg_m_s",
    "drift_pz_kg_m_s",
    "drift_lx_kg_m2_s",
    "drift_ly_kg_m2_s",
    "drift_lz_kg_m2_s",
];
const CLUSTERS: &[&str] = &[
    "time_s",
    "clusters",
    "largest_fraction",
    "largest_grains",
    "dispersion_degree",
    "radius_of_gyration_m",
    "largest_radius_of_gyration_m",
    "fractal_dimension",
    "contacts",
    "bonds",
    "mean_nearest_distance_m",
    "dispersion_degree_relative",
];
const MOMENTS: &[&str] = &[
    "time_s",
    "mean_x_m",
    "mean_y_m",
    "mean_z_m",
    "deviation_x_m",
    "deviation_y_m",
    "deviation_z_m",
    "mean_speed_m_s",
    "deviation_speed_m_s",
    "skewness_speed",
    "kurtosis_speed",
    "largest_speed_m_s",
];
const RAYS: &[&str] = &[
    "time_s",
    "pulses",
    "in_flight",
    "reflections",
    "segments",
    "power_in_W",
    "power_absorbed_W",
    "power_escaped_W",
    "power_truncated_W",
    "beam_x",
    "beam_y",
    "beam_z",
    "beam_magnitude",
    "beam_root_of_squares",
    "flying_x",
    "flying_y",
    "flying_z",
    "flying_magnitude",
];
const STEPS: &[&str] = &["time_s", "step", "step_size_s", "iterations", "rejected", "largest_strain"];

const EVENTS: &[&str] = &["time_s", "grain_i", "grain_j", "event", "energy_J"];

/// The tables; those over time come first, in the order of [`rows`].
pub const TABLES: Layout = &[
    ("series/energy.csv", ENERGY),
    ("series/momentum.csv", MOMENTUM),
    ("series/clusters.csv", CLUSTERS),
    ("series/moments.csv", MOMENTS),
    ("series/rays.csv", RAYS),
    ("series/steps.csv", STEPS),
    ("events.csv", EVENTS),
];
/// Number of the table of events.
pub const EVENTS_TABLE: usize = 6;

/// A row of each table over time; `start` has the clusters of the start.
pub fn rows(simulation: &Simulation, cluster_gap: f64, start: &Clusters) -> [Vec<f64>; 6] {
    [
        energy(simulation),
        momentum(simulation),
        clusters(simulation, cluster_gap, start),
        motion(simulation),
        rays(simulation),
        steps(simulation),
    ]
}

fn energy(simulation: &Simulation) -> Vec<f64> {
    let balance = simulation.balance();
    let stored = &balance.stored;
    vec![
        simulation.clock().time,
        stored.kinetic,
        stored.spin,
        stored.elastic,
        stored.tangential_spring,
        stored.bonds,
        stored.near_field,
        balance.rays,
        balance.gravity,
        balance.fields,
        balance.drag,
        balance.damping,
        balance.friction,
        balance.bond_damping,
        balance.broken_bonds,
        balance.drift,
        balance.drift_relative,
    ]
}

fn momentum(simulation: &Simulation) -> Vec<f64> {
    let momentum = simulation.momentum();
    let drift = simulation.ledger.momentum_drift(&momentum);
    let vectors = [momentum.linear, momentum.angular, drift.linear, drift.angular];
    std::iter::once(simulation.clock().time).chain(vectors.into_iter().flat_map(Vec3::to_array)).collect()
}

fn clusters(simulation: &Simulation, cluster_gap: f64, start: &Clusters) -> Vec<f64> {
    let together = Together::of(simulation, cluster_gap);
    let (summary, system) = (&together.summary, &simulation.system);
    vec![
        simulation.clock().time,
        summary.count as f64,
        summary.largest_mass_fraction,
        f64::from(summary.largest_size),
        summary.dispersion_degree,
        summary.radius_of_gyration,
        summary.largest_radius_of_gyration,
        summary.largest_fractal_dimension.unwrap_or(f64::NAN),
        together.contacts as f64,
        system.network.bonds().len() as f64,
        mean_nearest_distance(&system.grains.position),
        dispersion_since(start, &together.clusters()),
    ]
}

fn motion(simulation: &Simulation) -> Vec<f64> {
    let grains = &simulation.system.grains;
    let of = |values: &[f64]| -> Moments { moments(values, &grains.mass).unwrap_or_default() };
    let along = |axis: usize| -> Vec<f64> { grains.position.iter().map(|r| r[axis]).collect() };
    let places = [0, 1, 2].map(|axis| of(&along(axis)));
    let speeds: Vec<f64> = grains.velocity.iter().map(|v| v.norm()).collect();
    let speed = of(&speeds);
    let mut row = vec![simulation.clock().time];
    row.extend(places.iter().map(|place| place.mean));
    row.extend(places.iter().map(|place| place.deviation));
    row.extend([speed.mean, speed.deviation, speed.skewness, speed.kurtosis]);
    row.push(speeds.iter().copied().fold(0.0, f64::max));
    row
}

fn rays(simulation: &Simulation) -> Vec<f64> {
    let pulses = &simulation.pulses;
    let counts = pulses.counts();
    let sum = |figure: fn(&crate::acoustics::PulseCount) -> f64| counts.iter().map(figure).sum::<f64>();
    let mut row = vec![simulation.clock().time, counts.len() as f64, pulses.flight().rays().len() as f64];
    row.extend([
        sum(|count| count.reflections as f64),
        sum(|count| count.segments as f64),
        sum(|count| count.power_in),
        sum(|count| count.power_absorbed),
        sum(|count| count.power_escaped),
        sum(|count| count.power_truncated),
    ]);
    let (beam, flying) = (pulses.flight().beam_power(), pulses.flight().power_flying());
    row.extend(beam.flow.to_array());
    row.extend([beam.magnitude, beam.root_of_squares]);
    row.extend(flying.flow.to_array());
    row.push(flying.magnitude);
    row
}

fn steps(simulation: &Simulation) -> Vec<f64> {
    let clock = simulation.clock();
    let strain = simulation.system.trial.contact.worst_strain;
    vec![
        clock.time,
        clock.step as f64,
        clock.last_step,
        clock.iterations as f64,
        clock.rejected as f64,
        strain,
    ]
}
