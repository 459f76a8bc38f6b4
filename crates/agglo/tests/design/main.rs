//! The design's folder table and the tree say the same; crates, and files of the core, depend on each other in one direction.

mod circles;
mod errors;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use toml::{Table, Value};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Folders inside of another, relative to the project's root, with a slash at the end.
fn folders(root: &Path, within: &Path, found: &mut BTreeSet<String>) {
    for name in names(&root.join(within)) {
        let folder = within.join(name);
        found.insert(format!("{}/", folder.display()));
        folders(root, &folder, found);
    }
}

/// Names of the folders in a folder.
fn names(folder: &Path) -> Vec<String> {
    let entries = folder.read_dir().unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let folders = entries.flatten().filter(|entry| entry.path().is_dir());
    folders.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect()
}

#[test]
fn the_folder_table_is_the_tree() {
    let root = root();
    let design = std::fs::read_to_string(root.join("DESIGN.md")).unwrap();
    let rows = design.lines().filter_map(|line| line.strip_prefix("| `")?.split_once('`'));
    let told: BTreeSet<String> =
        rows.map(|(name, _)| name.to_owned()).filter(|name| name.ends_with('/')).collect();
    let mut there = BTreeSet::new();
    let crates = names(&root.join("crates"));
    assert!(crates.len() >= 5, "crates that were found: {crates:?}");
    for name in crates {
        there.insert(format!("crates/{name}/"));
        folders(&root, &Path::new("crates").join(name).join("src"), &mut there);
    }
    let untold: Vec<&String> = there.difference(&told).collect();
    assert!(untold.is_empty(), "folders that DESIGN.md does not tell of: {untold:?}");
    let gone: Vec<&String> = told.iter().filter(|name| !root.join(name).is_dir()).collect();
    assert!(gone.is_empty(), "folders that DESIGN.md tells of but are not there: {gone:?}");
}

