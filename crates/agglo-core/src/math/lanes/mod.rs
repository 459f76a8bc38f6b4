//! Contacts side by side: as many numbers as the processor at hand works on at once.
//!
//! Work that is written for [`Lanes`] runs by [`widest`] in lanes of eight where the processor has them, else one by one. Which
//! it is is found when the program runs, so one program serves every processor, and results have the same bits: lanes
//! round as single numbers do.

#[cfg(target_arch = "x86_64")]
#[path = "avx.rs"]
mod wide;

use super::Real;

/// Lanes of the widest numbers; sums that must not depend on the width are kept in as many parts.
pub const WIDEST: usize = 8;

/// A number for each of several contacts.
pub trait Lanes: Real {
    /// How many lanes.
    const COUNT: usize;

    /// A number for each lane.
    fn from_lanes(value: impl FnMut(usize) -> f64) -> Self;

    /// A truth for each lane.
    fn mask_from_lanes(value: impl FnMut(usize) -> bool) -> Self::Mask;

    /// The number in a lane.
    fn lane(self, lane: usize) -> f64;

    /// The truth in a lane.
    fn lane_of_mask(mask: Self::Mask, lane: usize) -> bool;

    /// Four numbers for each lane, from one row each.
    fn from_rows<'a>(row: impl FnMut(usize) -> &'a [f64; 4]) -> [Self; 4];

    /// Gives each lane's four numbers as a row.
    fn to_rows(columns: [Self; 4], row: impl FnMut(usize, [f64; 4]));
}

impl Lanes for f64 {
    const COUNT: usize = 1;

    #[inline(always)]
    fn from_lanes(mut value: impl FnMut(usize) -> f64) -> Self {
        value(0)
    }

    #[inline(always)]
    fn mask_from_lanes(mut value: impl FnMut(usize) -> bool) -> bool {
        value(0)
    }

    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self
    }

    #[inline(always)]
    fn lane_of_mask(mask: bool, _: usize) -> bool {
        mask
    }

    #[inline(always)]
    fn from_rows<'a>(mut row: impl FnMut(usize) -> &'a [f64; 4]) -> [Self; 4] {
        *row(0)
    }

    #[inline(always)]
    fn to_rows(columns: [Self; 4], mut row: impl FnMut(usize, [f64; 4])) {
        row(0, columns);
    }
}

/// Work in lanes of any width.
///
/// All that [`Work::with`] calls for each lane must be `#[inline(always)]`: what is not is built for the plainest processor.
pub trait Work {
    /// What comes of it.
    type Out;

    /// Does it in lanes of this width.
    fn with<F: Lanes>(self) -> Self::Out;
}

/// Does work in the widest lanes that the processor has.
#[inline]
pub fn widest<W: Work>(work: W) -> W::Out {
    #[cfg(target_arch = "x86_64")]
    return wide::widest(work);
    #[cfg(not(target_arch = "x86_64"))]
    return work.with::<f64>();
}

#[cfg(test)]
mod tests;
