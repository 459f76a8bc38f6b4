/// What a dashpot along the line of centers can do.
use crate::contact::{ContactGeometry, Elastic, PairConstants};
use crate::law::Law;
use crate::math::Real;
use crate::particles::Mixture;

/// What a dashpot along the line of centers can do.
///
/// What takes an `F` is worked out for one contact or for several side by side: a choice is a selection, and all of it is
/// `#[inline(always)]`, as what is not inlined is built for the plainest processor.
pub trait DampingLaw: Law {
    /// Whether the coefficient takes the stiffness of the elastic law.
    const TAKES_STIFFNESS: bool;

    /// Dashpot coefficient c [N s/m]; the force on the pair is -c times the speed of separation.
    fn coefficient<F: Real>(
        &self,
        pair: &PairConstants<F>,
        geometry: &ContactGeometry<F>,
        elastic: &Elastic<F>,
    ) -> F;

    /// Writes down what it has for a pair of materials, or what the pair has by itself.
    fn settle(&self, _: &mut PairConstants, _: Option<&Mixture>) {}

    /// Whether a pair of materials can have a restitution of its own.
    fn reads_restitution(&self) -> bool {
        false
    }

    /// Whether it can outgrow the elastic contact, so that only the overlap of the moment says how fast it is.
    fn outgrows_contact(&self) -> bool {
        false
    }
}
