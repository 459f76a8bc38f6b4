//! Twice as many lanes, so that one half's operations fill the waits of the other's.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::number::Lanes;
use crate::math::Real;

/// Two halves, of which the first has the lower lanes.
#[derive(Clone, Copy, Default)]
pub struct Twice<T>(T, T);

/// An operation of two numbers.
macro_rules! operation {
    ($trait:ident $name:ident) => {
        impl<T: Lanes> $trait for Twice<T> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Self(self.0.$name(other.0), self.1.$name(other.1))
            }
        }
    };
}

operation!(Add add);
operation!(Sub sub);
operation!(Mul mul);
operation!(Div div);

impl<T: Lanes> Neg for Twice<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl<T: Lanes> Real for Twice<T> {
    type Mask = Twice<T::Mask>;

    #[inline(always)]
    fn of(value: f64) -> Self {
        Self(T::of(value), T::of(value))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt(), self.1.sqrt())
    }

    #[inline(always)]
    fn powf(self, exponent: f64) -> Self {
        Self(self.0.powf(exponent), self.1.powf(exponent))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs(), self.1.abs())
    }

    #[inline(always)]
    fn round(self) -> Self {
        Self(self.0.round(), self.1.round())
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0), self.1.min(other.1))
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0), self.1.max(other.1))
    }

    #[inline(always)]
    fn below(self, other: Self) -> Self::Mask {
        Twice(self.0.below(other.0), self.1.below(other.1))
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> Self::Mask {
        Twice(self.0.at_most(other.0), self.1.at_most(other.1))
    }

    #[inline(always)]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Self(T::select(mask.0, yes.0, no.0), T::select(mask.1, yes.1, no.1))
    }

    #[inline(always)]
    fn both(a: Self::Mask, b: Self::Mask) -> Self::Mask {
        Twice(T::both(a.0, b.0), T::both(a.1, b.1))
    }

    #[inline(always)]
    fn not(mask: Self::Mask) -> Self::Mask {
        Twice(T::not(mask.0), T::not(mask.1))
    }

    #[inline(always)]
    fn all(mask: Self::Mask) -> bool {
        T::all(mask.0) && T::all(mask.1)
    }
}

impl<T: Lanes> Lanes for Twice<T> {
    const COUNT: usize = 2 * T::COUNT;

    #[inline(always)]
    fn from_lanes(mut value: impl FnMut(usize) -> f64) -> Self {
        Self(T::from_lanes(&mut value), T::from_lanes(|lane| value(T::COUNT + lane)))
    }

    #[inline(always)]
    fn mask_from_lanes(mut value: impl FnMut(usize) -> bool) -> Self::Mask {
        Twice(T::mask_from_lanes(&mut value), T::mask_from_lanes(|lane| value(T::COUNT + lane)))
    }

    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        if lane < T::COUNT { self.0.lane(lane) } else { self.1.lane(lane - T::COUNT) }
    }

    #[inline(always)]
    fn mask_from_flags(bytes: &[u8], flag: u8) -> Self::Mask {
        Twice(T::mask_from_flags(bytes, flag), T::mask_from_flags(&bytes[T::COUNT..], flag))
    }

    #[inline(always)]
    fn bits(mask: Self::Mask) -> u32 {
        T::bits(mask.0) | T::bits(mask.1) << T::COUNT
    }

    #[inline(always)]
    fn squeeze(bits: u32, items: &[u32], to: &mut [u32]) {
        let low = bits & ((1 << T::COUNT) - 1);
        T::squeeze(low, &items[..T::COUNT], &mut to[..T::COUNT]);
        let first = low.count_ones() as usize;
        T::squeeze(bits >> T::COUNT, &items[T::COUNT..], &mut to[first..first + T::COUNT]);
    }

    #[inline(always)]
    fn from_rows<'a>(mut row: impl FnMut(usize) -> &'a [f64; 4]) -> [Self; 4] {
        let ([a, b, c, d], [e, f, g, h]) =
            (T::from_rows(&mut row), T::from_rows(|lane| row(T::COUNT + lane)));
        [Self(a, e), Self(b, f), Self(c, g), Self(d, h)]
    }

    #[inline(always)]
    fn to_rows([a, b, c, d]: [Self; 4], mut row: impl FnMut(usize, [f64; 4])) {
        T::to_rows([a.0, b.0, c.0, d.0], &mut row);
        T::to_rows([a.1, b.1, c.1, d.1], |lane, numbers| row(T::COUNT + lane, numbers));
    }
}
