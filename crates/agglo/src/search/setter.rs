//! How a value is put into the tree of a scenario, and how a setting of the command line says the same.

use serde_json::{Map, Number, Value as Json};

use crate::scenario::KeyKind;
use crate::text::{fractional, number as text};

/// A key of a scenario and what it can be set to.
#[derive(Clone, Debug)]
pub struct Setter {
    /// Its path.
    pub key: String,
    /// What it can be set to.
    pub kind: KeyKind,
}

impl Setter {
    /// Whether it takes numbers.
    pub fn takes_numbers(&self) -> bool {
        !matches!(self.kind, KeyKind::Flag | KeyKind::Word(_) | KeyKind::Text)
    }

    /// A number in SI units as the tree has it.
    pub fn number(&self, value: f64) -> Json {
        match &self.kind {
            // The kind was checked: whole numbers come from whole ranges, and derived ones are rounded.
            KeyKind::Whole if value.is_finite() => Json::from(value.round() as i64),
            KeyKind::Field(dimension) if value.is_finite() => {
                Json::from(format!("{} {}", text(value), dimension.symbol()))
            }
            _ => Number::from_f64(value).map_or(Json::Null, Json::Number),
        }
    }

    /// Puts a value into a tree; tables on the way that are not there are made.
    pub fn put(&self, tree: &mut Json, value: Json) {
        let mut at = tree;
        for word in self.key.split('.') {
            match at {
                Json::Array(items) => {
                    // The path was checked, so there is such an entry.
                    let Some(item) = word.parse().ok().and_then(|index: usize| items.get_mut(index)) else {
                        return;
                    };
                    at = item;
                }
                other => {
                    if !other.is_object() {
                        *other = Json::Object(Map::new());
                    }
                    at = &mut other[word];
                }
            }
        }
        *at = value;
    }

    /// The setting `key=value` that does the same, as the command line takes it.
    pub fn setting(&self, value: &Json) -> String {
        let key = &self.key;
        match (&self.kind, value) {
            (KeyKind::Quantity(dimension), Json::Number(number)) => {
                format!("{key}=\"{} {}\"", text(si(number)), dimension.symbol())
            }
            (KeyKind::Number, Json::Number(number)) => {
                // Always with a point, so that it is read as a number and not as a whole one.
                format!("{key}={}", fractional(si(number)))
            }
            _ => format!("{key}={value}"),
        }
    }
}

fn si(number: &Number) -> f64 {
    number.as_f64().unwrap_or(f64::NAN)
}
