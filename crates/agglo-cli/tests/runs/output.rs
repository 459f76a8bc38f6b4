//! Results do not depend on what is written, nor on the number of threads.

use std::fs;
use std::path::Path;

use crate::common::{
    Bench, EVENTS, SCENARIOS, STAGGERED, STEPS, VERLET, assert_same, ended, reference, state,
};

fn last_row(run: &Path, table: &str) -> String {
    fs::read_to_string(run.join("series").join(table)).unwrap().lines().last().unwrap().to_owned()
}

/// Settings of the output, often and as good as never.
fn choices(often: [&str; 3]) -> [Vec<String>; 2] {
    let never = ["1 h"; 3];
    [often, never].map(|[series, frames, checkpoints]| {
        let settings = [("series", series), ("frames", frames), ("checkpoints", checkpoints)];
        let set = |(key, every): (&str, &str)| ["--set".to_owned(), format!("output.{key}=\"{every}\"")];
        settings.into_iter().flat_map(set).collect()
    })
}

/// Runs with output of its own and compares what must not depend on it with the reference.
fn assert_output_changes_nothing(scenario: &'static str, settings: &[String], tables: &[&str]) {
    let bench = Bench::with(scenario);
    let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
    ended(bench.start(&settings).output().unwrap(), 0);
    assert!(state(&bench.run()) == state(reference(scenario)), "another state with {settings:?}");
    for table in tables {
        let table = format!("{table}.csv");
        assert_eq!(last_row(&bench.run(), &table), last_row(reference(scenario), &table));
    }
    let events = |run: &Path| fs::read(run.join("events.csv")).unwrap();
    assert!(events(&bench.run()) == events(reference(scenario)), "other events with {settings:?}");
}

#[test]
fn what_is_written_never_changes_soft_spheres() {
    const TABLES: [&str; 6] = ["energy", "momentum", "clusters", "moments", "rays", "steps"];
    for scenario in [STAGGERED, VERLET] {
        let [often, mut never] = choices(["10 us", "0.5 ms", "0.4 ms"]);
        never.extend(
            ["bonds", "rays"]
                .into_iter()
                .flat_map(|what| ["--set".to_owned(), format!("output.{what}=false")]),
        );
        for settings in [often, never] {
            assert_output_changes_nothing(scenario, &settings, &TABLES);
        }
    }
}

/// Rows, frames and checkpoints of hard spheres from impact to impact are at their exact times, and yet change nothing.
#[test]
fn what_is_written_never_changes_hard_spheres() {
    const TABLES: [&str; 5] = ["grains", "energy", "momentum", "steps", "sizes"];
    for scenario in [EVENTS, STEPS] {
        for settings in choices(["1.7 us", "30 us", "70 us"]) {
            assert_output_changes_nothing(scenario, &settings, &TABLES);
        }
    }
}

#[test]
fn any_number_of_threads_writes_the_same_files() {
    for (_, scenario) in SCENARIOS {
        for threads in ["1", "2", "7"] {
            let bench = Bench::with(scenario);
            ended(bench.start(&["--threads", threads]).output().unwrap(), 0);
            assert_same(&bench.run(), reference(scenario));
        }
    }
}
