//! The guide's tables of columns are what the columns themselves say. `AGGLO_BLESS=1 cargo test -p agglo --lib page_tests`
//! writes them anew.

use std::path::Path;

use super::{tables, tables_at_the_end};
use crate::record::{About, Declared};
use crate::search::{analysis::Axis, campaign};

/// A part of a page, between two comments that say what it is.
struct Block {
    about: String,
    text: String,
}

/// Holds a page to its blocks, or puts them there.
fn assert_page(name: &str, blocks: &[Block]) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs").join(name);
    let found = std::fs::read_to_string(&path).unwrap();
    let mut due = found.clone();
    for Block { about, text } in blocks {
        let (first, last) = (format!("<!-- {about} -->\n"), "<!-- end -->\n");
        assert_eq!(due.matches(&first).count(), 1, "{name} has to have one line {first}");
        let begin = due.find(&first).unwrap() + first.len();
        let end =
            begin + due[begin..].find(last).unwrap_or_else(|| panic!("{name}: no {last} after {first}"));
        due.replace_range(begin..end, text);
    }
    if std::env::var_os("AGGLO_BLESS").is_some() {
        std::fs::write(&path, due).unwrap();
    } else {
        assert!(found == due, "docs/{name} has other columns than tables have: AGGLO_BLESS=1 writes it anew");
    }
}

fn kind(is_hard: bool) -> &'static str {
    if is_hard { "hard" } else { "soft" }
}

/// What is told of the columns of a table; `gap` is what stands for what cannot be had.
fn columns(table: &dyn Declared, of: &str, gap: &str) -> Block {
    let row = |column: &About| {
        let words = [column.label, column.meaning].into_iter().filter(|text| !text.is_empty());
        let words = words.collect::<Vec<_>>().join("; ");
        let gaps = if column.may_be_empty { format!(" (may be {gap})") } else { String::new() };
        format!("| `{}` | {} | {words}{gaps} |\n", column.name, column.unit)
    };
    let rows: String = table.columns().into_iter().map(row).collect();
    Block {
        about: format!("columns of {}{of}", table.file()),
        text: format!("| column | unit | meaning |\n|---|---|---|\n{rows}"),
    }
}

#[test]
fn the_page_of_files_has_every_column() {
    let of = |is_hard: bool| {
        let all = tables(is_hard).iter().chain(tables_at_the_end(is_hard));
        all.map(move |table| columns(*table, &format!(", {} spheres", kind(is_hard)), "`NaN`"))
    };
    assert_page("files.md", &[false, true].into_iter().flat_map(of).collect::<Vec<_>>());
}

#[test]
fn the_page_of_searches_has_every_column_that_all_campaigns_have() {
    let blocks: Vec<Block> =
        campaign::TABLES.iter().chain(campaign::RATES).map(|table| columns(*table, "", "empty")).collect();
    assert_page("search.md", &blocks);
}

#[test]
fn the_page_of_the_dashboard_has_every_quantity() {
    let of = |is_hard: bool| {
        let all = tables(is_hard).iter().flat_map(|table| {
            let told = table.columns().into_iter().filter_map(|column| Some((column.glance?.place, column)));
            told.map(move |(place, column)| (place, table.file(), column))
        });
        let mut told: Vec<_> = all.collect();
        told.sort_by_key(|(place, ..)| *place);
        let places: Vec<u8> = told.iter().map(|(place, ..)| *place).collect();
        assert_eq!(places, (1..=told.len() as u8).collect::<Vec<_>>(), "places of what is told of");
        let row = |(_, file, column): &(u8, &str, &About)| {
            let file = file.trim_start_matches("series/");
            format!("| {} | `{file}` `{}` |\n", column.label, column.name)
        };
        Block {
            about: format!("quantities of {} spheres", kind(is_hard)),
            text: format!(
                "| {} spheres | column |\n|---|---|\n{}",
                kind(is_hard),
                told.iter().map(row).collect::<String>()
            ),
        }
    };
    assert_page("watch.md", &[false, true].map(of));
}

/// Names end with their units, and what is said of a column is said in words.
#[test]
fn columns_are_named_by_their_units_and_have_labels() {
    let of_runs = [false, true].map(|is_hard| tables(is_hard).iter().chain(tables_at_the_end(is_hard)));
    for table in of_runs.into_iter().flatten().chain(campaign::TABLES).chain(campaign::RATES) {
        let names = table.names();
        for (at, column) in table.columns().into_iter().enumerate() {
            let place = format!("{}: {}", table.file(), column.name);
            let due = Axis::new(column.name, column.unit).column();
            assert_eq!(due, column.name, "{place} does not end with its unit {}", column.unit);
            assert!(!column.label.is_empty() && !column.label.contains('|'), "{place} has no label");
            assert!(!column.meaning.contains('|'), "{place}: {}", column.meaning);
            assert_has_not!(names[..at], &column.name, "{place} is there twice");
            let has_other_unit = column.panel.is_some_and(|panel| panel.unit != column.unit);
            assert!(!has_other_unit, "{place} has another unit than its chart");
        }
    }
}
