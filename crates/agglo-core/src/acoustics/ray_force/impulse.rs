//! A hit presses with the force of the wave that enters, for the duration of the pulse.
//!
//! # Equation
//! ```text
//! F = √(I (1 - ℛ) ρ_t c_t a_r) along the refracted ray, for τ                                   [A] 7
//! T = (r_hit - r_i) x F about the center of the grain                                           [A] 18
//! ```
//! In a solid with a `shear_sound_speed` two waves enter: the law adds up the same for each, with its own part of the power, its
//! own impedance (ρ_t c_t or ρ_t c_s) and its own direction. So F²/(impedance a_r) summed over the two is the power that
//! enters, as in the paper.
//!
//! # Source
//! T. I. Zohdi, Comput. Mech. 57, 465 (2016), section 3.1, remark 2; the duration is ours.
//!
//! # Symbols
//! | symbol  | name in code         | unit   | meaning                       |
//! |---------|----------------------|--------|-------------------------------|
//! | I       | `Hit::power_in`      | W      | power of the ray that arrives |
//! | ℛ       | `Hit::reflectance`   | 1      | part of it that is reflected  |
//! | ρ_t c_t | `Impedance::sound`   | Pa s/m | impedance of the grain        |
//! | ρ_t c_s | `Impedance::shear`   | Pa s/m | the same of its shear waves   |
//! | a_r     | `Hit::ray_area`      | m²     | area of the ray in its beam   |
//! | τ       | `duration`           | s      | how long the pulse presses    |
//!
//! # Valid when
//! Rays hold (wavelength much smaller than the grain); nothing that enters the grain comes out. Totally reflected rays do
//! not press.
//!
//! # Compared with others
//! In the paper a hit presses for the one time step in which the ray lands (`published_step`), so its impulse shrinks with
//! the step and the answer does not converge. Here a hit is an impulse F τ, whatever the step. The paper calls I an energy
//! [J], but only a power gives a force: sqrt(W · kg/(m² s) · m²) = sqrt(kg² m²/s⁴) = N.
//!
//! [A] 7 equates the power that enters with F²/(ρ_t c_t a_r), force times velocity of the wave in the grain: it is the pressure
//! amplitude of the wave, which changes its sign twice per period in a real wave, so it is not a mean push, and the ray's
//! own momentum (I/c) does not account for it. `radiation_pressure` is that mean push.
//!
//! # In a scenario
//! ```toml
//! [acoustics.force.impulse]
//! duration = "1 us"
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::acoustics::{Hit, Impedance, Impulse, Medium, RayForce};
//! use agglo::{math::Vec3, units::Quantity};
//! let law = RayForce::Impulse(Impulse { duration: Quantity(1e-6) });
//! let down = -Vec3::AXES[2];
//! let hit = Hit { power_in: 100.0, reflectance: 0.75, ray_area: 1e-4, refracted: down, ..Hit::default() };
//! let ceramic = Impedance { sound: 27e6, shear: 0.0 };
//! let force = law.force(&hit, ceramic, &Medium::default());
//! let by_hand = (100.0 * 0.25 * 27e6 * 1e-4_f64).sqrt(); // 260 N
//! assert!((force - down * by_hand).norm() < 1e-12);
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
