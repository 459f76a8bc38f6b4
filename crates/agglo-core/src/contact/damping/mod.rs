//! Dissipation along the line of centers.

mod restitution;
mod viscous_area;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use restitution::{Restitution, damping_ratio};
pub use viscous_area::ViscousArea;

use super::{Normal, PairConstants, Touch};
use crate::math::Pace;

/// The closed set of normal damping laws; each is a dashpot whose coefficient depends on the contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Damping {
    /// Coefficient times contact area (Zohdi 2016, eq. 19).
    ViscousArea(ViscousArea),
    /// Coefficient from a coefficient of restitution (Tsuji; Antypov and Elliott).
    Restitution(Restitution),
}

impl Damping {
    /// Dashpot coefficient c [N s/m]; the force on the pair is -c times the speed of separation.
    #[inline]
    pub fn coefficient(&self, pair: &PairConstants, touch: &Touch, normal: &Normal) -> f64 {
        match self {
            Self::ViscousArea(law) => law.coefficient(touch),
            Self::Restitution(law) => law.coefficient(pair, touch, normal),
        }
    }

    /// How fast the dashpot is at this overlap.
    pub fn pace(&self, pair: &PairConstants, touch: &Touch, normal: &Normal) -> Pace {
        match self {
            Self::ViscousArea(law) => law.pace(touch),
            Self::Restitution(law) => law.pace(pair, touch, normal),
        }
    }

    /// Whether it can outgrow the elastic contact, so that only the overlap of the moment says how fast it is.
    pub fn outgrows_contact(&self) -> bool {
        matches!(self, Self::ViscousArea(_))
    }
}
