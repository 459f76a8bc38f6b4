//! The momentum that a ray loses, for the duration of the pulse; the page of [`super`] has the equation.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Impedance, RayLaw};
use crate::acoustics::{Hit, Medium};
use crate::law::{Context, Faults, Law};
use crate::math::Vec3;
use crate::particles::Property;
use crate::particles::property::{SHEAR_SOUND_SPEED, SOUND_SPEED};
use crate::units::Time;

/// F = (I/c)(d_in - R d_out) for the duration of the pulse.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RadiationPressure {
    /// How long the pulse presses.
    pub duration: Time,
}

impl Law for RadiationPressure {
    const READS: &'static [Property] = &[SOUND_SPEED, SHEAR_SOUND_SPEED];

    fn faults(&self, faults: &mut Faults, _: &Context<'_>) {
        faults.positive("duration", self.duration);
    }
}

impl RayLaw for RadiationPressure {
    fn force(&self, hit: &Hit, _: Impedance, medium: &Medium) -> Vec3 {
        let lost = hit.direction_in - hit.direction_out * hit.reflectance;
        lost * (hit.power_in / medium.sound_speed.si())
    }

    fn duration(&self, _: f64, _: &Medium) -> f64 {
        self.duration.si()
    }
}
