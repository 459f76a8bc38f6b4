//! The box around grains.

use crate::math::Vec3;

/// Lower and upper corner [m] of the smallest box that holds places [m]; nothing without any.
pub fn extent_of_places(places: impl Iterator<Item = Vec3>) -> Option<(Vec3, Vec3)> {
    around(places.map(|place| (place, place)))
}

/// Lower and upper corner [m] of the smallest box that holds grains at `positions` [n, 3] [m] with `radii` [n] [m]; nothing
/// without grains.
pub fn extent(positions: &[Vec3], radii: &[f64]) -> Option<(Vec3, Vec3)> {
    let boxes = positions.iter().zip(radii).map(|(&position, &radius)| {
        let reach = Vec3::new(radius, radius, radius);
        (position - reach, position + reach)
    });
    around(boxes)
}

fn around(mut boxes: impl Iterator<Item = (Vec3, Vec3)>) -> Option<(Vec3, Vec3)> {
    let first = boxes.next()?;
    Some(boxes.fold(first, |(lower, upper), (low, high)| (lower.min(low), upper.max(high))))
}
