//! Lanes of x86-64 with AVX-512, eight at a time.
//!
//! Its numbers exist only within work that [`with`] hands over after it has asked the processor, as nothing outside this file
//! can name their type.
#![allow(unsafe_code, reason = "instructions that not every x86-64 has; each use says why it is sound")]

use std::arch::x86_64::{
    __m512d, __mmask8, _CMP_LE_OQ, _CMP_LT_OQ, _MM_FROUND_NO_EXC, _MM_FROUND_TO_NEAREST_INT,
    _mm_cvtsi64_si128, _mm_set1_epi8, _mm_test_epi8_mask, _mm256_loadu_pd, _mm256_loadu_si256,
    _mm256_maskz_compress_epi32, _mm256_storeu_pd, _mm256_storeu_si256, _mm512_abs_pd, _mm512_add_pd,
    _mm512_castpd256_pd512, _mm512_castpd512_pd256, _mm512_cmp_pd_mask, _mm512_div_pd,
    _mm512_extractf64x4_pd, _mm512_insertf64x4, _mm512_loadu_pd, _mm512_mask_blend_pd, _mm512_max_pd,
    _mm512_min_pd, _mm512_mul_pd, _mm512_permutex2var_pd, _mm512_roundscale_pd, _mm512_set1_pd,
    _mm512_setr_epi64, _mm512_setzero_pd, _mm512_sqrt_pd, _mm512_storeu_pd, _mm512_sub_pd,
    _mm512_unpackhi_pd, _mm512_unpacklo_pd, _mm512_xor_pd,
};
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::number::{Lanes, Work};
use super::register::{numbers, register};
use crate::math::Real;

/// Does work in eight lanes, if the processor has AVX-512 as servers have it.
#[inline]
pub(super) fn with<W: Work>(work: W) -> Result<W::Out, W> {
    let has = std::arch::is_x86_feature_detected!("avx512f")
        && std::arch::is_x86_feature_detected!("avx512bw")
        && std::arch::is_x86_feature_detected!("avx512dq")
        && std::arch::is_x86_feature_detected!("avx512vl")
        && std::arch::is_x86_feature_detected!("popcnt");
    // SAFETY: the processor has what the function asks for.
    if has { Ok(unsafe { with_avx512(work) }) } else { Err(work) }
}

#[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl,popcnt")]
fn with_avx512<W: Work>(work: W) -> W::Out {
    work.with::<Eight>()
}

register! {
    /// Eight numbers.
    Eight(__m512d) of 8,
    _mm512_setzero_pd, _mm512_loadu_pd, _mm512_storeu_pd,
    Add::add is _mm512_add_pd,
    Sub::sub is _mm512_sub_pd,
    Mul::mul is _mm512_mul_pd,
    Div::div is _mm512_div_pd
}

/// A truth for each of them, as bits.
#[derive(Clone, Copy, Default)]
struct Mask(__mmask8);

impl Neg for Eight {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        numbers!(Self(_mm512_xor_pd(self.0, _mm512_set1_pd(-0.0))))
    }
}

impl Real for Eight {
    type Mask = Mask;

    #[inline(always)]
    fn of(value: f64) -> Self {
        numbers!(Self(_mm512_set1_pd(value)))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        numbers!(Self(_mm512_sqrt_pd(self.0)))
    }

    #[inline(always)]
    fn powf(self, exponent: f64) -> Self {
        let lanes = self.to_array();
        Self::from_lanes(|lane| lanes[lane].powf(exponent))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        numbers!(Self(_mm512_abs_pd(self.0)))
    }

    #[inline(always)]
    fn round(self) -> Self {
        numbers!(Self(_mm512_roundscale_pd::<{ _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC }>(self.0)))
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        numbers!(Self(_mm512_min_pd(self.0, other.0)))
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        numbers!(Self(_mm512_max_pd(self.0, other.0)))
    }

    #[inline(always)]
    fn below(self, other: Self) -> Mask {
        numbers!(Mask(_mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.0, other.0)))
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> Mask {
        numbers!(Mask(_mm512_cmp_pd_mask::<_CMP_LE_OQ>(self.0, other.0)))
    }

    #[inline(always)]
    fn select(mask: Mask, yes: Self, no: Self) -> Self {
        numbers!(Self(_mm512_mask_blend_pd(mask.0, no.0, yes.0)))
    }

    #[inline(always)]
    fn both(a: Mask, b: Mask) -> Mask {
        Mask(a.0 & b.0)
    }

    #[inline(always)]
    fn not(mask: Mask) -> Mask {
        Mask(!mask.0)
    }

