//! When two grains count as touching.
//!
//! Grains that are placed as touching are apart or overlap by round-off, by chance and by place in space. So whoever
//! counts who hangs together asks here: bonds at the start, clusters and contacts in tables, quantities and frames.
//! Forces do not: they act from the first overlap.

/// Part of the smaller radius within which the surfaces of two grains count as touching; the default of
/// `bonds.beam.gap` and `measures.cluster_gap`. Far above round-off, far below what a picture shows.
pub const TOUCHING: f64 = 1e-3;

/// The default of a key that says when grains are close.
pub fn touching() -> f64 {
    TOUCHING
}

/// Distance of two centers [m] up to which surfaces are no farther apart than `part` of the smaller radius.
#[inline]
pub fn reach(a: f64, b: f64, part: f64) -> f64 {
    a + b + part * a.min(b)
}

/// Whether the surfaces of two grains are no farther apart than `part` of the smaller radius, from the square of the
/// distance of their centers [m²].
///
/// ```
/// # extern crate agglo_core as agglo;
/// use agglo::contact::closeness::{TOUCHING, are_close};
/// // Radii of 0.1 m and 0.2 m: 0.1 + 0.2 is not 0.3 in doubles.
/// assert!(are_close(0.3 * 0.3, 0.1, 0.2, TOUCHING));
/// assert!(are_close(0.300_09_f64.powi(2), 0.1, 0.2, TOUCHING));
/// assert!(!are_close(0.300_11_f64.powi(2), 0.1, 0.2, TOUCHING));
/// assert!(!are_close(0.300_11_f64.powi(2), 0.2, 0.1, TOUCHING));
/// ```
#[inline]
pub fn are_close(distance_squared: f64, a: f64, b: f64, part: f64) -> bool {
    let reach = reach(a, b, part);
    distance_squared <= reach * reach
}
