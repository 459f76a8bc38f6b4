/// What an elastic law along the line of centers can do.
use crate::contact::{ContactGeometry, PairConstants};
use crate::law::Law;
use crate::math::{Pace, Real};
use crate::particles::Material;

/// What an elastic law along the line of centers can do.
///
/// What takes an `F` is worked out for one contact or for several side by side: a choice is a selection, and all of it is
/// `#[inline(always)]`, as what is not inlined is built for the plainest processor.
pub trait NormalLaw: Law {
    /// Repulsion [N].
    fn force<F: Real>(&self, pair: &PairConstants<F>, geometry: &ContactGeometry<F>) -> F;

    /// Slope of the force over the overlap [N/m].
    fn tangent_stiffness<F: Real>(&self, pair: &PairConstants<F>, geometry: &ContactGeometry<F>) -> F;

    /// Energy stored [J]; the force is its slope over the overlap.
    fn energy(&self, pair: &PairConstants, geometry: &ContactGeometry) -> f64;

    /// n where the force grows like overlap^n at small overlap.
    fn exponent(&self) -> f64;

    /// How fast a contact is that reaches this overlap; the law is stiffest there if it says nothing else.
    #[inline]
    fn pace(&self, pair: &PairConstants, geometry: &ContactGeometry) -> Pace {
        Pace::of_spring(self.tangent_stiffness(pair, geometry), geometry.effective_mass)
    }

    /// How fast a wave crosses a grain of this radius [m], where a step must not outrun it either.
    fn wave_pace(&self, _: &Material, _radius: f64) -> Pace {
        Pace::NONE
    }
}
