//! What all evaluations together say: tables of a study, sentences; and where pictures of them come in.

use std::path::Path;

use super::archive::{Evaluation, Status};
use super::course::Results;
use crate::folder::names;
use crate::record::{RecordError, atomic};
use crate::search::analysis::{
    self, EvaluationRow, Evaluations, Objective, Replicates, measures_table, parameter_axis, parameter_value,
    study_tables,
};
use crate::search::{Axis, Campaign, Model, Problem};

/// Draws what all evaluations of a search or study say into a folder that is there and empty. It is asked when they are all
/// there and before the summary is: what is killed in between draws them anew. The crate `agglo-view` has the one of the
/// program.
pub type Draw<'a> = dyn Fn(&Path, &Campaign, &Evaluations) -> Result<(), RecordError> + 'a;

/// Writes the tables of a study, and lets pictures be drawn where someone draws.
pub fn write(
    campaign: &Campaign,
    problem: &Problem,
    results: &Results<'_>,
    draw: Option<&Draw<'_>>,
) -> Result<(), RecordError> {
    let evaluations = evaluations(campaign, problem, results.evaluations);
    if let Some(plan) = &campaign.plan {
        let root = results.folder.root();
        let keep = |name: &str, text: &str| atomic::write(&root.join(name), text.as_bytes());
        keep(names::MEASURES, &measures_table(&evaluations))?;
        for (name, text) in study_tables(plan, &evaluations, campaign.seed) {
            keep(name, &text)?;
        }
    }
    let Some(draw) = draw else { return Ok(()) };
    let pictures = results.folder.pictures();
    std::fs::create_dir_all(&pictures).map_err(RecordError::file("make the folder", &pictures))?;
    draw(&pictures, campaign, &evaluations)
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
        measures: problem.shown().iter().map(|name| plain(name)).collect(),
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
