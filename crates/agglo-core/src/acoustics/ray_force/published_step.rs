//! The force of [A] 7 for one step, as printed; the page of [`super`] has the equation.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::impulse::force_of_waves;
use super::{Impedance, RayLaw};
use crate::acoustics::{Hit, Medium};
use crate::law::{Context, Faults, Law};
use crate::math::Vec3;
use crate::particles::Property;
use crate::particles::property::{SHEAR_SOUND_SPEED, SOUND_SPEED};

/// |F| = sqrt(I (1-R) rho_t c_t a_r) for one step of xi R / c.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PublishedStep {
    /// ξ: part of a mean grain radius that a ray travels in one step; up to 1.
    #[serde(default = "default_xi")]
    pub step_fraction: f64,
}

fn default_xi() -> f64 {
    0.1
}

impl Law for PublishedStep {
    const READS: &'static [Property] = &[SOUND_SPEED, SHEAR_SOUND_SPEED];

    fn faults(&self, faults: &mut Faults, _: &Context<'_>) {
        if self.step_fraction <= 0.0 || self.step_fraction > 1.0 {
            let message = format!("found {}; a number above 0 and up to 1 is wanted", self.step_fraction);
            faults.fail("step_fraction", message);
        }
    }

    fn notes(&self, _: &Context<'_>) -> Vec<String> {
        let note = "acoustics.force.published_step: the impulse of a hit is proportional to the step and does not converge; impulse does";
        vec![note.to_owned()]
    }

    fn warnings(&self) -> &'static [&'static str] {
        &[
            "acoustics.force.published_step gives a force for one step: halving the step halves the impulse, so the \
           answer does not converge",
        ]
    }
}

impl RayLaw for PublishedStep {
    fn force(&self, hit: &Hit, impedance: Impedance, _: &Medium) -> Vec3 {
        force_of_waves(hit, impedance)
    }

    fn duration(&self, radius: f64, medium: &Medium) -> f64 {
        self.step_fraction * radius / medium.sound_speed.si()
    }

    fn is_impulse(&self) -> bool {
        false
    }
}
