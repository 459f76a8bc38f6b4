//! Every key that a file can have, with its unit, its default and its meaning: read off the schema, which derives from the
//! types.

use serde_json::Value as Json;

use super::enums::words;
use super::scalars::dimension_of;
use super::walk::{join, kind_of, resolve};
use crate::text::Number;

/// A key of a scenario or campaign.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Key {
    /// Its path; `N` stands for the number of an entry of a list, `NAME` for a name of one's own.
    pub path: String,
    /// Unit of its value, SI; `table` where keys of its own are below it, `-` where it has none.
    pub unit: String,
    /// What is taken where it is left out: `-` if it must be given, `none` if nothing is.
    pub default: String,
    /// What it means.
    pub meaning: String,
    /// The words that it can have, with their meanings; those of a choice.
    pub words: Vec<(String, String)>,
    /// Whether keys of its own are below it.
    pub is_table: bool,
}

impl Key {
    /// What it means, with its words where these have no tables of their own.
    pub fn whole_meaning(&self) -> String {
        let words = self.words.iter().map(|(word, meaning)| match meaning.as_str() {
            "" => format!("`\"{word}\"`"),
            _ => format!("`\"{word}\"`: {}", without_stop(meaning)),
        });
        std::iter::once(without_stop(&self.meaning))
            .chain(words)
            .filter(|part| !part.is_empty())
            .collect::<Vec<_>>()
            .join("; ")
    }
}

/// All keys of a file that is held to a schema, tables before what is in them, keys that must be given first.
pub fn keys_of(schema: &Json) -> Vec<Key> {
    let mut list = List { definitions: &schema["$defs"], keys: Vec::new() };
    list.below("", schema, false);
    list.keys
}

struct List<'a> {
    definitions: &'a Json,
    keys: Vec<Key>,
}

