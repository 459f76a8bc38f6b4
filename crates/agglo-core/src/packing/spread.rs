//! Spheres moved apart until they lie clear of one another: neighbors alone where that will do, else all by one factor.

use crate::domain::Space;
use crate::math::Vec3;
use crate::neighbors::PairList;

/// Part by which spheres that were spread are farther apart than touching: far above round-off.
const CLEARANCE: f64 = 1e-6;

/// Rounds of moving neighbors apart: in crowds each round makes new neighbors, and there need be no end.
const ROUNDS: u32 = 500;

/// Moves spheres of these radii [n] [m] and masses [n] [kg] away from those that they overlap, along the line of centers, so
/// that each pair's center of mass stays; again and again until none overlap, or it is given up.
///
/// ```
/// # extern crate agglo_core as agglo;
/// use agglo::{math::Vec3, packing::move_apart};
/// let mut places = [Vec3::ZERO, Vec3::new(1.0, 0.0, 0.0), Vec3::new(9.0, 0.0, 0.0)];
/// move_apart(&mut places, &[1.0; 3], &[3.0, 1.0, 1.0]);
/// assert!((places[0].x + 0.25).abs() < 1e-5 && (places[1].x - 1.75).abs() < 1e-5 && places[2].x == 9.0);
/// ```
pub fn move_apart(places: &mut [Vec3], radii: &[f64], masses: &[f64]) {
    let largest = radii.iter().copied().fold(0.0, f64::max);
    let mut list = PairList::default();
    for _ in 0..ROUNDS {
        list.build(&Space::OPEN, &(&*places, radii), 0.0, CLEARANCE * largest);
        let mut is_clear = true;
        for (a, b) in list.pairs() {
            let (i, j) = (a as usize, b as usize);
            let between = places[j] - places[i];
            let (apart, touching) = (between.norm(), radii[i] + radii[j]);
            // Half of the clearance is left to round-off.
            if apart >= touching * (1.0 + 0.5 * CLEARANCE) {
                continue;
            }
            is_clear = false;
            let along = if apart > 0.0 { between / apart } else { Vec3::AXES[0] };
            let step = along * ((touching * (1.0 + CLEARANCE) - apart) / (masses[i] + masses[j]));
            places[i] -= step * masses[j];
            places[j] += step * masses[i];
        }
        if is_clear {
            return;
        }
    }
}

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
    list.build(&Space::OPEN, &(places, radii), 0.0, CLEARANCE * radii.iter().copied().fold(0.0, f64::max));
    let factor = |(a, b): (u32, u32)| {
        let (i, j) = (a as usize, b as usize);
        let (apart, touching) = ((places[i] - places[j]).norm(), radii[i] + radii[j]);
        if apart >= touching { 1.0 } else { touching * (1.0 + CLEARANCE) / apart }
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
    fn two_at_one_place_cannot_be_spread_but_moved_apart() {
        let mut places = [Vec3::AXES[0]; 2];
        assert_eq!(least_spread(&places, &[1.0; 2]), f64::INFINITY);
        move_apart(&mut places, &[1.0; 2], &[1.0, 3.0]);
        assert_near!((places[1] - places[0]).norm(), 2.0, 1e-5);
        assert_near!((places[0] + places[1] * 3.0 - Vec3::AXES[0] * 4.0).norm(), 0.0, 1e-14);
    }

    /// A cloud with some overlaps: none are left, the center of mass stays, and those without neighbors are where they were.
    #[test]
    fn neighbors_move_apart_and_others_stay() {
        let mut stream = Stream::new(5, Purpose::Sampling, 0);
        let before: Vec<Vec3> =
            (0..200).map(|_| stream.direction() * (20.0 * stream.uniform().cbrt())).collect();
        let radii: Vec<f64> = (0..200).map(|k| 0.5 + 0.02 * f64::from(k % 50)).collect();
        let masses: Vec<f64> = radii.iter().map(|radius| radius.powi(3)).collect();
        let mut places = before.clone();
        assert_above!(least_spread(&places, &radii), 1.5);
        move_apart(&mut places, &radii, &masses);
        assert_eq!(least_spread(&places, &radii), 1.0);
        let moment = |places: &[Vec3]| {
            places.iter().zip(&masses).fold(Vec3::ZERO, |sum, (place, mass)| sum + *place * *mass)
        };
        assert_near_vector!(moment(&places), moment(&before), 1e-10);
        let moved = places.iter().zip(&before).filter(|(now, before)| now != before).count();
        assert_between!(moved, 10..150);
    }
}
