//! Formulas of parameters and of columns of a summary, in SI units, in the language of [`crate::math::formula`].
//!
//! Names may have dots: `0.7*growth_deficit + 0.3*energy.heat_J/v^2`. Which names there are is said where a formula is
//! bound to them.

use crate::math::formula;

/// A formula of parameters and columns.
pub type Formula = formula::Formula<Source>;

/// Where the value of a name is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// Among the parameters, with this number.
    Parameter(usize),
    /// Among the columns, with this number.
    Column(usize),
}

/// The value of a formula for values of the parameters and of the columns; not a number where it has none.
pub fn value_of(formula: &Formula, parameters: &[f64], columns: &[f64]) -> f64 {
    let value = |source: Source| match source {
        Source::Parameter(number) => parameters.get(number).copied(),
        Source::Column(number) => columns.get(number).copied(),
    };
    formula.at(|source| value(source).unwrap_or(f64::NAN))
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
        Ok(value_of(&Formula::new(text, find)?, &[2.0, 3.0], &[0.5, 1e3, 7.0]))
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
