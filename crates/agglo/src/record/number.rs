//! The one writer of numbers for files that programs read: tables, lists of frames, journals, scenarios.
//!
//! A number is written with as few digits as bring back the same double. Below 1e-4 and from 1e16 on it has an exponent,
//! since readers of tables lose digits of long decimals (some take 28 zeros for 0). A whole number has no point, so
//! that counts are counts. What cannot be had is `NaN`, what has no bound `inf`. A negative zero is a zero.
//!
//! Numbers for people are written by [`crate::scenario::readable`] and its neighbours.

use std::fmt;
use std::io::{self, Write};

use serde::Serialize;
use serde_json::Serializer;
use serde_json::ser::{Formatter, PrettyFormatter};

/// A number as files have it; writing it allocates nothing.
///
/// ```
/// use agglo::record::Number;
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

/// The text of a value as JSON over several lines, with a line's end. Numbers that are not finite are `null`, as JSON has it.
///
/// # Errors
/// What `serde_json` has no text for: keys of maps that are no strings.
pub fn json<T: Serialize>(value: &T) -> serde_json::Result<String> {
    let mut bytes = Vec::new();
    let pretty = Unsigned(PrettyFormatter::new());
    value.serialize(&mut Serializer::with_formatter(&mut bytes, pretty))?;
    bytes.push(b'\n');
    // `serde_json` writes nothing but UTF-8.
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// Writes JSON as `PrettyFormatter` does, but zeros without a sign.
struct Unsigned(PrettyFormatter<'static>);

impl Formatter for Unsigned {
    fn write_f64<W: ?Sized + Write>(&mut self, writer: &mut W, value: f64) -> io::Result<()> {
        self.0.write_f64(writer, value + 0.0)
    }

    fn begin_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.0.begin_array(writer)
    }

    fn end_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.0.end_array(writer)
    }

    fn begin_array_value<W: ?Sized + Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        self.0.begin_array_value(writer, first)
    }

    fn end_array_value<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.0.end_array_value(writer)
    }

    fn begin_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.0.begin_object(writer)
    }

    fn end_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.0.end_object(writer)
    }

    fn begin_object_key<W: ?Sized + Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        self.0.begin_object_key(writer, first)
    }

    fn begin_object_value<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.0.begin_object_value(writer)
    }

    fn end_object_value<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.0.end_object_value(writer)
    }
}

/// Where in a value, such as `energy.drift_J`, a number stands that is not finite, if one does.
///
/// `null` stands for what is not known, and is no number; so a summary says `None` and never `NaN`.
pub fn not_finite<T: Serialize>(value: &T) -> Option<String> {
    // TOML, unlike JSON, has words for such numbers. What it has no words for is no summary either.
    toml::Value::try_from(value).map_or_else(|error| Some(error.to_string()), |tree| odd_one(&tree))
}

fn odd_one(tree: &toml::Value) -> Option<String> {
    let below = |key: String, inner: &toml::Value| {
        let rest = odd_one(inner)?;
        Some(if rest.is_empty() { key } else { format!("{key}.{rest}") })
    };
    match tree {
        toml::Value::Float(number) if !number.is_finite() => Some(String::new()),
        toml::Value::Table(table) => table.iter().find_map(|(key, inner)| below(key.clone(), inner)),
        toml::Value::Array(items) => {
            items.iter().enumerate().find_map(|(at, inner)| below(at.to_string(), inner))
        }
        _ => None,
    }
}

/// Text that is read as a number with a fraction even where it is whole: `3.0`, as TOML tells them apart.
pub fn fractional(value: f64) -> String {
    let text = number(value);
    if text.contains(['.', 'e', 'n', 'N']) { text } else { text + ".0" }
}

/// Numbers that writers of numbers get wrong, for tests of every table.
#[cfg(test)]
pub(crate) const AWKWARD: [f64; 18] = [
    0.1,
    1.0 / 3.0,
    1e-28,
    -1e-28,
    5e-324,
    f64::MIN_POSITIVE,
    f64::MAX,
    f64::MIN,
    1e22,
    9_007_199_254_740_993.0,
    1e16,
    9_999_999_999_999_998.0,
    123_456_789.125,
    2.5e-7,
    9.999_999_999_999_999e-5,
    6.626_070_15e-34,
    1512.0,
    -3.0,
];

#[cfg(test)]
mod tests {
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

    #[derive(Serialize)]
    struct Inner {
        figure: f64,
        list: Vec<f64>,
        unknown: Option<f64>,
    }

    #[derive(Serialize)]
    struct Outer {
        #[serde(flatten)]
        inner: Inner,
        more: Vec<Inner>,
    }

    fn outer(figure: f64, last: f64) -> Outer {
        let inner = |figure, last| Inner { figure, list: vec![1.5, last], unknown: None };
        Outer { inner: inner(figure, 0.0), more: vec![inner(0.0, 1.0), inner(-0.0, last)] }
    }

    #[test]
    fn json_has_no_negative_zero() {
        let text = json(&outer(-0.0, 1e-300)).unwrap();
        assert!(!text.contains("-0.0") && text.ends_with("}\n"), "{text}");
        assert_eq!(
            text,
            serde_json::to_string_pretty(&outer(0.0, 1e-300)).unwrap().replace("-0.0", "0.0") + "\n"
        );
    }

    #[test]
    fn numbers_that_are_not_finite_are_found_wherever_they_stand() {
        assert_eq!(not_finite(&outer(1.0, -2.0)), None);
        assert_eq!(not_finite(&outer(f64::NAN, 0.0)).as_deref(), Some("figure"));
        assert_eq!(not_finite(&outer(1.0, f64::NEG_INFINITY)).as_deref(), Some("more.1.list.1"));
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
