//! A TOML file as a tree of values that know where they stand.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::text::{Number, cell};

/// Where a value stands: source 0 is the file, source k the k-th setting.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Place {
    pub source: usize,
    pub span: Range<usize>,
}

impl Place {
    /// No place: what a whole file lacks stands nowhere in it.
    pub fn nowhere() -> Self {
        Self { source: usize::MAX, span: 0..0 }
    }
}

/// A value and its place.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub place: Place,
    pub value: Value,
}

/// The kinds of TOML value.
#[derive(Clone, Debug)]
pub(super) enum Value {
    Text(String),
    Integer(i128),
    Float(f64),
    Flag(bool),
    Date(String),
    List(Vec<Node>),
    Table(Vec<Entry>),
}

/// A key of a table with its value.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub key: String,
    pub place: Place,
    pub node: Node,
}

impl Value {
    /// What was found, with its kind, short enough for a message.
    pub fn found(&self) -> String {
        match self {
            Self::Text(text) => format!("the string \"{}\"", cell(text)),
            Self::Integer(number) => format!("the number {number}"),
            Self::Float(number) => format!("the number {}", Number(*number)),
            Self::Flag(flag) => format!("the boolean {flag}"),
            Self::Date(date) => format!("the date {date}"),
            Self::List(items) => format!("a list of {}", items.len()),
            Self::Table(_) => "a table".to_owned(),
        }
    }
}

impl Node {
    /// Takes over a parsed value; `source` says where its spans point.
    pub fn from_toml(value: &Spanned<DeValue<'_>>, source: usize) -> Self {
        let place = Place { source, span: value.span() };
        let value = match value.get_ref() {
            DeValue::String(text) => Value::Text(text.to_string()),
            DeValue::Integer(number) => {
                Value::Integer(i128::from_str_radix(number.as_str(), number.radix()).unwrap_or(i128::MAX))
            }
            // A negative zero is a zero.
            DeValue::Float(number) => Value::Float(number.as_str().parse().unwrap_or(f64::NAN) + 0.0),
            DeValue::Boolean(flag) => Value::Flag(*flag),
            DeValue::Datetime(date) => Value::Date(date.to_string()),
            DeValue::Array(items) => {
                Value::List(items.iter().map(|item| Self::from_toml(item, source)).collect())
            }
            DeValue::Table(table) => Value::Table(entries(table, source)),
        };
        Self { place, value }
    }

    /// The whole file as a table.
    pub fn from_table(table: &Spanned<DeTable<'_>>) -> Self {
        Self { place: Place::nowhere(), value: Value::Table(entries(table.get_ref(), 0)) }
    }

    /// Place of the deepest value on the path that stands in the file; of its key where it is a table.
    ///
    /// Keys in quotes can have points of their own, so that a path is not cut at its points but held to the keys.
    pub fn locate(&self, path: &str) -> Option<Place> {
        let (place, child, rest) = match &self.value {
            Value::Table(entries) => {
                let found = entries.iter().filter_map(|entry| Some((entry, rest_of(path, &entry.key)?)));
                let (entry, rest) = found.max_by_key(|(entry, _)| entry.key.len())?;
                let is_table = matches!(entry.node.value, Value::Table(_));
                (if is_table { &entry.place } else { &entry.node.place }, &entry.node, rest)
            }
            Value::List(items) => {
                let (word, rest) = path.split_once('.').unwrap_or((path, ""));
                let item = word.parse::<usize>().ok().and_then(|index| items.get(index))?;
                (&item.place, item, rest)
            }
            _ => return None,
        };
        child.locate(rest).or_else(|| Some(place.clone()))
    }

    /// The same without places, for serde.
    pub fn to_value(&self) -> toml::Value {
        match &self.value {
            Value::Text(text) | Value::Date(text) => toml::Value::String(text.clone()),
            Value::Integer(number) => toml::Value::Integer(i64::try_from(*number).unwrap_or(i64::MAX)),
            Value::Float(number) => toml::Value::Float(*number),
            Value::Flag(flag) => toml::Value::Boolean(*flag),
            Value::List(items) => toml::Value::Array(items.iter().map(Self::to_value).collect()),
            Value::Table(entries) => toml::Value::Table(
                entries.iter().map(|entry| (entry.key.clone(), entry.node.to_value())).collect(),
            ),
        }
    }
}

/// What follows a key on a path.
fn rest_of<'a>(path: &'a str, key: &str) -> Option<&'a str> {
    let rest = path.strip_prefix(key)?;
    if rest.is_empty() { Some(rest) } else { rest.strip_prefix('.') }
}

fn entries(table: &DeTable<'_>, source: usize) -> Vec<Entry> {
    table
        .iter()
        .map(|(key, value)| Entry {
            key: key.get_ref().to_string(),
            place: Place { source, span: key.span() },
            node: Node::from_toml(value, source),
        })
        .collect()
}
