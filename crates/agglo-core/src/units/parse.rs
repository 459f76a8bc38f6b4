//! Reads `"150 MPa"`, `"0.25 ms"`, `"1e5 Pa s/m"`, `"6000 kg/m3"`, `"10 W/(m2 K)"`, `"350 J/mol"`.
//!
//! A slash divides by the next unit only, or by all that stands in parentheses. A mole is a number without a dimension:
//! molar quantities are told from others by the key they stand at.
//!
//! A decimal prefix is applied to the exponent in the text, not by multiplication, so that `"100 um"` is
//! the `f64` nearest to 1e-4 and not 100 times the one nearest to 1e-6.

use thiserror::Error;

use super::{Dimension, Kind, kind_of};
use crate::text::cell;

/// Why a text is not the quantity that was asked for.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum UnitError {
    /// There is a number but no unit.
    #[error("\"{text}\" has no unit; {expected} is wanted, such as \"{example}\"")]
    NoUnit {
        /// What stood in the file.
        text: String,
        /// The kind that is wanted.
        expected: &'static str,
        /// A value of that kind.
        example: &'static str,
    },
    /// The text does not begin with a number.
    #[error("\"{text}\" does not begin with a number; {expected} is wanted, such as \"{example}\"")]
    NoNumber {
        /// What stood in the file.
        text: String,
        /// The kind that is wanted.
        expected: &'static str,
        /// A value of that kind.
        example: &'static str,
    },
    /// A unit that is not known.
    #[error(
        "unknown unit \"{unit}\" in \"{text}\"; {expected} is wanted, such as \"{example}\"{}",
        advice(text)
    )]
    UnknownUnit {
        /// What stood in the file.
        text: String,
        /// The word that is not a unit.
        unit: String,
        /// The kind that is wanted.
        expected: &'static str,
        /// A value of that kind.
        example: &'static str,
    },
    /// Parentheses that do not pair up.
    #[error("the parentheses in \"{text}\" do not pair up; {expected} is wanted, such as \"{example}\"")]
    Parentheses {
        /// What stood in the file.
        text: String,
        /// The kind that is wanted.
        expected: &'static str,
        /// A value of that kind.
        example: &'static str,
    },
    /// A quantity of another dimension.
    #[error("\"{text}\" is {found} [{dimension}]; {expected} is wanted, such as \"{example}\"")]
    WrongDimension {
        /// What stood in the file.
        text: String,
        /// The kind that was found.
        found: &'static str,
        /// Its dimension in base units.
        dimension: Dimension,
        /// The kind that is wanted.
        expected: &'static str,
        /// A value of that kind.
        example: &'static str,
    },
    /// A value so large that its powers cannot be computed.
    #[error(
        "\"{text}\" is beyond what can be computed; {expected} of at most {largest:e} {symbol} is allowed"
    )]
    TooLarge {
        /// What stood in the file.
        text: String,
        /// The kind that is wanted.
        expected: &'static str,
        /// The largest size [SI units].
        largest: f64,
        /// Its unit.
        symbol: String,
    },
    /// The value is infinite or not a number.
    #[error("\"{text}\" is not a finite number")]
    NotFinite {
        /// What stood in the file.
        text: String,
    },
}

/// What to write for signs that people know and files do not.
fn advice(text: &str) -> &'static str {
    if text.contains(['\u{b0}', '\u{2103}', '\u{2109}']) {
        "; write temperatures in kelvin: 20 degrees Celsius are \"293.15 K\", and angles as deg"
    } else if text.contains(['\u{b2}', '\u{b3}', '\u{b9}', '\u{207b}']) {
        "; write powers as digits, such as kg/m3 or m^-1"
    } else {
        ""
    }
}

struct Unit {
    symbol: &'static str,
    dimension: Dimension,
    /// Power of ten to SI.
    decimal: i32,
    /// Factor that is not a power of ten (a minute, an electronvolt).
    factor: f64,
    takes_prefix: bool,
}

