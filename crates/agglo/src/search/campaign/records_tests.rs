//! The tables of a campaign: evaluations of distinct quantities, read back by the names of the columns.

use super::*;
use crate::search::{Candidate, Choice, Fitness, Scale};

fn axes() -> Vec<Axis> {
    let choice = |label: &str| Choice { label: label.to_owned(), number: None };
    vec![
        Axis { name: "v".to_owned(), unit: "m/s".to_owned(), scale: Scale::Linear([0.0, 100.0]) },
        Axis {
            name: "law".to_owned(),
            unit: String::new(),
            scale: Scale::Choices(["hertz", "hooke"].map(choice).to_vec()),
        },
    ]
}

/// An evaluation whose quantities all follow from its number and differ from those of others.
fn evaluation(number: u64, (stage, status): (Stage, Status), costs: &[f64]) -> Evaluation {
    let k = number as f64;
    Evaluation {
        number,
        stage,
        generation: 40 + number,
        candidate: Candidate { point: vec![0.5, 0.9], values: vec![20.0 + k, 1.0], violation: 0.0 },
        status,
        replicates: 3 + number as u32,
        repeats: None,
        fitness: Fitness {
            costs: costs.to_vec(),
            standard_errors: costs.iter().map(|cost| cost / 64.0).collect(),
            violation: if status == Status::Infeasible { 0.125 + k } else { 0.0 },
        },
        quantities: vec![vec![300.0 + k, 400.0 + k], vec![301.0 + k, 402.0 + k]],
        costs: vec![costs.to_vec(); 2],
    }
}

/// The rows of a table, each as names with cells.
fn rows(folder: &Path, table: &str) -> Vec<Vec<(String, String)>> {
    let text = std::fs::read_to_string(folder.join(table)).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let head = lines.next().unwrap();
    lines
        .map(|cells| {
            assert_eq!(cells.len(), head.len(), "{table}: cells of a row");
            head.iter().cloned().zip(cells).collect()
        })
        .collect()
}

fn assert_row(place: &str, row: &[(String, String)], wanted: &[(&str, &str)]) {
    let found: Vec<&str> = row.iter().map(|(name, _)| name.as_str()).collect();
    let due: Vec<&str> = wanted.iter().map(|(name, _)| *name).collect();
    assert_eq!(found, due, "{place}: columns: found on the left, due on the right");
    for ((name, found), (_, due)) in row.iter().zip(wanted) {
        assert_eq!(
            found, due,
            "{place}: column {name}: found on the left, due on the right (in the unit of its name)"
        );
    }
}

fn records(folder: &Path, objectives: usize) -> Records {
    let columns = ["n_f", "wall_s"].map(str::to_owned);
    Records::create(folder, &axes(), objectives, &columns).unwrap()
}

#[test]
fn evaluations_stand_under_their_columns() {
    let folder = tempfile::tempdir().unwrap();
    let mut records = records(folder.path(), 2);
    let mut one = evaluation(5, (Stage::Polish, Status::Infeasible), &[16.0, -32.0]);
    one.repeats = Some(2);
    records.evaluation(&one).unwrap();
    let failed = Evaluation {
        fitness: Fitness::failed(),
        quantities: Vec::new(),
        replicates: 0,
        ..evaluation(6, (Stage::Search, Status::Failed), &[])
    };
    records.evaluation(&failed).unwrap();
    records.flush().unwrap();
    let rows = rows(folder.path(), "evaluations.csv");
    let wanted = [
        ("evaluation", "5"),
        ("generation", "45"),
        ("stage", "polish"),
        ("status", "infeasible"),
        ("replicates", "8"),
        ("repeats", "2"),
        ("violation", "5.125"),
        ("cost_1", "16"),
        ("cost_2", "-32"),
        ("cost_1_standard_error", "0.25"),
        ("cost_2_standard_error", "-0.5"),
        ("v_m_s", "25"),
        ("law", "hooke"),
        ("n_f", "305.5"),
        ("wall_s", "406"),
    ];
    assert_row("evaluations.csv", &rows[0], &wanted);
    let wanted = [("evaluation", "6"), ("generation", "46"), ("stage", "search"), ("status", "failed")];
    let of_failed = [("replicates", "0"), ("v_m_s", "26"), ("law", "hooke")];
    for (name, cell) in &rows[1] {
        let due =
            wanted.iter().chain(&of_failed).find(|(known, _)| known == name).map_or("", |(_, cell)| cell);
        assert_eq!(
            cell, due,
            "evaluations.csv, one that failed: column {name}: found on the left, due on the right"
        );
    }
}

