//! What is said of a word: its page with the keys of what it tells of, its keys, or what it most probably stands for.

use super::keys::{self, File, HEAD, found, is_below, keys_table, row, table};
use super::notes::{NOTES, note};
use super::{Page, all, page};
use crate::scenario::{Key, nearest};

/// A word of which nothing is known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unknown {
    /// The word that it most probably stands for.
    pub nearest: Option<String>,
}

/// All that is known of a word: a law, a method, a plan, a key or the path of one, a word of a choice.
///
/// # Errors
/// [`Unknown`].
pub fn explain(word: &str) -> Result<String, Unknown> {
    let mut parts = Vec::new();
    let own = page(word).map_or_else(Vec::new, |page| {
        parts.push(whole(page));
        keys::keys(page)
    });
    parts.extend(note(word).map(str::to_owned));
    let shown: Vec<&str> = own.iter().map(|key| key.path.as_str()).collect();
    let start = if parts.is_empty() { "In" } else { "Elsewhere in" };
    for file in File::ALL {
        let rows = rows_of(file, word, &shown);
        let name = if file == File::Scenario { "a scenario" } else { "a search or study" };
        parts.extend((!rows.is_empty()).then(|| format!("# {start} {name}\n{}", table(&HEAD, &rows))));
    }
    if parts.is_empty() { Err(Unknown { nearest: nearest_to(word) }) } else { Ok(parts.join("\n\n")) }
}

/// A page with the keys of what it tells of, and without the example in Rust, which is for users of the library.
fn whole(page: &Page) -> String {
    let mut parts = vec![format!("{} ({})", page.name, page.group)];
    for (heading, text) in page.sections() {
        match heading.as_str() {
            "" => parts.push(text),
            "Example" => {}
            _ => parts.push(format!("# {heading}\n{text}")),
        }
    }
    parts.extend(keys_table(page).map(|table| format!("# Keys\n{table}")));
    parts.join("\n\n")
}

/// Rows of the keys that a word leads to, with all that is in those that are tables; not of keys that were shown.
fn rows_of(file: File, word: &str, shown: &[&str]) -> Vec<Vec<String>> {
    let mut rows = Vec::new();
    let mut last: Option<&str> = None;
    for (key, word) in found(file, word) {
        let is_shown = |path: &str| shown.contains(&path);
        // What is in a table that was just shown whole comes with it.
        if last.is_some_and(|last| is_below(&key.path, last)) || is_shown(&key.path) {
            continue;
        }
        if word.is_some() || !key.is_table {
            rows.push(row(key, word));
            continue;
        }
        last = Some(&key.path);
        let inside = file.keys().iter().filter(|inner| is_below(&inner.path, &key.path) && !inner.is_table);
        let (old, new): (Vec<&Key>, Vec<&Key>) = inside.partition(|inner| is_shown(&inner.path));
        if old.is_empty() {
            rows.push(row(key, None));
        }
        rows.extend(new.into_iter().map(|inner| row(inner, None)));
    }
    rows
}

/// The word that an unknown one most probably stands for; of a path the nearest path.
fn nearest_to(word: &str) -> Option<String> {
    if word.contains('.') {
        return nearest(word, all_keys().map(|key| key.path.as_str())).map(str::to_owned);
    }
    let of_pages = all().flat_map(|page| std::iter::once(page.name).chain(page.words.iter().copied()));
    let of_notes = NOTES.iter().flat_map(|(words, _)| words.iter().copied());
    let of_keys = all_keys().flat_map(|key| {
        let last = key.path.rsplit('.').next().unwrap_or("");
        std::iter::once(last).chain(key.words.iter().map(|(word, _)| word.as_str()))
    });
    nearest(word, of_pages.chain(of_notes).chain(of_keys)).map(str::to_owned)
}

fn all_keys() -> impl Iterator<Item = &'static Key> {
    File::ALL.into_iter().flat_map(File::keys)
}
