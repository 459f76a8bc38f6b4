//! The tables over time: energy, momentum, clusters, moments, rays, steps.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::engine::soft::Simulation;
use crate::math::Vec3;
use crate::measure::{
    ClusterSummary, Clusters, Moments, close_pairs, mean_nearest_distance, moments, summarize,
};
use crate::record::{RecordError, Series};

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
];
const STEPS: &[&str] = &["time_s", "step", "step_size_s", "iterations", "rejected", "largest_strain"];

/// The tables by name, in the order in which they are written.
const NAMES: [(&str, &[&str]); 6] = [
    ("energy", ENERGY),
    ("momentum", MOMENTUM),
    ("clusters", CLUSTERS),
    ("moments", MOMENTS),
    ("rays", RAYS),
    ("steps", STEPS),
];

/// Lengths of the tables' files [bytes].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TablesState {
    positions: Vec<u64>,
}

impl TablesState {
    fn files(&self, folder: &Path) -> impl Iterator<Item = (PathBuf, u64)> {
        let path = |name: &str| folder.join(format!("{name}.csv"));
        NAMES.into_iter().zip(&self.positions).map(move |((name, _), bytes)| (path(name), *bytes))
    }
}

/// The tables over time.
#[derive(Debug)]
pub struct Tables {
    series: Vec<Series>,
}

impl Tables {
    /// Makes the tables' files.
    pub fn create(folder: &Path) -> Result<Self, RecordError> {
        let open =
            |(name, columns): (&str, &[&str])| Series::create(&folder.join(format!("{name}.csv")), columns);
        Ok(Self { series: NAMES.into_iter().map(open).collect::<Result<_, _>>()? })
    }

    /// Whether the tables' files can be cut back; none is changed.
    pub fn check(folder: &Path, state: &TablesState) -> Result<(), RecordError> {
        state.files(folder).try_for_each(|(path, bytes)| Series::check(&path, bytes))
    }

    /// Opens the tables' files and cuts them back.
    pub fn resume(folder: &Path, state: &TablesState) -> Result<Self, RecordError> {
        let open = |(path, bytes): (PathBuf, u64)| Series::reopen_at(&path, bytes);
        Ok(Self { series: state.files(folder).map(open).collect::<Result<_, _>>()? })
    }

    /// Lengths of the files.
    pub fn state(&self) -> TablesState {
        TablesState { positions: self.series.iter().map(Series::position).collect() }
    }

    /// Puts all rows onto the disk.
    pub fn sync(&mut self) -> Result<(), RecordError> {
        self.series.iter_mut().try_for_each(Series::sync)
    }

    /// Writes a row in each table.
    pub fn write(&mut self, simulation: &Simulation, cluster_gap: f64) -> Result<(), RecordError> {
        let rows = [
            energy(simulation),
            momentum(simulation),
            clusters(simulation, cluster_gap),
            motion(simulation),
            rays(simulation),
            steps(simulation),
        ];
        // An empty sum may be a negative zero, which no reader expects.
        let plain = |row: Vec<f64>| row.into_iter().map(|value| value + 0.0).collect::<Vec<f64>>();
        self.series.iter_mut().zip(rows).try_for_each(|(series, row)| series.row(&plain(row)))
    }
}

fn energy(simulation: &Simulation) -> Vec<f64> {
    let balance = simulation.balance();
    let stores = &balance.stores;
    vec![
        simulation.clock().time,
        stores.kinetic,
        stores.spin,
        stores.elastic,
        stores.tangential_spring,
        stores.bonds,
        stores.near_field,
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

/// Clusters by contact, bond or gap, with the cluster of each grain.
pub fn clusters_of(simulation: &Simulation, cluster_gap: f64) -> (ClusterSummary, Vec<u32>) {
    let system = &simulation.system;
    let grains = &system.grains;
    let mut edges: Vec<(u32, u32)> = system.network.bonds().iter().map(|bond| bond.grains.into()).collect();
    close_pairs(&grains.position, &grains.radius, cluster_gap, &mut |a, b| edges.push((a, b)));
    let clusters = Clusters::new(&grains.mass, edges);
    let summary = summarize(&clusters, &grains.position, &grains.radius, &grains.mass);
    (summary, clusters.labels)
}

fn clusters(simulation: &Simulation, cluster_gap: f64) -> Vec<f64> {
    let (summary, _) = clusters_of(simulation, cluster_gap);
    let system = &simulation.system;
    vec![
        simulation.clock().time,
        summary.count as f64,
        summary.largest_mass_fraction,
        f64::from(summary.largest_size),
        summary.dispersion_degree,
        summary.radius_of_gyration,
        summary.largest_radius_of_gyration,
        summary.largest_fractal_dimension.unwrap_or(f64::NAN),
        f64::from(system.trial.contact.touching),
        system.network.bonds().len() as f64,
        mean_nearest_distance(&system.grains.position),
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
    row.extend(pulses.flight().beam_power());
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