const fn unit(
    symbol: &'static str,
    dimension: [i8; 5],
    decimal: i32,
    factor: f64,
    takes_prefix: bool,
) -> Unit {
    Unit { symbol, dimension: Dimension(dimension), decimal, factor, takes_prefix }
}

const UNITS: &[Unit] = &[
    unit("m", [0, 1, 0, 0, 0], 0, 1.0, true),
    unit("g", [1, 0, 0, 0, 0], -3, 1.0, true),
    unit("s", [0, 0, 1, 0, 0], 0, 1.0, true),
    unit("K", [0, 0, 0, 1, 0], 0, 1.0, true),
    unit("A", [0, 0, 0, 0, 1], 0, 1.0, true),
    unit("Hz", [0, 0, -1, 0, 0], 0, 1.0, true),
    unit("N", [1, 1, -2, 0, 0], 0, 1.0, true),
    unit("Pa", [1, -1, -2, 0, 0], 0, 1.0, true),
    unit("J", [1, 2, -2, 0, 0], 0, 1.0, true),
    unit("W", [1, 2, -3, 0, 0], 0, 1.0, true),
    unit("C", [0, 0, 1, 0, 1], 0, 1.0, true),
    unit("V", [1, 2, -3, 0, -1], 0, 1.0, true),
    unit("T", [1, 0, -2, 0, -1], 0, 1.0, true),
    unit("bar", [1, -1, -2, 0, 0], 5, 1.0, true),
    unit("L", [0, 3, 0, 0, 0], -3, 1.0, true),
    unit("P", [1, -1, -1, 0, 0], -1, 1.0, true),
    unit("rad", [0, 0, 0, 0, 0], 0, 1.0, true),
    unit("mol", [0, 0, 0, 0, 0], 0, 1.0, true),
    unit("min", [0, 0, 1, 0, 0], 0, 60.0, false),
    unit("h", [0, 0, 1, 0, 0], 0, 3600.0, false),
    unit("deg", [0, 0, 0, 0, 0], 0, std::f64::consts::PI / 180.0, false),
    unit("eV", [1, 2, -2, 0, 0], 0, crate::constants::ELEMENTARY_CHARGE, true),
    unit("e", [0, 0, 1, 0, 1], 0, crate::constants::ELEMENTARY_CHARGE, false),
    unit("t", [1, 0, 0, 0, 0], 3, 1.0, false),
    unit("1", [0, 0, 0, 0, 0], 0, 1.0, false),
];

const PREFIXES: &[(&str, i32)] = &[
    ("T", 12),
    ("G", 9),
    ("M", 6),
    ("k", 3),
    ("h", 2),
    ("d", -1),
    ("c", -2),
    ("m", -3),
    ("u", -6),
    ("\u{b5}", -6),
    ("\u{3bc}", -6),
    ("n", -9),
    ("p", -12),
    ("f", -15),
];

/// Finds a unit and the power of ten of its prefix; a symbol as such goes before prefix + symbol (`min`).
fn find_unit(word: &str) -> Option<(&'static Unit, i32)> {
    if let Some(plain) = UNITS.iter().find(|unit| unit.symbol == word) {
        return Some((plain, 0));
    }
    PREFIXES.iter().find_map(|(prefix, decimal)| {
        let rest = word.strip_prefix(prefix)?;
        UNITS.iter().find(|unit| unit.takes_prefix && unit.symbol == rest).map(|unit| (unit, *decimal))
    })
}

/// The value of `text` in SI units.
///
/// # Errors
/// [`UnitError`] where the number or unit is missing or unknown, the dimension is not `wanted`, or the value
/// is not finite.
pub fn parse_quantity(text: &str, wanted: Dimension) -> Result<f64, UnitError> {
    let Kind { name: expected, example, .. } = kind_of(wanted);
    let bare = || split_number(text.trim()).is_some_and(|(_, _, rest)| rest.trim().is_empty());
    if wanted != Dimension::default() && bare() {
        return Err(UnitError::NoUnit { text: cell(text), expected, example });
    }
    let (value, dimension) = read(text, expected, example)?;
    if dimension == wanted {
        return within(value, wanted, text);
    }
    let found = kind_of(dimension).name;
    Err(UnitError::WrongDimension { text: cell(text), found, dimension, expected, example })
}

