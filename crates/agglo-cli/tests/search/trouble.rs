//! Candidates that fail, campaigns that come to nothing, folders in use.

use crate::bench::{Bench, SEARCH};
use crate::common::{complained, ended};

/// Grains with these radii; the one in the middle must fit into the volume.
fn radii(list: &str) -> String {
    let radius =
        format!("name = \"radius\"\nkey = \"grains.0.size.constant.radius\"\nrange.choices = [{list}]\n");
    SEARCH.replacen(
        "name = \"v\"\nkey = \"grains.0.velocity_spread.uniform.bounds.0\"\nrange.log = { lower = \"20 m/s\", upper = \"200 m/s\" }\n",
        &radius,
        1,
    )
}

#[test]
fn candidates_that_fail_are_recorded_and_the_search_goes_on() {
    let bench = Bench::with(&radii("\"3 mm\", \"0.5 mm\", \"0.4 mm\""));
    bench.ends("search", &[], 0);
    let failures = bench.summary()["failures"].as_u64().unwrap();
    let rows = bench.rows("failures.csv");
    assert!(failures > 0 && rows.len() as u64 >= failures, "{failures} failures, {rows:?}");
    assert!(rows[0].split(',').count() >= 4, "{}", rows[0]);
    let evaluations = bench.rows("evaluations.csv");
    let failed = evaluations.iter().filter(|row| row.split(',').nth(3) == Some("failed"));
    assert_eq!(failed.count() as u64, failures);
    let best = bench.summary()["best"]["parameters"]["radius_m"].as_f64().unwrap();
    assert!(best < 1e-3, "{best}");
}

#[test]
fn a_search_in_which_all_fail_is_given_up() {
    // Grains without a thermal conductivity have no Biot number.
    let bench = Bench::with(&SEARCH.replace("minimize = \"growth_deficit\"", "minimize = \"biot_number\""));
    let text = complained(&bench.ends("search", &[], 1));
    assert!(text.contains("none of 20 candidates could be evaluated: 20 failed"), "{text}");
    assert!(text.contains("the first one failed so: \"biot_number\" has no value"), "{text}");
    assert_gone!(bench.out().join("summary.json"));
    assert_eq!(bench.rows("failures.csv").len(), 20);
}

#[test]
fn a_folder_in_use_is_refused() {
    let bench = Bench::with(SEARCH);
    std::fs::create_dir(bench.out()).unwrap();
    std::fs::write(bench.out().join("thesis.tex"), "").unwrap();
    let text = complained(&bench.ends("search", &[], 2));
    assert!(text.contains("is not empty") && !text.contains("agglo resume"), "{text}");
    let empty = tempfile::tempdir().unwrap();
    let text = complained(&ended(crate::common::agglo(&["resume", empty.path().to_str().unwrap()]), 2));
    assert!(text.contains("holds no run"), "{text}");
}
