//! Holds a tree of values to the JSON schema of a scenario and collects every fault of form.
//!
//! It knows nothing of scenarios: keys, kinds, words and dimensions all come from the schema. Rules between keys are
//! in `check`.

use serde_json::Value as Json;

use super::enums::walk_enum;
use super::fault::{Fault, nearest};
use super::scalars::{walk_integer, walk_number, walk_scalar, walk_text};
use super::tree::{Entry, Node, Place, Value};
use crate::text::cell;

/// Nearest words are looked for so often: the rest of a file of unknown keys is not understood either.
const MOST_LOOKED: usize = 200;

/// The walk: the schema's definitions, and what was found so far.
pub(super) struct Walk<'a> {
    definitions: &'a Json,
    faults: Vec<(Place, Fault)>,
    /// How many nearest words were looked for.
    looked: usize,
}

impl<'a> Walk<'a> {
    /// All faults of form of a tree.
    pub fn faults(schema: &'a Json, root: &Node) -> Vec<(Place, Fault)> {
        let mut walk = Self { definitions: &schema["$defs"], faults: Vec::new(), looked: 0 };
        walk.node(root, schema, "");
        walk.faults
    }

    /// Notes a fault at a place.
    pub fn push(&mut self, place: &Place, fault: Fault) {
        self.faults.push((place.clone(), fault));
    }

    /// Notes that something else is wanted.
    pub fn wrong_kind(&mut self, node: &Node, path: &str, wanted: &str) {
        let found = node.value.found();
        self.push(&node.place, Fault::new(path, format!("found {found}; {wanted} is wanted")));
    }

    /// Holds one value to its schema.
    pub fn node(&mut self, node: &Node, schema: &'a Json, path: &str) {
        let schema = resolve(self.definitions, schema);
        if schema["oneOf"].is_array() || schema["enum"].is_array() {
            return walk_enum(self, node, schema, path);
        }
        if schema["x-scalar"] == true {
            return walk_scalar(self, node, schema, path);
        }
        match kind_of(schema) {
            "object" => self.object(node, schema, path),
            "array" => self.list(node, schema, path),
            "string" => walk_text(self, node, schema, path),
            "integer" => walk_integer(self, node, schema, path),
            "number" => walk_number(self, node, path),
            "boolean" if !matches!(node.value, Value::Flag(_)) => {
                self.wrong_kind(node, path, "true or false");
            }
            _ => {}
        }
    }

    fn object(&mut self, node: &Node, schema: &'a Json, path: &str) {
        let Value::Table(entries) = &node.value else {
            return self.wrong_kind(node, path, "a table");
        };
        let Some(properties) = schema["properties"].as_object() else {
            if schema["additionalProperties"].is_object() {
                self.map(entries, &schema["additionalProperties"], path);
            } else {
                for entry in entries {
                    self.unknown_key(entry, &[], path);
                }
            }
            return;
        };
        let known: Vec<&str> = properties.keys().map(String::as_str).collect();
        for entry in entries {
            match properties.get(&entry.key) {
                Some(inner) => self.node(&entry.node, inner, &join(path, &entry.key)),
                None => self.unknown_key(entry, &known, path),
            }
        }
        for key in schema["required"].as_array().into_iter().flatten().filter_map(Json::as_str) {
            if !entries.iter().any(|entry| entry.key == key) {
                self.missing_key(node, key, &properties[key], path);
            }
        }
    }

    fn map(&mut self, entries: &[Entry], inner: &'a Json, path: &str) {
        for entry in entries {
            self.node(&entry.node, inner, &join(path, &entry.key));
        }
    }

    fn list(&mut self, node: &Node, schema: &'a Json, path: &str) {
        let Value::List(items) = &node.value else {
            let table = matches!(node.value, Value::Table(_));
            self.wrong_kind(node, path, "a list");
            if let (true, Some((_, fault))) = (table, self.faults.last_mut()) {
                fault.help = Some(format!("write [[{path}]] with two brackets for one entry of a list"));
            }
            return;
        };
        if let (Some(least), Some(most)) = (schema["minItems"].as_u64(), schema["maxItems"].as_u64()) {
            let count = items.len() as u64;
            if count < least || count > most {
                let message = format!("found a list of {count}; {most} values are wanted");
                self.push(&node.place, Fault::new(path, message));
            }
        }
        for (index, item) in items.iter().enumerate() {
            self.node(item, &schema["items"], &join(path, &index.to_string()));
        }
    }

    fn unknown_key(&mut self, entry: &Entry, known: &[&str], path: &str) {
        let message = match known {
            [] => "unknown key; none is allowed here".to_owned(),
            _ => format!("unknown key; allowed are {}", known.join(", ")),
        };
        let fault = Fault::new(join(path, &cell(&entry.key)), message);
        self.looked += 1;
        let known = if self.looked <= MOST_LOOKED { known } else { &[] };
        let fault = match nearest(&entry.key, known.iter().copied()) {
            Some(word) => fault.with_help(format!("did you mean \"{word}\"?")),
            None => fault,
        };
        self.push(&entry.place, fault);
    }

    fn missing_key(&mut self, node: &Node, key: &str, inner: &'a Json, path: &str) {
        let wanted = self.wanted(inner);
        let meaning = inner["description"].as_str().unwrap_or("").trim_end_matches('.').to_owned();
        let fault = Fault::new(join(path, key), format!("is missing; {wanted} is wanted"));
        let fault = if meaning.is_empty() { fault } else { fault.with_help(format!("meaning: {meaning}")) };
        self.push(&node.place, fault);
    }

    /// "a length, such as \"40 um\"", as it stands in a message.
    pub fn wanted(&self, schema: &'a Json) -> String {
        let schema = resolve(self.definitions, schema);
        if let Some(kind) = schema["x-kind"].as_str() {
            let example = schema["examples"][0].as_str().unwrap_or("");
            return format!("{kind}, such as \"{example}\",");
        }
        let words = super::enums::words(schema);
        if !words.is_empty() {
            return format!("one of {}", words.join(", "));
        }
        match kind_of(schema) {
            "object" => "a table",
            "array" => "a list",
            "string" => "a string",
            "integer" => "a whole number",
            "boolean" => "true or false",
            _ => "a number",
        }
        .to_owned()
    }
}

/// Follows references and drops the `null` of what may be left out.
pub(super) fn resolve<'a>(definitions: &'a Json, schema: &'a Json) -> &'a Json {
    if let Some(name) = schema["$ref"].as_str().and_then(|path| path.strip_prefix("#/$defs/")) {
        return resolve(definitions, &definitions[name]);
    }
    let real = |choice: &&Json| choice["type"] != "null";
    schema["anyOf"]
        .as_array()
        .and_then(|any| any.iter().find(real))
        .map_or(schema, |one| resolve(definitions, one))
}

/// The type of a schema, where it may also be `null`.
pub(super) fn kind_of(schema: &Json) -> &str {
    match &schema["type"] {
        Json::String(kind) => kind,
        Json::Array(kinds) => {
            kinds.iter().filter_map(Json::as_str).find(|kind| *kind != "null").unwrap_or("")
        }
        _ => "",
    }
}

/// A path with one more word.
pub(super) fn join(path: &str, word: &str) -> String {
    if path.is_empty() { word.to_owned() } else { format!("{path}.{word}") }
}
