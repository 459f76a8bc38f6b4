//! A field that is a constant with a unit or an expression in x, y, z and t.
//!
//! A constant carries its unit (`"0.1 T"`). A formula is in SI units throughout: x, y, z in meters, t in
//! seconds, the value in the field's SI unit; it must contain at least one of them, so that a bare number is
//! never taken for a quantity. It knows `+ - * / ^`, parentheses, `pi` and the functions of
//! [`FUNCTIONS`](crate::math::formula::FUNCTIONS), as formulas of searches do. Where a formula has no value (1/x at 0) the
//! result is infinite or not a number, and the run stops at its guard against such states.
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::fields::Expression;
//! use agglo::math::Vec3;
//! let field: Expression<1, 0, -2, 0, -1> = Expression::new("0.1*sin(2*pi*t) + 3*x").unwrap();
//! assert!((field.at(Vec3::new(0.2, 0.0, 0.0), 0.25) - 0.7).abs() < 1e-15);
//! ```

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

use crate::math::Vec3;
use crate::math::formula::{self, Formula};
use crate::units::{Dimension, kind_of, parse_quantity};

/// One component of a field: `"0.1 T"`, or `"0.1*sin(6.28*t) + 3*x"` in SI units.
#[derive(Clone)]
pub struct Expression<const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8> {
    text: String,
    value: Value,
}

#[derive(Clone, Debug)]
enum Value {
    Constant(f64),
    /// Names are the numbers of what they stand for in [`VARIABLES`].
    Formula(Box<Formula<usize>>),
}

/// Three components of a field.
pub type FieldVector<const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8> =
    [Expression<KG, M, S, K, A>; 3];

/// What a formula may name: where and when.
const VARIABLES: [&str; 4] = ["x", "y", "z", "t"];

impl<const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8> Expression<KG, M, S, K, A> {
    /// Reads a constant with its unit, or a formula in SI units.
    ///
    /// # Errors
    /// Says why the text is neither.
    pub fn new(text: &str) -> Result<Self, String> {
        let dimension = Dimension([KG, M, S, K, A]);
        let reason = match parse_quantity(text, dimension) {
            Ok(value) => return Ok(Self { text: text.to_owned(), value: Value::Constant(value) }),
            Err(reason) => reason.to_string(),
        };
        let find = |name: &str| {
            VARIABLES.iter().position(|known| *known == name).ok_or_else(|| {
                let advice = formula::advice(name).map(|advice| format!("; {advice}")).unwrap_or_default();
                format!(
                    "\"{text}\" uses \"{name}\"; a formula knows x, y, z [m] and t [s], a constant needs a unit, such as \"{}\"{advice}",
                    kind_of(dimension).example
                )
            })
        };
        match Formula::new(text, find) {
            Ok(formula) if formula.names().is_empty() => Err(reason),
            Ok(formula) => Ok(Self { text: text.to_owned(), value: Value::Formula(Box::new(formula)) }),
            // What only looks like a formula is a constant that is broken.
            Err(why) if why.contains("is not a formula") => {
                Err(format!("{reason}, or a formula in x, y, z, t"))
            }
            Err(why) => Err(why),
        }
    }

    /// The value at a point [m] and time [s], in SI units.
    #[inline]
    pub fn at(&self, point: Vec3, time: f64) -> f64 {
        match &self.value {
            Value::Constant(value) => *value,
            Value::Formula(formula) => {
                let known = [point.x, point.y, point.z, time];
                formula.at(|name| known[name])
            }
        }
    }

    /// The slopes along x, y, z [per m] and t [per s] at a point [m] and time [s].
    #[inline]
    pub fn slopes_at(&self, point: Vec3, time: f64) -> [f64; 4] {
        match &self.value {
            Value::Constant(_) => [0.0; 4],
            Value::Formula(formula) => {
                let known = [point.x, point.y, point.z, time];
                let along = |name: usize| std::array::from_fn(|way| if way == name { 1.0 } else { 0.0 });
                formula.with_slopes(|name| known[name], along).1
            }
        }
    }

    /// The value if it is the same everywhere and always.
    pub fn constant(&self) -> Option<f64> {
        match &self.value {
            Value::Constant(value) => Some(*value),
            Value::Formula(_) => None,
        }
    }
}

/// The vector of a field at a point [m] and time [s].
#[inline]
pub fn evaluate<const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8>(
    field: &FieldVector<KG, M, S, K, A>,
    point: Vec3,
    time: f64,
) -> Vec3 {
    Vec3::new(field[0].at(point, time), field[1].at(point, time), field[2].at(point, time))
}

