//! Results do not depend on what is written, nor on the number of threads.

use std::fs;
use std::path::Path;

use crate::common::{Bench, STAGGERED, VERLET, assert_same, ended, reference, state};

fn last_row(run: &Path, table: &str) -> String {
    fs::read_to_string(run.join("series").join(table)).unwrap().lines().last().unwrap().to_owned()
}

#[test]
fn what_is_written_never_changes_the_simulation() {
    let often = ["series=\"10 us\"", "frames=\"0.5 ms\"", "checkpoints=\"0.4 ms\""];
    let never = ["series=\"1 h\"", "frames=\"1 h\"", "checkpoints=\"1 h\"", "bonds=false", "rays=false"];
    for scenario in [STAGGERED, VERLET] {
        let wanted = state(reference(scenario));
        for choice in [&often[..], &never] {
            let bench = Bench::with(scenario);
            let settings: Vec<String> =
                choice.iter().flat_map(|text| ["--set".to_owned(), format!("output.{text}")]).collect();
            let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
            ended(bench.start(&settings).output().unwrap(), 0);
            assert!(state(&bench.run()) == wanted, "another state with {choice:?}");
            for table in ["energy", "momentum", "clusters", "moments", "rays", "steps"] {
                let table = format!("{table}.csv");
                assert_eq!(last_row(&bench.run(), &table), last_row(reference(scenario), &table));
            }
            let events = |run: &Path| fs::read(run.join("events.csv")).unwrap();
            assert!(events(&bench.run()) == events(reference(scenario)), "other events with {choice:?}");
        }
    }
}

#[test]
fn any_number_of_threads_writes_the_same_files() {
    for scenario in [STAGGERED, VERLET] {
        for threads in ["1", "2", "7"] {
            let bench = Bench::with(scenario);
            ended(bench.start(&["--threads", threads]).output().unwrap(), 0);
            assert_same(&bench.run(), reference(scenario));
        }
    }
}
