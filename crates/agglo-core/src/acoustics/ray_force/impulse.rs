//! The force of [A] 7 for the duration of the pulse; the page of [`super`] has the equation.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Impedance, RayLaw};
use crate::acoustics::{Hit, Medium};
use crate::law::{Context, Faults, Law};
use crate::math::Vec3;
use crate::particles::Property;
use crate::particles::property::{SHEAR_SOUND_SPEED, SOUND_SPEED};
use crate::units::Time;

/// |F| = sqrt(I (1-R) rho_t c_t a_r) for the duration of the pulse.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Impulse {
    /// How long the pulse presses.
    pub duration: Time,
}

/// The force of [A] 7 [N], of each wave that enters.
pub(super) fn force_of_waves(hit: &Hit, impedance: Impedance) -> Vec3 {
    // Rounding may leave less than nothing where only a shear wave enters.
    let entering = (hit.power_in * (1.0 - hit.reflectance - hit.sheared)).max(0.0);
    let sound = hit.refracted * (entering * impedance.sound * hit.ray_area).sqrt();
    let shearing = hit.power_in * hit.sheared;
    sound + hit.refracted_shear * (shearing * impedance.shear * hit.ray_area).sqrt()
}

impl Law for Impulse {
    const READS: &'static [Property] = &[SOUND_SPEED, SHEAR_SOUND_SPEED];

    fn faults(&self, faults: &mut Faults, _: &Context<'_>) {
        faults.positive("duration", self.duration);
    }
}

impl RayLaw for Impulse {
    fn force(&self, hit: &Hit, impedance: Impedance, _: &Medium) -> Vec3 {
        force_of_waves(hit, impedance)
    }

    fn duration(&self, _: f64, _: &Medium) -> f64 {
        self.duration.si()
    }
}
