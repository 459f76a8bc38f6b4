//! A run that has ended.

use crate::common::{Bench, STAGGERED, assert_same, bytes, complained, ended, reference, said};

/// A finished run has nothing left to do: its summary is shown again, and no file changes.
#[test]
fn resuming_a_finished_run_shows_its_summary_and_changes_nothing() {
    let bench = Bench::with(STAGGERED);
    let first = said(&ended(bench.start(&["--threads", "1"]).output().unwrap(), 0));
    let before = bytes(&bench.run());
    let again = ended(bench.resume().output().unwrap(), 0);
    assert!(said(&again).contains("has finished already"), "{}", said(&again));
    assert!(complained(&again).is_empty(), "{}", complained(&again));
    // All rows of the table as they were, threads and wall time included.
    let rows: Vec<&str> = first.lines().filter(|line| line.starts_with("  ")).collect();
    assert!(rows.len() >= 9 && rows.iter().all(|row| said(&again).contains(row)), "{}", said(&again));
    assert!(bytes(&bench.run()) == before, "a finished run was changed");
}

/// Killed between the last checkpoint and the summary: the summary is written.
#[test]
fn a_summary_that_is_missing_or_damaged_is_written_again() {
    for damage in [None, Some("{\"version\": \"0.1")] {
        let bench = Bench::with(STAGGERED);
        let first = said(&ended(bench.start(&[]).output().unwrap(), 0));
        let summary = bench.run().join("summary.json");
        std::fs::remove_file(&summary).unwrap();
        if let Some(text) = damage {
            std::fs::write(&summary, text).unwrap();
        }
        let again = said(&ended(bench.resume().output().unwrap(), 0));
        // Warnings of the whole run are counted, also by the one who only ends it.
        let closing = |text: &str| {
            text.lines().find_map(|line| {
                Some(line.split_once(", ")?.1.to_owned()).filter(|_| line.starts_with("in "))
            })
        };
        assert!(closing(&again).is_some() && closing(&again) == closing(&first), "{first}\n{again}");
        assert_same(&bench.run(), reference(STAGGERED));
    }
}
