//! The choice of an engine: what kind of spheres, and how time goes on.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::hard::{EventDriven, TimeStepped};
use super::soft::{Staggered, Verlet};

/// The closed set of engines.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Engine {
    /// Soft spheres: the staggered implicit scheme of [A] 31-34 with adaptive steps.
    Staggered(Staggered),
    /// Soft spheres: explicit velocity Verlet.
    Verlet(Verlet),
    /// Hard spheres: from collision to collision, each at its exact time.
    EventDriven(EventDriven),
    /// Hard spheres: steps that are as long as gaps allow, [B] 6.14.
    TimeStepped(TimeStepped),
}

impl Engine {
    /// Whether it moves hard spheres.
    pub fn is_hard(&self) -> bool {
        matches!(self, Self::EventDriven(_) | Self::TimeStepped(_))
    }
}
