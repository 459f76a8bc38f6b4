//! Sorting out the pairs of a block that touch, or are within the reach of a law.

use std::ops::Range;

use super::given::{Given, ends, rows, scalars, vectors};
use super::memory::TOUCHES;
use super::record::Record;
use crate::math::lanes::{Lanes, WIDEST};
use crate::math::prefetch;

/// How many pairs ahead the memory of a grain is asked for.
const AHEAD: usize = 24;
/// How many touching pairs are sorted out before laws are asked: few enough to stay at hand.
const ROOM: usize = 512;

/// Bits of a pair's number in its block; those above have what it remembers.
const NUMBER: u32 = 24;

/// Pairs that touch, side by side as many as there is room for, and which of the block to look at next.
pub(super) struct Touching {
    /// Numbers of the pairs in the block, and above [`NUMBER`] what they remember.
    pairs: [u32; ROOM],
    pub owners: [u32; ROOM],
    pub partners: [u32; ROOM],
    /// Slots of the partners in the block.
    pub targets: [u32; ROOM],
    pub count: usize,
    rest: Range<usize>,
}

impl Touching {
    /// None yet of these pairs.
    #[inline(always)]
    pub fn among(pairs: Range<usize>) -> Self {
        let none = [0; ROOM];
        Self { pairs: none, owners: none, partners: none, targets: none, count: 0, rest: pairs }
    }

    /// Number in the block of one of them.
    #[inline(always)]
    pub fn pair(&self, at: usize) -> usize {
        (self.pairs[at] & ((1 << NUMBER) - 1)) as usize
    }

    /// What it remembers.
    #[inline(always)]
    pub fn before(&self, at: usize) -> u8 {
        (self.pairs[at] >> NUMBER) as u8
    }

    /// Finds more, and tells all pairs whether they touch; whether these are the last.
    #[inline(always)]
    pub fn fill<F: Lanes>(&mut self, given: &Given<'_>, states: &mut [u8]) -> bool {
        while self.rest.len() >= F::COUNT {
            if self.count + F::COUNT > ROOM {
                return false;
            }
            self.sort_out::<F>(given, states);
        }
        while !self.rest.is_empty() {
            if self.count == ROOM {
                return false;
            }
            self.sort_out::<f64>(given, states);
        }
        true
    }

    /// Looks at as many as there are lanes, and writes those that touch down side by side, without a branch on it.
    #[inline(always)]
    fn sort_out<F: Lanes>(&mut self, given: &Given<'_>, states: &mut [u8]) {
        let (list, records) = (given.world.list, given.passage.records);
        let pairs = self.rest.start..self.rest.start + F::COUNT;
        self.rest.start = pairs.end;
        let first = pairs.start - given.first[1];
        let (owners, partners) = (&list.owners()[pairs.clone()], &list.partners()[pairs.clone()]);
        let (targets, before) =
            (&given.targets[first..first + F::COUNT], &given.committed.states[pairs.clone()]);
        if let Some(ahead) = list.partners().get(pairs.start + AHEAD..pairs.end + AHEAD) {
            for partner in ahead {
                prefetch(records, *partner as usize);
            }
        }
        let touches = F::bits(touch::<F>(given, records, owners, partners));
        let mut numbers = [0; WIDEST];
        let states = &mut states[first..first + F::COUNT];
        for lane in 0..F::COUNT {
            numbers[lane] = (first + lane) as u32 | u32::from(before[lane]) << NUMBER;
            states[lane] = TOUCHES * (touches >> lane & 1) as u8;
        }
        let room = self.count..self.count + F::COUNT;
        F::squeeze(touches, &numbers[..F::COUNT], &mut self.pairs[room.clone()]);
        F::squeeze(touches, owners, &mut self.owners[room.clone()]);
        F::squeeze(touches, partners, &mut self.partners[room.clone()]);
        F::squeeze(touches, targets, &mut self.targets[room]);
        self.count += touches.count_ones() as usize;
    }

    /// Forgets so many of the first.
    #[inline(always)]
    pub fn drop_first(&mut self, count: usize) {
        for column in [&mut self.pairs, &mut self.owners, &mut self.partners, &mut self.targets] {
            column.copy_within(count..self.count, 0);
        }
        self.count -= count;
    }
}

/// Whether grains touch, or are within the reach of a law.
#[inline(always)]
fn touch<F: Lanes>(given: &Given<'_>, records: &[Record], owners: &[u32], partners: &[u32]) -> F::Mask {
    let ends = ends(records, owners, partners);
    let place = rows::<F>(&ends, |of| &of.place);
    let (centers, radii) = (vectors(&place), scalars(&place));
    let reach = radii[0] + radii[1] + F::of(given.world.beyond());
    given.world.space.shortest(centers[1] - centers[0]).norm_squared().below(reach * reach)
}
