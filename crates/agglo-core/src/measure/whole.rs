//! Clusters as they are, where faces across which space repeats itself cut them in two.

use std::borrow::Cow;

use crate::domain::Space;
use crate::math::{Groups, Vec3};

/// Centers [n] [m] of images that lie side by side as edges (pairs of indices) join their grains; each cluster where the grain of its
/// lowest index is. In open space they are what was given.
///
/// A cluster that goes all through the volume and meets its own image has no such places: it is cut somewhere.
pub fn whole<'a>(space: &Space, positions: &'a [Vec3], edges: &[(u32, u32)]) -> Cow<'a, [Vec3]> {
    if !space.repeats() {
        return Cow::Borrowed(positions);
    }
    let n = positions.len();
    let mut neighbors = Groups::default();
    neighbors.fill(n, edges.iter().flat_map(|&(a, b)| [(a, b), (b, a)]));
    let mut found = positions.to_vec();
    let mut is_placed = vec![false; n];
    let mut front = Vec::new();
    for seed in 0..n as u32 {
        if std::mem::replace(&mut is_placed[seed as usize], true) {
            continue;
        }
        front.push(seed);
        while let Some(at) = front.pop() {
            for &other in neighbors.of(at as usize) {
                if !std::mem::replace(&mut is_placed[other as usize], true) {
                    let between = positions[other as usize] - positions[at as usize];
                    found[other as usize] = found[at as usize] + space.shortest(between);
                    front.push(other);
                }
            }
        }
    }
    Cow::Owned(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::radius_of_gyration;

    /// A rod of ten touching grains of radius 0.5 has R_g² = (10² - 1)/12 + 3/5 0.5², wherever faces 12 m apart cut it, and
    /// whichever grain comes first. To the rounding of some meters.
    #[test]
    fn a_rod_across_a_face_is_whole() {
        let space = Space::repeating([Vec3::ZERO, Vec3::new(12.0, 12.0, 12.0)], [true, true, false]);
        let edges: Vec<(u32, u32)> = (1..10).map(|at| (at - 1, at)).collect();
        for from in [0.3, 5.0, 11.9] {
            let places: Vec<Vec3> =
                (0..10).map(|at| space.home(Vec3::new(from + f64::from(at), 0.0, 40.0)).0).collect();
            let found = whole(&space, &places, &edges);
            let members: Vec<u32> = (0..10).collect();
            let gyration = radius_of_gyration(&found, &[0.5; 10], &[2.0; 10], &members);
            assert_close!(gyration, (99.0 / 12.0 + 0.6 * 0.25_f64).sqrt(), 1e-14, "m");
            assert_eq!(found[0], places[0]);
        }
    }
}
