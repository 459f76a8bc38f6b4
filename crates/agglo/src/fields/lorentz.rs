//! Electric and magnetic force on charges ([A] 27).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::FieldVector;

/// q (E + v x B).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lorentz {
    /// E; none if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub electric_field: Option<FieldVector<1, 1, -3, 0, -1>>,
    /// B; none if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub magnetic_flux_density: Option<FieldVector<1, 0, -2, 0, -1>>,
}
