//! Quantities with units at the border, SI inside.
//!
//! A scenario writes `"150 MPa"` or `"40 um"`; the program computes with plain `f64` in SI units. A
//! [`Quantity`] carries its dimension in its type, so a pressure where a length belongs is refused while
//! the file is read. So is one that is too large to compute with: each kind has one range ([`KINDS`]). This module
//! does not do arithmetic with units.

mod dimension;
mod parse;

pub use dimension::{Dimension, KINDS, Kind, kind_of};
pub use parse::{UnitError, parse_any, parse_quantity};

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::text::Number;

/// A value in SI units whose dimension kg^KG m^M s^S K^K A^A is part of its type.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Quantity<const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8>(pub f64);

macro_rules! quantities {
    ($($(#[$doc:meta])* $name:ident = $kg:literal $m:literal $s:literal $k:literal $a:literal;)*) => {
        $($(#[$doc])* pub type $name = Quantity<$kg, $m, $s, $k, $a>;)*
    };
}

quantities! {
    /// Length [m].
    Length = 0 1 0 0 0;
    /// Time [s].
    Time = 0 0 1 0 0;
    /// Mass [kg].
    Mass = 1 0 0 0 0;
    /// Temperature [K].
    Temperature = 0 0 0 1 0;
    /// Velocity [m/s].
    Velocity = 0 1 -1 0 0;
    /// Acceleration [m/s²].
    Acceleration = 0 1 -2 0 0;
    /// Frequency or angular velocity [1/s].
    Frequency = 0 0 -1 0 0;
    /// Density [kg/m³].
    Density = 1 -3 0 0 0;
    /// Pressure, stress or modulus [Pa].
    Pressure = 1 -1 -2 0 0;
    /// Dynamic viscosity [Pa s].
    Viscosity = 1 -1 -1 0 0;
    /// Stiffness [N/m]; also surface energy [J/m²].
    Stiffness = 1 0 -2 0 0;
    /// Damping per contact area [Pa s/m].
    AreaDamping = 1 -2 -1 0 0;
    /// Stiffness per contact area [Pa/m].
    AreaStiffness = 1 -2 -2 0 0;
    /// Force [N].
    Force = 1 1 -2 0 0;
    /// Energy [J].
    Energy = 1 2 -2 0 0;
    /// Power [W].
    Power = 1 2 -3 0 0;
    /// Heat capacity per mass [J/(kg K)].
    SpecificHeat = 0 2 -2 -1 0;
    /// Heat transfer coefficient [W/(m² K)].
    HeatTransfer = 1 0 -3 -1 0;
    /// Thermal conductivity [W/(m K)].
    Conductivity = 1 1 -3 -1 0;
    /// Electric charge [C].
    Charge = 0 0 1 0 1;
    /// Energy per squared magnetic flux density [J/T²].
    Magnetizability = -1 2 2 0 2;
}

impl<const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8> Quantity<KG, M, S, K, A> {
    /// The dimension that the type stands for.
    pub const DIMENSION: Dimension = Dimension([KG, M, S, K, A]);

    /// The value in SI units.
    #[inline]
    pub const fn si(self) -> f64 {
        self.0
    }
}

impl<const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8> Serialize
    for Quantity<KG, M, S, K, A>
{
    fn serialize<Z: Serializer>(&self, serializer: Z) -> Result<Z::Ok, Z::Error> {
        serializer.collect_str(&format_args!("{} {}", Number(self.0), Self::DIMENSION.symbol()))
    }
}

impl<'de, const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8> Deserialize<'de>
    for Quantity<KG, M, S, K, A>
{
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        if deserializer.is_human_readable() {
            return deserializer.deserialize_any(Reader);
        }
        deserializer.deserialize_str(Reader)
    }
}

/// Reads a text with its unit, or a bare number in SI units.
///
/// No file gets so far with a bare number, since its form is checked before it is deserialized; the program itself
/// puts numbers where it makes many scenarios of one.
struct Reader<const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8>;

impl<const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8> Visitor<'_>
    for Reader<KG, M, S, K, A>
{
    type Value = Quantity<KG, M, S, K, A>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kind = kind_of(Self::Value::DIMENSION);
        write!(f, "{}, such as \"{}\"", kind.name, kind.example)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Self::Value, E> {
        parse_quantity(text, Self::Value::DIMENSION).map(Quantity).map_err(E::custom)
    }

    fn visit_f64<E: Error>(self, si: f64) -> Result<Self::Value, E> {
        parse::within(si, Self::Value::DIMENSION, &Number(si).to_string()).map(Quantity).map_err(E::custom)
    }

    fn visit_u64<E: Error>(self, si: u64) -> Result<Self::Value, E> {
        self.visit_f64(si as f64)
    }

    fn visit_i64<E: Error>(self, si: i64) -> Result<Self::Value, E> {
        self.visit_f64(si as f64)
    }
}

impl<const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8> JsonSchema
    for Quantity<KG, M, S, K, A>
{
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        kind_of(Self::DIMENSION).name.into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let kind = kind_of(Self::DIMENSION);
        json_schema!({
            "type": "string",
            "x-dimension": [KG, M, S, K, A],
            "x-kind": kind.name,
            "x-largest": kind.largest,
            "examples": [kind.example],
        })
    }
}

/// Three quantities of one kind: a point, a velocity, an acceleration.
pub type Triple<Q> = [Q; 3];

/// The vector of a [`Triple`], in SI units.
pub fn vector<const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8>(
    triple: Triple<Quantity<KG, M, S, K, A>>,
) -> crate::math::Vec3 {
    triple.map(Quantity::si).into()
}
