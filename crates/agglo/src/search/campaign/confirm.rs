//! Which of the best candidates is the best, by starts that the search has not seen.
//!
//! The lowest of many scattered costs is low by luck as well. So the best are run again with fresh starts, the one with
//! the lowest fresh mean is taken, and that mean is reported beside the cost that the search saw.

use serde_json::Value as Json;

use super::archive::{Evaluation, Stage};
use super::conduct::{Conductor, Course, Stop};
use super::records::error_of;
use super::summary::{Best, CampaignSummary, FrontPoint, Named};
use crate::search::optimiser::Point;
use crate::search::{Axis, Candidate, Model};

/// Where the best candidate stands in the archive.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chosen {
    /// Its evaluation, with fresh starts if it was confirmed.
    pub at: usize,
    /// Its evaluation in the search.
    pub search: Option<usize>,
}

impl<M: Model> Conductor<'_, M> {
    /// Runs the best candidates with fresh starts, writes them down in their order, and names the best.
    pub(super) fn confirm(
        &mut self,
        course: &Course<'_>,
        recommended: Option<Point>,
    ) -> Result<Option<Chosen>, Stop> {
        let searched: Vec<usize> = self.best_of_search(course);
        let Some(&best) = searched.first() else { return Ok(None) };
        if course.confirm.candidates == 0 || course.confirm.starts == 0 {
            let ranked: Vec<_> = searched.iter().map(|&at| (&self.archive.evaluations[at], None)).collect();
            self.records.best(self.folder(), &ranked)?;
            return Ok(Some(Chosen { at: best, search: Some(best) }));
        }
        let mut candidates: Vec<(Candidate, Option<usize>)> =
            searched.iter().map(|&at| (self.archive.evaluations[at].candidate.clone(), Some(at))).collect();
        let recommended = recommended.map(|point| self.candidate(&point));
        if let Some(new) = recommended.filter(|new| new.violation == 0.0)
            && candidates.iter().all(|(known, _)| known.values != new.values)
        {
            // The optimiser's own choice, which it need not have evaluated, goes before the last of the others.
            candidates.truncate((course.confirm.candidates as usize).max(2) - 1);
            let search = self.archive.evaluations.iter().position(|one| one.candidate.values == new.values);
            candidates.push((new, search));
        }
        let first = self.archive.evaluations.len();
        let (candidates, search): (Vec<_>, Vec<_>) = candidates.into_iter().unzip();
        self.generation(Stage::Confirm, candidates)?;
        let mut ranked: Vec<Chosen> =
            (first..).zip(search).map(|(at, search)| Chosen { at, search }).collect();
        let fitness = |chosen: &Chosen| &self.archive.evaluations[chosen.at].fitness;
        ranked.sort_by(|a, b| fitness(a).compare(fitness(b)));
        let evaluation = |at: usize| &self.archive.evaluations[at];
        let rows: Vec<_> =
            ranked.iter().map(|chosen| (evaluation(chosen.at), chosen.search.map(evaluation))).collect();
        self.records.best(self.folder(), &rows)?;
        // Where all fail with fresh starts, the search's best is all there is.
        let is_sound = |chosen: &&Chosen| evaluation(chosen.at).has_figures();
        let sound = ranked.iter().find(is_sound).copied();
        Ok(Some(sound.unwrap_or(Chosen { at: best, search: Some(best) })))
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
        };
        CampaignSummary {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            title: course.title.to_owned(),
            seed: course.seed,
            objectives: course.objectives.clone(),
            best: best.map(|best| self.best(course, best)),
            front: front.iter().map(point).collect(),
            generations: self.generations(),
            evaluations: self.archive.evaluations.len() as u64,
            runs: self.archive.runs,
            failures: self.archive.failures,
            excluded: self.archive.excluded,
            noise: self.archive.noise(),
            findings: (course.findings)(&self.archive.evaluations),
            wall_s: 0.0,
        }
    }

    fn best(&self, course: &Course<'_>, best: Chosen) -> Best {
        let evaluation = &self.archive.evaluations[best.at];
        let search =
            best.search.map(|at| &self.archive.evaluations[at]).filter(|search| search.has_figures());
        let figures = evaluation.mean_figures().into_iter().map(Json::from);
        let figures = self.columns().iter().cloned().zip(figures);
        Best {
            evaluation: evaluation.number,
            cost: evaluation.fitness.cost(),
            cost_standard_error: error_of(evaluation),
            costs: if course.objectives.len() > 1 { evaluation.fitness.costs.clone() } else { Vec::new() },
            starts: evaluation.starts,
            is_confirmed: evaluation.stage == Stage::Confirm,
            search_cost: search.map(|search| search.fitness.cost()),
            search_cost_standard_error: search.and_then(error_of),
            violation: evaluation.fitness.violation,
            start_seed: self.seed_of_first_start(evaluation),
            parameters: named_parameters(&course.parameters, &evaluation.candidate.values),
            readable: readable_parameters(&course.parameters, &evaluation.candidate.values),
            settings: (course.settings)(&evaluation.candidate),
            figures: Named(figures.collect()),
        }
    }
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
