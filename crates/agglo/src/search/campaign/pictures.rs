//! What all evaluations together say: tables of a study, sentences, pictures.

use std::path::Path;

use super::archive::{Evaluation, Status};
use super::course::Results;
use crate::folder::names;
use crate::record::{RecordError, atomic};
use crate::search::analysis::{
    self, EvaluationRow, Evaluations, Objective, Replicates, measures_table, parameter_axis, parameter_value,
    search_pictures, study_pictures, study_tables,
};
use crate::search::{Axis, Campaign, Model, Problem};

/// Writes the tables of a study, and pictures.
pub fn write(campaign: &Campaign, problem: &Problem, results: &Results<'_>) -> Result<(), RecordError> {
    let evaluations = evaluations(campaign, problem, results.evaluations);
    let (root, pictures) = (results.folder.root(), results.folder.pictures());
    std::fs::create_dir_all(&pictures).map_err(RecordError::file("make the folder", &pictures))?;
    let Some(plan) = &campaign.plan else {
        return search_pictures(&pictures, &evaluations).map(drop);
    };
    let keep = |name: &str, text: &str| atomic::write(&root.join(name), text.as_bytes());
    keep(names::MEASURES, &measures_table(&evaluations))?;
    for (name, text) in study_tables(plan, &evaluations, campaign.seed) {
        keep(name, &text)?;
    }
    study_pictures(&pictures, plan, &evaluations, campaign.seed).map(drop)
}

/// What a study says, in sentences.
pub fn findings(campaign: &Campaign, problem: &Problem, known: &[Evaluation]) -> Vec<String> {
    let said = |plan| analysis::findings(plan, &evaluations(campaign, problem, known), campaign.seed);
    campaign.plan.as_ref().map_or_else(Vec::new, said)
}

/// Takes away what an earlier session may have left half done.
pub fn clear(folder: &Path) -> Result<(), RecordError> {
    match std::fs::remove_dir_all(folder) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(RecordError::file("remove", folder)(error))
        }
        _ => Ok(()),
    }
}

fn evaluations(campaign: &Campaign, problem: &Problem, known: &[Evaluation]) -> Evaluations {
    let plain = |name: &str| analysis::Axis::new(name, "");
    let objective =
        |(formula, is_to_be_large): (&str, bool)| Objective { axis: plain(formula), is_to_be_large };
    let searched = known.iter().filter(|evaluation| evaluation.stage.is_search());
    Evaluations {
        title: campaign.title.clone(),
        parameters: problem.axes().iter().map(parameter_axis).collect(),
        objectives: problem.objectives().map(objective).collect(),
        measures: problem.columns().iter().map(|name| plain(name)).collect(),
        replicates: if campaign.ensemble.common_random_numbers {
            Replicates::Shared
        } else {
            Replicates::Own
        },
        rows: searched.map(|evaluation| row(problem.axes(), evaluation)).collect(),
    }
}

fn row(axes: &[Axis], evaluation: &Evaluation) -> EvaluationRow {
    let number = |(axis, value): (&Axis, &f64)| parameter_value(axis, *value);
    EvaluationRow {
        point: evaluation.candidate.point.clone(),
        values: axes.iter().zip(&evaluation.candidate.values).map(number).collect(),
        costs: evaluation.fitness.costs.clone(),
        standard_errors: evaluation.standard_errors(),
        replicate_costs: evaluation.costs.clone(),
        status: match evaluation.status {
            Status::Ok => analysis::Status::Feasible,
            Status::Infeasible => analysis::Status::Infeasible,
            Status::Excluded => analysis::Status::Excluded,
            Status::Failed => analysis::Status::Failed,
        },
        generation: evaluation.generation as u32,
        replicates: evaluation.quantities.clone(),
    }
}
