//! Which of the best candidates is the best, by replicates that the search has not seen; and how good it is, by further ones.
//!
//! The lowest of many scattered costs is low by luck as well. So the best are run again with fresh replicates, and the one with
//! the lowest fresh mean is taken. That choice is of the lowest of a few means again, so the one taken is run once more,
//! with replicates that had no part in it: the mean of those is reported, beside what it was chosen by.

use serde_json::Value as Json;

use super::archive::{Evaluation, Stage};
use super::conduct::{Conductor, Stop};
use super::course::Course;
use super::records::{Ranked, error_of};
use super::summary::{Best, CampaignSummary, FrontPoint, Named, Spent};
use crate::record::RecordError;
use crate::search::optimizer::Point;
use crate::search::{Axis, Candidate, Model};

/// Where the best candidate stands in the archive.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chosen {
    /// Its evaluation that is reported: the last one.
    pub at: usize,
    /// Its evaluation by which it was chosen among those that were run again.
    pub confirmed: Option<usize>,
    /// Its evaluation in the search.
    pub search: Option<usize>,
}

impl<M: Model> Conductor<'_, M> {
    /// Runs the best candidates with fresh replicates, the best of them once more, writes them down, and names the best.
    pub(super) fn confirm(
        &mut self,
        course: &Course<'_>,
        recommended: Option<Point>,
    ) -> Result<Option<Chosen>, Stop> {
        let searched: Vec<usize> = self.best_of_search(course);
        let Some(&best) = searched.first() else { return Ok(None) };
        let unconfirmed = Chosen { at: best, confirmed: None, search: Some(best) };
        if course.confirm.candidates == 0 || course.confirm.replicates == 0 {
            let ranked = searched.iter().map(|&at| Chosen { at, ..unconfirmed }).collect::<Vec<_>>();
            self.write_best(&ranked)?;
            return Ok(Some(unconfirmed));
        }
        let (candidates, search) = self.to_be_confirmed(course, &searched, recommended);
        let first = self.archive.evaluations.len();
        self.generation(Stage::Confirm, candidates)?;
        let chosen = |(at, search)| Chosen { at, confirmed: None, search };
        let mut ranked: Vec<Chosen> = (first..).zip(search).map(chosen).collect();
        let evaluation = |at: usize| &self.archive.evaluations[at];
        ranked.sort_by(|a, b| evaluation(a.at).fitness.compare(&evaluation(b.at).fitness));
        // Where all fail with fresh replicates, the search's best is all there is.
        if !evaluation(ranked[0].at).has_quantities() {
            self.write_best(&ranked)?;
            return Ok(Some(unconfirmed));
        }
        if ranked.len() > 1 {
            let last = self.archive.evaluations.len();
            self.generation(Stage::Final, vec![evaluation(ranked[0].at).candidate.clone()])?;
            if self.archive.evaluations[last].has_quantities() {
                ranked[0] = Chosen { at: last, confirmed: Some(ranked[0].at), ..ranked[0] };
            }
        }
        self.write_best(&ranked)?;
        Ok(Some(ranked[0]))
    }

    /// The candidates that are run again, as many as the file says, and their evaluations in the search.
    fn to_be_confirmed(
        &self,
        course: &Course<'_>,
        searched: &[usize],
        recommended: Option<Point>,
    ) -> (Vec<Candidate>, Vec<Option<usize>>) {
        let mut candidates: Vec<(Candidate, Option<usize>)> =
            searched.iter().map(|&at| (self.archive.evaluations[at].candidate.clone(), Some(at))).collect();
        let recommended = recommended.map(|point| self.candidate(&point));
        if let Some(new) = recommended.filter(|new| new.violation == 0.0)
            && candidates.iter().all(|(known, _)| known.values != new.values)
        {
            // The optimizer's own choice, which it need not have evaluated, goes before the last of the others.
            candidates.truncate(course.confirm.candidates as usize - 1);
            let search = self.archive.evaluations.iter().position(|one| one.candidate.values == new.values);
            candidates.push((new, search));
        }
        candidates.into_iter().unzip()
    }

    fn write_best(&self, ranked: &[Chosen]) -> Result<(), RecordError> {
        let evaluation = |at: usize| &self.archive.evaluations[at];
        let row = |chosen: &Chosen| Ranked {
            evaluation: evaluation(chosen.confirmed.unwrap_or(chosen.at)),
            search: chosen.search.map(evaluation),
            last: chosen.confirmed.map(|_| evaluation(chosen.at)),
        };
        self.records.best(self.folder.root(), &ranked.iter().map(row).collect::<Vec<_>>())
    }

    /// Numbers of the best evaluations, best first; of the front where there are several costs.
    fn best_of_search(&self, course: &Course<'_>) -> Vec<usize> {
        let most = (course.confirm.candidates as usize).max(1);
        let best = if course.objectives.len() > 1 {
            let front = self.archive.front();
            let every = front.len().div_ceil(most).max(1);
            front.into_iter().step_by(every).collect()
        } else {
            self.archive.ranked(most)
        };
        best.into_iter().map(|evaluation| evaluation.number as usize).collect()
    }

    /// The summary but for the wall time.
    pub(super) fn summary(&self, course: &Course<'_>, best: Option<Chosen>) -> CampaignSummary {
        let front = if course.objectives.len() > 1 { self.archive.front() } else { Vec::new() };
        let point = |evaluation: &&Evaluation| FrontPoint {
            evaluation: evaluation.number,
            costs: evaluation.fitness.costs.clone(),
            standard_errors: evaluation.fitness.standard_errors.clone(),
            parameters: named_parameters(&course.parameters, &evaluation.candidate.values),
            violation: evaluation.fitness.violation,
        };
        CampaignSummary {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            title: course.title.to_owned(),
            seed: course.seed,
            objectives: course.objectives.clone(),
            is_study: course.is_study,
            part: course.part.as_ref().map(|(part, _)| *part),
            function: course.function.clone(),
            best: best.filter(|_| !course.objectives.is_empty()).map(|best| self.best(course, best)),
            front: front.iter().map(point).collect(),
            generations: self.generations,
            evaluations: self.archive.evaluations.len() as u64,
            stages: self.stages_spent(course),
            ended_early: self.ended_early(course),
            runs: self.archive.runs,
            failures: self.archive.failures,
            excluded: self.archive.excluded,
            infeasible: self.archive.infeasible,
            repeats: self.archive.repeats,
            noise: self.archive.noise(),
            findings: (course.findings)(&self.archive.evaluations),
            wall_s: 0.0,
        }
    }

    /// What each stage has come to beside what it was allowed.
    fn stages_spent(&self, course: &Course<'_>) -> Vec<Spent> {
        let of = |&(stage, candidates, runs): &(Stage, u64, u64)| Spent {
            stage: stage.word().to_owned(),
            allowed: allowed(course, stage),
            candidates,
            runs,
        };
        self.archive.spent.0.iter().map(of).collect()
    }

    /// Why the search came to fewer candidates than it was allowed.
    fn ended_early(&self, course: &Course<'_>) -> Option<String> {
        if self.is_out_of_time() {
            return Some("budget.time".to_owned());
        }
        let searched = self.archive.spent.0.iter().find(|(stage, ..)| *stage == Stage::Search)?;
        (searched.1 < allowed(course, Stage::Search)?).then(|| "convergence".to_owned())
    }

    fn best(&self, course: &Course<'_>, best: Chosen) -> Best {
        let evaluation = &self.archive.evaluations[best.at];
        let search =
            best.search.map(|at| &self.archive.evaluations[at]).filter(|search| search.has_quantities());
        let confirmed = best.confirmed.map(|at| &self.archive.evaluations[at]);
        let quantities = evaluation.mean_quantities().into_iter().map(Json::from);
        let quantities = self.columns().iter().cloned().zip(quantities);
        Best {
            evaluation: evaluation.number,
            cost: evaluation.fitness.cost(),
            cost_standard_error: error_of(evaluation),
            costs: if course.objectives.len() > 1 { evaluation.fitness.costs.clone() } else { Vec::new() },
            replicates: evaluation.replicates,
            is_confirmed: !evaluation.stage.is_search(),
            confirm_cost: confirmed.map(|confirmed| confirmed.fitness.cost()),
            confirm_cost_standard_error: confirmed.and_then(error_of),
            search_cost: search.map(|search| search.fitness.cost()),
            search_cost_standard_error: search.and_then(error_of),
            violation: evaluation.fitness.violation,
            limits: (course.limits)(evaluation),
            replicate_seed: self.seed_of_first_replicate(evaluation),
            parameters: named_parameters(&course.parameters, &evaluation.candidate.values),
            readable: readable_parameters(&course.parameters, &evaluation.candidate.values),
            settings: (course.settings)(&evaluation.candidate),
            quantities: Named(quantities.collect()),
        }
    }
}

fn allowed(course: &Course<'_>, stage: Stage) -> Option<u64> {
    course.planned.iter().find(|(planned, _)| *planned == stage).map(|(_, candidates)| *candidates)
}

fn named_parameters(axes: &[Axis], values: &[f64]) -> Named {
    let value = |axis: &Axis, value: f64| {
        if axis.is_numeric() { Json::from(axis.number(value)) } else { Json::from(axis.label(value)) }
    };
    Named(axes.iter().zip(values).map(|(axis, &is)| (axis.column(), value(axis, is))).collect())
}

fn readable_parameters(axes: &[Axis], values: &[f64]) -> Vec<String> {
    axes.iter()
        .zip(values)
        .map(|(axis, &value)| format!("{} = {}", axis.name, axis.readable(value)))
        .collect()
}
