//! The groups of quantities that the summary of hard spheres is made of. In `summary.json` they stand side by side.

use serde::{Deserialize, Serialize};

use crate::engine::hard::{Counts, Simulation};
use crate::scenario::Scenario;

use super::growth::Growth;
use super::scales::Scales;

/// What was run, for how long and how.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct RunQuantities {
    /// Version of agglo.
    pub version: String,
    /// The scenario's title.
    pub title: String,
    /// Wall time [s], all sessions together.
    pub wall_s: f64,
    /// Simulated time [s].
    pub time_s: f64,
    /// Ends [s] that the run had before it went on; none where it never got another end.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub went_on_from_s: Vec<f64>,
    /// Steps, or events.
    pub steps: u64,
    /// What `steps` counts: "steps" or "events".
    pub steps_are: String,
    /// Mean simulated time of a step, or between two events [s].
    pub step_mean_s: Option<f64>,
    /// Bounces of a pair that followed one another within this time again and again were elastic [s].
    pub contact_duration_s: f64,
    /// Grains at the end.
    pub grains: u64,
    /// Threads.
    pub threads: usize,
    /// Seed.
    pub seed: u64,
}

/// How far the grains have grown.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct GrowthQuantities {
    /// Grains at the start.
    pub grains_start: u64,
    /// Grains at the end.
    pub grains_end: u64,
    /// Mean radius at the start [m].
    pub mean_radius_start_m: f64,
    /// Mean radius at the end [m].
    pub mean_radius_m: f64,
    /// Mean radius at the end over that at the start.
    pub radius_ratio: f64,
    /// The cost of [B] 7.1: 1 - mean radius over the radius of one sphere of all the solid.
    #[serde(alias = "pi")]
    pub growth_deficit: f64,
    /// The third power of `radius_ratio`.
    pub n_f: f64,
    /// Largest radius at the end [m].
    pub largest_radius_m: f64,
    /// Largest radius at the end over the mean radius at the start.
    pub largest_radius_ratio: f64,
    /// Most primaries of a grain at the end.
    pub largest_primaries: u32,
    /// Mass of the largest grain over that of all.
    pub largest_fraction: f64,
}

/// How far the models are from their limits; null where that cannot be said.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct ScaleQuantities {
    /// Radius at which the largest grain's own gravity would matter ([B] 4.16) [m].
    pub self_gravity_radius_m: Option<f64>,
    /// Largest radius at the end over that.
    pub largest_over_self_gravity: Option<f64>,
    /// Largest Biot number at the end; null without cooling or without a thermal conductivity.
    pub biot_number: Option<f64>,
    /// Largest Reynolds number at the end, in the medium at rest; null where the scenario does not name a medium.
    pub reynolds_number: Option<f64>,
}

/// What happened.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct CountQuantities {
    /// Impacts.
    pub impacts: u64,
    /// Impacts after which both went on.
    pub bounces: u64,
    /// Impacts after which the two were one.
    pub merges: u64,
    /// Agglomerates that broke.
    pub fragmentations: u64,
    /// Agglomerates that did not break since there was no room for the fragments.
    pub fragmentations_without_room: u64,
    /// Bounces that were made elastic, since their pair had bounced again and again just before.
    pub tc_bounces: u64,
    /// Kinetic energy that these would have lost, each by itself [J].
    #[serde(rename = "tc_kept_J", default)]
    pub tc_kept: f64,
    /// Impacts of spheres that overlapped.
    pub impacts_overlapping: u64,
    /// Bounces off walls.
    pub impacts_walls: u64,
    /// Merges, and impacts that broke one or both partners: rows of `events.csv`.
    pub events: u64,
    /// Steps, or events of the driver, per impact.
    pub events_per_impact: Option<f64>,
    /// Mean iterations of a coupled solve.
    pub solver_iterations_mean: Option<f64>,
    /// Most iterations of a coupled solve.
    pub solver_iterations_most: u32,
    /// Solves that did not end within their tolerance.
    pub solves_not_converged: u64,
}

