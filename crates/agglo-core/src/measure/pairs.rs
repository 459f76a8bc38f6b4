//! Grains whose surfaces are close to one another.

use crate::contact::closeness::are_close;
use crate::domain::Space;
use crate::math::Vec3;
use crate::neighbors::{CellIndex, Sorted, Span};

/// Calls `found(i, j)`, i < j, once for every pair of grains whose surfaces are no farther apart than `gap` times the
/// smaller radius: |r_i - r_j| <= R_i + R_j + gap min(R_i, R_j). With `gap` 0 grains that are placed as touching are
/// found or not by round-off; see [`crate::contact::closeness::TOUCHING`].
///
/// `positions` [n] and `radii` [n] in m; of images in a space that repeats itself the nearest counts. The order of the calls says nothing. Memory is in proportion to n however far the grains
/// have spread.
pub fn close_pairs(
    space: &Space,
    positions: &[Vec3],
    radii: &[f64],
    gap: f64,
    found: &mut impl FnMut(u32, u32),
) {
    let smallest = radii.iter().copied().fold(f64::INFINITY, f64::min);
    let mut cells = CellIndex::<Sorted>::default();
    cells.fill(&(positions, radii), &Span::Free(*space), gap * smallest);
    for of in 0..positions.len() as u32 {
        let (center, radius) = (positions[of as usize], radii[of as usize]);
        cells.visit_partners(of, center, radius + gap * radius, &mut |other, _| {
            let (i, j) = (of.min(other), of.max(other));
            let (i_at, j_at) = (i as usize, j as usize);
            let distance_squared = space.shortest(positions[i_at] - positions[j_at]).norm_squared();
            if are_close(distance_squared, radii[i_at], radii[j_at], gap) {
                found(i, j);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::closeness::TOUCHING;
    use crate::math::rng::{Purpose, Stream};
    use crate::measure::Clusters;

    fn close(positions: &[Vec3], radii: &[f64], gap: f64) -> Vec<(u32, u32)> {
        let mut pairs = Vec::new();
        close_pairs(&Space::OPEN, positions, radii, gap, &mut |i, j| pairs.push((i, j)));
        let count = pairs.len();
        pairs.sort_unstable();
        pairs.dedup();
        assert_eq!(pairs.len(), count, "a pair came twice");
        pairs
    }

    /// Against all pairs, for grains in one, two and three dimensions, dense ones and widely spread ones.
    #[test]
    fn agrees_with_brute_force() {
        let mut stream = Stream::new(4, Purpose::Sampling, 0);
        for spread in
            [[8.0, 8.0, 8.0], [40.0, 40.0, 0.0], [900.0, 0.0, 0.0], [1.0, 1.0, 1.0], [1e9, 5.0, 5.0]]
        {
            for gap in [0.0, 0.3] {
                let mut signed = || 2.0 * stream.uniform() - 1.0;
                let n = 600;
                let positions: Vec<Vec3> = (0..n)
                    .map(|_| Vec3::new(spread[0] * signed(), spread[1] * signed(), spread[2] * signed()))
                    .collect();
                let radii: Vec<f64> = (0..n).map(|_| 0.6 + 0.4 * signed()).collect();
                let mut brute = Vec::new();
                for i in 0..n {
                    for j in i + 1..n {
                        let (a, b) = (radii[i], radii[j]);
                        if (positions[i] - positions[j]).norm() - a - b <= gap * a.min(b) {
                            brute.push((i as u32, j as u32));
                        }
                    }
                }
                assert_eq!(close(&positions, &radii, gap), brute, "{spread:?} {gap}");
                assert!(!brute.is_empty() || spread[0] > 1e8, "no pair in a spread of {spread:?}");
            }
        }
    }

    #[test]
    fn a_gap_is_a_part_of_the_smaller_radius() {
        // Radii 1 and 3, surfaces 0.2 apart: a fifth of the smaller radius.
        let (positions, radii) = ([Vec3::ZERO, Vec3::new(4.2, 0.0, 0.0)], [1.0, 3.0]);
        assert_eq!(close(&positions, &radii, 0.201), [(0, 1)]);
        assert_eq!(close(&positions, &radii, 0.199), []);
    }

    /// The 314 places of a hexagonal close packing that are nearest to one of them, in radii; of equal distance by z, y, x.
    fn close_packing() -> Vec<Vec3> {
        let edges = Vec3::new(2.0, 12.0_f64.sqrt(), (32.0_f64 / 3.0).sqrt());
        let cell = [[0.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.5, 1.0 / 6.0, 0.5], [0.0, 2.0 / 3.0, 0.5]];
        let mut places = Vec::new();
        for number in 0..19 * 13 * 13 {
            let corner = [number % 19 - 9, number / 19 % 13 - 6, number / (19 * 13) - 6].map(f64::from);
            places.extend(cell.map(|[x, y, z]| {
                Vec3::new((corner[0] + x) * edges.x, (corner[1] + y) * edges.y, (corner[2] + z) * edges.z)
            }));
        }
        places.sort_by(|a, b| {
            let key = |place: &Vec3| (place.norm_squared() * 1e6).round();
            key(a).total_cmp(&key(b)).then([a.z, a.y, a.x].partial_cmp(&[b.z, b.y, b.x]).unwrap())
        });
        places.truncate(314);
        places
    }

    /// Round-off decides about none of the 1512 contacts, wherever the packing stands and however it is turned: places up to
    /// 4e10 radii away are known to 1e-5 R, a hundredth of the tolerance.
    #[test]
    fn contacts_of_a_close_packing_are_counted() {
        let packing = close_packing();
        let axis = Vec3::new(0.3, -0.5, 0.8).normalized();
        for radius in [1.0, 1.7e-6, 0.1] {
            for away in [0.0, 0.1, 1e3, -3e7, 4e10] {
                for angle in [0.0, 1e-3, 0.7, 2.0] {
                    let shift = Vec3::new(away, 0.7 * away, -0.3 * away);
                    let put = |place: &Vec3| (place.rotated_about(axis, angle) + shift) * radius;
                    let placed: Vec<Vec3> = packing.iter().map(put).collect();
                    let radii = vec![radius; placed.len()];
                    let pairs = close(&placed, &radii, TOUCHING);
                    assert_eq!(pairs.len(), 1512, "R = {radius}, {away} R away, turned by {angle}");
                    let clusters = Clusters::new(&vec![1.0; placed.len()], pairs);
                    assert_eq!((clusters.count(), clusters.dispersion_degree()), (1, 0.0));
                }
            }
        }
    }

    /// An aggregate that grows grain by grain, each put against one that is there, touching it to the last bit or so: one
    /// cluster, with a contact a grain at least.
    #[test]
    fn a_grown_aggregate_is_one_cluster() {
        for (seed, spread) in [(1, 0.0), (2, 0.5), (3, 0.9)] {
            let mut stream = Stream::new(seed, Purpose::Sampling, 0);
            let (mut places, mut radii) = (vec![Vec3::new(0.1, 0.2, 0.3)], vec![1.0]);
            while places.len() < 1024 {
                let radius = 1.0 - spread * stream.uniform();
                let on = (stream.uniform() * places.len() as f64) as usize;
                let place = places[on] + stream.direction() * (radii[on] + radius);
                let is_clear = |at: usize| (places[at] - place).norm() > radii[at] + radius;
                if (0..places.len()).all(|at| at == on || is_clear(at)) {
                    places.push(place);
                    radii.push(radius);
                }
            }
            let pairs = close(&places, &radii, TOUCHING);
            assert!(pairs.len() >= 1023, "{}", pairs.len());
            assert_eq!(Clusters::new(&radii, pairs).count(), 1);
            let by_rounding = Clusters::new(&radii, close(&places, &radii, 0.0)).count();
            assert!(by_rounding > 300, "{by_rounding}");
        }
    }

    #[test]
    fn no_grains_and_grains_at_one_place() {
        assert_eq!(close(&[], &[], 0.1), []);
        assert_eq!(close(&[Vec3::ZERO; 3], &[1.0; 3], 0.0), [(0, 1), (0, 2), (1, 2)]);
        assert_eq!(close(&[Vec3::ZERO; 2], &[0.0; 2], 0.0), [(0, 1)]);
    }
}
