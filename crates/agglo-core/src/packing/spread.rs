//! How far spheres must be spread to lie clear of one another.

use crate::math::Vec3;
use crate::neighbors::PairList;

/// Part by which spheres that were spread are farther apart than touching: far above round-off.
const CLEARANCE: f64 = 1e-6;

/// The least factor, 1 or more, by which all places [n, 3] [m] are to be multiplied so that spheres of these radii [n] [m] about
/// them do not overlap. It is infinite where two are at one place.
///
/// ```
/// # extern crate agglo_core as agglo;
/// use agglo::{math::Vec3, packing::least_spread};
/// let places = [Vec3::ZERO, Vec3::new(2.0, 0.0, 0.0), Vec3::new(9.0, 0.0, 0.0)];
/// assert!((least_spread(&places, &[1.0, 2.0, 1.0]) - 1.5).abs() < 1e-5);
/// assert_eq!(least_spread(&places, &[0.5; 3]), 1.0);
/// ```
pub fn least_spread(places: &[Vec3], radii: &[f64]) -> f64 {
    let mut list = PairList::default();
    list.build(places, radii, 0.0, CLEARANCE * radii.iter().copied().fold(0.0, f64::max));
    let factor = |(a, b): (u32, u32)| {
        let (i, j) = (a as usize, b as usize);
        (radii[i] + radii[j]) * (1.0 + CLEARANCE) / (places[i] - places[j]).norm()
    };
    list.pairs().map(factor).fold(1.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::{Purpose, Stream};

    /// Against all pairs: after spreading none overlap, and one per mille less leaves a pair that does.
    #[test]
    fn it_is_enough_and_no_more() {
        let mut stream = Stream::new(4, Purpose::Sampling, 0);
        let places: Vec<Vec3> =
            (0..200).map(|_| stream.direction() * (10.0 * stream.uniform().cbrt())).collect();
        let radii: Vec<f64> = (0..200).map(|k| 0.3 + 0.01 * f64::from(k % 50)).collect();
        let factor = least_spread(&places, &radii);
        assert_above!(factor, 1.0);
        let overlaps = |factor: f64| {
            let pairs = (0..200).flat_map(|i| (0..i).map(move |j| (i, j)));
            pairs.filter(|&(i, j)| (places[i] - places[j]).norm() * factor < radii[i] + radii[j]).count()
        };
        assert_eq!((overlaps(factor), overlaps(0.999 * factor)), (0, 1), "overlaps at {factor} and below");
    }

    #[test]
    fn two_at_one_place_cannot_be_spread() {
        assert_eq!(least_spread(&[Vec3::AXES[0]; 2], &[1.0; 2]), f64::INFINITY);
    }
}
