//! What holds grains together.

mod beam;
mod strain_bond;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use beam::{Beam, BeamLoad, BeamPair, BeamState, Break};
pub use strain_bond::StrainBond;

/// The closed set of bond laws.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Bonds {
    /// The paper's bond (Zohdi 2016, eqs 25-26), which acts in contact only and cannot resist tension.
    StrainBond(StrainBond),
    /// Parallel-bond beam (Potyondy and Cundall 2004).
    Beam(Beam),
}