/// How warm and how fast the grains are at the end.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct MotionQuantities {
    /// Mean temperature by mass [K].
    #[serde(rename = "temperature_mean_K")]
    pub temperature_mean: f64,
    /// Lowest temperature [K].
    #[serde(rename = "temperature_lowest_K")]
    pub temperature_lowest: f64,
    /// Highest temperature [K].
    #[serde(rename = "temperature_highest_K")]
    pub temperature_highest: f64,
    /// Mean speed [m/s].
    pub mean_speed_m_s: f64,
    /// Granular temperature [m²/s²].
    pub granular_temperature_m2_s2: f64,
}

fn per(whole: f64, parts: u64) -> Option<f64> {
    (parts > 0).then(|| whole / parts as f64)
}

impl RunQuantities {
    /// Of a simulation that ended, of which `grains` are left.
    pub fn of(
        scenario: &Scenario,
        simulation: &Simulation,
        grains: u64,
        (steps_are, wall_s): (&str, f64),
    ) -> Self {
        let clock = simulation.clock();
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            title: scenario.title.clone(),
            wall_s,
            time_s: clock.time,
            went_on_from_s: Vec::new(),
            steps: clock.step,
            steps_are: steps_are.to_owned(),
            step_mean_s: per(clock.time, clock.step),
            contact_duration_s: simulation.system().contact_duration,
            grains,
            threads: rayon::current_num_threads(),
            seed: scenario.seed,
        }
    }
}

impl GrowthQuantities {
    /// Of grains that were so many and in the mean so large [m] at the start.
    pub fn of(growth: &Growth, grains_start: u64, mean_radius_start_m: f64) -> Self {
        let ratio = growth.mean_radius / mean_radius_start_m;
        Self {
            grains_start,
            grains_end: growth.grains as u64,
            mean_radius_start_m,
            mean_radius_m: growth.mean_radius,
            radius_ratio: ratio,
            growth_deficit: growth.cost(),
            n_f: ratio * ratio * ratio,
            largest_radius_m: growth.largest_radius,
            largest_radius_ratio: growth.largest_radius / mean_radius_start_m,
            largest_primaries: growth.largest_primaries,
            largest_fraction: growth.largest_fraction,
        }
    }
}

impl ScaleQuantities {
    /// Of grains of which the largest has this radius [m].
    pub fn of(scales: &Scales, largest_radius: f64) -> Self {
        Self {
            self_gravity_radius_m: scales.self_gravity_radius,
            largest_over_self_gravity: scales.self_gravity_radius.map(|radius| largest_radius / radius),
            biot_number: scales.biot,
            reynolds_number: scales.reynolds,
        }
    }
}

impl CountQuantities {
    /// Of so many steps; bounces that were made elastic kept `tc_kept` [J].
    pub fn of(counts: &Counts, steps: u64, tc_kept: f64) -> Self {
        Self {
            impacts: counts.collisions,
            bounces: counts.bounces,
            merges: counts.merges,
            fragmentations: counts.fragmentations,
            fragmentations_without_room: counts.no_room,
            tc_bounces: counts.tc_bounces,
            tc_kept,
            impacts_overlapping: counts.overlapping,
            impacts_walls: counts.walls,
            events: counts.events,
            events_per_impact: per(steps as f64, counts.collisions),
            solver_iterations_mean: per(counts.iterations as f64, counts.collisions),
            solver_iterations_most: counts.most_iterations,
            solves_not_converged: counts.not_converged,
        }
    }
}

impl MotionQuantities {
    /// Of grains at one moment.
    pub fn of(growth: &Growth) -> Self {
        Self {
            temperature_mean: growth.mean_temperature,
            temperature_lowest: growth.lowest_temperature,
            temperature_highest: growth.highest_temperature,
            mean_speed_m_s: growth.mean_speed,
            granular_temperature_m2_s2: growth.granular_temperature,
        }
    }
}
