//! Pairs of grains that may come to touch, kept with a skin so that the list serves many steps (Verlet list).
//!
//! Pairs stand by owner, partners in rising order, and every grain knows the pairs in which it is the partner,
//! also in rising order. Which pairs touch, and the order in which a grain meets them, therefore does not depend
//! on when the list was built or how thick its skin is.

use std::ops::Range;

use rayon::prelude::*;

use super::cells::{CellIndex, Sorted, Span};
use crate::domain::Space;
use crate::math::{Groups, Vec3, parallel};

/// Grains per task of the search.
const CHUNK: usize = 1024;

/// Candidate pairs with a skin.
#[derive(Debug, Default)]
pub struct PairList {
    cells: CellIndex<Sorted>,
    found: Vec<(Vec<u32>, Vec<u32>)>,
    /// Pairs of owner k: `starts[k]..starts[k + 1]`.
    starts: Vec<u32>,
    partners: Vec<u32>,
    owners: Vec<u32>,
    /// Pairs by their partners.
    back: Groups,
    reference: Vec<Vec3>,
    space: Space,
    skin: f64,
    /// No sphere is farther from where it was listed [m].
    strayed: f64,
}

impl PairList {
    /// Lists all pairs whose surfaces are closer than `reach` + `skin` [m] in a space; valid until a grain has moved by half
    /// the skin.
    pub fn build(&mut self, space: &Space, positions: &[Vec3], radii: &[f64], reach: f64, skin: f64) {
        let n = positions.len();
        let margin = reach + skin;
        (self.skin, self.space) = (skin, *space);
        self.cells.fill(&(positions, radii), &Span::Free(*space), margin);
        self.found.resize_with(n.div_ceil(CHUNK), Default::default);
        let cells = &self.cells;
        self.found.par_iter_mut().enumerate().for_each(|(chunk, (counts, partners))| {
            counts.clear();
            partners.clear();
            for owner in chunk * CHUNK..((chunk + 1) * CHUNK).min(n) {
                let first = partners.len();
                let near = radii[owner] + margin;
                cells.visit_partners(owner as u32, positions[owner], near, &mut |other, _| {
                    let reach = radii[owner] + radii[other as usize] + margin;
                    let apart = space.shortest(positions[other as usize] - positions[owner]);
                    if apart.norm_squared() < reach * reach {
                        partners.push(other);
                    }
                });
                partners[first..].sort_unstable();
                counts.push((partners.len() - first) as u32);
            }
        });
        self.starts.clear();
        self.starts.push(0);
        self.partners.clear();
        for (counts, partners) in &self.found {
            for count in counts {
                self.starts.push(self.starts[self.starts.len() - 1] + count);
            }
            self.partners.extend_from_slice(partners);
        }
        self.owners.clear();
        for owner in 0..n {
            self.owners.resize(self.starts[owner + 1] as usize, owner as u32);
        }
        self.back.fill(n, self.partners.iter().copied().zip(0..));
        self.reference.clear();
        self.reference.extend_from_slice(positions);
        self.strayed = 0.0;
    }

    /// Takes note that no sphere has moved by more than this [m].
    pub fn note_way(&mut self, longest: f64) {
        self.strayed += longest;
    }

    /// Whether the list surely has every pair within its reach still, by the ways that were noted.
    pub fn holds(&self) -> bool {
        self.strayed <= 0.5 * self.skin
    }

    /// Whether it has, by where the spheres are.
    pub fn holds_for(&mut self, positions: &[Vec3]) -> bool {
        if self.reference.len() != positions.len() {
            return false;
        }
        let (reference, space) = (&self.reference, &self.space);
        let squared = parallel::over(
            0..positions.len(),
            4096,
            (),
            &|range: Range<usize>, ()| {
                let ways = positions[range.clone()].iter().zip(&reference[range]);
                ways.map(|(now, then)| space.shortest(*now - *then).norm_squared()).fold(0.0, f64::max)
            },
            &f64::max,
        );
        self.strayed = squared.sqrt();
        self.holds()
    }

    /// Skin of the list as built [m].
    pub fn skin(&self) -> f64 {
        self.skin
    }

    /// How many pairs.
    pub fn len(&self) -> usize {
        self.partners.len()
    }

    /// Whether there is no pair.
    pub fn is_empty(&self) -> bool {
        self.partners.is_empty()
    }

    /// Where the pairs of each owner start: [n + 1].
    pub fn starts(&self) -> &[u32] {
        &self.starts
    }

    /// The partner of each pair.
    pub fn partners(&self) -> &[u32] {
        &self.partners
    }

    /// The pairs that a grain owns.
    #[inline]
    pub fn owned(&self, grain: usize) -> Range<usize> {
        self.starts[grain] as usize..self.starts[grain + 1] as usize
    }

    /// The pairs in which a grain is the partner.
    #[inline]
    pub fn joined(&self, grain: usize) -> &[u32] {
        self.back.of(grain)
    }

