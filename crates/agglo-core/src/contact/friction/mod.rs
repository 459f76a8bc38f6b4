//! Resistance to sliding: one law of the paper without memory, one with a spring that each contact keeps.

mod mindlin;
mod regularized;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use mindlin::{Mindlin, Sliding, TangentialSpring};
pub use regularized::Regularized;

/// The closed set of friction laws.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Friction {
    /// The paper's regularized law (Zohdi 2016, eqs 20-24); its stick force carries the time step and does not converge.
    Regularized(Regularized),
    /// Mindlin / Cundall-Strack: a tangential spring kept per contact.
    Mindlin(Mindlin),
}
