//! Lanes of x86-64 with AVX2, four at a time.
//!
//! Its numbers exist only within work that [`with`] hands over after it has asked the processor, as nothing outside this file
//! can name their type.
#![allow(unsafe_code, reason = "instructions that not every x86-64 has; each use says why it is sound")]

use std::arch::x86_64::{
    __m256d, _CMP_LE_OQ, _CMP_LT_OQ, _MM_FROUND_NO_EXC, _MM_FROUND_TO_NEAREST_INT, _mm_cvtsi32_si128,
    _mm_loadu_ps, _mm_loadu_si128, _mm_permutevar_ps, _mm_storeu_ps, _mm256_add_pd, _mm256_and_pd,
    _mm256_and_si256, _mm256_andnot_pd, _mm256_blendv_pd, _mm256_castsi256_pd, _mm256_cmp_pd,
    _mm256_cmpeq_epi64, _mm256_cvtepu8_epi64, _mm256_div_pd, _mm256_loadu_pd, _mm256_max_pd, _mm256_min_pd,
    _mm256_movemask_pd, _mm256_mul_pd, _mm256_permute2f128_pd, _mm256_round_pd, _mm256_set1_epi64x,
    _mm256_set1_pd, _mm256_setzero_pd, _mm256_sqrt_pd, _mm256_storeu_pd, _mm256_sub_pd, _mm256_unpackhi_pd,
    _mm256_unpacklo_pd, _mm256_xor_pd,
};
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::number::{Lanes, Work};
use super::register::{numbers, register};
use super::twice::Twice;
use crate::math::Real;

/// Does work in eight lanes, if the processor has AVX2.
#[inline]
pub(super) fn with<W: Work>(work: W) -> Result<W::Out, W> {
    if std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("popcnt") {
        // SAFETY: the processor has what the function asks for.
        Ok(unsafe { with_avx2(work) })
    } else {
        Err(work)
    }
}

#[target_feature(enable = "avx2,popcnt")]
fn with_avx2<W: Work>(work: W) -> W::Out {
    work.with::<Twice<Four>>()
}

register! {
    /// Four numbers.
    Four(__m256d) of 4,
    _mm256_setzero_pd, _mm256_loadu_pd, _mm256_storeu_pd,
    Add::add is _mm256_add_pd,
    Sub::sub is _mm256_sub_pd,
    Mul::mul is _mm256_mul_pd,
    Div::div is _mm256_div_pd
}

impl Neg for Four {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        numbers!({
            let sign = _mm256_set1_pd(-0.0);
            Self(_mm256_xor_pd(self.0, sign))
        })
    }
}

impl Real for Four {
    type Mask = Self;

    #[inline(always)]
    fn of(value: f64) -> Self {
        numbers!(Self(_mm256_set1_pd(value)))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        numbers!(Self(_mm256_sqrt_pd(self.0)))
    }

    #[inline(always)]
    fn powf(self, exponent: f64) -> Self {
        let lanes = self.to_array();
        Self::from_lanes(|lane| lanes[lane].powf(exponent))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        numbers!({
            let sign = _mm256_set1_pd(-0.0);
            Self(_mm256_andnot_pd(sign, self.0))
        })
    }

    #[inline(always)]
    fn round(self) -> Self {
        numbers!(Self(_mm256_round_pd::<{ _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC }>(self.0)))
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        numbers!(Self(_mm256_min_pd(self.0, other.0)))
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        numbers!(Self(_mm256_max_pd(self.0, other.0)))
    }

    #[inline(always)]
    fn below(self, other: Self) -> Self {
        numbers!(Self(_mm256_cmp_pd::<_CMP_LT_OQ>(self.0, other.0)))
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> Self {
        numbers!(Self(_mm256_cmp_pd::<_CMP_LE_OQ>(self.0, other.0)))
    }

    #[inline(always)]
    fn select(mask: Self, yes: Self, no: Self) -> Self {
        numbers!(Self(_mm256_blendv_pd(no.0, yes.0, mask.0)))
    }

    #[inline(always)]
    fn both(a: Self, b: Self) -> Self {
        numbers!(Self(_mm256_and_pd(a.0, b.0)))
    }

    #[inline(always)]
    fn not(mask: Self) -> Self {
        numbers!({
            let ones = _mm256_castsi256_pd(_mm256_set1_epi64x(-1));
            Self(_mm256_xor_pd(mask.0, ones))
        })
    }

    #[inline(always)]
    fn all(mask: Self) -> bool {
        numbers!(_mm256_movemask_pd(mask.0) == 0b1111)
    }
}

impl Lanes for Four {
    const COUNT: usize = 4;

    #[inline(always)]
    fn from_lanes(mut value: impl FnMut(usize) -> f64) -> Self {
        let mut lanes = [0.0; 4];
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
    fn mask_from_flags(bytes: &[u8], flag: u8) -> Self {
        let bytes = bytes[..4].try_into().map_or(0, i32::from_le_bytes);
        numbers!({
            let flag = _mm256_set1_epi64x(i64::from(flag));
            let found = _mm256_and_si256(_mm256_cvtepu8_epi64(_mm_cvtsi32_si128(bytes)), flag);
            Self(_mm256_castsi256_pd(_mm256_cmpeq_epi64(found, flag)))
        })
    }

    #[inline(always)]
    fn bits(mask: Self) -> u32 {
        numbers!(_mm256_movemask_pd(mask.0)) as u32
    }

    #[inline(always)]
    fn squeeze(bits: u32, items: &[u32], to: &mut [u32]) {
        let (items, to): (&[u32; 4], &mut [u32; 4]) = match (items.try_into(), to.try_into()) {
            (Ok(items), Ok(to)) => (items, to),
            _ => return,
        };
        let order = &ORDERS[(bits & 0b1111) as usize];
        // SAFETY: as above; all three are arrays of four.
        unsafe {
            let order = _mm_loadu_si128(order.as_ptr().cast());
            let items = _mm_loadu_ps(items.as_ptr().cast());
            _mm_storeu_ps(to.as_mut_ptr().cast(), _mm_permutevar_ps(items, order));
        }
    }

    #[inline(always)]
    fn from_rows<'a>(mut row: impl FnMut(usize) -> &'a [f64; 4]) -> [Self; 4] {
        let [a, b, c, d] = transposed([load(row(0)), load(row(1)), load(row(2)), load(row(3))]);
        [Self(a), Self(b), Self(c), Self(d)]
    }

    #[inline(always)]
    fn to_rows([a, b, c, d]: [Self; 4], mut row: impl FnMut(usize, [f64; 4])) {
        for (lane, numbers) in transposed([a.0, b.0, c.0, d.0]).iter().enumerate() {
            row(lane, store(*numbers));
        }
    }
}

/// Where the items at set bits are, one after the other.
const ORDERS: [[u32; 4]; 16] = {
    let mut orders = [[0; 4]; 16];
    let mut bits = 0;
    while bits < 16 {
        let (mut place, mut lane) = (0, 0);
        while lane < 4 {
            if bits >> lane & 1 == 1 {
                orders[bits][place] = lane;
                place += 1;
            }
            lane += 1;
        }
        bits += 1;
    }
    orders
};

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
    numbers!({
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
