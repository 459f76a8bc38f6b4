//! What a contact remembers of friction from step to step.

use serde::{Deserialize, Serialize};

use crate::math::{Real, Vector};

/// What a law of friction remembers, and how it is kept: in the one form that contacts and checkpoints have for it.
pub trait Memory<F: Real>: Copy {
    /// Whether there is anything to keep.
    const IS_KEPT: bool;

    /// From what was kept.
    fn taken_from(kept: &TangentialSpring<F>) -> Self;

    /// To be kept.
    fn kept(self) -> TangentialSpring<F>;
}

impl<F: Real> Memory<F> for () {
    const IS_KEPT: bool = false;

    #[inline(always)]
    fn taken_from(_: &TangentialSpring<F>) -> Self {}

    #[inline(always)]
    fn kept(self) -> TangentialSpring<F> {
        TangentialSpring::default()
    }
}

/// The force of a tangential spring and the stiffness it was loaded with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TangentialSpring<F: Real = f64> {
    /// Force on i [N].
    pub force: Vector<F>,
    /// Stiffness [N/m] at that moment.
    pub stiffness: F,
    /// Whether the contact slips, so that dynamic friction is its limit.
    pub sliding: F::Mask,
}

impl<F: Real> Memory<F> for TangentialSpring<F> {
    const IS_KEPT: bool = true;

    #[inline(always)]
    fn taken_from(kept: &Self) -> Self {
        *kept
    }

    #[inline(always)]
    fn kept(self) -> Self {
        self
    }
}

impl TangentialSpring {
    /// Energy stored [J].
    #[inline]
    pub fn energy(&self) -> f64 {
        if self.stiffness > 0.0 { 0.5 * self.force.norm_squared() / self.stiffness } else { 0.0 }
    }
}

impl<F: Real> TangentialSpring<F> {
    /// The force [N] after the contact has turned to `normal` and by `turn_about_normal` [rad] about it, relaxed
    /// where the stiffness [N/m] has fallen.
    #[inline(always)]
    pub(super) fn carried(&self, normal: Vector<F>, turn_about_normal: F, stiffness: F) -> Vector<F> {
        let zero = F::of(0.0);
        let before = self.force.norm_squared();
        if F::all(before.at_most(zero)) {
            return Vector::default();
        }
        let turned = self.force.rejected_from(normal) + normal.cross(self.force) * turn_about_normal;
        let after = turned.norm_squared();
        // |F| k'/k in one root: what it was where the stiffness has not fallen.
        let fell = stiffness.below(self.stiffness);
        let (now, then) =
            (F::select(fell, stiffness, F::of(1.0)), F::select(fell, self.stiffness, F::of(1.0)));
        let size = (before * (now * now) / (after * (then * then))).sqrt();
        let is_there = F::both(zero.below(before), zero.below(after));
        Vector::select(is_there, turned * size, Vector::default())
    }
}

/// The vector, cut to this length if it is longer.
///
/// The spring itself is cut, not set to the whole force: a spring set to the force would store what the dashpot
/// gave, and hand it back as motion.
#[inline(always)]
pub(super) fn shortened<F: Real>(vector: Vector<F>, length: F) -> Vector<F> {
    let size = vector.norm_squared();
    Vector::select((length * length).below(size), vector * (length / size.sqrt()), vector)
}
