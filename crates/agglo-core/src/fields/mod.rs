//! Forces on single grains, and between grains at a distance.

mod drag;
mod expression;
mod flow;
mod gravity;
mod lorentz;
mod magnetic;
pub mod near_field;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use drag::{Drag, DragLaw, spin_coefficient};
pub use expression::{Expression, FieldVector, evaluate};
pub use flow::{Flow, FlowAt, FlowField};
pub use gravity::Gravity;
pub use lorentz::Lorentz;
pub use magnetic::Magnetic;
pub use near_field::NearField;

/// The fields of a scenario; each is off if left out.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fields {
    /// Weight, with buoyancy if wanted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gravity: Option<Gravity>,
    /// Drag of the medium.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drag: Option<Drag>,
    /// Electric and magnetic force on charges.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lorentz: Option<Lorentz>,
    /// Magnetic force on magnetizable grains.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub magnetic: Option<Magnetic>,
    /// Attraction and repulsion between grains at a distance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub near_field: Option<NearField>,
}
