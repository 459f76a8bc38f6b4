//! Drag of the medium ([A] 30) and what goes beyond it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::FieldVector;

/// Drag on every grain; viscosity and density are the medium's.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Drag {
    /// The law.
    pub law: DragLaw,
    /// Velocity of the medium; at rest if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub medium_velocity: Option<FieldVector<0, 1, -1, 0, 0>>,
    /// Part of the displaced mass that moves with a grain (1/2 for a sphere in an ideal fluid).
    #[serde(default)]
    pub added_mass: f64,
}

/// The closed set of drag laws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DragLaw {
    /// 6 π η R v: Reynolds number well below 1.
    Stokes,
    /// Schiller and Naumann's factor 1 + 0.15 Re^0.687 on Stokes' law, up to Re = 1000.
    SchillerNaumann,
}
