//! Where a simulation of hard spheres stands in time.

use serde::{Deserialize, Serialize};

/// Where the simulation stands in time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Clock {
    /// Simulated time [s].
    pub time: f64,
    /// What rounding has taken from the sum of the steps [s]; 0 for the event-driven engine.
    pub lag: f64,
    /// Events dealt with, or steps.
    pub step: u64,
    /// Length of the last step [s]; mean time between two collisions for the event-driven engine.
    pub last_step: f64,
}
