//! Formulas as files write them, over names that a law declares.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::bound::Formula;
use super::words::advice;

/// What the formulas of a law can name.
pub trait Names: Copy + PartialEq + Send + Sync + 'static {
    /// Each name with its unit.
    const ALL: &'static [(&'static str, &'static str, Self)];
}

/// A formula in SI units over the names `N`.
///
/// A text that is no formula is kept, and worth nothing: [`Written::fault`] says what is wrong with it, so that all faults of a file
/// are told at once.
#[derive(Clone, Debug)]
pub struct Written<N> {
    text: String,
    read: Result<Box<Formula<N>>, String>,
}

impl<N: Names> Written<N> {
    /// Reads a text.
    pub fn new(text: &str) -> Self {
        let find = |name: &str| {
            let found = N::ALL.iter().find(|(known, ..)| *known == name);
            found.map(|(.., name)| *name).ok_or_else(|| unknown::<N>(text, name))
        };
        let read = Formula::new(text, find).map(Box::new).map_err(|why| {
            let hint = if why.contains("is not a formula") {
                "; it is in SI units, without signs of units"
            } else {
                ""
            };
            why + hint
        });
        Self { text: text.to_owned(), read }
    }

    /// The text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// What is wrong with the text.
    pub fn fault(&self) -> Option<&str> {
        self.read.as_ref().err().map(String::as_str)
    }

    /// Whether it has a name in it.
    #[inline]
    pub fn has(&self, name: N) -> bool {
        self.read.as_ref().is_ok_and(|formula| formula.names().contains(&name))
    }

    /// Its value, where names have these; not a number if it is no formula.
    #[inline]
    pub fn at(&self, value: impl Fn(N) -> f64) -> f64 {
        self.read.as_ref().map_or(f64::NAN, |formula| formula.at(value))
    }

    /// Its slopes along `W` ways, where names have these values and change by so much along each way.
    #[inline]
    pub fn slopes<const W: usize>(
        &self,
        value: impl Fn(N) -> f64,
        along: impl Fn(N) -> [f64; W],
    ) -> [f64; W] {
        self.read.as_ref().map_or([f64::NAN; W], |formula| formula.with_slopes(value, along).1)
    }
}

fn unknown<N: Names>(text: &str, name: &str) -> String {
    let known: Vec<String> = N::ALL.iter().map(|(name, unit, _)| format!("{name} [{unit}]")).collect();
    let advice = advice(name).map(|advice| format!("; {advice}")).unwrap_or_default();
    format!("\"{text}\" uses \"{name}\"; a formula here knows {}{advice}", known.join(", "))
}

impl<N> PartialEq for Written<N> {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

impl<N> Serialize for Written<N> {
    fn serialize<Z: Serializer>(&self, serializer: Z) -> Result<Z::Ok, Z::Error> {
        self.text.serialize(serializer)
    }
}

impl<'de, N: Names> Deserialize<'de> for Written<N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Ok(Self::new(&Cow::<str>::deserialize(deserializer)?))
    }
}

impl<N: Names> JsonSchema for Written<N> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "formula".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let names: Vec<&str> = N::ALL.iter().map(|(name, ..)| *name).collect();
        json_schema!({
            "type": "string",
            "x-unit": "formula",
            "x-kind": format!("a formula of {}", names.join(", ")),
            "examples": [format!("2*{}", names[0])],
        })
    }
}
