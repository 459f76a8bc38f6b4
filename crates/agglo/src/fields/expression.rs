//! A field that is a constant with a unit or an expression in x, y, z and t.

use std::borrow::Cow;
use std::fmt;

use exmex::{Express, FlatEx};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

use crate::math::Vec3;
use crate::units::{Dimension, kind_of, parse_quantity};

/// One component of a field: `"0.1 T"`, or `"0.1*sin(6.28*t) + 3*x"` in SI units.
#[derive(Clone)]
pub struct Expression<const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8> {
    text: String,
    value: Value,
}

#[derive(Clone)]
enum Value {
    Constant(f64),
    Formula { formula: Box<FlatEx<f64>>, arguments: Vec<usize> },
}

/// Three components of a field.
pub type FieldVector<const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8> =
    [Expression<KG, M, S, K, A>; 3];

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
        let Ok(formula) = FlatEx::<f64>::parse(text) else {
            return Err(format!("{reason}, or a formula in x, y, z, t"));
        };
        let names = formula.var_names();
        if let Some(stranger) = names.iter().find(|name| !VARIABLES.contains(&name.as_str())) {
            let kind = kind_of(dimension);
            return Err(format!(
                "\"{text}\" uses \"{stranger}\"; a formula knows x, y, z [m] and t [s], a constant needs a unit, such as \"{}\"",
                kind.example
            ));
        }
        let arguments: Vec<usize> =
            names.iter().filter_map(|name| VARIABLES.iter().position(|known| known == name)).collect();
        if arguments.is_empty() {
            return Err(reason);
        }
        Ok(Self { text: text.to_owned(), value: Value::Formula { formula: Box::new(formula), arguments } })
    }

    /// The value at a point [m] and time [s], in SI units.
    #[inline]
    pub fn at(&self, point: Vec3, time: f64) -> f64 {
        match &self.value {
            Value::Constant(value) => *value,
            Value::Formula { formula, arguments } => {
                let known = [point.x, point.y, point.z, time];
                let mut given = [0.0; 4];
                for (slot, which) in given.iter_mut().zip(arguments) {
                    *slot = known[*which];
                }
                formula.eval(&given[..arguments.len()]).unwrap_or(f64::NAN)
            }
        }
    }

    /// The value if it is the same everywhere and always.
    pub fn constant(&self) -> Option<f64> {
        match &self.value {
            Value::Constant(value) => Some(*value),
            Value::Formula { .. } => None,
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
