//! What stands at the end of a path of keys: looked up along the schema and the lists of a scenario.

use serde_json::Value as Json;

use super::enums::words;
use super::fault::nearest;
use super::parse::schema;
use super::scalars::dimension_of;
use super::walk::{kind_of, resolve};
use crate::units::Dimension;

/// What a key can be set to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum KeyKind {
    /// A quantity of this dimension.
    Quantity(Dimension),
    /// A component of a field of this dimension: a constant or a formula.
    Field(Dimension),
    /// A number without unit.
    Number,
    /// A whole number.
    Whole,
    /// True or false.
    Flag,
    /// One of these words.
    Word(Vec<String>),
    /// Any text.
    Text,
}

/// Why a path leads nowhere: what is wrong, and the advice.
pub(crate) type Astray = (String, Option<String>);

/// The keys of scenarios.
#[derive(Debug)]
pub(crate) struct Keys {
    schema: Json,
}

impl Keys {
    /// All keys that a scenario can have.
    pub fn new() -> Self {
        Self { schema: schema() }
    }

    /// What stands at `path` of the scenario `tree`; its lists and names must be there, other keys may be missing.
    ///
    /// # Errors
    /// [`Astray`].
    pub fn kind(&self, path: &str, tree: &Json) -> Result<KeyKind, Astray> {
        let mut at = At { schema: self.resolve(&self.schema), value: Some(tree) };
        for word in path.split('.') {
            at = self.descend(&at, word)?;
        }
        leaf(&at)
    }

    /// Replaces quantities of `tree` by their values in SI units, which deserialize without being parsed.
    pub fn to_si(&self, tree: &mut Json) {
        self.strip(self.resolve(&self.schema), tree);
    }

    fn resolve<'a>(&'a self, schema: &'a Json) -> &'a Json {
        resolve(&self.schema["$defs"], schema)
    }

    fn descend<'a>(&'a self, at: &At<'a>, word: &str) -> Result<At<'a>, Astray> {
        let value = |key: &str| at.value.and_then(|value| value.get(key));
        if at.schema["oneOf"].is_array() {
            let known = tables(at.schema);
            let inner = table_of(at.schema, word).ok_or_else(|| stranger(word, &known))?;
            if let Some(chosen) = at.value.and_then(chosen).filter(|chosen| *chosen != word) {
                let message = format!("the base has \"{chosen}\" here, not \"{word}\"");
                return Err((
                    message,
                    Some("the base says which one it is, a search sets its values".to_owned()),
                ));
            }
            return Ok(At { schema: self.resolve(inner), value: value(word) });
        }
        match kind_of(at.schema) {
            "object" => {
                if let Some(properties) = at.schema["properties"].as_object() {
                    let known: Vec<&str> = properties.keys().map(String::as_str).collect();
                    let inner = properties.get(word).ok_or_else(|| stranger(word, &known))?;
                    return Ok(At { schema: self.resolve(inner), value: value(word) });
                }
                let known: Vec<&str> = at
                    .value
                    .and_then(Json::as_object)
                    .into_iter()
                    .flatten()
                    .map(|(key, _)| key.as_str())
                    .collect();
                if !known.contains(&word) {
                    return Err(stranger(word, &known));
                }
                Ok(At { schema: self.resolve(&at.schema["additionalProperties"]), value: value(word) })
            }
            "array" => {
                let items = at.value.and_then(Json::as_array).map_or(&[][..], Vec::as_slice);
                let entry = word.parse::<usize>().ok().and_then(|index| items.get(index));
                let entry = entry.ok_or_else(|| {
                    let count = items.len();
                    (format!("\"{word}\" is no entry of a list of {count} in the base; the first is 0"), None)
                })?;
                Ok(At { schema: self.resolve(&at.schema["items"]), value: Some(entry) })
            }
            _ => Err((format!("has no key \"{word}\" inside: the path ends before it"), None)),
        }
    }

    fn strip(&self, schema: &Json, value: &mut Json) {
        match value {
            Json::String(text) => {
                let is_quantity = schema["x-formula"] != true;
                if let Some(dimension) = dimension_of(schema).filter(|_| is_quantity)
                    && let Ok(si) = crate::units::parse_quantity(text, dimension)
                {
                    *value = Json::from(si);
                }
            }
            Json::Array(items) => {
                let inner = self.resolve(&schema["items"]);
                for item in items {
                    self.strip(inner, item);
                }
            }
            Json::Object(entries) => {
                for (key, entry) in entries {
                    let inner = schema["properties"]
                        .get(key)
                        .or_else(|| table_of(schema, key))
                        .unwrap_or(&schema["additionalProperties"]);
                    self.strip(self.resolve(inner), entry);
                }
            }
            _ => {}
        }
    }
}

