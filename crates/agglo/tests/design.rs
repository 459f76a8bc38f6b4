//! The design's folder table and the tree say the same.

use std::collections::BTreeSet;
use std::path::Path;

/// Folders that hold code, relative to the project's root, with a slash at the end.
fn folders(root: &Path, below: &Path, found: &mut BTreeSet<String>) {
    for entry in std::fs::read_dir(root.join(below)).expect("the sources are there").flatten() {
        if entry.path().is_dir() {
            let name = below.join(entry.file_name());
            found.insert(format!("{}/", name.display()));
            folders(root, &name, found);
        }
    }
}

#[test]
fn the_folder_table_is_the_tree() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let design = std::fs::read_to_string(root.join("DESIGN.md")).unwrap();
    let rows = design.lines().filter_map(|line| line.strip_prefix("| `")?.split_once('`'));
    let told: BTreeSet<String> =
        rows.map(|(name, _)| name.to_owned()).filter(|name| name.ends_with('/')).collect();
    let mut there = BTreeSet::new();
    folders(&root, Path::new("crates/agglo/src"), &mut there);
    let told_of_library: BTreeSet<String> =
        told.iter().filter(|name| name.starts_with("crates/agglo/src/")).cloned().collect();
    let untold: Vec<&String> = there.difference(&told_of_library).collect();
    assert!(untold.is_empty(), "folders that DESIGN.md does not tell of: {untold:?}");
    let gone: Vec<&String> = told.iter().filter(|name| !root.join(name).is_dir()).collect();
    assert!(gone.is_empty(), "folders that DESIGN.md tells of but are not there: {gone:?}");
}
