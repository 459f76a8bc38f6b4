//! The box around grains.

use crate::math::Vec3;

/// Lower and upper corner [m] of the smallest box that holds grains at `positions` [n, 3] [m] with `radii` [n] [m]; nothing
/// without grains.
pub fn extent(positions: &[Vec3], radii: &[f64]) -> Option<(Vec3, Vec3)> {
    let boxes = positions.iter().zip(radii).map(|(&position, &radius)| {
        let reach = Vec3::new(radius, radius, radius);
        (position - reach, position + reach)
    });
    boxes.reduce(|(lower, upper), (low, high)| (lower.min(low), upper.max(high)))
}
