//! What a law of the force of a ray can do.

use crate::acoustics::{Hit, Medium};
use crate::law::Law;
use crate::math::Vec3;

/// What a law of the force of a ray can do.
pub trait RayLaw: Law {
    /// Force [N] on the grain that is hit, whose `impedance` it is.
    fn force(&self, hit: &Hit, impedance: Impedance, medium: &Medium) -> Vec3;

    /// How long a hit presses [s]; `radius` [m] is the mean radius of the grains.
    fn duration(&self, radius: f64, medium: &Medium) -> f64;

    /// Whether a hit is an impulse, whatever the step; otherwise a force for one step.
    fn is_impulse(&self) -> bool {
        true
    }
}

/// Impedances of a grain [Pa s/m]: its density times the speed of a wave in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impedance {
    /// Of sound.
    pub sound: f64,
    /// Of shear waves; 0 in a fluid.
    pub shear: f64,
}
