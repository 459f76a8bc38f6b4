//! Restitution: relative normal velocity after over before.

pub mod constant;
pub mod hardness;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use constant::Constant;
pub use hardness::Hardness;

/// The closed set of laws of restitution.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Restitution {
    /// From the pressure of the impact over the hardness, [B] 3.1.
    Hardness(Hardness),
    /// The same for all impacts.
    Constant(Constant),
}
