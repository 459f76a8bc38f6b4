//! Magnetic force grad(gamma B.B) ([A] 29).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::FieldVector;
use crate::units::{Length, Magnetisability};

/// Force up the gradient of B.B.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Magnetic {
    /// gamma.
    pub magnetisability: Magnetisability,
    /// B.
    pub magnetic_flux_density: FieldVector<1, 0, -2, 0, -1>,
    /// Distance over which the gradient is taken; a ten-thousandth of a grain's radius if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub difference: Option<Length>,
}
