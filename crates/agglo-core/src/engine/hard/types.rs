//! What a scenario says of the engines of hard spheres.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::units::{Quantity, Time};

/// From collision to collision.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EventDriven {
    /// A pair that bounces again and again, each time less than this after the last, then bounces elastically (after Luding and
    /// McNamara 1998): so inelastic collapse cannot bring the clock to a halt. Worked out from the start if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact_duration: Option<Time>,
}

/// Step by step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TimeStepped {
    /// Part of the shortest time of approach that a step takes; above 0, up to 1.
    #[serde(default = "default_fraction")]
    pub fraction: f64,
    /// Shortest step, not above `longest_step`. With `gap` and `all`, steps are shorter only where spheres are so small that this one would take them
    /// into one another by more than a tenth of their radii.
    #[serde(default = "default_shortest")]
    pub shortest_step: Time,
    /// Longest step.
    #[serde(default = "default_longest")]
    pub longest_step: Time,
    /// The distance that a pair has to go.
    #[serde(default)]
    pub distance: Distance,
    /// Which pairs are dealt with.
    #[serde(default)]
    pub pairs: Pairs,
}

fn default_fraction() -> f64 {
    0.5
}
fn default_shortest() -> Time {
    Quantity(1e-8)
}
fn default_longest() -> Time {
    Quantity(1e-3)
}

impl Default for TimeStepped {
    fn default() -> Self {
        Self {
            fraction: default_fraction(),
            shortest_step: default_shortest(),
            longest_step: default_longest(),
            distance: Distance::default(),
            pairs: Pairs::default(),
        }
    }
}

/// The distance that a pair has to go before it touches.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Distance {
    /// The gap between the surfaces.
    #[default]
    Gap,
    /// The distance of the centers, of pairs that part too, as [B] 6.14 prints.
    Centers,
}

/// Which pairs a step deals with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Pairs {
    /// All that touch.
    #[default]
    All,
    /// Each grain's nearest neighbor, as in [B].
    Nearest,
}
