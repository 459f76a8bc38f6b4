//! Lanes of x86-64 with AVX2: twice four numbers, so that one half's operations fill the waits of the other's.
//!
//! The one place with instructions of a certain processor. Its numbers exist only within work that [`widest`] hands over
//! after it has asked the processor, as nothing outside this file can name their type.
#![allow(unsafe_code, reason = "instructions that not every x86-64 has; each use says why it is sound")]

use std::arch::x86_64::{
    __m256d, _CMP_LE_OQ, _CMP_LT_OQ, _mm256_add_pd, _mm256_and_pd, _mm256_andnot_pd, _mm256_blendv_pd,
    _mm256_castsi256_pd, _mm256_cmp_pd, _mm256_div_pd, _mm256_loadu_pd, _mm256_max_pd, _mm256_min_pd,
    _mm256_movemask_pd, _mm256_mul_pd, _mm256_permute2f128_pd, _mm256_set1_epi64x, _mm256_set1_pd,
    _mm256_setzero_pd, _mm256_sqrt_pd, _mm256_storeu_pd, _mm256_sub_pd, _mm256_unpackhi_pd,
    _mm256_unpacklo_pd, _mm256_xor_pd,
};
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Lanes, Work};
use crate::math::Real;

/// Does work in eight lanes where the processor has AVX2, else one by one.
#[inline]
pub(super) fn widest<W: Work>(work: W) -> W::Out {
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has what the function asks for.
        unsafe { with_avx2(work) }
    } else {
        work.with::<f64>()
    }
}

#[target_feature(enable = "avx2")]
fn with_avx2<W: Work>(work: W) -> W::Out {
    work.with::<Eight>()
}

/// Eight numbers.
#[derive(Clone, Copy)]
struct Eight(__m256d, __m256d);

/// Gives a number or a mask for both halves from instructions without memory.
macro_rules! halves {
    ($instructions:expr) => {{
        // SAFETY: a value of this type exists only where the processor has AVX2 (see above), and the instructions
        // read and write registers alone.
        #[allow(clippy::macro_metavars_in_unsafe, reason = "the macro is this file's own")]
        unsafe {
            $instructions
        }
    }};
}

impl Eight {
    #[inline(always)]
    fn to_array(self) -> [f64; 8] {
        let mut lanes = [0.0; 8];
        // SAFETY: as above; both halves lie within the array.
        unsafe {
            _mm256_storeu_pd(lanes.as_mut_ptr(), self.0);
            _mm256_storeu_pd(lanes.as_mut_ptr().add(4), self.1);
        }
        lanes
    }

    #[inline(always)]
    fn from_array(lanes: &[f64; 8]) -> Self {
        // SAFETY: as above; both halves lie within the array.
        unsafe { Self(_mm256_loadu_pd(lanes.as_ptr()), _mm256_loadu_pd(lanes.as_ptr().add(4))) }
    }
}

impl Default for Eight {
    #[inline(always)]
    fn default() -> Self {
        halves!(Self(_mm256_setzero_pd(), _mm256_setzero_pd()))
    }
}

/// An operation of two numbers.
macro_rules! operation {
    ($trait:ident $name:ident $instruction:ident) => {
        impl $trait for Eight {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                halves!(Self($instruction(self.0, other.0), $instruction(self.1, other.1)))
            }
        }
    };
}

operation!(Add add _mm256_add_pd);
operation!(Sub sub _mm256_sub_pd);
operation!(Mul mul _mm256_mul_pd);
operation!(Div div _mm256_div_pd);

impl Neg for Eight {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        halves!({
            let sign = _mm256_set1_pd(-0.0);
            Self(_mm256_xor_pd(self.0, sign), _mm256_xor_pd(self.1, sign))
        })
    }
}

impl Real for Eight {
    type Mask = Self;

    #[inline(always)]
    fn of(value: f64) -> Self {
        halves!(Self(_mm256_set1_pd(value), _mm256_set1_pd(value)))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        halves!(Self(_mm256_sqrt_pd(self.0), _mm256_sqrt_pd(self.1)))
    }

    #[inline(always)]
    fn powf(self, exponent: f64) -> Self {
        let lanes = self.to_array();
        Self::from_lanes(|lane| lanes[lane].powf(exponent))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        halves!({
            let sign = _mm256_set1_pd(-0.0);
            Self(_mm256_andnot_pd(sign, self.0), _mm256_andnot_pd(sign, self.1))
        })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        halves!(Self(_mm256_min_pd(self.0, other.0), _mm256_min_pd(self.1, other.1)))
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        halves!(Self(_mm256_max_pd(self.0, other.0), _mm256_max_pd(self.1, other.1)))
    }

