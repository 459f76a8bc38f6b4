//! Which pictures there are of what, and that they show nothing that is not there. With `AGGLO_PICTURES` set to a folder they
//! are left there to be looked at.

use std::f64::consts::{PI, TAU};
use std::path::PathBuf;

use super::*;
use agglo::math::rng::{Purpose, Stream};
use agglo::search::analysis::Replicates;
use agglo::search::{Grid, Morris, Refinement, SobolIndices};

/// The pictures that are made in a folder: their names and texts.
fn drawn(draw: impl FnOnce(&Path) -> Result<Vec<PathBuf>, RecordError>) -> (Vec<String>, Vec<String>) {
    let temporary = tempfile::tempdir().unwrap();
    let kept = std::env::var_os("AGGLO_PICTURES").map(PathBuf::from);
    let files = draw(kept.as_deref().unwrap_or(temporary.path())).unwrap();
    let name = |file: &PathBuf| file.file_name().unwrap().to_string_lossy().into_owned();
    let names = files.iter().map(name).collect();
    (names, files.iter().map(|file| std::fs::read_to_string(file).unwrap()).collect())
}

/// A search in three parameters, among them a choice of words; every fifth candidate fails or misses a limit.
fn searched() -> Evaluations {
    let mut stream = Stream::new(8, Purpose::Sampling, 0);
    let row = |number: u32| {
        let spread = 1.0 / (1.0 + f64::from(number) / 40.0);
        let point: Vec<f64> = (0..3).map(|_| 0.3 + spread * 0.7 * (stream.uniform() - 0.4)).collect();
        let cost = 0.65 + point.iter().map(|u| (u - 0.3).powi(2)).sum::<f64>();
        let (status, costs) = match number % 10 {
            3 => (Status::Failed, Vec::new()),
            7 => (Status::Infeasible, vec![cost, point[0] + 0.1]),
            _ => (Status::Feasible, vec![cost, point[0] + 0.1]),
        };
        EvaluationRow {
            values: vec![20.0 + 180.0 * point[0], 10.0_f64.powf(5.0 + point[1]), (2.0 * point[2]).floor()],
            standard_errors: vec![0.01; costs.len()],
            replicates: (0..10).map(|_| vec![1.0 / (1.0 - cost.min(0.9)) + 0.1 * stream.normal()]).collect(),
            point,
            costs,
            status,
            generation: number / 20,
            replicate_costs: Vec::new(),
        }
    };
    Evaluations {
        title: "Agglomeration".to_owned(),
        parameters: vec![
            Axis::new("speed", "m/s"),
            Axis::new("hardness", "Pa").log(),
            Axis::choice("law", &["published", "consistent"]),
        ],
        objectives: vec![objective("growth_deficit", ""), objective("energy", "J")],
        measures: vec![Axis::new("radius_ratio", "")],
        rows: (0..300).map(row).collect(),
        ..Evaluations::default()
    }
}

fn objective(name: &str, unit: &str) -> Objective {
    Objective { axis: Axis::new(name, unit), is_to_be_large: false }
}

#[test]
fn searches_have_their_pictures() {
    let (names, texts) = drawn(|folder| search_pictures(folder, &searched()));
    assert_eq!(names, ["cost.svg", "parallel.svg", "pairs.svg", "front.svg"]);
    assert_all!(texts.iter(), |text| text.contains("Agglomeration: ") && !text.contains("NaN"));
    let (none, _) = drawn(|folder| search_pictures(folder, &Evaluations::default()));
    assert_empty!(none);
}

/// Absorbed power against the number of rays, with an error of 40/rays and a little noise.
fn refined() -> Evaluations {
    let mut stream = Stream::new(2, Purpose::Sampling, 0);
    let row = |(number, rays): (usize, f64)| EvaluationRow {
        point: vec![(number as f64 + 0.5) / 5.0],
        values: vec![rays],
        replicates: (0..16).map(|_| vec![2.0 + 80.0 / rays + 1e-3 * stream.normal()]).collect(),
        ..EvaluationRow::default()
    };
    Evaluations {
        replicates: Replicates::Shared,
        title: "Rays".to_owned(),
        parameters: vec![Axis::new("rays", "")],
        measures: vec![Axis::new("power", "W")],
        rows: [1e3, 2e3, 4e3, 8e3, 16e3].into_iter().enumerate().map(row).collect(),
        ..Evaluations::default()
    }
}

/// An objective that is a column too is one thing, and stands with the sign of the column.
#[test]
fn an_objective_that_is_a_column_is_drawn_once_with_its_own_sign() {
    let mut evaluations = refined();
    let axis = evaluations.measures[0].clone();
    evaluations.objectives = vec![Objective { axis, is_to_be_large: true }];
    for row in &mut evaluations.rows {
        row.replicate_costs = row.replicates.iter().map(|replicate| vec![-replicate[0]]).collect();
        row.costs = vec![-row.measure(0).mean];
        row.standard_errors = vec![row.measure(0).standard_error()];
    }
    let plan = Plan::Refinement(Refinement { tolerance: 0.01 });
    let (names, found) = drawn(|folder| study_pictures(folder, &plan, &evaluations, 1));
    assert_eq!(names, ["refinement.svg", "histograms.svg"]);
    let (_, due) = drawn(|folder| study_pictures(folder, &plan, &refined(), 1));
    assert!(found == due, "pictures of an objective that is a column: {found:?}");
}

fn ishigami(u: &[f64]) -> f64 {
    let x: Vec<f64> = u.iter().map(|u| PI * (2.0 * u - 1.0)).collect();
    x[0].sin() + 7.0 * x[1].sin().powi(2) + 0.1 * x[2].powi(4) * x[0].sin()
}

fn studied(plan: &Plan) -> Evaluations {
    let row = |point: Vec<f64>| EvaluationRow {
        values: point.iter().map(|u| TAU * u - PI).collect(),
        costs: vec![ishigami(&point)],
        standard_errors: vec![0.1],
        point,
        ..EvaluationRow::default()
    };
    Evaluations {
        title: "Ishigami".to_owned(),
        parameters: ["x", "y", "z"].map(|name| Axis::new(name, "rad")).to_vec(),
        objectives: vec![objective("height", "m")],
        rows: plan.points(&[Some(4); 3], 1).into_iter().map(row).collect(),
        ..Evaluations::default()
    }
}

#[test]
fn studies_have_the_picture_of_their_plan() {
    for (plan, picture) in [
        (Plan::Morris(Morris::default()), "sensitivity.svg"),
        (Plan::SobolIndices(SobolIndices::default()), "sensitivity.svg"),
        (Plan::Grid(Grid::default()), "parallel.svg"),
    ] {
        let (names, texts) = drawn(|folder| study_pictures(folder, &plan, &studied(&plan), 1));
        assert_eq!(names, [picture], "{plan:?}");
        assert!(texts[0].contains("Ishigami: ") && !texts[0].contains("NaN"), "{plan:?}: {}", texts[0]);
    }
}

#[test]
fn what_does_not_vary_is_drawn_as_that() {
    for plan in [Plan::Morris(Morris::default()), Plan::SobolIndices(SobolIndices::default())] {
        let mut constant = studied(&plan);
        for row in &mut constant.rows {
            row.costs = vec![192.53];
        }
        let (_, texts) = drawn(|folder| study_pictures(folder, &plan, &constant, 1));
        assert!(texts[0].contains("which does not vary") && !texts[0].contains("NaN"), "{}", texts[0]);
    }
}
