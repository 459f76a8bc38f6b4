//! The verbs that print: check, explain, schema, new.

use std::fs;
use std::path::Path;

use agglo::pages::all;
use agglo::scenario::TEMPLATES;
use agglo::search::Campaign;

use crate::common::{agglo, complained, ended, said};

#[test]
fn every_shipped_scenario_passes_its_check_with_a_plan() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let mut count = 0;
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        // Searches and studies have tests of their own.
        let is_campaign = || Campaign::is_meant_by(&fs::read_to_string(&path).unwrap());
        if path.extension().is_some_and(|extension| extension == "toml") && !is_campaign() {
            let checked = ended(agglo(&["check", path.to_str().unwrap()]), 0);
            let text = said(&checked);
            for word in [" is valid", "grains", "memory"] {
                assert!(text.contains(word), "no {word} in {text}");
            }
            // From impact to impact there are no steps.
            assert!(text.contains("  steps") || text.contains("  impacts"), "{text}");
            assert!(complained(&checked).is_empty(), "{}", complained(&checked));
            count += 1;
        }
    }
    assert_at_least!(count, 3);
}

#[test]
fn every_law_has_a_page() {
    let list = said(&ended(agglo(&["explain"]), 0));
    for page in all() {
        assert!(list.contains(page.name), "no {} in {list}", page.name);
        for word in page.words.iter().chain([&page.name]) {
            let text = said(&ended(agglo(&["explain", word]), 0));
            assert!(text.starts_with(page.name), "{word}: {text}");
            assert!(text.lines().count() > 4, "{word}: {text}");
        }
    }
}

#[test]
fn the_schema_is_json_that_knows_every_table() {
    let text = said(&ended(agglo(&["schema"]), 0));
    let schema: serde_json::Value = serde_json::from_str(&text).unwrap();
    let properties = schema["properties"].as_object().unwrap();
    for table in ["time", "engine", "materials", "grains", "contact", "fields", "acoustics", "output"] {
        assert!(properties.contains_key(table), "no {table}");
    }
}

#[test]
fn every_template_passes_its_own_check() {
    let folder = tempfile::tempdir().unwrap();
    for template in TEMPLATES {
        let printed = ended(agglo(&["new", template.name]), 0);
        let file = folder.path().join(format!("{}.toml", template.name));
        fs::write(&file, &printed.stdout).unwrap();
        ended(agglo(&["check", file.to_str().unwrap()]), 0);
    }
}
