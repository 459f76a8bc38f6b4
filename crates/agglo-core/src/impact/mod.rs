//! What happens when two hard spheres meet. Laws here are pure: they are asked, and return an outcome with its energies;
//! the engine changes the state and keeps the ledger.
//!
//! Signs: the normal points from the first partner to the second; the approach speed is the part of the first
//! velocity less the second along it, above zero when they approach.

mod body;
mod collide;
pub mod contact_area;
pub mod contact_time;
pub mod cooling;
mod decay;
pub mod fragmentation;
pub mod heat;
mod laws;
pub mod reaction_heat;
pub mod restitution;
pub mod self_gravity;
pub mod softening;
mod solve;
pub mod sticking;
pub mod tangential;
pub mod work;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use body::{Body, ImpactEnergy, Outcome};
pub use cooling::Cooling;
pub use fragmentation::{Draws, Fragmentation};
pub use heat::HeatBalance;
pub use laws::ImpactLaws;
pub use restitution::Restitution;
pub use sticking::Sticking;
pub use tangential::Tangential;

use crate::law::Chosen;

/// Laws of impact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Impact {
    /// Along the line of centers.
    pub restitution: Restitution,
    /// Across the line of centers; frictionless if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tangential: Option<Tangential>,
    /// What becomes of a pair with restitution 0.
    #[serde(default)]
    pub sticking: Sticking,
    /// How agglomerates break; they do not if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fragmentation: Option<Fragmentation>,
    /// Where lost energy goes.
    #[serde(default)]
    pub heat: HeatBalance,
    /// Cooling between impacts; none if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cooling: Option<Cooling>,
}

impl Impact {
    /// All that the scenario has chosen.
    pub fn chosen(&self) -> impl Iterator<Item = Chosen<'_>> {
        [
            Some(self.restitution.chosen()),
            self.tangential.as_ref().map(Tangential::chosen),
            Some(self.sticking.chosen()),
            Some(self.heat.chosen()),
            self.fragmentation.as_ref().map(Fragmentation::chosen),
            self.cooling.as_ref().map(Cooling::chosen),
        ]
        .into_iter()
        .flatten()
    }
}
