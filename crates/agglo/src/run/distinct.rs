//! For tests of tables, summaries and frames: quantities read back by the names of their columns, in messages that name them.

use std::path::Path;

use serde_json::Value as Json;

use super::tables::Tables;
use crate::record::columns;

/// A quantity with its name, in the unit that ends the name.
pub type Named<'a> = (&'a str, f64);

/// Holds a row to what its columns are due, all of them: no column may be left out, and no two may be due the same, else one
/// could stand under the name of another. `part` bounds the round-off of sums of a few terms.
pub fn assert_columns(place: &str, names: &[String], row: &[f64], wanted: &[Named<'_>], part: f64) {
    let due: Vec<&str> = wanted.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, due, "{place} has other columns than are due");
    assert_eq!(row.len(), names.len(), "{place} has another number of values than of columns");
    for (at, (name, one)) in wanted.iter().enumerate() {
        for (other, value) in &wanted[..at] {
            let is_near = (one - value).abs() <= 1e-6 * one.abs().max(value.abs());
            assert!(!is_near, "{place}: {name} and {other} are both due {one}: make the state distinct");
        }
    }
    for (&found, (name, wanted)) in row.iter().zip(wanted) {
        let agrees = (found - wanted).abs() <= part * wanted.abs() || found.is_nan() && wanted.is_nan();
        assert!(
            agrees,
            "{place}: column {name} is due {wanted:e}, found {found:e} (in the unit of its name)"
        );
    }
}

/// Tables in a folder of their own, with the folders that they lie in.
pub fn tables(layout: columns::Tables, folder: &Path) -> Tables {
    std::fs::create_dir(folder.join("series")).unwrap();
    Tables::create(layout.to_vec(), folder).unwrap()
}

/// Names of the columns and the cells of the only row of a table.
pub fn only_row(folder: &Path, table: &str) -> (Vec<String>, Vec<String>) {
    let text = std::fs::read_to_string(folder.join(table)).unwrap();
    let split = |line: &str| line.split(',').map(str::to_owned).collect();
    let lines: Vec<Vec<String>> = text.lines().map(split).collect();
    let [names, row] = &lines[..] else { panic!("{table} has {} lines, not a head and a row", lines.len()) };
    (names.clone(), row.clone())
}

/// Holds the only row of a table of numbers to what its columns are due.
pub fn assert_table(folder: &Path, table: &str, wanted: &[Named<'_>], part: f64) {
    let (names, cells) = only_row(folder, table);
    let row: Vec<f64> = cells.iter().map(|cell| cell.parse().unwrap()).collect();
    assert_columns(table, &names, &row, wanted, part);
}

/// All numbers of a tree with their dotted names.
pub fn leaves(tree: &Json) -> Vec<(String, f64)> {
    let mut found = Vec::new();
    collect(tree, "", &mut found);
    found
}

fn collect(tree: &Json, path: &str, found: &mut Vec<(String, f64)>) {
    let join = |word: &str| if path.is_empty() { word.to_owned() } else { format!("{path}.{word}") };
    match tree {
        Json::Object(entries) => entries.iter().for_each(|(key, inner)| collect(inner, &join(key), found)),
        Json::Array(items) => {
            items.iter().enumerate().for_each(|(at, inner)| collect(inner, &join(&at.to_string()), found));
        }
        Json::Number(number) => found.push((path.to_owned(), number.as_f64().unwrap())),
        Json::String(_) | Json::Bool(_) | Json::Null => {}
    }
}

/// Holds all numbers of a summary, in any order, to what is due; those of `elsewhere` are looked at elsewhere.
pub fn assert_quantities(place: &str, tree: &Json, wanted: &[Named<'_>], elsewhere: &[&str], part: f64) {
    let mut found = leaves(tree);
    found.retain(|(name, _)| !elsewhere.contains(&name.as_str()));
    found.sort_by(|a, b| a.0.cmp(&b.0));
    let mut wanted = wanted.to_vec();
    wanted.sort_by(|a, b| a.0.cmp(b.0));
    let (names, row): (Vec<String>, Vec<f64>) = found.into_iter().unzip();
    assert_columns(place, &names, &row, &wanted, part);
}
