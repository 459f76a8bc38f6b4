/// What a law of friction can do.
use super::spring::Memory;
use crate::contact::{ContactGeometry, Elastic, PairConstants};
use crate::law::{Faults, Law};
use crate::math::{Pace, Real, Vector};
use crate::particles::Mixture;

/// What a law needs to know of the contact over one step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sliding<F = f64> {
    /// Unit normal from i to j at the end of the step.
    pub normal: Vector<F>,
    /// Displacement of j's surface relative to i's over the step, tangential [m]; zero for a law without memory.
    pub displacement: Vector<F>,
    /// Velocity of j's surface relative to i's at the end of the step, tangential [m/s].
    pub velocity: Vector<F>,
    /// Angle [rad] by which the pair turned about its normal over the step: dt (w_i + w_j) . n / 2; zero for a law
    /// without memory.
    pub turn_about_normal: F,
    /// The elastic law's force and stiffness.
    pub elastic: Elastic<F>,
    /// Normal dashpot [N s/m].
    pub normal_dashpot: F,
    /// Normal force [N] with its dashpot, repulsion > 0.
    pub normal_force: F,
    /// Length of the step [s], for laws that carry it.
    pub dt: F,
}

/// What a law of friction can do.
///
/// What takes an `F` is worked out for one contact or for several side by side: a choice is a selection, and all of it is
/// `#[inline(always)]`, as what is not inlined is built for the plainest processor.
pub trait FrictionLaw: Law {
    /// What a contact remembers from step to step; `()` for nothing.
    type Memory<F: Real>: Memory<F>;

    /// The force on i [N] and what to remember. Over the step friction takes `force . displacement` less the growth of
    /// the energy remembered.
    fn force<F: Real>(
        &self,
        pair: &PairConstants<F>,
        geometry: &ContactGeometry<F>,
        sliding: &Sliding<F>,
        before: &Self::Memory<F>,
    ) -> (Vector<F>, Self::Memory<F>);

    /// How fast it is, with the elastic law and the normal dashpot [N s/m].
    fn pace(&self, pair: &PairConstants, geometry: &ContactGeometry, elastic: &Elastic, dashpot: f64)
    -> Pace;

    /// Writes down the coefficients for a pair of materials, or what the pair has by itself.
    fn settle(&self, pair: &mut PairConstants, own: Option<&Mixture>);

    /// Static friction, and dynamic friction where the law has one of its own.
    fn coefficients(&self) -> (f64, Option<f64>);

    /// Whether it can outgrow the elastic contact, so that only the overlap of the moment says how fast it is.
    fn outgrows_contact(&self) -> bool {
        false
    }
}

/// Faults of the coefficients that every law of friction has.
pub(super) fn check_coefficients(faults: &mut Faults, at_rest: f64, in_motion: Option<f64>) {
    faults.zero_or_more("static_friction", at_rest);
    let Some(in_motion) = in_motion else { return };
    faults.zero_or_more("dynamic_friction", in_motion);
    if in_motion > at_rest {
        let message = format!("dynamic friction {in_motion} is above static friction {at_rest}");
        faults.fail("dynamic_friction", message);
    }
}
