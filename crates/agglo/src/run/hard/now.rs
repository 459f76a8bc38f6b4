//! What the tables over time tell of hard spheres, measured at one moment.

use serde::{Deserialize, Serialize};

use crate::engine::hard::{Clock, Counts, Simulation, Snapshot};
use crate::ledger::{Balance, Momentum};
use crate::math::Vec3;
use crate::measure::{SizeClass, SizeClasses};

use super::growth::Growth;

/// One moment of a run.
pub struct Now {
    /// Time and steps.
    pub clock: Clock,
    /// How far the grains have grown.
    pub growth: Growth,
    /// Mean radius over that at the start.
    pub radius_ratio: f64,
    /// The ledger of energy.
    pub balance: Balance,
    /// Momentum [kg m/s], what walls gave of it, and what they do not explain.
    pub momentum: Vec3,
    /// See `momentum`.
    pub walls: Vec3,
    /// See `momentum`.
    pub drift: Vec3,
    /// Impacts since the start.
    pub counts: Counts,
    /// Mean time between two impacts of a grain since the last row [s].
    pub free_time: Option<f64>,
}

impl Now {
    /// Measures a simulation; `mean_radius_at_start` in [m].
    pub fn of(simulation: &Simulation, growth: Growth, mean_radius_at_start: f64, last: &LastRow) -> Self {
        let (momentum, state) = (simulation.momentum(), &simulation.system().state);
        let all = Momentum { linear: momentum, angular: Vec3::ZERO };
        Self {
            clock: *simulation.clock(),
            growth,
            radius_ratio: growth.mean_radius / mean_radius_at_start,
            balance: simulation.balance(),
            momentum,
            walls: state.ledger.flows.walls,
            drift: state.ledger.momentum_drift(&all).linear,
            counts: state.counts.clone(),
            free_time: last.mean_free_time(&LastRow::of(simulation)),
        }
    }

    /// The third power of the radius ratio.
    pub fn n_f(&self) -> f64 {
        self.radius_ratio * self.radius_ratio * self.radius_ratio
    }
}

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
    /// two rows; none without impacts.
    fn mean_free_time(&self, now: &Self) -> Option<f64> {
        let impacts = now.impacts.saturating_sub(self.impacts) as f64;
        let grains = 0.5 * (self.grains + now.grains);
        (impacts > 0.0).then(|| grains * (now.time - self.time) / (2.0 * impacts))
    }
}

/// A class of sizes at one moment.
pub struct ClassNow {
    /// Time [s].
    pub time: f64,
    /// The class.
    pub class: SizeClass,
    /// Mass of all grains [kg].
    pub mass_of_all: f64,
}

/// The size distribution at `time` [s], class by class.
pub fn classes(
    time: f64,
    now: &Snapshot,
    (classes, growth): (&SizeClasses, &Growth),
) -> impl Iterator<Item = ClassNow> {
    let mass_of_all = growth.mass;
    let classes = classes.distribution(&now.primaries, &now.grains.mass);
    classes.into_iter().map(move |class| ClassNow { time, class, mass_of_all })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of 20, then 10 grains, 30 impacts in 2 s: each grain takes part in 4, so it flies for half a second.
    #[test]
    fn the_mean_free_time_counts_both_partners() {
        let last = LastRow { time: 1.0, grains: 20.0, impacts: 5 };
        let now = LastRow { time: 3.0, grains: 10.0, impacts: 35 };
        assert_eq!(last.mean_free_time(&now), Some(15.0 * 2.0 / 60.0));
        assert_none!(now.mean_free_time(&now));
    }
}