    /// The number of the pair with this owner and partner.
    pub fn find(&self, owner: u32, partner: u32) -> Option<usize> {
        let owned = self.owned(owner as usize);
        self.partners[owned.clone()].binary_search(&partner).ok().map(|at| owned.start + at)
    }

    /// The owner of each pair.
    pub fn owners(&self) -> &[u32] {
        &self.owners
    }

    /// Owner and partner of each pair.
    pub fn pairs(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        self.owners.iter().copied().zip(self.partners.iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::{Purpose, Stream};

    /// Oracle: all pairs by brute force.
    fn brute(positions: &[Vec3], radii: &[f64], margin: f64) -> Vec<(u32, u32)> {
        let mut pairs = Vec::new();
        for i in 0..positions.len() {
            for j in i + 1..positions.len() {
                if (positions[i] - positions[j]).norm() < radii[i] + radii[j] + margin {
                    pairs.push((i as u32, j as u32));
                }
            }
        }
        pairs
    }

    fn cloud(n: usize, spread: f64, ratio: f64) -> (Vec<Vec3>, Vec<f64>) {
        let mut stream = Stream::new(3, Purpose::Sampling, 0);
        let positions = (0..n).map(|_| stream.direction() * (spread * stream.uniform())).collect();
        let radii = (0..n).map(|_| 0.05 * ratio.powf(stream.uniform())).collect();
        (positions, radii)
    }

    #[test]
    fn agrees_with_all_pairs() {
        for (spread, ratio) in [(1.0, 1.0), (1.0, 10.0), (200.0, 1.0), (200.0, 30.0), (0.05, 2.0)] {
            let (positions, radii) = cloud(400, spread, ratio);
            let mut list = PairList::default();
            list.build(&Space::OPEN, &positions, &radii, 0.0, 0.02);
            let mut pairs: Vec<(u32, u32)> = list.pairs().map(|(a, b)| (a.min(b), a.max(b))).collect();
            pairs.sort_unstable();
            assert_eq!(pairs, brute(&positions, &radii, 0.02), "spread {spread}, ratio {ratio}");
            let partners = list.partners();
            for grain in 0..400 {
                assert_all!(list.joined(grain).iter(), |pair| partners[*pair as usize] as usize == grain);
            }
        }
    }

    /// Against all pairs in their nearest images, for boxes down to two diameters across, open along some axes or none, and
    /// spheres that lie a little out of them.
    #[test]
    fn agrees_with_all_pairs_in_space_that_repeats_itself() {
        let mut stream = Stream::new(8, Purpose::Sampling, 0);
        for round in 0..60 {
            let edges = Vec3::new(0.3, 0.3, 0.3) + Vec3::new(3.0, 3.0, 3.0) * stream.uniform().powi(2);
            let edges = Vec3::new(edges.x, edges.y * (1.0 + stream.uniform()), edges.z);
            let axes = [0, 1, 2].map(|axis| round >> axis & 1 == 0);
            let lower = Vec3::new(-1.0, 4.0, 0.3);
            let space = Space::repeating([lower, lower + edges], axes);
            let mut within = |edge: f64| edge * (1.02 * stream.uniform() - 0.01);
            let positions: Vec<Vec3> = (0..200)
                .map(|_| lower + Vec3::new(within(edges.x), within(edges.y), within(edges.z)))
                .collect();
            let radii: Vec<f64> = (0..200).map(|_| 0.07 * 0.1_f64.powf(stream.uniform())).collect();
            let mut list = PairList::default();
            list.build(&space, &positions, &radii, 0.0, 0.01);
            let mut pairs: Vec<(u32, u32)> = list.pairs().map(|(a, b)| (a.min(b), a.max(b))).collect();
            pairs.sort_unstable();
            let mut wanted = Vec::new();
            for i in 0..200 {
                for j in i + 1..200 {
                    let apart = space.shortest(positions[i] - positions[j]).norm();
                    if apart < radii[i] + radii[j] + 0.01 {
                        wanted.push((i as u32, j as u32));
                    }
                }
            }
            assert_eq!(pairs, wanted, "edges {edges:?}, repeating {axes:?}");
        }
    }

    #[test]
    fn holds_until_half_the_skin() {
        let (mut positions, radii) = cloud(50, 1.0, 1.0);
        let mut list = PairList::default();
        list.build(&Space::OPEN, &positions, &radii, 0.0, 0.02);
        positions[7].x += 0.0099;
        assert_true!(
            list.holds_for(&positions) && list.holds(),
            "no grain has come nearer than the list allows for"
        );
        // Ways that were noted are added to what was seen, 0.0099.
        list.note_way(0.00009);
        assert_true!(list.holds(), "it is 0.00999 at most");
        list.note_way(0.00002);
        assert_false!(list.holds(), "it may be 0.01001");
        assert_true!(list.holds_for(&positions) && list.holds(), "seen again it is not");
        positions[7].x += 0.0002;
        assert_false!(list.holds_for(&positions), "no grain has come nearer than the list allows for");
    }
}
