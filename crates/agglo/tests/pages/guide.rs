//! Tables of the guide that are made from pages and keys: what stands between `<!-- made: ... -->` and `<!-- end -->` is what
//! is made now. `AGGLO_BLESS=1 cargo test -p agglo --test pages` writes it there.

use std::path::{Path, PathBuf};

use agglo::pages::{File, Page, all, markdown, table};
use agglo::scenario::Key;

const START: &str = "<!-- made: ";
const END: &str = "<!-- end -->";

fn path(page: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs").join(page)
}

fn read(page: &str) -> String {
    let path = path(page);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// What the tables of a page are made of: the words of its marks.
fn orders(text: &str) -> Vec<Vec<&str>> {
    let marks = text.lines().filter_map(|line| line.strip_prefix(START)?.strip_suffix(" -->"));
    marks.map(|mark| mark.split_whitespace().collect()).collect()
}

/// The page with all of its tables made anew.
fn made(file: File, text: &str) -> String {
    let orders = orders(text);
    let own: Vec<&str> =
        orders.iter().filter(|order| order[0] == "keys").flat_map(|order| order[1..].to_vec()).collect();
    let mut parts = text.split(START);
    let mut page = parts.next().unwrap_or("").to_owned();
    for (part, order) in parts.zip(&orders) {
        let table = match order[..] {
            ["laws"] => markdown(),
            ["tables"] => tables(file),
            ["keys", first, ..] => keys(file, first, &own),
            ["equations", ..] => equations(&order[1..]),
            ["steps"] => steps(),
            _ => panic!("nothing is known that is made by {order:?}"),
        };
        let (_, rest) = part.split_once(END).unwrap_or_else(|| panic!("{order:?} has no {END}"));
        page.extend([START, &order.join(" "), " -->\n\n", &table, "\n\n", END, rest]);
    }
    page
}

fn is_below(path: &str, table: &str) -> bool {
    path.strip_prefix(table).is_some_and(|rest| rest.starts_with('.'))
}

const HEAD: [&str; 4] = ["key", "unit", "default", "meaning"];

/// All keys below a path, but for those that have a table of their own on the page.
fn keys(file: File, top: &str, own: &[&str]) -> String {
    let elsewhere = |path: &str| own.iter().any(|other| is_below(path, other) && is_below(other, top));
    let keys: Vec<&Key> =
        file.keys().iter().filter(|key| is_below(&key.path, top) && !elsewhere(&key.path)).collect();
    assert!(!keys.is_empty(), "there are no keys below {top}");
    let rows: Vec<Vec<String>> = keys
        .into_iter()
        .map(|key| {
            vec![
                format!("`{}`", &key.path[top.len() + 1..]),
                key.unit.clone(),
                key.default.clone(),
                key.whole_meaning(),
            ]
        })
        .collect();
    table(&HEAD, &rows)
}

/// The tables of a file, and its keys outside of tables.
fn tables(file: File) -> String {
    let rows: Vec<Vec<String>> = file
        .keys()
        .iter()
        .filter(|key| !key.path.contains('.'))
        .map(|key| {
            let has = |inner: &str| {
                file.keys().iter().any(|other| other.path.starts_with(&format!("{}.{inner}.", key.path)))
            };
            let name = match key.path.as_str() {
                path if has("N") => format!("[[{path}]]"),
                path if has("NAME") => format!("[{path}.NAME]"),
                path if key.is_table => format!("[{path}]"),
                path => path.to_owned(),
            };
            vec![format!("`{name}`"), key.default.clone(), key.whole_meaning()]
        })
        .collect();
    table(&["key", "default", "meaning"], &rows)
}

/// Equations with labels of pages, which are named by their names or groups.
fn equations(of: &[&str]) -> String {
    let wanted = |name: &&&str| {
        all().filter(|page| page.name == **name || page.group == **name).collect::<Vec<&Page>>()
    };
    let mut rows = Vec::new();
    for name in of {
        let pages = wanted(&name);
        assert!(!pages.is_empty(), "there is no page and no group {name}");
        for page in pages {
            for (at, (equation, label)) in page.equations().into_iter().enumerate() {
                let word = if at == 0 { format!("`{}`", page.name) } else { String::new() };
                rows.push(vec![word, format!("`{}`", equation.replace('|', "\\|")), label]);
            }
        }
    }
    table(&["word", "equation", "label"], &rows)
}

/// What each law gives for the step that `verlet` works out.
fn steps() -> String {
    let row = |page: &Page| {
        let words = page.section("Critical step")?.replace('\n', " ").replace('|', "\\|");
        Some(vec![format!("`{}`", page.name), words])
    };
    table(&["law", "ω² and Γ"], &all().filter_map(row).collect::<Vec<_>>())
}

/// Holds a page to what is made now, or writes it.
fn hold(file: File, page: &str) {
    let text = read(page);
    let wanted = made(file, &text);
    if std::env::var_os("AGGLO_BLESS").is_some() {
        std::fs::write(path(page), &wanted).unwrap();
    } else if let Some((line, (is, should))) =
        (1..).zip(text.lines().zip(wanted.lines())).find(|(_, (is, should))| is != should)
    {
        panic!(
            "docs/{page}:{line} is not what the pages and keys of the program say:\n  it is     {is}\n  should be {should}\n\
             AGGLO_BLESS=1 cargo test -p agglo --test pages writes it"
        );
    }
}

#[test]
fn the_list_of_laws_is_made_of_the_pages() {
    hold(File::Scenario, "laws.md");
}

#[test]
fn the_tables_of_equations_are_made_of_the_pages() {
    hold(File::Scenario, "theory.md");
}

#[test]
fn the_tables_of_keys_are_made_of_the_types() {
    hold(File::Scenario, "scenario.md");
}

#[test]
fn the_tables_of_keys_of_searches_are_made_of_the_types() {
    hold(File::Campaign, "search.md");
}

#[test]
fn every_key_of_scenarios_is_in_a_table_of_the_guide() {
    let text = read("scenario.md");
    let orders = orders(&text);
    let own: Vec<&str> =
        orders.iter().filter(|order| order[0] == "keys").flat_map(|order| order[1..].to_vec()).collect();
    assert!(orders.iter().any(|order| order[0] == "tables"), "the tables of the file");
    let missing: Vec<&str> = File::Scenario
        .keys()
        .iter()
        .map(|key| key.path.as_str())
        .filter(|path| path.contains('.') && !own.iter().any(|top| is_below(path, top) || path == top))
        .collect();
    assert!(missing.is_empty(), "no table of docs/scenario.md has {missing:?}");
}

#[test]
fn a_page_that_has_been_changed_is_made_anew() {
    let text = "a\n<!-- made: keys bonds.beam -->\n\nold\n\n<!-- end -->\nb\n";
    let made = made(File::Scenario, text);
    assert!(made.starts_with("a\n<!-- made: keys bonds.beam -->\n\n| key"), "{made}");
    assert!(
        made.ends_with("\n\n<!-- end -->\nb\n") && made.contains("| `gap`") && !made.contains("old"),
        "{made}"
    );
}
