//! All that the library and its core call an error becomes `agglo::Error`.

use std::fs;

use agglo::engine::SimError;
use agglo::engine::hard::EmbeddedError;
use agglo::folder::FolderError;
use agglo::hand_over::HandOverError;
use agglo::packing::{PackingError, StartError, TableError};
use agglo::record::RecordError;
use agglo::run::RunError;
use agglo::scenario::{Faults, LoadError};
use agglo::search::campaign::CampaignError;
use agglo::units::UnitError;

fn becomes<E: Into<agglo::Error>>() -> &'static str {
    std::any::type_name::<E>().rsplit("::").next().expect("a name")
}

#[test]
fn every_error_becomes_one() {
    let known = [
        becomes::<Faults>(),
        becomes::<LoadError>(),
        becomes::<UnitError>(),
        becomes::<TableError>(),
        becomes::<PackingError>(),
        becomes::<StartError>(),
        becomes::<SimError>(),
        becomes::<EmbeddedError>(),
        becomes::<RecordError>(),
        becomes::<FolderError>(),
        becomes::<RunError>(),
        becomes::<HandOverError>(),
        becomes::<CampaignError>(),
    ];
    let mut files = Vec::new();
    for folder in ["src", "../agglo-core/src"] {
        super::sources(&super::root().join("crates/agglo").join(folder), &mut files);
    }
    let mut found = 0;
    for file in files {
        let text = fs::read_to_string(&file).expect("a source");
        let names = text.lines().filter_map(|line| line.strip_prefix("pub enum ")?.split_whitespace().next());
        for name in names.filter(|name| name.ends_with("Error") && *name != "Error") {
            assert!(known.contains(&name), "{name} of {} does not become agglo::Error", file.display());
            found += 1;
        }
    }
    assert!(found >= known.len() - 1, "{found} errors");
}
