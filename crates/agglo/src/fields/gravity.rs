//! Weight, with Archimedes' buoyancy if wanted.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::units::{Acceleration, Triple};

/// Uniform gravity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Gravity {
    /// Acceleration of free fall.
    pub acceleration: Triple<Acceleration>,
    /// Whether the medium carries part of the weight.
    #[serde(default)]
    pub buoyancy: bool,
}
