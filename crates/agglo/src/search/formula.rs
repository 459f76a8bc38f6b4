//! Formulas of parameters and of columns of a summary, in SI units, in the language of [`crate::math::formula`].
//!
//! Names may have dots: `0.7*growth_deficit + 0.3*energy.heat_J/v^2`. Which names there are is said where a formula is
//! bound to them; `pi` is 3.14159... in all of them.

use exmex::{Express, FlatEx};

use crate::math::formula::{self, PI, Parsed};

/// A formula and where the values of its names are found.
#[derive(Clone, Debug)]
pub struct Formula {
    text: String,
    expression: Box<FlatEx<f64>>,
    sources: Vec<Source>,
    names_pi: bool,
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
        let Parsed { expression, names } = formula::parse(text)?;
        let mut source = |name: &String| {
            if name == PI { Ok(Source::Constant(std::f64::consts::PI)) } else { find(name) }
        };
        let sources = names.iter().map(&mut source).collect::<Result<Vec<_>, _>>()?;
        let names_pi = names.iter().any(|name| name == PI);
        Ok(Self { text: text.to_owned(), expression: Box::new(expression), sources, names_pi })
    }

    /// Whether it has neither a parameter nor a column in it.
    pub fn is_constant(&self) -> bool {
        self.sources.iter().all(|source| matches!(source, Source::Constant(_)))
    }

    /// Whether it has the constant `pi` in it.
    pub fn names_pi(&self) -> bool {
        self.names_pi
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

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> Result<f64, String> {
        let find = |name: &str| match name {
            "v" => Ok(Source::Parameter(0)),
            "e" => Ok(Source::Parameter(1)),
            "deficit" => Ok(Source::Column(0)),
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
            ("deficit", 0.5),
            ("sin(pi*e/2)", -1.0),
            ("0.7*deficit + 0.3*energy.heat_J/1000", 0.65),
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
        assert_nan!(value("ln(v - 3)").unwrap());
    }

    #[test]
    fn what_is_wrong_is_said() {
        let message = |text: &str| value(text).unwrap_err();
        assert_eq!(message("2*w"), "who is w?");
        assert_contains!(message("sine(v)"), "calls \"sine\"; functions are abs");
        assert_contains!(message("v % 2"), "\"%\" has no meaning");
        assert_contains!(message("v*-2"), "\"v*-2\" has two operators in a row");
        for broken in ["", "v +", "(v", "v e", "2 v", "sin()", "sin", "v)"] {
            assert!(!message(broken).is_empty(), "{broken}");
        }
    }
}
