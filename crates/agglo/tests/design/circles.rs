//! Files of the core use one another in one direction: none needs one that needs it.
//!
//! Read off the text, without what only tests use: who writes `crate::a::B`, `super::B` or the name of a module uses the
//! file in which B is defined, wherever it is handed on from.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use super::root;

type Module = Vec<String>;

/// A name that a module has from elsewhere.
struct Import {
    path: Module,
    name: String,
}

struct Source {
    file: String,
    imports: Vec<Import>,
    /// Paths in the code, imports left out.
    paths: Vec<Module>,
    /// Words of the code, likewise.
    words: BTreeSet<String>,
}

/// The files below a folder, by the modules that they are.
type Tree = BTreeMap<Module, Source>;

fn words(path: &str) -> Module {
    path.split("::").map(|word| word.trim().to_owned()).filter(|word| !word.is_empty()).collect()
}

/// Without comments and without what stands from the first tests on.
fn code(text: &str) -> String {
    let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or(text);
    text.lines().map(|line| line.split("//").next().unwrap_or(line)).collect::<Vec<_>>().join("\n")
}

/// What a tree of imports names: `a::{b, c as d}` is `a::b` and `a::c`, known as d.
fn imports(tree: &str, before: &[String], found: &mut Vec<Import>) {
    let (mut depth, mut start) = (0, 0);
    let ends = tree.char_indices().chain([(tree.len(), ',')]);
    for (at, letter) in ends {
        match letter {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                one_import(tree[start..at].trim(), before, found);
                start = at + 1;
            }
            _ => {}
        }
    }
}

fn one_import(tree: &str, before: &[String], found: &mut Vec<Import>) {
    if let Some((beginning, rest)) = tree.split_once('{') {
        let before = [before, &words(beginning)].concat();
        imports(rest.trim_end().trim_end_matches('}'), &before, found);
    } else if !tree.is_empty() {
        let (path, other) = tree.split_once(" as ").unwrap_or((tree, ""));
        let mut path = [before, &words(path)].concat();
        path.retain(|word| word != "self");
        let name = if other.is_empty() { path[path.len() - 1].clone() } else { other.trim().to_owned() };
        found.push(Import { path, name });
    }
}

/// What a file imports, and the paths that it has besides.
fn read(file: &str, text: &str) -> Source {
    let code = code(text);
    let (mut found, mut rest) = (Vec::new(), String::new());
    for statement in code.split_inclusive(';') {
        // Before an import there may be attributes and what came last.
        let start = statement.rfind("use ").filter(|at| {
            let line = statement[..*at].rsplit('\n').next().unwrap_or("").trim();
            line.is_empty() || line == "pub" || (line.starts_with("pub(") && line.ends_with(')'))
        });
        if let Some(at) = start {
            imports(statement[at + 4..].trim_end_matches(';'), &[], &mut found);
            rest.push_str(&statement[..at]);
        } else {
            rest.push_str(statement);
        }
    }
    let paths = || rest.split(|letter: char| !(letter.is_alphanumeric() || "_:".contains(letter)));
    Source {
        file: file.to_owned(),
        imports: found,
        paths: paths().filter(|path| path.contains("::") && !path.starts_with("::")).map(words).collect(),
        words: paths().flat_map(words).collect(),
    }
}

fn tree(files: &BTreeMap<String, String>) -> Tree {
    let module = |file: &str| -> Module {
        let mut words: Module = file.trim_end_matches(".rs").split('/').map(str::to_owned).collect();
        if ["mod", "lib"].contains(&words[words.len() - 1].as_str()) {
            words.pop();
        }
        words
    };
    files.iter().map(|(file, text)| (module(file), read(file, text))).collect()
}

/// Where a path of a module begins, and what is left of it; none where it leads out of the crate.
fn start<'a>(tree: &Tree, module: &Module, path: &'a [String]) -> Option<(Module, &'a [String])> {
    let first = path.first()?.as_str();
    let above = path.iter().take_while(|word| *word == "super").count();
    let child = [module.as_slice(), &path[..1]].concat();
    match first {
        "crate" => Some((Module::new(), &path[1..])),
        "super" => Some((module[..module.len().saturating_sub(above)].to_vec(), &path[above..])),
        "self" => Some((module.clone(), &path[1..])),
        _ if tree.contains_key(&child) => Some((module.clone(), path)),
        _ => None,
    }
}