impl<const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8> fmt::Debug
    for Expression<KG, M, S, K, A>
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.text)
    }
}

impl<const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8> PartialEq
    for Expression<KG, M, S, K, A>
{
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

impl<const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8> Serialize
    for Expression<KG, M, S, K, A>
{
    fn serialize<Z: Serializer>(&self, serializer: Z) -> Result<Z::Ok, Z::Error> {
        self.text.serialize(serializer)
    }
}

impl<'de, const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8> Deserialize<'de>
    for Expression<KG, M, S, K, A>
{
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Self::new(&Cow::<str>::deserialize(deserializer)?).map_err(D::Error::custom)
    }
}

impl<const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8> JsonSchema
    for Expression<KG, M, S, K, A>
{
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "formula".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let kind = kind_of(Dimension([KG, M, S, K, A]));
        json_schema!({
            "type": "string",
            "x-dimension": [KG, M, S, K, A],
            "x-formula": true,
            "x-kind": kind.name,
            "examples": [kind.example],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type FluxDensity = Expression<1, 0, -2, 0, -1>;

    const AT: Vec3 = Vec3::new(0.2, -0.5, 3.0);

    fn value(text: &str) -> f64 {
        FluxDensity::new(text).unwrap().at(AT, 0.25)
    }

    #[test]
    fn constants_have_units() {
        assert_eq!(value("0.1 T"), 0.1);
        assert_eq!(value("-250 mT"), -0.25);
        assert_eq!(FluxDensity::new("3 T").unwrap().constant(), Some(3.0));
        assert_eq!(FluxDensity::new("3*x").unwrap().constant(), None);
    }

    /// Formulas against the same arithmetic in Rust; two roundings may differ in order.
    #[test]
    fn formulas_mean_what_they_say() {
        let rows = [
            ("x", 0.2),
            ("2*x - y/4 + z^2", 0.4 + 0.125 + 9.0),
            ("0.1*sin(6.5*t) + 3*x", 0.1 * (6.5_f64 * 0.25).sin() + 0.6),
            ("-(z - t)", -2.75),
            ("exp(-t)*cos(2*pi*y)", (-0.25_f64).exp() * (-std::f64::consts::PI).cos()),
            ("sqrt(x^2 + y^2)", 0.29_f64.sqrt()),
            ("2^(-t)", 2.0_f64.powf(-0.25)),
            ("-x^2", -0.04),
            ("2*(-y^2) + 1e3*x", 199.5),
            ("2.5E-1*y + .5e+1*z", 14.875),
            ("z*y*x*t", -0.075),
        ];
        for (text, wanted) in rows {
            assert!((value(text) - wanted).abs() < 1e-14, "{text}: {}", value(text));
        }
        assert_false!(value("1/(x - 0.2)").is_finite(), "a pole is not finite");
    }

    #[test]
    fn what_is_wrong_is_said() {
        let message = |text: &str| FluxDensity::new(text).unwrap_err();
        assert_contains!(message("3*-x"), "two operators in a row");
        assert!(message("3").contains("has no unit"), "{}", message("3"));
        assert!(
            message("2*pi").contains("has no unit") || message("2*pi").contains("unknown unit"),
            "{}",
            message("2*pi")
        );
        assert!(message("3 m").contains("is a length"), "{}", message("3 m"));
        for (text, advice) in
            [("x*E", "exp(1)"), ("x*e", "exp(1)"), ("x*PI", "pi"), ("x*π", "pi"), ("TAU*t", "2*pi")]
        {
            assert!(message(text).contains(&format!("write {advice}")), "{}", message(text));
        }
        assert!(message("log(x)").contains("calls \"log\"; functions are abs"), "{}", message("log(x)"));
        let stranger = message("3*u + x");
        assert!(stranger.contains("uses \"u\"") && stranger.contains("x, y, z"), "{stranger}");
        for broken in ["3*(x", "sin(", "x +", "", "x y"] {
            assert!(!message(broken).is_empty(), "{broken}");
        }
    }

    #[test]
    fn text_survives_a_round_trip() {
        for text in ["\"0.1 T\"", "\"3*x + t\""] {
            let read: FluxDensity = serde_json::from_str(text).unwrap();
            assert_eq!(serde_json::to_string(&read).unwrap(), text);
        }
        assert_err!(serde_json::from_str::<FluxDensity>("\"3 kg\""));
    }
}
