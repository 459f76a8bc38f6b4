//! A hit presses with the momentum that the ray loses, for the duration of the pulse.
//!
//! # Equation
//! ```text
//! F = (I/c_i)(d_in - ℛ d_out), for τ                                                            A13
//! T = (r_hit - r_i) x F about the center of the grain                                           [A] 18
//! ```
//!
//! # Source
//! The momentum balance of a ray: what it has lost when it leaves, the grain has gained.
//!
//! # Symbols
//! | symbol      | name in code             | unit | meaning                       |
//! |-------------|--------------------------|------|-------------------------------|
//! | I           | `Hit::power_in`          | W    | power of the ray that arrives |
//! | ℛ           | `Hit::reflectance`       | 1    | part of it that is reflected  |
//! | c_i         | `Medium::sound_speed`    | m/s  | speed of sound in the medium  |
//! | d_in, d_out | `Hit::direction_in/_out` | 1    | unit vectors before and after |
//! | τ           | `duration`               | s    | how long the pulse presses    |
//!
//! # Valid when
//! Rays hold (wavelength much smaller than the grain); all that enters the grain stays in it, whatever it is.
//!
//! # Compared with others
//! What the ray loses in momentum the grain gains: the mean push of a beam, where the paper's force (`impulse`) is the pressure
//! amplitude of the wave in the grain. At normal incidence this one is smaller by the factor v_t (1 + ℛ)/(c_i (1 - ℛ)), with
//! v_t = F/(ρ_t c_t a_r) the velocity of that wave.
//!
//! # In a scenario
//! ```toml
//! [acoustics.force.radiation_pressure]
//! duration = "1 us"
//! ```

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
