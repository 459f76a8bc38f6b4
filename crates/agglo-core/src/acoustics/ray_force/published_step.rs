//! A hit presses with the force of the wave that enters, for one step, as printed; does not converge.
//!
//! # Equation
//! ```text
//! F = √(I (1 - ℛ) ρ_t c_t a_r) along the refracted ray, for the step in which the ray lands     [A] 7
//! Δt = ξ R/c_i
//! ```
//! The force of `impulse`, of each wave that enters.
//!
//! # Source
//! T. I. Zohdi, Comput. Mech. 57, 465 (2016), section 3.1, remark 2, with the step that the paper advises.
//!
//! # Symbols
//! | symbol  | name in code          | unit   | meaning                                                     |
//! |---------|-----------------------|--------|-------------------------------------------------------------|
//! | I       | `Hit::power_in`       | W      | power of the ray that arrives                               |
//! | ℛ       | `Hit::reflectance`    | 1      | part of it that is reflected                                |
//! | ρ_t c_t | `Impedance::sound`    | Pa s/m | impedance of the grain                                      |
//! | a_r     | `Hit::ray_area`       | m²     | area of the ray in its beam                                 |
//! | ξ       | `step_fraction`       | 1      | part of a mean radius that a ray travels in one step        |
//! | R       | `radius`              | m      | mean radius of the grains                                   |
//! | c_i     | `Medium::sound_speed` | m/s    | speed of sound in the medium                                |
//!
//! # Valid when
//! Never as physics: half the step is half the impulse. It is here to run the paper's sample problem as printed, with the
//! step that the paper advises.
//!
//! # Compared with others
//! `impulse` has the same force and presses for the duration of the pulse, whatever the step.
//!
//! # In a scenario
//! ```toml
//! [acoustics.force.published_step]
//! step_fraction = 0.1
//! ```

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
