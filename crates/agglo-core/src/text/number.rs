//! The one writer of numbers for files that programs read: tables, lists of frames, journals, scenarios.
//!
//! A number is written with as few digits as bring back the same double. Below 1e-4 and from 1e16 on it has an exponent,
//! since readers of tables lose digits of long decimals (some take 28 zeros for 0). A whole number has no point, so
//! that counts are counts. What cannot be had is `NaN`, what has no bound `inf`. A negative zero is a zero.
//!
//! Numbers for people are written by [`super::readable`] and its neighbors.

use std::fmt;

/// A number as files have it; writing it allocates nothing.
///
/// ```
/// # extern crate agglo_core as agglo;
/// use agglo::text::Number;
/// let texts = [1512.0, 0.1, 1e-28, 2.5e16].map(|value| Number(value).to_string());
/// assert_eq!(texts, ["1512", "0.1", "1e-28", "2.5e16"]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number(pub f64);

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Adding zero takes the sign off a zero and off nothing else.
        let value = self.0 + 0.0;
        let size = value.abs();
        if size == 0.0 || (1e-4..1e16).contains(&size) || !size.is_finite() {
            write!(f, "{value}")
        } else {
            write!(f, "{value:e}")
        }
    }
}

/// The text of a number as files have it.
pub fn number(value: f64) -> String {
    Number(value).to_string()
}

/// Text that is read as a number with a fraction even where it is whole: `3.0`, as TOML tells them apart.
pub fn fractional(value: f64) -> String {
    let text = number(value);
    if text.contains(['.', 'e', 'n', 'N']) { text } else { text + ".0" }
}

#[cfg(test)]
mod tests {
    use agglo_testing::AWKWARD;
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn awkward_numbers_come_back_bit_by_bit_and_are_short() {
        for value in AWKWARD.into_iter().chain([0.0]) {
            for text in [number(value), fractional(value)] {
                assert_eq!(text.parse::<f64>().unwrap().to_bits(), value.to_bits(), "{text}");
                // A sign, 17 digits, a point, and an exponent of a sign and three digits.
                assert!(text.len() <= 24, "{text}");
            }
        }
        assert_eq!([f64::NAN, f64::INFINITY, -0.0].map(number), ["NaN", "inf", "0"]);
        assert_eq!(fractional(-0.0), "0.0");
    }

    #[test]
    fn whole_numbers_have_no_point_and_small_ones_an_exponent() {
        let texts = [1512.0, 1e15, -3.0, 0.0001, 0.000_01, 1e16].map(number);
        assert_eq!(texts, ["1512", "1000000000000000", "-3", "0.0001", "1e-5", "1e16"]);
        assert_eq!([3.0, 1e-5, 0.5, 1e16].map(fractional), ["3.0", "1e-5", "0.5", "1e16"]);
    }

    proptest! {
        #[test]
        fn every_number_comes_back_bit_by_bit(bits in any::<u64>()) {
            let value = f64::from_bits(bits);
            prop_assume!(!value.is_nan() && bits != (-0.0_f64).to_bits());
            let text = number(value);
            prop_assert_eq!(text.parse::<f64>().unwrap().to_bits(), bits);
            prop_assert!(text.len() <= 24);
        }
    }
}
