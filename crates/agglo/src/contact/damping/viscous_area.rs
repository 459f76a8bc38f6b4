//! A dashpot proportional to the contact area ([A] 19).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::contact::Touch;
use crate::units::AreaDamping;

/// F = c A times the speed of approach.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ViscousArea {
    /// c.
    pub coefficient: AreaDamping,
}

impl ViscousArea {
    /// Dashpot coefficient [N s/m].
    #[inline]
    pub fn coefficient(&self, touch: &Touch) -> f64 {
        self.coefficient.si() * touch.area()
    }
}
