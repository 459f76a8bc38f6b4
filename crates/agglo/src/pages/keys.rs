//! The keys of what a page tells of, and keys by their words.

use std::sync::LazyLock;

use toml::{Table, Value};

use super::{Fragment, Page};
use crate::scenario::{Key, keys_of, schema};
use crate::search::campaign_schema;

static SCENARIO: LazyLock<Vec<Key>> = LazyLock::new(|| keys_of(&schema()));
static CAMPAIGN: LazyLock<Vec<Key>> = LazyLock::new(|| keys_of(&campaign_schema()));

/// A kind of file that has keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum File {
    /// A scenario.
    Scenario,
    /// A search or study.
    Campaign,
}

impl File {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Scenario, Self::Campaign];

    /// All of its keys.
    pub fn keys(self) -> &'static [Key] {
        match self {
            Self::Scenario => &SCENARIO,
            Self::Campaign => &CAMPAIGN,
        }
    }
}

/// The keys of what a page tells of: all that are in a table of its name or of one of its words, and what else its fragment
/// shows.
pub fn keys(page: &Page) -> Vec<&'static Key> {
    let Some(fragment) = page.fragment() else { return Vec::new() };
    let known = match fragment {
        Fragment::Scenario(_) => File::Scenario,
        Fragment::Campaign(_) => File::Campaign,
    };
    let tree: Table = fragment.text().parse().unwrap_or_default();
    let mut shown = Vec::new();
    collect(&Value::Table(tree.clone()), "", &mut shown);
    let is_own = |path: &str| {
        let mut words = path.split('.');
        let top = words.next().unwrap_or("");
        // What a material is like belongs to all laws that ask for it.
        top != "materials"
            && tree.contains_key(top)
            && std::iter::once(top).chain(words).any(|word| page.has(word))
    };
    let known = known.keys();
    let is_empty = |path: &str| !known.iter().any(|key| is_below(&key.path, path));
    let mut keys: Vec<&Key> = known
        .iter()
        .filter(|key| !key.is_table || !key.words.is_empty() || is_empty(&key.path))
        .filter(|key| is_own(&key.path) || shown.contains(&key.path))
        .collect();
    keys.sort_by_key(|key| !is_own(&key.path));
    keys
}

/// The table of the keys of what a page tells of; none if it has none.
pub(super) fn keys_table(page: &Page) -> Option<String> {
    let rows: Vec<Vec<String>> = keys(page).into_iter().map(|key| row(key, None)).collect();
    (!rows.is_empty()).then(|| table(&HEAD, &rows))
}

/// Whether a path is inside of a table.
pub(super) fn is_below(path: &str, table: &str) -> bool {
    path.strip_prefix(table).is_some_and(|rest| rest.starts_with('.'))
}

/// Paths of all that a tree has, as [`Key::path`] has them.
fn collect(value: &Value, path: &str, paths: &mut Vec<String>) {
    let mut inner = |word: &str, value: &Value| {
        let path = if path.is_empty() { word.to_owned() } else { format!("{path}.{word}") };
        paths.push(path.clone());
        collect(value, &path, paths);
    };
    match value {
        Value::Table(table) => {
            for (word, value) in table {
                inner(if path == "materials" { "NAME" } else { word }, value);
            }
        }
        Value::Array(items) => items.iter().for_each(|item| inner("N", item)),
        _ => {}
    }
}

/// What a path of keys, or the end of one, leads to: a key, and the word of a choice that is meant.
pub(super) fn found(file: File, path: &str) -> Vec<(&'static Key, Option<&'static (String, String)>)> {
    let path = path.to_lowercase().replace('-', "_");
    let words: Vec<&str> = path.split('.').filter(|word| word.parse::<usize>().is_err()).collect();
    let Some((last, before)) = words.split_last() else { return Vec::new() };
    let mut found = Vec::new();
    for key in file.keys() {
        if leads_to(&words, &key.path) {
            found.push((key, None));
        } else if before.is_empty() || leads_to(before, &key.path) {
            found.extend(key.words.iter().find(|(word, _)| word == last).map(|word| (key, Some(word))));
        }
    }
    found
}

/// Whether words are the end of a path; names of one's own may be given or left out.
fn leads_to(words: &[&str], path: &str) -> bool {
    let mut left = words;
    for part in path.split('.').filter(|part| *part != "N").rev() {
        let Some((last, before)) = left.split_last() else { return true };
        if part == *last {
            left = before;
        } else if part != "NAME" || left.len() == words.len() {
            return false;
        } else if before.last() == Some(&"materials") {
            left = before;
        }
    }
    left.is_empty()
}

/// Columns of a table that are wider than this are not aligned.
const WIDEST: usize = 66;

/// A table in Markdown whose columns are aligned, but for wide ones and the last.
pub fn table(head: &[&str], rows: &[Vec<String>]) -> String {
    let width = |column: usize| {
        let cells = rows.iter().map(|row| row[column].chars().count());
        cells.chain([head[column].chars().count()]).max().unwrap_or(0)
    };
    let is_aligned = |column: usize| column + 1 < head.len() && width(column) <= WIDEST;
    let widths: Vec<usize> = (0..head.len()).map(|at| if is_aligned(at) { width(at) } else { 0 }).collect();
    let line = |cells: Vec<&str>| {
        let padded = cells.iter().zip(&widths).map(|(cell, width)| format!(" {cell:<width$} |"));
        format!("|{}", padded.collect::<String>())
    };
    let rules: Vec<String> = widths.iter().map(|width| "-".repeat(width.max(&1) + 2)).collect();
    let rows = rows.iter().map(|row| line(row.iter().map(String::as_str).collect()));
    [line(head.to_vec()), format!("|{}|", rules.join("|"))]
        .into_iter()
        .chain(rows)
        .collect::<Vec<_>>()
        .join("\n")
}

/// The cells of keys in a table: path, unit, default, meaning.
pub(super) const HEAD: [&str; 4] = ["key", "unit", "default", "meaning"];

/// The row of a key, or of one of its words.
pub(super) fn row(key: &Key, word: Option<&(String, String)>) -> Vec<String> {
    let (path, meaning) = match word {
        None => (format!("`{}`", key.path), key.whole_meaning()),
        Some((word, meaning)) => {
            (format!("`{} = \"{word}\"`", key.path), meaning.trim_end_matches('.').to_owned())
        }
    };
    vec![path, key.unit.clone(), key.default.clone(), meaning]
}
