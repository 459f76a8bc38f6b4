//! What a campaign does not run: points that it knows, and what its time is up for.

use std::fs;
use std::ops::ControlFlow;
use std::time::Duration;

use super::tests::{self, Setup, conducted_with, results, rows, whole};
use super::*;
use crate::search::optimizer::{Genetic, Method, Random};
use crate::search::test_models::Analytic;

/// Eleven by eleven whole numbers: of 200 points many come again, and are not run again.
#[test]
fn candidates_that_come_again_use_what_is_known() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path().join("run");
    let model = Analytic { sigma: 3.0, is_whole: true, fails_below: 0.05, ..Analytic::default() };
    let summary = whole(&model, &dir, 1, &Method::Random(Random { points: 200 }));
    let (evaluations, runs) = (rows(&dir, "evaluations.csv"), rows(&dir, "runs.csv"));
    let mut repeats = 0;
    for (number, row) in evaluations.iter().enumerate() {
        let own = runs.iter().filter(|run| run["evaluation"] == number.to_string()).count();
        let Ok(earlier) = row["repeats"].parse::<usize>() else {
            assert_eq!(own, tests::number(row, "replicates") as usize);
            continue;
        };
        repeats += 1;
        let same =
            ["status", "replicates", "cost", "cost_standard_error", "x_m_s", "y_m_s", "value", "noise"];
        assert!(same.iter().all(|column| row[*column] == evaluations[earlier][*column]), "{row:?}");
        assert_below!(earlier, number);
        assert_eq!(own, 0);
        assert_empty!(evaluations[earlier]["repeats"]);
    }
    // 205 points on 121 places: 1 - (1 - 1/121)^205 of these are met, so about 205 - 99 come again.
    assert!((70..140).contains(&repeats) && summary.repeats == repeats, "{repeats}");
    assert_eq!(summary.runs, runs.len() as u64);
    // Reasons may have lines of their own.
    let failures = fs::read_to_string(dir.join("failures.csv")).unwrap();
    let failures = failures.lines().filter(|line| line.starts_with(|first: char| first.is_ascii_digit()));
    assert_eq!(failures.count() as u64, summary.failures);
    // One thread runs nothing in vain; replicates that fail have no row.
    let failed = evaluations.iter().filter(|row| row["status"] == "failed" && row["repeats"].is_empty());
    assert_eq!(model.runs.into_inner(), summary.runs + failed.count() as u64);
}

/// The clock ends the search, the rest is done all the same, and whatever is interrupted meanwhile ends where the clock said.
#[test]
fn a_budget_of_time_ends_the_search_and_is_kept_when_resumed() {
    let folder = tempfile::tempdir().unwrap();
    let method = Method::Random(Random { points: 100_000 });
    let slow = || Analytic { slowest: Duration::from_millis(4), ..Analytic::default() };
    let setup = Setup { budget_s: Some(1.0), ..Setup::default() };
    let dir = folder.path().join("run");
    let go_on = &mut |_: &CampaignProgress| ControlFlow::Continue(());
    // Interrupted when all is evaluated: what the clock decided is in the journal.
    let interrupted = Setup { budget_s: Some(1.0), is_interrupted: true, ..Setup::default() };
    let ended = conducted_with(&slow(), &dir, (2, &method), &interrupted, go_on).unwrap();
    assert_matches!(ended, CampaignEnding::Interrupted);
    let journal = fs::read_to_string(dir.join("replicates.journal")).unwrap();
    let decided: Vec<&str> = journal.lines().filter(|line| line.starts_with("budget,")).collect();
    assert!(decided.last().unwrap().contains(",ends,"), "{decided:?}");
    let at: u64 = decided.last().unwrap().split(',').nth(1).unwrap().parse().unwrap();
    assert_above!(at, 8);
    assert_below!(at, 100_000);
    // The same journal on another number of threads, with all the time in the world gone by: the same files.
    let again = folder.path().join("again");
    fs::create_dir(&again).unwrap();
    for file in ["search.toml", "scenario.toml", "replicates.journal"] {
        fs::copy(dir.join(file), again.join(file)).unwrap();
    }
    let mut summaries = Vec::new();
    for (dir, threads) in [(&dir, 2), (&again, 5)] {
        let ended = conducted_with(&slow(), dir, (threads, &method), &setup, go_on).unwrap();
        let CampaignEnding::Finished(summary) = ended else { panic!("nobody asked it to stop") };
        summaries.push(summary);
    }
    assert_eq!(results(&dir), results(&again));
    let summary = &summaries[0];
    assert_eq!(summary.ended_early.as_deref(), Some("budget.time"));
    assert_eq!((summary.stages[0].candidates, summary.stages[0].allowed), (at, Some(100_000)));
    let best = summary.best.as_ref().unwrap();
    assert_true!(best.is_confirmed, "the best was run again on new seeds");
    assert_some!(best.confirm_cost);
    let said = summary.table().into_iter().find(|(what, _)| what == "evaluations").unwrap().1;
    assert!(said.contains(&format!("search {at} of 100000 (the time was up)")), "{said}");
}

/// The best of a search for two costs tells both, as its front does; that of one cost has no list.
#[test]
fn the_best_of_two_costs_tells_both() {
    let folder = tempfile::tempdir().unwrap();
    let method = Method::Genetic(Genetic { population: 8, generations: 2, ..Genetic::default() });
    let model = Analytic { second: Some([2.0, -1.0]), ..Analytic::default() };
    let setup = Setup { polishes: false, ..Setup::default() };
    let go_on = &mut |_: &CampaignProgress| ControlFlow::Continue(());
    let ended = conducted_with(&model, &folder.path().join("two"), (1, &method), &setup, go_on).unwrap();
    let CampaignEnding::Finished(summary) = ended else { panic!("nobody asked it to stop") };
    let best = summary.best.unwrap();
    let [x, y] = [0, 1].map(|at| best.parameters.0[at].1.as_f64().unwrap());
    assert_eq!(best.costs, [x * x + y * y, (x - 2.0).powi(2) + (y + 1.0).powi(2)]);
    assert_eq!(best.cost, best.costs[0]);
    assert_at_least!(summary.front.len(), 2);
    assert_all!(summary.front.iter(), |point| point.costs.len() == 2);
    let one =
        whole(&Analytic::default(), &folder.path().join("one"), 1, &Method::Random(Random { points: 9 }));
    assert_empty!(one.best.unwrap().costs);
}