impl<'a> List<'a> {
    fn resolve(&self, schema: &'a Json) -> &'a Json {
        resolve(self.definitions, schema)
    }

    fn key(&mut self, path: &str, schema: &'a Json, description: &Json, is_required: bool) {
        let plain = self.resolve(schema);
        let meaning = [description, &schema["description"], &plain["description"]];
        let meaning = meaning.into_iter().find_map(Json::as_str).unwrap_or("").replace('\n', " ");
        let at = self.keys.len();
        let default = if is_required { "-".to_owned() } else { default_of(&schema["default"]) };
        let words = words_alone(plain);
        self.keys.push(Key {
            path: path.to_owned(),
            unit: self.unit(schema),
            default,
            meaning,
            words,
            is_table: false,
        });
        self.below(path, plain, is_required);
        let is_table =
            self.keys.len() > at + 1 || (kind_of(plain) == "object" && self.keys[at].words.is_empty());
        let key = &mut self.keys[at];
        key.is_table = is_table;
        if is_table && key.words.is_empty() && key.unit == "-" {
            "table".clone_into(&mut key.unit);
        }
    }

    /// The keys below a place.
    fn below(&mut self, path: &str, schema: &'a Json, is_required: bool) {
        let schema = self.resolve(schema);
        for choice in schema["oneOf"].as_array().into_iter().flatten() {
            for (word, inner) in choice["properties"].as_object().into_iter().flatten() {
                self.key(&join(path, word), inner, &choice["description"], is_required);
            }
        }
        match kind_of(schema) {
            "object" => {
                if schema["additionalProperties"].is_object() {
                    self.below(&join(path, "NAME"), &schema["additionalProperties"], false);
                }
                let required: Vec<&str> =
                    schema["required"].as_array().into_iter().flatten().filter_map(Json::as_str).collect();
                let properties = schema["properties"].as_object().into_iter().flatten();
                let (given, free): (Vec<_>, Vec<_>) =
                    properties.partition(|(name, _)| required.contains(&name.as_str()));
                for name in &required {
                    if let Some((name, inner)) = given.iter().find(|(given, _)| given.as_str() == *name) {
                        self.key(&join(path, name), inner, &Json::Null, true);
                    }
                }
                for (name, inner) in free {
                    self.key(&join(path, name), inner, &Json::Null, false);
                }
            }
            "array" => self.below(&join(path, "N"), &schema["items"], false),
            _ => {}
        }
    }

    fn unit(&self, schema: &'a Json) -> String {
        let given = schema["x-unit"].as_str();
        let schema = self.resolve(schema);
        if kind_of(schema) == "array" {
            let one = self.unit(&schema["items"]);
            return match schema["maxItems"].as_u64() {
                Some(count) if one == "-" => format!("list of {count}"),
                Some(count) => format!("{one} x {count}"),
                None if one == "-" => "list".to_owned(),
                None => format!("list of {one}"),
            };
        }
        match dimension_of(schema) {
            Some(dimension) if schema["x-formula"] == true => format!("{} or formula", dimension.symbol()),
            Some(dimension) => given.map_or_else(|| dimension.symbol(), str::to_owned),
            None => given.or(schema["x-unit"].as_str()).unwrap_or("-").to_owned(),
        }
    }
}

/// Words of a choice that stand alone, with their meanings.
fn words_alone(schema: &Json) -> Vec<(String, String)> {
    let choices = schema["oneOf"].as_array().into_iter().flatten();
    let meaning = |word: &str| {
        let of_word = |choice: &&Json| choice["const"] == word;
        let found = schema["oneOf"].as_array().into_iter().flatten().find(of_word);
        found.and_then(|choice| choice["description"].as_str()).unwrap_or("").replace('\n', " ")
    };
    let tables: Vec<&String> = choices
        .filter_map(|choice| choice["properties"].as_object())
        .flat_map(|table| table.keys())
        .collect();
    let alone = words(schema).into_iter().filter(|word| !tables.iter().any(|table| table == word));
    alone.map(|word| (word.to_owned(), meaning(word))).collect()
}

/// A sentence without its full stop.
fn without_stop(text: &str) -> String {
    text.trim_end_matches('.').to_owned()
}

/// A default as a file would have it.
fn default_of(value: &Json) -> String {
    match value {
        Json::Null => "none".to_owned(),
        Json::Number(number) => {
            number.as_f64().map_or_else(|| number.to_string(), |number| Number(number).to_string())
        }
        Json::String(text) if text.starts_with(|first: char| first.is_ascii_digit()) => text.clone(),
        Json::Array(items) => match items.as_slice() {
            [] => "none".to_owned(),
            [first, rest @ ..] if rest.iter().all(|item| item == first) => default_of(first),
            _ => value.to_string(),
        },
        Json::Object(_) => "see there".to_owned(),
        _ => format!("`{value}`"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::schema;

    fn key(path: &str) -> Key {
        keys_of(&schema()).into_iter().find(|key| key.path == path).unwrap_or_else(|| panic!("no key {path}"))
    }

    fn line(path: &str) -> [String; 2] {
        let key = key(path);
        [key.unit, key.default]
    }

    #[test]
    fn units_and_defaults_are_those_of_the_types() {
        assert_eq!(line("time.end"), ["s", "-"]);
        assert_eq!(line("bonds.beam.gap"), ["-", "0.001"]);
        assert_eq!(line("medium.viscosity"), ["Pa s", "0.001 Pa s"]);
        assert_eq!(line("materials.NAME.youngs_modulus"), ["Pa", "none"]);
        assert_eq!(line("grains.N.velocity"), ["m/s x 3", "0 m/s"]);
        assert_eq!(line("fields.drag.medium_velocity"), ["m/s or formula x 3", "none"]);
        assert_eq!(line("grains.N.size.table.radii"), ["list of m", "-"]);
        assert_eq!(line("acoustics.beams.N.pulses.count"), ["-", "1"]);
        assert_eq!(line("output.rays"), ["-", "`true`"]);
        assert_eq!(line("limits"), ["table", "see there"]);
        assert_eq!(line("materials.NAME.surface_energy"), ["J/m^2", "none"]);
        assert_eq!(line("acoustics.beams.N.strength.power"), ["W", "-"]);
    }

    #[test]
    fn words_of_choices_have_meanings() {
        let boundary = key("volume.boundary");
        assert_eq!(boundary.default, "`\"periodic\"`");
        assert_contains!(boundary.whole_meaning(), "`\"open\"`: The faces do nothing");
        let are_tables =
            [&boundary, &key("contact.normal"), &key("contact.normal.hertz")].map(|key| key.is_table);
        assert_eq!(are_tables, [false, true, true], "keys that are tables");
        assert_empty!(key("contact.normal").words);
        // A choice of a word alone or of a table.
        let profile = key("acoustics.beams.N.profile");
        assert_eq!(profile.words.iter().map(|(word, _)| word.as_str()).collect::<Vec<_>>(), ["uniform"]);
    }
}
