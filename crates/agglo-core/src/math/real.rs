//! The numbers that laws of contact are written for: one `f64`, or several side by side.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A real number, or as many as a machine works on at once.
///
/// Every operation here is exact to the last bit in each lane (IEEE 754), so a law gives the same bits however many
/// contacts are worked out side by side. A choice between two values is a selection, not a branch.
pub trait Real:
    Copy
    + Default
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// What a comparison gives: whether it holds, lane by lane.
    type Mask: Copy + Default;

    /// The same number in every lane.
    fn of(value: f64) -> Self;

    /// Square root.
    #[must_use]
    fn sqrt(self) -> Self;

    /// A power with the same exponent in every lane.
    #[must_use]
    fn powf(self, exponent: f64) -> Self;

    /// Size without sign.
    #[must_use]
    fn abs(self) -> Self;

    /// The nearest whole number, the even one of two that are equally near.
    #[must_use]
    fn round(self) -> Self;

    /// The smaller of two; the other one where they cannot be compared.
    #[must_use]
    fn min(self, other: Self) -> Self;

    /// The larger of two; the other one where they cannot be compared.
    #[must_use]
    fn max(self, other: Self) -> Self;

    /// Where this is below another.
    fn below(self, other: Self) -> Self::Mask;

    /// Where this is another or below.
    fn at_most(self, other: Self) -> Self::Mask;

    /// `yes` where the mask holds, `no` elsewhere.
    #[must_use]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// Where both hold.
    fn both(a: Self::Mask, b: Self::Mask) -> Self::Mask;

    /// Where it does not hold.
    #[must_use]
    fn not(mask: Self::Mask) -> Self::Mask;

    /// Whether a mask holds in every lane, so that work which no lane wants can be spared.
    fn all(mask: Self::Mask) -> bool;
}

impl Real for f64 {
    type Mask = bool;

    #[inline(always)]
    fn of(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn powf(self, exponent: f64) -> Self {
        self.powf(exponent)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn round(self) -> Self {
        self.round_ties_even()
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    #[inline(always)]
    fn below(self, other: Self) -> bool {
        self < other
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> bool {
        self <= other
    }

    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }

    #[inline(always)]
    fn both(a: bool, b: bool) -> bool {
        a && b
    }

    #[inline(always)]
    fn not(mask: bool) -> bool {
        !mask
    }

    #[inline(always)]
    fn all(mask: bool) -> bool {
        mask
    }
}