    #[inline(always)]
    fn all(mask: Mask) -> bool {
        mask.0 == __mmask8::MAX
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
    fn mask_from_lanes(mut value: impl FnMut(usize) -> bool) -> Mask {
        let mut bits = 0;
        for lane in 0..8 {
            bits |= __mmask8::from(value(lane)) << lane;
        }
        Mask(bits)
    }

    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self.to_array()[lane]
    }

    #[inline(always)]
    fn mask_from_flags(bytes: &[u8], flag: u8) -> Mask {
        let bytes = bytes[..8].try_into().map_or(0, i64::from_le_bytes);
        let flag = flag.cast_signed();
        numbers!(Mask(_mm_test_epi8_mask(_mm_cvtsi64_si128(bytes), _mm_set1_epi8(flag)) as __mmask8))
    }

    #[inline(always)]
    fn bits(mask: Mask) -> u32 {
        u32::from(mask.0)
    }

    #[inline(always)]
    fn squeeze(bits: u32, items: &[u32], to: &mut [u32]) {
        let (items, to): (&[u32; 8], &mut [u32; 8]) = match (items.try_into(), to.try_into()) {
            (Ok(items), Ok(to)) => (items, to),
            _ => return,
        };
        // SAFETY: as above; both are arrays of eight.
        unsafe {
            let items = _mm256_loadu_si256(items.as_ptr().cast());
            let first = _mm256_maskz_compress_epi32(bits as __mmask8, items);
            _mm256_storeu_si256(to.as_mut_ptr().cast(), first);
        }
    }

    #[inline(always)]
    fn from_rows<'a>(mut row: impl FnMut(usize) -> &'a [f64; 4]) -> [Self; 4] {
        let (a, b) = (load(row(0), row(4)), load(row(1), row(5)));
        let (c, d) = (load(row(2), row(6)), load(row(3), row(7)));
        numbers!({
            let (ab_even, ab_odd) = (_mm512_unpacklo_pd(a, b), _mm512_unpackhi_pd(a, b));
            let (cd_even, cd_odd) = (_mm512_unpacklo_pd(c, d), _mm512_unpackhi_pd(c, d));
            let low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
            let high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
            [
                Self(_mm512_permutex2var_pd(ab_even, low, cd_even)),
                Self(_mm512_permutex2var_pd(ab_odd, low, cd_odd)),
                Self(_mm512_permutex2var_pd(ab_even, high, cd_even)),
                Self(_mm512_permutex2var_pd(ab_odd, high, cd_odd)),
            ]
        })
    }

    #[inline(always)]
    fn to_rows([a, b, c, d]: [Self; 4], mut row: impl FnMut(usize, [f64; 4])) {
        let pairs = numbers!({
            let (ab_even, ab_odd) = (_mm512_unpacklo_pd(a.0, b.0), _mm512_unpackhi_pd(a.0, b.0));
            let (cd_even, cd_odd) = (_mm512_unpacklo_pd(c.0, d.0), _mm512_unpackhi_pd(c.0, d.0));
            let low = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11);
            let high = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
            [
                _mm512_permutex2var_pd(ab_even, low, cd_even),
                _mm512_permutex2var_pd(ab_odd, low, cd_odd),
                _mm512_permutex2var_pd(ab_even, high, cd_even),
                _mm512_permutex2var_pd(ab_odd, high, cd_odd),
            ]
        });
        // Rows 0 and 2, 1 and 3, 4 and 6, 5 and 7.
        for (pair, first) in pairs.iter().zip([0, 1, 4, 5]) {
            let [one, two] = store(*pair);
            row(first, one);
            row(first + 2, two);
        }
    }
}

/// Two rows side by side.
#[inline(always)]
fn load(low: &[f64; 4], high: &[f64; 4]) -> __m512d {
    // SAFETY: as above; the rows are arrays of four.
    unsafe {
        let low = _mm512_castpd256_pd512(_mm256_loadu_pd(low.as_ptr()));
        _mm512_insertf64x4::<1>(low, _mm256_loadu_pd(high.as_ptr()))
    }
}

/// Two rows that stand side by side.
#[inline(always)]
fn store(pair: __m512d) -> [[f64; 4]; 2] {
    let mut rows = [[0.0; 4]; 2];
    // SAFETY: as above; the rows are arrays of four.
    unsafe {
        _mm256_storeu_pd(rows[0].as_mut_ptr(), _mm512_castpd512_pd256(pair));
        _mm256_storeu_pd(rows[1].as_mut_ptr(), _mm512_extractf64x4_pd::<1>(pair));
    }
    rows
}