/// What can be set at the end of the way.
fn leaf(at: &At<'_>) -> Result<KeyKind, Astray> {
    let whole = |what: &str, inside: Vec<&str>| {
        let message = format!("is {what}; the path of a single value is wanted");
        Err((message, (!inside.is_empty()).then(|| format!("inside are {}", inside.join(", ")))))
    };
    let schema = at.schema;
    if schema["oneOf"].is_array() || schema["enum"].is_array() {
        let tables = tables(schema);
        let alone: Vec<&str> = words(schema).into_iter().filter(|word| !tables.contains(word)).collect();
        if alone.is_empty() {
            return whole("a choice with parameters", tables);
        }
        return Ok(KeyKind::Word(alone.into_iter().map(str::to_owned).collect()));
    }
    match kind_of(schema) {
        "object" => {
            let properties = schema["properties"].as_object();
            whole("a table", properties.into_iter().flatten().map(|(key, _)| key.as_str()).collect())
        }
        "array" => whole("a list", Vec::new()),
        "integer" => Ok(KeyKind::Whole),
        "number" => Ok(KeyKind::Number),
        "boolean" => Ok(KeyKind::Flag),
        _ => Ok(match dimension_of(schema) {
            Some(dimension) if schema["x-formula"] == true => KeyKind::Field(dimension),
            Some(dimension) => KeyKind::Quantity(dimension),
            None => KeyKind::Text,
        }),
    }
}

/// A place on the way: the schema there, and the value if there is one.
struct At<'a> {
    schema: &'a Json,
    value: Option<&'a Json>,
}

/// Words of a choice that are followed by a table.
fn tables(schema: &Json) -> Vec<&str> {
    let choices = schema["oneOf"].as_array().into_iter().flatten();
    let with = choices.filter_map(|choice| choice["properties"].as_object());
    with.flat_map(|properties| properties.keys().map(String::as_str)).collect()
}

/// The schema of the table that follows the word of a choice.
fn table_of<'a>(schema: &'a Json, word: &str) -> Option<&'a Json> {
    schema["oneOf"].as_array()?.iter().find_map(|choice| choice["properties"].get(word))
}

/// The word that a value of a choice has.
fn chosen(value: &Json) -> Option<&str> {
    match value {
        Json::String(word) => Some(word),
        Json::Object(table) => table.keys().next().map(String::as_str),
        _ => None,
    }
}

fn stranger(word: &str, known: &[&str]) -> Astray {
    let message = match known {
        [] => format!("\"{word}\" is no key; there is none here"),
        _ => format!("\"{word}\" is no key; allowed are {}", known.join(", ")),
    };
    (message, nearest(word, known.iter().copied()).map(|near| format!("did you mean \"{near}\"?")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::{Scenario, template};

    fn tree() -> (Scenario, Json) {
        let scenario = Scenario::from_toml(template("reacting").unwrap().text).unwrap();
        let tree = serde_json::to_value(&scenario).unwrap();
        (scenario, tree)
    }

    #[test]
    fn kinds_of_keys() {
        let (_, tree) = tree();
        let kind = |path: &str| Keys::new().kind(path, &tree);
        assert_eq!(kind("time.end"), Ok(KeyKind::Quantity(Dimension([0, 0, 1, 0, 0]))));
        assert_eq!(kind("materials.grain.density"), Ok(KeyKind::Quantity(Dimension([1, -3, 0, 0, 0]))));
        assert_eq!(kind("grains.0.size.length_ratio.ratio"), Ok(KeyKind::Number));
        assert_eq!(kind("grains.0.placement.fill.count"), Ok(KeyKind::Whole));
        assert_eq!(
            kind("grains.0.velocity_spread.uniform.bounds.2"),
            Ok(KeyKind::Quantity(Dimension([0, 1, -1, 0, 0])))
        );
        assert_eq!(kind("output.rays"), Ok(KeyKind::Flag));
        assert_eq!(kind("title"), Ok(KeyKind::Text));
        let boundaries = ["periodic", "reflecting", "open"].map(str::to_owned);
        assert_matches!(kind("volume.boundary"), Ok(KeyKind::Word(words)) if words.contains(&boundaries[0]));
        let astray = |path: &str| kind(path).unwrap_err();
        assert_eq!(astray("materials.grian.density").1.unwrap(), "did you mean \"grain\"?");
        assert_contains!(astray("grains.1.charge").0, "no entry of a list of 1");
        assert_contains!(astray("time").0, "is a table");
        assert_contains!(astray("time.end.x").0, "the path ends before it");
        assert_contains!(astray("grains.0.size.constant.radius").0, "the base has \"length_ratio\"");
        assert_eq!(astray("time.ende").1.unwrap(), "did you mean \"end\"?");
    }

    /// A tree of numbers is the same scenario, to the last bit.
    #[test]
    fn numbers_in_si_units_stand_for_quantities() {
        for template in crate::scenario::scenario_templates() {
            let scenario = Scenario::from_toml(template.text).unwrap();
            let mut tree = serde_json::to_value(&scenario).unwrap();
            Keys::new().to_si(&mut tree);
            assert_matches!(tree["time"]["end"], serde_json::Value::Number(number) if number.is_f64());
            let again: Scenario = serde_json::from_value(tree).unwrap();
            assert_eq!(again, scenario, "{}", template.name);
        }
    }
}
