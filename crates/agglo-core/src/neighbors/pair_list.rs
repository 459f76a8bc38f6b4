//! Pairs of grains that may come to touch, kept with a skin so that the list serves many steps (Verlet list).
//!
//! Pairs stand by owner, partners in rising order; on request every grain knows the pairs in which it is the partner,
//! also in rising order. Which pairs touch, and the order in which a grain meets them, therefore does not depend
//! on when the list was built or how thick its skin is.

use std::ops::Range;

use rayon::prelude::*;

use super::cells::{CellIndex, Places, Sorted, Span};
use crate::domain::Space;
use crate::math::{Groups, Vec3, make_room_for, parallel, refill};

/// Grains per task of the search.
const CHUNK: usize = 1024;
/// Tasks whose finds are kept aside at a time: enough for many threads, and little beside the list.
const AT_ONCE: usize = 64;

/// Candidate pairs with a skin.
#[derive(Debug, Default)]
pub struct PairList {
    cells: CellIndex<Sorted>,
    found: Vec<(Vec<u32>, Vec<u32>)>,
    /// Pairs of owner k: `starts[k]..starts[k + 1]`.
    starts: Vec<u32>,
    partners: Vec<u32>,
    owners: Vec<u32>,
    /// Pairs by their partners, where someone asks for them.
    back: Groups,
    reference: Vec<Vec3>,
    space: Space,
    skin: f64,
    /// No sphere is farther from where it was listed [m].
    strayed: f64,
}

impl PairList {
    /// Lists all pairs whose surfaces are closer than `reach` + `skin` [m] in a space; valid until a grain has moved by half
    /// the skin. All spheres of `spheres` must be there.
    pub fn build(&mut self, space: &Space, spheres: &(impl Places + Sync), reach: f64, skin: f64) {
        let n = spheres.slots();
        let margin = reach + skin;
        (self.skin, self.space) = (skin, *space);
        self.cells.fill(spheres, &Span::Free(*space), margin);
        refill(&mut self.starts, n + 1, 0);
        self.partners.clear();
        let chunks = n.div_ceil(CHUNK);
        self.found.resize_with(chunks.min(AT_ONCE), Default::default);
        for first in (0..chunks).step_by(AT_ONCE) {
            let count = AT_ONCE.min(chunks - first);
            let tasks = &mut self.found[..count];
            let cells = &self.cells;
            tasks.par_iter_mut().zip(first..first + count).for_each(|((counts, partners), chunk)| {
                counts.clear();
                partners.clear();
                for owner in chunk * CHUNK..((chunk + 1) * CHUNK).min(n) {
                    let before = partners.len();
                    partners_of(owner as u32, spheres, cells, (space, margin), partners);
                    counts.push((partners.len() - before) as u32);
                }
            });
            self.take_found(first, chunks, n);
        }
        refill(&mut self.owners, self.partners.len(), 0);
        for owner in 0..n {
            let owned = self.owned(owner);
            self.owners[owned].fill(owner as u32);
        }
        refill(&mut self.reference, n, Vec3::ZERO);
        self.reference.iter_mut().zip(0..).for_each(|(place, at)| *place = spheres.position(at));
        self.strayed = 0.0;
    }

    /// Takes over what the chunks from `first` on found.
    fn take_found(&mut self, first: usize, chunks: usize, n: usize) {
        let done = (first + AT_ONCE).min(chunks);
        let found = &self.found[..done - first];
        let more: usize = found.iter().map(|(_, partners)| partners.len()).sum();
        // As many as those so far let expect, so that room need not grow again and again.
        let expected = (self.partners.len() + more) as f64 * chunks as f64 / done as f64;
        make_room_for(&mut self.partners, expected.ceil() as usize);
        let (mut at, mut sum) = (first * CHUNK, self.partners.len() as u32);
        for (counts, partners) in found {
            for count in counts {
                sum += count;
                at += 1;
                self.starts[at] = sum;
            }
            self.partners.extend_from_slice(partners);
        }
        debug_assert_eq!(at, (done * CHUNK).min(n), "each sphere has a count");
    }

    /// Works out in which pairs each sphere is the partner, for [`PairList::joined`].
    pub fn join_back(&mut self) {
        self.back.fill(self.starts.len().saturating_sub(1), self.partners.iter().copied().zip(0..));
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
    pub fn holds_for(&mut self, spheres: &(impl Places + Sync)) -> bool {
        let n = spheres.slots();
        if self.reference.len() != n {
            return false;
        }
        let (reference, space) = (&self.reference, &self.space);
        let squared = parallel::over(
            0..n,
            4096,
            (),
            &|range: Range<usize>, ()| {
                let way = |at: usize| space.shortest(spheres.position(at as u32) - reference[at]);
                range.map(|at| way(at).norm_squared()).fold(0.0, f64::max)
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

    /// The pairs in which a grain is the partner, after [`PairList::join_back`].
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

/// Appends the partners of a sphere in rising order.
#[inline(always)]
fn partners_of(
    owner: u32,
    spheres: &impl Places,
    cells: &CellIndex<Sorted>,
    (space, margin): (&Space, f64),
    partners: &mut Vec<u32>,
) {
    let first = partners.len();
    let (place, near) = (spheres.position(owner), spheres.radius(owner) + margin);
    cells.visit_partners(owner, place, near, &mut |other, _| {
        let reach = near + spheres.radius(other);
        let apart = space.shortest(spheres.position(other) - place);
        if apart.norm_squared() < reach * reach {
            partners.push(other);
        }
    });
    partners[first..].sort_unstable();
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
            list.build(&Space::OPEN, &(&positions[..], &radii[..]), 0.0, 0.02);
            list.join_back();
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
            list.build(&space, &(&positions[..], &radii[..]), 0.0, 0.01);
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
        list.build(&Space::OPEN, &(&positions[..], &radii[..]), 0.0, 0.02);
        positions[7].x += 0.0099;
        assert_true!(
            list.holds_for(&(&positions[..], &radii[..])) && list.holds(),
            "no grain has come nearer than the list allows for"
        );
        // Ways that were noted are added to what was seen, 0.0099.
        list.note_way(0.00009);
        assert_true!(list.holds(), "it is 0.00999 at most");
        list.note_way(0.00002);
        assert_false!(list.holds(), "it may be 0.01001");
        assert_true!(list.holds_for(&(&positions[..], &radii[..])) && list.holds(), "seen again it is not");
        positions[7].x += 0.0002;
        assert_false!(
            list.holds_for(&(&positions[..], &radii[..])),
            "no grain has come nearer than the list allows for"
        );
    }
}
