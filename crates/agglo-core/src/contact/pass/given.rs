//! What a block of contacts reads, and how it comes into lanes.

use super::memory::Memory;
use super::record::Record;
use super::world::{ContactWorld, Passage};
use crate::math::Vector;
use crate::math::lanes::{Lanes, WIDEST};

/// What a block reads.
#[derive(Clone, Copy)]
pub(super) struct Given<'a> {
    pub world: &'a ContactWorld<'a>,
    pub passage: &'a Passage<'a>,
    pub committed: &'a Memory,
    /// Slots of the partners of the block's pairs.
    pub targets: &'a [u32],
    /// The block's first grain and first pair.
    pub first: [usize; 2],
}

/// Both ends of as many pairs as there are lanes.
#[inline(always)]
pub(super) fn ends<'a>(records: &'a [Record], owners: &[u32], partners: &[u32]) -> [[&'a Record; WIDEST]; 2] {
    let mut ends = [[&records[0]; WIDEST]; 2];
    for (lane, (owner, partner)) in owners.iter().zip(partners).enumerate() {
        ends[0][lane] = &records[*owner as usize];
        ends[1][lane] = &records[*partner as usize];
    }
    ends
}

/// Rows of both ends of each contact.
#[inline(always)]
pub(super) fn rows<F: Lanes>(
    ends: &[[&Record; WIDEST]; 2],
    row: impl Fn(&Record) -> &[f64; 4],
) -> [[F; 4]; 2] {
    [F::from_rows(|lane| row(ends[0][lane])), F::from_rows(|lane| row(ends[1][lane]))]
}

#[inline(always)]
pub(super) fn vectors<F: Lanes>([a, b]: &[[F; 4]; 2]) -> [Vector<F>; 2] {
    [Vector::new(a[0], a[1], a[2]), Vector::new(b[0], b[1], b[2])]
}

#[inline(always)]
pub(super) fn scalars<F: Lanes>([a, b]: &[[F; 4]; 2]) -> [F; 2] {
    [a[3], b[3]]
}
