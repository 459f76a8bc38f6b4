//! What a law between grains at a distance can do.

use super::Source;
use crate::law::Law;

/// What a law between grains at a distance can do.
pub trait NearLaw: Law {
    /// Repulsion [N] of two grains at a distance of centers [m].
    fn force(&self, a: &Source, b: &Source, distance: f64) -> f64;

    /// Energy [J]; minus its slope over the distance is the force.
    fn energy(&self, a: &Source, b: &Source, distance: f64) -> f64;

    /// Size of the gradient of the force [N/m], or a bound on it, at a distance of centers [m].
    fn gradient(&self, a: &Source, b: &Source, distance: f64) -> f64;

    /// The power b with which the force falls off at least as fast as d^-b beyond any distance.
    fn slowest_decay(&self) -> f64;

    /// Whether the gradient has a bound however close grains come.
    fn is_capped(&self) -> bool {
        false
    }

    /// Whether it acts on charges alone.
    fn is_by_charge(&self) -> bool {
        false
    }
}
