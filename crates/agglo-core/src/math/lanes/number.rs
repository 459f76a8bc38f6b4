//! What numbers side by side can do, and work that is done in them.

use crate::math::Real;

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

    /// A truth for each lane: whether the flag is set in the byte at its place.
    fn mask_from_flags(bytes: &[u8], flag: u8) -> Self::Mask;

    /// The truths as bits, that of lane 0 the lowest.
    fn bits(mask: Self::Mask) -> u32;

    /// Puts the items at the places of set bits side by side, in their order; what stands behind them is left open.
    ///
    /// There are as many items as lanes, and as much room.
    fn squeeze(bits: u32, items: &[u32], to: &mut [u32]);

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
    fn mask_from_flags(bytes: &[u8], flag: u8) -> bool {
        bytes[0] & flag != 0
    }

    #[inline(always)]
    fn bits(mask: bool) -> u32 {
        u32::from(mask)
    }

    #[inline(always)]
    fn squeeze(_: u32, items: &[u32], to: &mut [u32]) {
        to[0] = items[0];
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