/// The module that defines what a path leads to, and whether it leads to the whole of it.
fn definition(tree: &Tree, mut module: Module, mut path: &[String], hops: usize) -> (Module, bool) {
    while let Some(first) = path.first() {
        let child = [module.as_slice(), &path[..1]].concat();
        if tree.contains_key(&child) {
            (module, path) = (child, &path[1..]);
            continue;
        }
        let handed_on =
            tree.get(&module).and_then(|source| source.imports.iter().find(|import| import.name == *first));
        let next = handed_on.and_then(|import| start(tree, &module, &import.path));
        return match next {
            Some((next, rest)) if hops > 0 => definition(tree, next, &[rest, &path[1..]].concat(), hops - 1),
            _ => (module, false),
        };
    }
    (module, true)
}

/// The files that each file uses.
fn uses(tree: &Tree) -> BTreeMap<&str, BTreeSet<&str>> {
    let mut uses: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for (module, source) in tree {
        let used = uses.entry(&source.file).or_default();
        let mut note = |found: &Module| used.extend(tree.get(found).map(|other| other.file.as_str()));
        let mut modules: BTreeMap<&str, Module> = BTreeMap::new();
        for import in &source.imports {
            let Some((from, rest)) = start(tree, module, &import.path) else { continue };
            let (found, is_whole) = definition(tree, from, rest, 8);
            // A folder's own file hands on what its files define.
            let hands_on = found.starts_with(module) && !source.words.contains(&import.name);
            if is_whole {
                modules.insert(&import.name, found);
            } else if !hands_on {
                note(&found);
            }
        }
        for path in &source.paths {
            let known = modules.get(path[0].as_str()).map(|found| (found.clone(), &path[1..]));
            if let Some((from, rest)) = known.or_else(|| start(tree, module, path)) {
                note(&definition(tree, from, rest, 8).0);
            }
        }
        used.remove(source.file.as_str());
    }
    uses
}

/// Files that a file needs, with all that they need.
fn needs<'a>(uses: &BTreeMap<&'a str, BTreeSet<&'a str>>, file: &'a str) -> BTreeSet<&'a str> {
    let (mut found, mut open) = (BTreeSet::new(), vec![file]);
    while let Some(file) = open.pop() {
        open.extend(uses[file].iter().filter(|used| found.insert(**used)));
    }
    found
}

/// Uses that lie on a circle, as "file uses file".
fn circles(files: &BTreeMap<String, String>) -> Vec<String> {
    let tree = tree(files);
    let uses = uses(&tree);
    let mut found = Vec::new();
    for (&file, used) in &uses {
        let back = |other: &&&str| needs(&uses, other).contains(file);
        found.extend(used.iter().filter(back).map(|other| format!("{file} uses {other}")));
    }
    found
}

/// Files below a folder that are built without tests, by their paths.
fn sources(folder: &Path, before: &str, found: &mut BTreeMap<String, String>) {
    let entries = folder.read_dir().unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    for entry in entries.flatten() {
        let (path, name) = (entry.path(), entry.file_name().to_string_lossy().into_owned());
        let is_test = name.ends_with("tests.rs") || name.starts_with("test");
        if path.is_dir() {
            sources(&path, &format!("{before}{name}/"), found);
        } else if path.extension().is_some_and(|end| end == "rs") && !is_test {
            let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
            found.insert(format!("{before}{name}"), text);
        }
    }
}

#[test]
fn files_of_the_core_use_one_another_in_one_direction() {
    let mut files = BTreeMap::new();
    sources(&root().join("crates/agglo-core/src"), "", &mut files);
    assert!(files.len() > 150, "files that were found: {}", files.len());
    let found = circles(&files);
    assert!(found.is_empty(), "files that use one another in a circle:\n{found:#?}");
}

#[test]
fn a_circle_is_found_through_names_that_are_handed_on() {
    let mut files: BTreeMap<String, String> = [
        ("lib.rs", "pub mod law;\npub mod pair;\n"),
        ("law/mod.rs", "mod hooke;\npub use hooke::Hooke;\n"),
        ("law/hooke.rs", "use crate::pair::{self, Pair as Two};\npub struct Hooke(Two);\n"),
        ("pair.rs", "//! crate::law::Hooke\npub struct Pair;\n#[cfg(test)]\nmod tests {\n    use crate::law::Hooke;\n}\n"),
    ]
    .map(|(file, text)| (file.to_owned(), text.to_owned()))
    .into();
    assert_eq!(circles(&files), [""; 0], "uses on a circle, where only words and tests point back");
    let both = ["law/hooke.rs uses pair.rs", "pair.rs uses law/hooke.rs"];
    for back in [
        "pub use crate::{\n    law::Hooke,\n};",
        "fn of(law: &crate::law::Hooke) {}",
        "use crate::law;\nfn of(_: &law::Hooke) {}",
    ] {
        files.insert("pair.rs".to_owned(), format!("{back}\npub struct Pair;\n"));
        assert_eq!(circles(&files), both, "uses on a circle with {back:?}");
    }
}
