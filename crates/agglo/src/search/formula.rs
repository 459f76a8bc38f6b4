//! Formulas of parameters and of columns of a summary, in SI units.
//!
//! They know `+ - * / ^`, parentheses, the functions of [`FUNCTIONS`], and names, which may have dots:
//! `0.7*pi + 0.3*energy.heat_J/v^2`. Which names there are is said where a formula is bound to them.

use exmex::{Express, FlatEx};

use crate::fields::{as_mathematicians_read, leading_number};

/// Functions that a formula may call; `atan2`, `min` and `max` take two arguments.
pub const FUNCTIONS: [&str; 26] = [
    "abs", "acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "cbrt", "ceil", "cos", "cosh", "exp",
    "floor", "ln", "log10", "log2", "max", "min", "round", "signum", "sin", "sinh", "sqrt", "tan", "tanh",
];

/// A formula and where the values of its names are found.
#[derive(Clone, Debug)]
pub struct Formula {
    text: String,
    expression: Box<FlatEx<f64>>,
    sources: Vec<Source>,
}

/// Where the value of a name is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// Among the parameters, with this number.
    Parameter(usize),
    /// Among the columns, with this number.
    Column(usize),
    /// It is always the same.
    Constant(f64),
}

impl Formula {
    /// Reads a formula whose names are found by `find`.
    ///
    /// # Errors
    /// Says what is wrong with the text, or what `find` says of a name.
    pub fn new(text: &str, mut find: impl FnMut(&str) -> Result<Source, String>) -> Result<Self, String> {
        let (numbered, names) = with_numbers_for_names(text)?;
        let plain = as_mathematicians_read(&numbered)
            .map_err(|_| format!("\"{text}\" has two operators in a row; put the second into parentheses"))?;
        let broken = |why: String| format!("\"{text}\" is not a formula: {why}");
        let expression = FlatEx::<f64>::parse(&plain).map_err(|error| broken(error.msg().to_owned()))?;
        let mut sources = Vec::new();
        for placeholder in expression.var_names() {
            let number =
                placeholder.strip_prefix(PLACEHOLDER).and_then(|number| number.parse::<usize>().ok());
            let name = number.and_then(|number| names.get(number));
            sources.push(find(name.ok_or_else(|| broken(format!("\"{placeholder}\" cannot be read")))?)?);
        }
        Ok(Self { text: text.to_owned(), expression: Box::new(expression), sources })
    }

    /// Its text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Its value for values of the parameters and of the columns; not a number where it has none.
    pub fn at(&self, parameters: &[f64], columns: &[f64]) -> f64 {
        let value = |source: &Source| match *source {
            Source::Parameter(number) => parameters.get(number).copied(),
            Source::Column(number) => columns.get(number).copied(),
            Source::Constant(value) => Some(value),
        };
        let given: Vec<f64> = self.sources.iter().map(|source| value(source).unwrap_or(f64::NAN)).collect();
        self.expression.eval(&given).unwrap_or(f64::NAN)
    }
}

/// A name that no unit, function or constant of the parser has.
const PLACEHOLDER: &str = "name_";

/// The formula with `name_0`, `name_1` ... for its names, and the names; the parser would not take their dots, and
/// would take some of them for constants.
fn with_numbers_for_names(text: &str) -> Result<(String, Vec<String>), String> {
    let mut read = String::with_capacity(text.len());
    let mut names: Vec<String> = Vec::new();
    let mut rest = text;
    while let Some(next) = rest.chars().next() {
        if next.is_ascii_digit() || next == '.' {
            let (number, length) = leading_number(rest);
            read += &number;
            rest = &rest[length..];
        } else if next.is_alphabetic() || next == '_' {
            let stop = |c: char| !(c.is_alphanumeric() || c == '_' || c == '.');
            let (word, after) = rest.split_at(rest.find(stop).unwrap_or(rest.len()));
            rest = after;
            if after.trim_start().starts_with('(') {
                if !FUNCTIONS.contains(&word) {
                    let known = FUNCTIONS.join(", ");
                    return Err(format!("\"{text}\" calls \"{word}\"; functions are {known}"));
                }
                read += word;
            } else {
                let number = names.iter().position(|name| name == word).unwrap_or_else(|| {
                    names.push(word.to_owned());
                    names.len() - 1
                });
                read += PLACEHOLDER;
                read += &number.to_string();
            }
        } else if next.is_whitespace() || "+-*/^(),".contains(next) {
            read.push(next);
            rest = &rest[next.len_utf8()..];
        } else {
            return Err(format!("\"{text}\" is not a formula: \"{next}\" has no meaning in one"));
        }
    }
    Ok((read, names))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> Result<f64, String> {
        let find = |name: &str| match name {
            "v" => Ok(Source::Parameter(0)),
            "e" => Ok(Source::Parameter(1)),
            "pi" => Ok(Source::Column(0)),
            "energy.heat_J" => Ok(Source::Column(1)),
            "pulses.0.power_in_W" => Ok(Source::Column(2)),
            _ => Err(format!("who is {name}?")),
        };
        Ok(Formula::new(text, find)?.at(&[2.0, 3.0], &[0.5, 1e3, 7.0]))
    }

    /// The same arithmetic in Rust; two roundings may differ in order.
    #[test]
    fn formulas_mean_what_they_say() {
        let rows = [
            ("pi", 0.5),
            ("0.7*pi + 0.3*energy.heat_J/1000", 0.65),
            ("(v - 2.0)^2", 0.0),
            ("-v^2", -4.0),
            ("2e-3*v + e", 3.004),
            ("v*cos(e)", 2.0 * 3.0_f64.cos()),
            ("max(v, e) - min(v, 1E1)", 1.0),
            ("pulses.0.power_in_W/7 - v / e * e", -1.0),
            ("sqrt (v*v)", 2.0),
            ("3", 3.0),
        ];
        for (text, wanted) in rows {
            let found = value(text).unwrap();
            assert!((found - wanted).abs() < 1e-14, "{text}: {found}");
        }
        assert!(value("ln(v - 3)").unwrap().is_nan());
    }

    #[test]
    fn what_is_wrong_is_said() {
        let message = |text: &str| value(text).unwrap_err();
        assert_eq!(message("2*w"), "who is w?");
        assert!(message("sine(v)").contains("calls \"sine\"; functions are abs"));
        assert!(message("v % 2").contains("\"%\" has no meaning"));
        assert!(message("v*-2").contains("\"v*-2\" has two operators in a row"));
        for broken in ["", "v +", "(v", "v e", "2 v", "sin()", "sin", "v)"] {
            assert!(!message(broken).is_empty(), "{broken}");
        }
    }
}