/// The value of `text` in SI units, and its dimension.
///
/// # Errors
/// [`UnitError`] where the number is missing, the unit is unknown, or the value is not finite.
pub fn parse_any(text: &str) -> Result<(f64, Dimension), UnitError> {
    let (value, dimension) = read(text, "a number or a quantity", "40 um")?;
    Ok((within(value, dimension, text)?, dimension))
}

/// The value, if it is no larger than its kind allows.
pub(super) fn within(value: f64, dimension: Dimension, text: &str) -> Result<f64, UnitError> {
    let kind = kind_of(dimension);
    if kind.holds(value) {
        // A negative zero is a zero.
        return Ok(value + 0.0);
    }
    let (text, symbol) = (cell(text), dimension.symbol());
    Err(UnitError::TooLarge { text, expected: kind.name, largest: kind.largest, symbol })
}

fn read(text: &str, expected: &'static str, example: &'static str) -> Result<(f64, Dimension), UnitError> {
    let owned = || cell(text);
    let (mantissa, exponent, rest) =
        split_number(text.trim()).ok_or_else(|| UnitError::NoNumber { text: owned(), expected, example })?;
    let product = read_units(rest).map_err(|word| match word.as_str() {
        "(" | ")" => UnitError::Parentheses { text: owned(), expected, example },
        _ => UnitError::UnknownUnit { text: owned(), unit: cell(&word), expected, example },
    })?;
    let shifted = format!("{mantissa}e{}", exponent.saturating_add(product.decimal));
    let value = shifted.parse::<f64>().unwrap_or(f64::NAN) * product.factor;
    if value.is_finite() {
        Ok((value, product.dimension))
    } else {
        Err(UnitError::NotFinite { text: owned() })
    }
}

/// Splits "1.5e3 kg/m3" into ("1.5", 3, " kg/m3").
fn split_number(text: &str) -> Option<(&str, i32, &str)> {
    let mantissa_end =
        text.find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '+' | '-'))).unwrap_or(text.len());
    let (mantissa, rest) = text.split_at(mantissa_end);
    mantissa.parse::<f64>().ok()?;
    if let Some(tail) = rest.strip_prefix(['e', 'E']) {
        let sign = usize::from(tail.starts_with(['+', '-']));
        let digits = tail[sign..].find(|c: char| !c.is_ascii_digit()).unwrap_or(tail.len() - sign);
        if digits > 0 {
            let exponent = tail[..sign + digits].parse().ok()?;
            return Some((mantissa, exponent, &tail[sign + digits..]));
        }
    }
    Some((mantissa, 0, rest))
}

struct Product {
    dimension: Dimension,
    decimal: i32,
    factor: f64,
}

/// Reads a product of units such as `kg/m3`, `Pa s/m`, `N m^-1` or `J/(kg K)`; one slash divides by the next factor
/// only. What cannot be read comes back as the error.
fn read_units(text: &str) -> Result<Product, String> {
    let mut product = Product { dimension: Dimension::default(), decimal: 0, factor: 1.0 };
    // The sign of powers in each open parenthesis, and whether a slash waits for its factor.
    let mut signs = vec![1_i8];
    let mut divides = false;
    let spaced =
        text.replace('/', " / ").replace('(', " ( ").replace(')', " ) ").replace(['*', '\u{b7}'], " ");
    for word in spaced.split_whitespace() {
        let outer = signs.last().copied().unwrap_or(1);
        let sign = if divides { -outer } else { outer };
        match word {
            "/" if divides => return Err(word.to_owned()),
            "/" => {
                divides = true;
                continue;
            }
            "(" => signs.push(sign),
            ")" if divides || signs.len() == 1 => return Err(word.to_owned()),
            ")" => drop(signs.pop()),
            _ => product.multiply(word, sign)?,
        }
        divides = false;
    }
    match (divides, signs.len()) {
        (true, _) => Err("/".to_owned()),
        (false, 1) => Ok(product),
        (false, _) => Err("(".to_owned()),
    }
}

