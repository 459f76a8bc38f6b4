//! What the tables over time tell of soft spheres, measured at one moment.

use crate::acoustics::{BeamPower, PulseCount};
use crate::engine::soft::{Absorbed, Clock, Simulation, WallSound};
use crate::ledger::{Balance, Momentum};
use crate::math::Vec3;
use crate::measure::{ClusterSummary, Moments, mean_nearest_distance, moments};
use crate::walls::Passed;

use super::summary::Clusters;
use super::together::{Together, dispersion_since};

/// One moment of a run.
pub struct Now {
    /// Time and steps.
    pub clock: Clock,
    /// The ledger of energy.
    pub balance: Balance,
    /// Momentum, and what of it impulses do not explain.
    pub momentum: Momentum,
    /// See `momentum`.
    pub drift: Momentum,
    /// The clusters.
    pub clusters: ClusterSummary,
    /// Grains.
    pub grains: u64,
    /// What has left through absorbing faces.
    pub absorbed: Absorbed,
    /// Pairs of grains that touch.
    pub contacts: u64,
    /// The dispersion degree relative to the start.
    pub dispersion_since: f64,
    /// Bonds that hold.
    pub bonds: u64,
    /// Mean distance from a center to the nearest other one [m].
    pub nearest: f64,
    /// Moments of the places along x, y and z [m], by mass.
    pub places: [Moments; 3],
    /// Moments of the speed [m/s], by mass.
    pub speed: Moments,
    /// Largest speed [m/s].
    pub fastest: f64,
    /// The pulses so far.
    pub pulses: Vec<PulseCount>,
    /// Rays in flight.
    pub in_flight: u64,
    /// Power of the rays of the latest pulse of each beam.
    pub beam: BeamPower,
    /// Power of the rays in flight.
    pub flying: BeamPower,
    /// Largest overlap over the sum of the radii.
    pub largest_strain: f64,
}

impl Now {
    /// Measures a simulation; `start` has the clusters of its start.
    pub fn of(simulation: &Simulation, cluster_gap: f64, start: &Clusters) -> Self {
        let together = Together::of(simulation, cluster_gap);
        let (system, flight) = (&simulation.system, simulation.pulses.flight());
        let grains = &system.grains;
        let momentum = simulation.momentum();
        let by_mass = |values: &[f64]| -> Moments { moments(values, &grains.mass).unwrap_or_default() };
        let along = |axis: usize| -> Vec<f64> { grains.position.iter().map(|r| r[axis]).collect() };
        let speeds: Vec<f64> = grains.velocity.iter().map(|v| v.norm()).collect();
        Self {
            clock: *simulation.clock(),
            balance: simulation.balance(),
            drift: simulation.momentum_drift(&momentum),
            momentum,
            dispersion_since: dispersion_since(start, &together.clusters()),
            clusters: together.summary,
            grains: grains.len() as u64,
            absorbed: simulation.absorbed().unwrap_or_default(),
            contacts: together.contacts,
            bonds: system.network.bonds().len() as u64,
            nearest: mean_nearest_distance(&simulation.system.space, &grains.position),
            places: [0, 1, 2].map(|axis| by_mass(&along(axis))),
            speed: by_mass(&speeds),
            fastest: speeds.iter().copied().fold(0.0, f64::max),
            pulses: simulation.pulses.counts().to_vec(),
            in_flight: flight.rays().len() as u64,
            beam: flight.beam_power(),
            flying: flight.power_flying(),
            largest_strain: system.trial.contact.worst_strain,
        }
    }

    /// A quantity of all pulses together.
    pub fn sum(&self, quantity: fn(&PulseCount) -> f64) -> f64 {
        self.pulses.iter().map(quantity).sum()
    }

    /// A count of all pulses together.
    pub fn count(&self, quantity: fn(&PulseCount) -> u64) -> u64 {
        self.pulses.iter().map(quantity).sum()
    }
}

/// A wall at one moment of a run.
pub struct WallNow {
    /// Simulated time [s].
    pub time: f64,
    /// Its number in the scenario's list.
    pub number: u64,
    /// Contacts with grains.
    pub contacts: u64,
    /// Force [N] of all grains on it.
    pub force: Vec3,
    /// Their torque [N m] about the point that it turns about.
    pub torque: Vec3,
    /// Work [J] that it has put in since the start.
    pub work: f64,
    /// Grains beyond a plane with an opening; nothing of other walls.
    pub passed: Option<Passed>,
    /// What rays have given it since the start.
    pub sound: WallSound,
}

/// The walls of a simulation now.
pub fn walls(simulation: &Simulation) -> impl Iterator<Item = WallNow> {
    let time = simulation.clock().time;
    (0..).zip(simulation.system.wall_states(time)).map(move |(number, wall)| WallNow {
        time,
        number,
        contacts: u64::from(wall.contacts),
        force: wall.force,
        torque: wall.torque,
        work: wall.work,
        passed: wall.passed,
        sound: simulation.pulses.given_to(number as usize),
    })
}