    #[inline(always)]
    fn below(self, other: Self) -> Self {
        halves!(Self(
            _mm256_cmp_pd::<_CMP_LT_OQ>(self.0, other.0),
            _mm256_cmp_pd::<_CMP_LT_OQ>(self.1, other.1)
        ))
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> Self {
        halves!(Self(
            _mm256_cmp_pd::<_CMP_LE_OQ>(self.0, other.0),
            _mm256_cmp_pd::<_CMP_LE_OQ>(self.1, other.1)
        ))
    }

    #[inline(always)]
    fn select(mask: Self, yes: Self, no: Self) -> Self {
        halves!(Self(_mm256_blendv_pd(no.0, yes.0, mask.0), _mm256_blendv_pd(no.1, yes.1, mask.1)))
    }

    #[inline(always)]
    fn both(a: Self, b: Self) -> Self {
        halves!(Self(_mm256_and_pd(a.0, b.0), _mm256_and_pd(a.1, b.1)))
    }

    #[inline(always)]
    fn not(mask: Self) -> Self {
        halves!({
            let ones = _mm256_castsi256_pd(_mm256_set1_epi64x(-1));
            Self(_mm256_xor_pd(mask.0, ones), _mm256_xor_pd(mask.1, ones))
        })
    }

    #[inline(always)]
    fn all(mask: Self) -> bool {
        halves!(_mm256_movemask_pd(mask.0) & _mm256_movemask_pd(mask.1) == 0b1111)
    }
}

impl Lanes for Eight {
    const COUNT: usize = 8;

    #[inline(always)]
    fn from_lanes(mut value: impl FnMut(usize) -> f64) -> Self {
        let mut lanes = [0.0; 8];
        for (lane, place) in lanes.iter_mut().enumerate() {
            *place = value(lane);
        }
        Self::from_array(&lanes)
    }

    #[inline(always)]
    fn mask_from_lanes(mut value: impl FnMut(usize) -> bool) -> Self {
        Self::from_lanes(|lane| f64::from_bits(if value(lane) { u64::MAX } else { 0 }))
    }

    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self.to_array()[lane]
    }

    #[inline(always)]
    fn lane_of_mask(mask: Self, lane: usize) -> bool {
        mask.lane(lane).to_bits() != 0
    }

    #[inline(always)]
    fn from_rows<'a>(mut row: impl FnMut(usize) -> &'a [f64; 4]) -> [Self; 4] {
        let [a, b, c, d] = transposed([load(row(0)), load(row(1)), load(row(2)), load(row(3))]);
        let [e, f, g, h] = transposed([load(row(4)), load(row(5)), load(row(6)), load(row(7))]);
        [Self(a, e), Self(b, f), Self(c, g), Self(d, h)]
    }

    #[inline(always)]
    fn to_rows([a, b, c, d]: [Self; 4], mut row: impl FnMut(usize, [f64; 4])) {
        let low = transposed([a.0, b.0, c.0, d.0]);
        let high = transposed([a.1, b.1, c.1, d.1]);
        for (lane, numbers) in low.iter().enumerate() {
            row(lane, store(*numbers));
        }
        for (lane, numbers) in high.iter().enumerate() {
            row(4 + lane, store(*numbers));
        }
    }
}

#[inline(always)]
fn load(row: &[f64; 4]) -> __m256d {
    // SAFETY: as above; the row is an array of four.
    unsafe { _mm256_loadu_pd(row.as_ptr()) }
}

#[inline(always)]
fn store(numbers: __m256d) -> [f64; 4] {
    let mut row = [0.0; 4];
    // SAFETY: as above; the row is an array of four.
    unsafe { _mm256_storeu_pd(row.as_mut_ptr(), numbers) };
    row
}

/// Four rows as four columns.
#[inline(always)]
fn transposed([a, b, c, d]: [__m256d; 4]) -> [__m256d; 4] {
    halves!({
        let (ab_even, ab_odd) = (_mm256_unpacklo_pd(a, b), _mm256_unpackhi_pd(a, b));
        let (cd_even, cd_odd) = (_mm256_unpacklo_pd(c, d), _mm256_unpackhi_pd(c, d));
        [
            _mm256_permute2f128_pd::<0x20>(ab_even, cd_even),
            _mm256_permute2f128_pd::<0x20>(ab_odd, cd_odd),
            _mm256_permute2f128_pd::<0x31>(ab_even, cd_even),
            _mm256_permute2f128_pd::<0x31>(ab_odd, cd_odd),
        ]
    })
}