fn read_toml(path: &str) -> Table {
    let text = std::fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"));
    text.parse().unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// What a crate of the project is built with, on any system; what only its tests take is left out.
fn dependencies(name: &str) -> BTreeSet<String> {
    let manifest = read_toml(&format!("crates/{name}/Cargo.toml"));
    let targets = manifest.get("target").and_then(Value::as_table).into_iter().flatten();
    let tables = targets.filter_map(|(_, target)| target.as_table()).chain([&manifest]);
    let of_kind = |table: &Table, kind: &str| {
        table
            .get(kind)
            .and_then(Value::as_table)
            .into_iter()
            .flatten()
            .map(|(name, _)| name.clone())
            .collect()
    };
    let lists: Vec<Vec<String>> = tables
        .flat_map(|table| ["dependencies", "build-dependencies"].map(|kind| of_kind(table, kind)))
        .collect();
    lists.into_iter().flatten().collect()
}

/// The package for Python names the program, the program names what shows and the library, these name the library and the core; the core and the assertions name none.
#[test]
fn crates_depend_on_each_other_in_one_direction() {
    let allowed: [(&str, &[&str]); 6] = [
        ("agglo-testing", &[]),
        ("agglo-core", &[]),
        ("agglo", &["agglo-core"]),
        ("agglo-view", &["agglo"]),
        ("agglo-cli", &["agglo", "agglo-view"]),
        ("agglo-py", &["agglo", "agglo-cli", "agglo-view"]),
    ];
    let own: BTreeSet<String> = names(&root().join("crates")).into_iter().collect();
    assert_eq!(own, allowed.iter().map(|(name, _)| (*name).to_owned()).collect(), "crates with a direction");
    for (name, allowed) in allowed {
        let found: Vec<String> = dependencies(name).intersection(&own).cloned().collect();
        assert_eq!(found, allowed, "crates of the project that {name} is built with");
    }
}

/// Beginnings of the names of crates that read files, speak to terminals or draw.
const OF_NO_USE_FOR_PHYSICS: [&str; 20] = [
    "annotate-snippets",
    "anstream",
    "anstyle",
    "clap",
    "console",
    "crossterm",
    "csv",
    "ctrlc",
    "dejavu",
    "indicatif",
    "plotly",
    "png",
    "ratatui",
    "rustix",
    "signal-hook",
    "tempfile",
    "termcolor",
    "terminal",
    "toml",
    "walkdir",
];

/// With all that it pulls in.
#[test]
fn the_core_is_built_with_nothing_that_reads_files_or_knows_a_terminal() {
    let lock = read_toml("Cargo.lock");
    let packages: Vec<&Table> =
        lock["package"].as_array().unwrap().iter().filter_map(Value::as_table).collect();
    let mut open: Vec<String> = dependencies("agglo-core").into_iter().collect();
    let mut found = BTreeSet::new();
    while let Some(name) = open.pop() {
        let versions = packages.iter().filter(|package| package["name"].as_str() == Some(&name));
        let needed = versions.filter_map(|package| package.get("dependencies")?.as_array()).flatten();
        // Where there are several versions of one, its version stands behind the name.
        let names = needed.filter_map(|need| need.as_str()?.split(' ').next()).map(str::to_owned);
        let names: Vec<String> = names.filter(|name| !found.contains(name)).collect();
        if found.insert(name) {
            open.extend(names);
        }
    }
    assert!(found.len() > 10 && found.contains("rayon-core"), "what the core is built with: {found:?}");
    let wrong: Vec<&String> = found
        .iter()
        .filter(|name| OF_NO_USE_FOR_PHYSICS.iter().any(|beginning| name.starts_with(beginning)))
        .collect();
    assert!(wrong.is_empty(), "crates of no use for physics that agglo-core is built with: {wrong:?}");
}

/// One table with one meaning a symbol; what a law's page takes from its source under another letter stands in a table of its own.
#[test]
fn a_symbol_has_one_meaning() {
    let text = std::fs::read_to_string(root().join("NOTATION.md")).unwrap();
    assert_eq!(text.matches("| symbol |").count(), 1, "tables of symbols in NOTATION.md");
    let (table, _) = text.split_once("## Letters").expect("a table of letters of sources");
    let rows = table.lines().filter_map(|line| line.strip_prefix("| ")?.split_once(" |"));
    let symbols: Vec<&str> = rows.flat_map(|(cell, _)| cell.split(", ")).collect();
    assert!(symbols.len() > 150, "symbols that were found: {symbols:?}");
    let mut seen = BTreeSet::new();
    let twice: Vec<&str> = symbols.into_iter().filter(|symbol| !seen.insert(*symbol)).collect();
    assert_eq!(twice, Vec::<&str>::new(), "symbols of NOTATION.md that stand there twice");
}

/// Where a line of code, and not of a comment, writes out the name of a file of a run, search or study.
fn written_out(text: &str) -> Option<(usize, &str)> {
    const NAMES: [&str; 9] = [
        ".csv",
        ".vtp",
        ".pvd",
        ".agglo\"",
        "scenario.toml",
        "search.toml",
        "summary.json",
        "report.html",
        "replicates.journal",
    ];
    let code = text.lines().take_while(|line| !line.starts_with("mod tests {")).enumerate();
    let mut code = code.filter(|(_, line)| !line.trim_start().starts_with("//"));
    code.find(|(_, line)| NAMES.iter().any(|name| line.contains(name)))
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in folder.read_dir().expect("a folder of sources").flatten() {
        let path = entry.path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|end| end == "rs") {
            found.push(path);
        }
    }
}

/// What a folder holds is named in one place, so that readers and writers cannot part.
#[test]
fn names_of_files_have_one_home() {
    let root = root();
    let mut files = Vec::new();
    for name in names(&root.join("crates")).iter().filter(|name| *name != "agglo-testing") {
        sources(&root.join("crates").join(name).join("src"), &mut files);
    }
    assert!(files.len() > 300, "files that were found: {}", files.len());
    let is_of_tests = |path: &Path| {
        let name = path.file_name().unwrap().to_string_lossy();
        name.ends_with("tests.rs") || ["distinct.rs", "testing.rs"].contains(&&*name)
    };
    for path in files.iter().filter(|path| !is_of_tests(path) && !path.ends_with("folder/names.rs")) {
        let text = std::fs::read_to_string(path).unwrap();
        if let Some((line, found)) = written_out(&text) {
            panic!("{}:{}: take the name from folder/names.rs: {}", path.display(), line + 1, found.trim());
        }
    }
    assert!(written_out("let path = dir.join(\"events.csv\");").is_some(), "such a line is found");
    assert!(
        written_out("/// `events.csv`\n#[cfg(test)]\nmod tests {\n\"a.csv\"").is_none(),
        "such lines are not"
    );
}
