//! What all evaluations together say: tables of a study, pictures.

use std::path::Path;

use super::archive::{Evaluation, Stage, Status};
use super::conduct::Results;
use crate::record::{RecordError, atomic};
use crate::search::analysis::{
    self, EvaluationRow, Evaluations, measures_table, parameter_axis, parameter_value, search_pictures,
    study_pictures, study_table,
};
use crate::search::{Axis, Campaign, Problem};

/// Writes the tables of a study, and pictures.
pub fn write(campaign: &Campaign, problem: &Problem, results: &Results<'_>) -> Result<(), RecordError> {
    let evaluations = evaluations(campaign, problem, results);
    let (root, pictures) = (results.folder.root(), results.folder.pictures());
    std::fs::create_dir_all(&pictures).map_err(RecordError::file("make the folder", &pictures))?;
    let Some(plan) = &campaign.plan else {
        return search_pictures(&pictures, &evaluations).map(drop);
    };
    let keep = |name: &str, text: &str| atomic::write(&root.join(name), text.as_bytes());
    keep("measures.csv", &measures_table(&evaluations))?;
    if let Some((name, text)) = study_table(plan, &evaluations, campaign.seed) {
        keep(name, &text)?;
    }
    study_pictures(&pictures, plan, &evaluations, campaign.seed).map(drop)
}

/// Takes away what an earlier sitting may have left half done.
pub fn clear(folder: &Path) -> Result<(), RecordError> {
    match std::fs::remove_dir_all(folder) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(RecordError::file("remove", folder)(error))
        }
        _ => Ok(()),
    }
}

fn evaluations(campaign: &Campaign, problem: &Problem, results: &Results<'_>) -> Evaluations {
    let plain = |name: &str| analysis::Axis::new(name, "");
    let objective = |(formula, is_to_be_large): (&str, bool)| {
        plain(&if is_to_be_large { format!("-({formula})") } else { formula.to_owned() })
    };
    let searched = results.evaluations.iter().filter(|evaluation| evaluation.stage != Stage::Confirm);
    Evaluations {
        title: campaign.title.clone(),
        parameters: problem.axes().iter().map(parameter_axis).collect(),
        objectives: problem.objectives().map(objective).collect(),
        measures: results.columns.iter().map(|name| plain(name)).collect(),
        rows: searched.map(|evaluation| row(problem.axes(), evaluation)).collect(),
    }
}

fn row(axes: &[Axis], evaluation: &Evaluation) -> EvaluationRow {
    let number = |(axis, value): (&Axis, &f64)| parameter_value(axis, *value);
    EvaluationRow {
        point: evaluation.candidate.point.clone(),
        values: axes.iter().zip(&evaluation.candidate.values).map(number).collect(),
        costs: evaluation.fitness.costs.clone(),
        standard_errors: evaluation.fitness.standard_errors.clone(),
        status: match evaluation.status {
            Status::Ok => analysis::Status::Feasible,
            Status::Infeasible => analysis::Status::Infeasible,
            Status::Excluded => analysis::Status::Excluded,
            Status::Failed => analysis::Status::Failed,
        },
        generation: evaluation.generation as u32,
        starts: evaluation.figures.clone(),
    }
}
