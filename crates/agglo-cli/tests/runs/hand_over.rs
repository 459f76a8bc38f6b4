//! The verb `hand-over`: what has grown becomes a scenario of soft spheres that is checked and run, and goes back.

use std::fs;

use crate::common::{agglo, complained, ended, said};

/// A shipped scenario, a part of it after another: few grains, little time.
#[test]
fn what_has_grown_is_handed_over_run_and_handed_back() {
    let folder = tempfile::tempdir().unwrap();
    let [form, formed, soft, dispersed, hard] =
        ["form.toml", "formed", "soft.toml", "dispersed", "hard.toml"]
            .map(|name| folder.path().join(name).display().to_string());
    fs::write(&form, said(&ended(agglo(&["new", "form"]), 0))).unwrap();
    let few = ["--set", "grains.0.placement.fill.count=60", "--no-report", "-o", &formed];
    ended(agglo(&[&["run", &form][..], &few].concat()), 0);
    let short = ["--set", "time.end=10 ns", "--set", "acoustics.beams.0.rays=10", "--with", "disperse"];
    let told = said(&ended(agglo(&[&["hand-over", &formed, "-o", &soft][..], &short].concat()), 0));
    for words in [
        "to               60 grains of soft spheres",
        "mass             1.",
        ", kept",
        "each agglomerate is one piece",
    ] {
        assert_contains!(told, words);
    }
    assert_contains!(said(&ended(agglo(&["check", &soft]), 0)), "grains             60");
    ended(agglo(&["run", &soft, "--no-report", "-o", &dispersed]), 0);
    let back = said(&ended(agglo(&["hand-over", &dispersed, "-o", &hard, "--with", &form]), 0));
    assert_contains!(back, "grains of hard spheres, the rest from");
    ended(agglo(&["check", &hard]), 0);
    let record: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(folder.path().join("soft-hand-over.json")).unwrap())
            .unwrap();
    assert_eq!(record["after"]["grains"], 60);
    let again = complained(&ended(agglo(&["hand-over", &formed, "-o", &soft]), 2));
    assert_contains!(again, "soft.toml is there already; remove it, or choose another name with -o");
    let same = complained(&ended(agglo(&["hand-over", &formed, "-o", "x.toml", "--with", "reacting"]), 2));
    assert_contains!(same, "is a run of hard spheres, and so is reacting");
    let none = complained(&ended(agglo(&["hand-over", "nowhere", "-o", "x.toml"]), 2));
    assert_contains!(none, "nowhere");
}
