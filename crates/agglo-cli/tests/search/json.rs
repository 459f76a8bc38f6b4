//! What programs are told of searches and studies.

use serde_json::{Value as Json, json};

use crate::bench::{Bench, SEARCH, assert_same, reference};
use crate::common::{agglo, assert_documented, complained, ended, objects};

#[test]
fn a_search_tells_what_it_does_and_ends_with_its_summary() {
    let bench = Bench::with(SEARCH);
    let stopped = bench.ends("search", &["--json", "--wall-time", "1 us"], 3);
    assert_empty!(complained(&stopped));
    let told = objects(&stopped);
    assert_documented(told.last().unwrap(), "`stopped`");
    assert_eq!((&told[0]["verb"], &told.last().unwrap()["time_s"]), (&json!("search"), &Json::Null));
    let done = ended(bench.resume().arg("--json").output().unwrap(), 0);
    assert_empty!(complained(&done));
    let told = objects(&done);
    let [started, progress, .., finished] = told.as_slice() else { panic!("{told:?}") };
    assert_documented(started, "`started`");
    assert_documented(progress, "`progress` of a search or study");
    assert_documented(finished, "`finished`");
    assert_eq!((&started["verb"], &progress["stage"]), (&json!("resume"), &json!("search")));
    assert_eq!(progress["evaluations_at_most"], json!(66));
    assert_eq!((&finished["summary"], &finished["exit_code"]), (&bench.summary(), &json!(0)));
    assert_eq!(finished["best_run"], json!(bench.out().join("best").display().to_string()));
    assert_same(&bench.out(), &reference().out());
}

#[test]
fn check_gives_the_plan_of_a_search_in_numbers() {
    let bench = Bench::with(SEARCH);
    let told = objects(&ended(agglo(&["check", &bench.file("campaign.toml"), "--json"]), 0));
    let [plan] = told.as_slice() else { panic!("{told:?}") };
    assert_documented(plan, "`plan`");
    assert_documented(&plan["run"], "`plan.run`");
    let campaign = &plan["campaign"];
    assert_documented(campaign, "`plan.campaign`");
    assert_eq!((&plan["kind"], &campaign["word"]), (&json!("search"), &json!("published_genetic")));
    let speed = json!({
        "name": "v", "column": "v_m_s", "key": "grains.0.velocity_spread.uniform.bounds.0", "scale": "log",
        "bounds": [20.0, 200.0], "choices": null,
    });
    assert_eq!(campaign["parameters"][0], speed);
    assert_eq!(campaign["replicates"], json!({ "least": 2, "most": 8, "are_common": true }));
    assert_eq!(campaign["runs"], json!({ "least": 140.0, "most": 512.0 }));
    assert_eq!(campaign["candidates"][0], json!({ "stage": "search", "at_most": 62 }));
    assert_eq!(campaign["objectives"], json!([{ "formula": "growth_deficit", "is_to_be_large": false }]));
}

/// Also those that show only when the file meets its base.
#[test]
fn faults_of_a_search_are_told_one_by_one() {
    let bench = Bench::with(&SEARCH.replace("hardness\"\nrange", "hardnes\"\nrange"));
    for verb in ["check", "search"] {
        let output = ended(agglo(&[verb, &bench.file("campaign.toml"), "--json"]), 2);
        assert_empty!(complained(&output));
        let told = objects(&output);
        let [refused] = told.as_slice() else { panic!("{told:?}") };
        assert_eq!(
            (&refused["type"], &refused["file"]),
            (&json!("refused"), &json!(bench.file("campaign.toml")))
        );
        let fault = &refused["faults"][0];
        assert_documented(fault, "`refused.faults`");
        assert_eq!(fault["key"], json!("parameters.1.key"));
        assert_contains!(fault["message"].as_str().unwrap(), "materials.grain.hardnes");
    }
}