impl Product {
    /// Takes in a unit with its prefix and power, such as `mm^2`, to the power `sign`.
    fn multiply(&mut self, word: &str, sign: i8) -> Result<(), String> {
        let start = word.find(|c: char| c.is_ascii_digit() || matches!(c, '^' | '-')).filter(|at| *at > 0);
        let (symbol, power_text) = word.split_at(start.unwrap_or(word.len()));
        let power_text = power_text.trim_start_matches('^');
        let power =
            if power_text.is_empty() { 1 } else { power_text.parse::<i8>().map_err(|_| word.to_owned())? };
        let (unit, prefix) = find_unit(symbol).ok_or_else(|| symbol.to_owned())?;
        let power = power.checked_mul(sign).ok_or_else(|| word.to_owned())?;
        self.dimension = self.dimension.times(unit.dimension, power).ok_or_else(|| word.to_owned())?;
        self.decimal += i32::from(power) * (prefix + unit.decimal);
        self.factor *= unit.factor.powi(i32::from(power));
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::KINDS;

    fn si(text: &str, dimension: [i8; 5]) -> f64 {
        parse_quantity(text, Dimension(dimension)).unwrap()
    }

    /// Each row is a statement of physics with the value written by hand.
    #[test]
    fn units_mean_what_physics_says() {
        let (length, pressure) = ([0, 1, 0, 0, 0], [1, -1, -2, 0, 0]);
        assert_eq!(si("100 um", length), 1e-4);
        assert_eq!(si("100 \u{b5}m", length), 1e-4);
        assert_eq!(si("40um", length), 4e-5);
        assert_eq!(si("150 MPa", pressure), 1.5e8);
        assert_eq!(si("1 bar", pressure), 1e5);
        assert_eq!(si("1 N/mm2", pressure), 1e6);
        assert_eq!(si("1 J/m^3", pressure), 1.0);
        assert_eq!(si("1.5e+3 kg m^-3", [1, -3, 0, 0, 0]), 1500.0);
        assert_eq!(si("1 g/cm3", [1, -3, 0, 0, 0]), 1000.0);
        assert_eq!(si("1 mPa s", [1, -1, -1, 0, 0]), 1e-3);
        assert_eq!(si("1 cP", [1, -1, -1, 0, 0]), 1e-3);
        assert_eq!(si("2 min", [0, 0, 1, 0, 0]), 120.0);
        assert_eq!(si("3.6 km/h", [0, 1, -1, 0, 0]), 1.0);
        assert_eq!(si("1 T", [1, 0, -2, 0, -1]), 1.0);
        assert_eq!(si("1 mJ/m2", [1, 0, -2, 0, 0]), 1e-3);
        assert_eq!(si("1 Hz", [0, 0, -1, 0, 0]), si("1 rad/s", [0, 0, -1, 0, 0]));
        assert_eq!(si("-2 kV/m", [1, 1, -3, 0, -1]), -2000.0);
        // A calorie warms a gram of water by a kelvin: 4.184 J/(g K).
        let (specific_heat, transfer) = ([0, 2, -2, -1, 0], [1, 0, -3, -1, 0]);
        assert_eq!(si("4.184 J/(g K)", specific_heat), 4184.0);
        assert_eq!(si("4184 J/kg/K", specific_heat), 4184.0);
        assert_eq!(si("4184 m2/(s2 K)", specific_heat), 4184.0);
        assert_eq!(si("1 W/(cm2 K)", transfer), 1e4);
        assert_eq!(si("1 W/(cm2*K)", transfer), 1e4);
        assert_eq!(si("1 W/cm2/K", transfer), 1e4);
        assert_eq!(si("1 W / ( m^2 K )", transfer), 1.0);
        assert_eq!(si("0.4 kW/(m K)", [1, 1, -3, -1, 0]), 400.0);
        // The gas constant in J/(mol K) and, per thousand moles, in kJ.
        let molar = [1, 2, -2, -1, 0];
        assert_eq!(si("8.314462618 J/(mol K)", molar), 8.314_462_618);
        assert_eq!(si("8.314462618 kJ/(kmol K)", molar), 8.314_462_618);
        assert_eq!(si("352 J/mol", [1, 2, -2, 0, 0]), 352.0);
        assert_eq!(si("0.352 kJ/mol", [1, 2, -2, 0, 0]), 352.0);
    }

    /// 1/(a/(b c)) is b c/a.
    #[test]
    fn parentheses_nest() {
        assert_eq!(si("3 1/(s/(kg m))", [1, 1, -1, 0, 0]), 3.0);
        assert_eq!(si("3 (kg m)/s", [1, 1, -1, 0, 0]), 3.0);
        assert_eq!(si("3 J/((kg) (K)) s", [0, 2, -1, -1, 0]), 3.0);
    }

    #[test]
    fn examples_and_symbols_can_be_read_back() {
        for kind in KINDS {
            parse_quantity(kind.example, kind.dimension).unwrap();
            assert_eq!(
                parse_quantity(&format!("1 {}", kind.symbol), kind.dimension),
                Ok(1.0),
                "{}",
                kind.symbol
            );
        }
    }

    /// The largest of each kind is taken, twice as much is not. Cubes of a product of any two, and the fourth power of a
    /// temperature, are numbers; so are those of the smallest.
    #[test]
    fn ranges_hold_what_can_be_cubed() {
        for kind in KINDS {
            let read = |value: f64| parse_quantity(&format!("{value:e} {}", kind.symbol), kind.dimension);
            assert_eq!(read(-kind.largest), Ok(-kind.largest), "{}", kind.name);
            assert!(matches!(read(2.0 * kind.largest), Err(UnitError::TooLarge { .. })), "{}", kind.name);
            assert_above!(kind.smallest, 0.0);
            assert_below!(kind.smallest, kind.largest);
            for other in KINDS {
                assert!((kind.largest * other.largest).powi(3).is_finite(), "{}, {}", kind.name, other.name);
                assert!((kind.smallest * other.smallest).powi(2) > 0.0, "{}, {}", kind.name, other.name);
            }
        }
    }

    #[test]
    fn zero_has_no_sign() {
        assert_eq!(si("-0 m", [0, 1, 0, 0, 0]).to_bits(), 0);
    }

    #[test]
    fn what_is_wrong_is_said() {
        let length = Dimension([0, 1, 0, 0, 0]);
        let message = |text: &str| parse_quantity(text, length).unwrap_err().to_string();
        assert_contains!(message("3"), "has no unit");
        assert_contains!(message("3 Pa"), "is a pressure");
        assert_contains!(message("3 meters"), "unknown unit \"meters\"");
        assert_contains!(message("wide"), "does not begin with a number");
        assert_ends!(message("1000 kg/m\u{b3}"), "write powers as digits, such as kg/m3 or m^-1");
        assert_contains!(message("20 \u{b0}C"), "20 degrees Celsius are \"293.15 K\"");
        assert_contains!(message("1e999 m"), "not a finite number");
        let beyond = "\"2e9 m\" is beyond what can be computed; a length of at most 1e9 m is allowed";
        assert_eq!(message("2e9 m"), beyond);
        assert_contains!(message("3 m^200"), "unknown unit");
        assert_contains!(message(""), "does not begin");
        for text in ["3 J/(kg K", "3 J/kg K)", "3 )m(", "3 m/(s/)"] {
            assert!(message(text).contains("parentheses in"), "{}", message(text));
        }
        assert_contains!(message("3 m/"), "unknown unit \"/\"");
        assert_contains!(message("3 m//s"), "unknown unit \"/\"");
    }
}