#[test]
fn replicates_and_failures_stand_under_their_columns() {
    let folder = tempfile::tempdir().unwrap();
    let mut records = records(folder.path(), 1);
    records
        .replicate(5, &Replicate { number: 2, seed: 77, costs: &[1.25], quantities: &[8.5, 9.5] })
        .unwrap();
    records.failure(6, 3, 78, "too low").unwrap();
    records.flush().unwrap();
    let wanted = [
        ("evaluation", "5"),
        ("replicate", "2"),
        ("seed", "77"),
        ("cost", "1.25"),
        ("n_f", "8.5"),
        ("wall_s", "9.5"),
    ];
    assert_row("runs.csv", &rows(folder.path(), "runs.csv")[0], &wanted);
    let wanted = [("evaluation", "6"), ("replicate", "3"), ("seed", "78"), ("reason", "too low")];
    assert_row("failures.csv", &rows(folder.path(), "failures.csv")[0], &wanted);
}

/// One that misses a limit, then costs of 8 and 3 with another that misses one and one that was not run, then 4, 6 and 8 with
/// two that failed: lowest and mean are of those of the generation that keep the limits, the best and the sums are of all.
#[test]
fn generations_stand_under_their_columns() {
    let folder = tempfile::tempdir().unwrap();
    let mut records = records(folder.path(), 1);
    let mut archive = Archive::default();
    let search = |number, status, cost| evaluation(number, (Stage::Search, status), &[cost]);
    let without_costs =
        |number, status| Evaluation { fitness: Fitness::failed(), ..search(number, status, 0.0) };
    archive.add(search(0, Status::Infeasible, 2.0));
    records.generation((7, Stage::Search), &archive, 1).unwrap();
    archive.add(search(1, Status::Ok, 8.0));
    archive.add(search(2, Status::Ok, 3.0));
    archive.add(search(3, Status::Infeasible, 1.0));
    archive.add(without_costs(4, Status::Excluded));
    records.generation((8, Stage::Search), &archive, 4).unwrap();
    for (number, cost) in [(5, 4.0), (6, 6.0), (7, 8.0)] {
        archive.add(search(number, Status::Ok, cost));
    }
    for number in [8, 9, 10] {
        archive.add(without_costs(number, Status::Failed));
    }
    records.generation((9, Stage::Polish), &archive, 6).unwrap();
    records.flush().unwrap();
    let names = [
        "generation",
        "stage",
        "evaluations",
        "runs",
        "failures",
        "excluded",
        "cost_lowest",
        "cost_mean",
        "best_evaluation",
        "best_cost",
        "best_cost_standard_error",
        "best_violation",
        "infeasible",
    ];
    // Of 3 replicates and one more for each number.
    let wanted = [
        ["7", "search", "1", "3", "0", "0", "", "", "0", "2", "0.03125", "0.125", "1"],
        ["8", "search", "5", "25", "0", "1", "3", "5.5", "2", "3", "0.046875", "0", "2"],
        ["9", "polish", "11", "88", "3", "1", "4", "6", "2", "3", "0.046875", "0", "2"],
    ];
    for (row, wanted) in rows(folder.path(), "generations.csv").iter().zip(wanted) {
        let wanted: Vec<(&str, &str)> = names.into_iter().zip(wanted).collect();
        assert_row(&format!("generations.csv, generation {}", wanted[0].1), row, &wanted);
    }
}

#[test]
fn the_best_stand_under_their_columns() {
    let folder = tempfile::tempdir().unwrap();
    let records = records(folder.path(), 1);
    let confirmed = evaluation(7, (Stage::Confirm, Status::Infeasible), &[16.0]);
    let search = evaluation(4, (Stage::Search, Status::Ok), &[32.0]);
    let last = evaluation(9, (Stage::Final, Status::Infeasible), &[48.0]);
    let ranked = [
        Ranked { evaluation: &confirmed, search: Some(&search), last: Some(&last) },
        Ranked { evaluation: &search, search: None, last: None },
    ];
    records.best(folder.path(), &ranked).unwrap();
    let rows = rows(folder.path(), "best.csv");
    let wanted = [
        ("rank", "1"),
        ("evaluation", "7"),
        ("cost", "16"),
        ("cost_standard_error", "0.25"),
        ("replicates", "10"),
        ("violation", "7.125"),
        ("search_evaluation", "4"),
        ("search_cost", "32"),
        ("search_cost_standard_error", "0.5"),
        ("search_replicates", "7"),
        ("final_evaluation", "9"),
        ("final_cost", "48"),
        ("final_cost_standard_error", "0.75"),
        ("final_replicates", "12"),
        ("final_violation", "9.125"),
        ("v_m_s", "27"),
        ("law", "hooke"),
    ];
    assert_row("best.csv, rank 1", &rows[0], &wanted);
    let wanted = wanted.map(|(name, _)| {
        let due = match name {
            "rank" => "2",
            "evaluation" => "4",
            "cost" => "32",
            "cost_standard_error" => "0.5",
            "replicates" => "7",
            "violation" => "0",
            "v_m_s" => "24",
            "law" => "hooke",
            _ => "",
        };
        (name, due)
    });
    assert_row("best.csv, rank 2", &rows[1], &wanted);
}
