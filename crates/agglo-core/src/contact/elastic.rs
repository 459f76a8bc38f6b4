//! What the elastic law makes of a contact.

/// What the elastic law makes of a contact, as damping and friction take it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Elastic<F = f64> {
    /// Repulsion [N].
    pub force: F,
    /// Slope of the repulsion over the overlap [N/m]; 0 where no law takes it.
    pub stiffness: F,
    /// (n + 1)/(2 n) where the repulsion grows like overlap^n at small overlap: what a dashpot of constant restitution takes.
    pub damped_part: F,
}

/// (n + 1)/(2 n).
#[inline(always)]
pub(super) fn damped_part(exponent: f64) -> f64 {
    (exponent + 1.0) / (2.0 * exponent)
}
