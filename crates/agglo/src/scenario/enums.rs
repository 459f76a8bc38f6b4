//! Holds a choice to its schema: one word, or a table with one word as its key.

use serde_json::Value as Json;

use super::fault::{Fault, nearest};
use super::tree::{Entry, Node, Value};
use super::walk::{Walk, join};

/// The words of a choice, in the order of the schema.
pub(super) fn words(schema: &Json) -> Vec<&str> {
    let plain = schema["enum"].as_array().into_iter().flatten().filter_map(Json::as_str);
    plain.chain(schema["oneOf"].as_array().into_iter().flatten().flat_map(words_of)).collect()
}

fn words_of(choice: &Json) -> Vec<&str> {
    if let Some(word) = choice["const"].as_str() {
        return vec![word];
    }
    match choice["properties"].as_object() {
        Some(properties) => properties.keys().map(String::as_str).collect(),
        None => words(choice),
    }
}

/// The schema of the table that follows the word; nothing for a word that stands alone.
fn table_of<'a>(schema: &'a Json, word: &str) -> Option<&'a Json> {
    schema["oneOf"].as_array()?.iter().find_map(|choice| choice["properties"].get(word))
}

/// Holds one value to a choice.
pub(super) fn walk_enum<'a>(walk: &mut Walk<'a>, node: &Node, schema: &'a Json, path: &str) {
    match &node.value {
        Value::Text(word) => word_alone(walk, node, word, schema, path),
        Value::Table(entries) => table(walk, node, entries, schema, path),
        _ => {
            let wanted = format!("one of {}", words(schema).join(", "));
            walk.wrong_kind(node, path, &wanted);
        }
    }
}

fn word_alone(walk: &mut Walk<'_>, node: &Node, word: &str, schema: &Json, path: &str) {
    let known = words(schema);
    if !known.contains(&word) {
        let fault = Fault::new(path, unknown(word, &known));
        return walk.push(&node.place, advised(fault, word, &known));
    }
    if table_of(schema, word).is_some() {
        let fault = Fault::new(path, format!("\"{word}\" has parameters and is written as a table"));
        walk.push(&node.place, fault.with_help(table_help(path, word)));
    }
}

/// How a table is written: below an entry of a list a header would need the list's brackets.
fn table_help(path: &str, word: &str) -> String {
    let last = path.rsplit('.').next().unwrap_or(path);
    if path.split('.').any(|part| part.parse::<usize>().is_ok()) {
        format!("write {last}.{word} = {{ ... }}")
    } else {
        format!("write [{path}.{word}] and its parameters below")
    }
}

fn table<'a>(walk: &mut Walk<'a>, node: &Node, entries: &[Entry], schema: &'a Json, path: &str) {
    let known = words(schema);
    for entry in entries {
        let inner_path = join(path, &entry.key);
        if !known.contains(&entry.key.as_str()) {
            let fault = Fault::new(path, unknown(&entry.key, &known));
            walk.push(&entry.place, advised(fault, &entry.key, &known));
        } else if let Some(inner) = table_of(schema, &entry.key) {
            walk.node(&entry.node, inner, &inner_path);
        } else {
            let fault = Fault::new(path, format!("\"{}\" has no parameters", entry.key));
            let last = path.rsplit('.').next().unwrap_or(path);
            walk.push(&entry.place, fault.with_help(format!("write {last} = \"{}\"", entry.key)));
        }
    }
    let chosen: Vec<&Entry> = entries.iter().filter(|entry| known.contains(&entry.key.as_str())).collect();
    match chosen.as_slice() {
        [] if entries.is_empty() => {
            let fault = Fault::new(path, format!("is empty; one of {} is wanted", known.join(", ")));
            walk.push(&node.place, fault);
        }
        [_, second, ..] => {
            let names: Vec<&str> = chosen.iter().map(|entry| entry.key.as_str()).collect();
            let message = format!(
                "found {} together; only one of {} is allowed",
                names.join(" and "),
                known.join(", ")
            );
            let later = chosen.iter().max_by_key(|entry| (entry.place.source, entry.place.span.start));
            let place = later.unwrap_or(second).place.clone();
            walk.push(&place, Fault::new(path, message).with_help("remove all but one"));
        }
        _ => {}
    }
}

fn unknown(word: &str, known: &[&str]) -> String {
    format!("unknown word \"{word}\"; allowed are {}", known.join(", "))
}

fn advised(fault: Fault, word: &str, known: &[&str]) -> Fault {
    match nearest(word, known.iter().copied()) {
        Some(near) => fault.with_help(format!("did you mean \"{near}\"?")),
        None => fault,
    }
}
