//! What is written of each evaluation: the columns of all tables are here.

use std::path::Path;

use super::archive::{Archive, Evaluation, Stage, Status};
use super::tables::Table;
use crate::record::RecordError;
use crate::search::Axis;

/// The tables that grow while a campaign goes on.
#[derive(Debug)]
pub struct Records {
    parameters: Vec<Axis>,
    objectives: usize,
    evaluations: Table,
    runs: Table,
    generations: Table,
    failures: Table,
}

/// A start that counts.
#[derive(Clone, Copy, Debug)]
pub struct Start<'a> {
    /// Its number.
    pub number: u32,
    /// Its seed.
    pub seed: u64,
    /// Its costs.
    pub costs: &'a [f64],
    /// Its figures.
    pub figures: &'a [f64],
}

/// One of the best candidates.
#[derive(Clone, Copy, Debug)]
pub struct Ranked<'a> {
    /// As it was run again, or as the search saw it.
    pub evaluation: &'a Evaluation,
    /// As the search saw it, if it did.
    pub search: Option<&'a Evaluation>,
    /// As it was run once more after it was chosen.
    pub last: Option<&'a Evaluation>,
}

/// `cost`, or `cost_1`, `cost_2` where there are several.
fn cost_names(objectives: usize) -> Vec<String> {
    if objectives <= 1 {
        vec!["cost".to_owned(); objectives]
    } else {
        (1..=objectives).map(|k| format!("cost_{k}")).collect()
    }
}

fn words(words: &[&str]) -> impl Iterator<Item = String> {
    words.iter().map(|word| (*word).to_owned())
}

impl Records {
    /// Begins the tables in the campaign's folder.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn create(
        folder: &Path,
        parameters: &[Axis],
        objectives: usize,
        columns: &[String],
    ) -> Result<Self, RecordError> {
        let names = cost_names(objectives);
        let errors = names.iter().map(|name| format!("{name}_standard_error"));
        let parameter_names = parameters.iter().map(Axis::column);
        let evaluations =
            words(&["evaluation", "generation", "stage", "status", "starts", "repeats", "violation"])
                .chain(names.iter().cloned())
                .chain(errors)
                .chain(parameter_names)
                .chain(columns.iter().cloned());
        let runs =
            words(&["evaluation", "start", "seed"]).chain(names.clone()).chain(columns.iter().cloned());
        let generations = [
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
        Ok(Self {
            parameters: parameters.to_vec(),
            objectives,
            evaluations: Table::create(&folder.join("evaluations.csv"), evaluations)?,
            runs: Table::create(&folder.join("runs.csv"), runs)?,
            generations: Table::create(&folder.join("generations.csv"), generations)?,
            failures: Table::create(&folder.join("failures.csv"), ["evaluation", "start", "seed", "reason"])?,
        })
    }

    /// Writes an evaluation.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn evaluation(&mut self, evaluation: &Evaluation, columns: usize) -> Result<(), RecordError> {
        let (fitness, figures) = (&evaluation.fitness, evaluation.mean_figures());
        let errors = evaluation.standard_errors();
        let table = &mut self.evaluations;
        table.count(evaluation.number);
        table.count(evaluation.generation);
        table.word(evaluation.stage.word());
        table.word(evaluation.status.word());
        table.count(u64::from(evaluation.starts));
        table.count(evaluation.repeats);
        table.number(fitness.violation.is_finite().then_some(fitness.violation));
        for known in [&fitness.costs, &errors] {
            (0..self.objectives).for_each(|k| table.number(finite(known.get(k).copied())));
        }
        parameters(table, &self.parameters, &evaluation.candidate.values);
        (0..columns).for_each(|k| table.number(finite(figures.get(k).copied())));
        table.end_row()
    }

    /// Writes a start that counts.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn start(&mut self, evaluation: u64, start: &Start<'_>) -> Result<(), RecordError> {
        let table = &mut self.runs;
        table.count(evaluation);
        table.count(u64::from(start.number));
        table.count(start.seed);
        start.costs.iter().take(self.objectives).for_each(|cost| table.number(*cost));
        start.figures.iter().for_each(|figure| table.number(finite(Some(*figure))));
        table.end_row()
    }

    /// Writes a failure.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn failure(
        &mut self,
        evaluation: u64,
        start: u32,
        seed: u64,
        reason: &str,
    ) -> Result<(), RecordError> {
        self.failures.count(evaluation);
        self.failures.count(u64::from(start));
        self.failures.count(seed);
        self.failures.word(reason);
        self.failures.end_row()
    }

    /// Writes what the archive holds after a generation, of which the last `count` evaluations are.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn generation(
        &mut self,
        (generation, stage): (u64, Stage),
        archive: &Archive,
        count: usize,
    ) -> Result<(), RecordError> {
        let of_it = &archive.evaluations[archive.evaluations.len() - count..];
        // Costs of those that miss a limit are no costs to be had.
        let kept = of_it.iter().filter(|one| one.status == Status::Ok && self.objectives > 0);
        let costs: Vec<f64> = kept.filter_map(|one| one.fitness.costs.first().copied()).collect();
        let table = &mut self.generations;
        table.count(generation);
        table.word(stage.word());
        for sum in [archive.evaluations.len() as u64, archive.runs, archive.failures, archive.excluded] {
            table.count(sum);
        }
        table.number(costs.iter().copied().reduce(f64::min));
        table.number((!costs.is_empty()).then(|| costs.iter().sum::<f64>() / costs.len() as f64));
        let best = archive.best().filter(|_| self.objectives > 0);
        table.count(best.map(|best| best.number));
        table.number(best.map(|best| best.fitness.cost()));
        table.number(best.and_then(error_of));
        table.number(best.map(|best| best.fitness.violation));
        table.count(archive.infeasible);
        table.end_row()
    }

    /// Hands all rows to the operating system.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn flush(&mut self) -> Result<(), RecordError> {
        let tables = [&mut self.evaluations, &mut self.runs, &mut self.generations, &mut self.failures];
        tables.into_iter().try_for_each(Table::flush)
    }

    /// Writes the best candidates with what they were in the search, best first, in one go.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn best(&self, folder: &Path, ranked: &[Ranked<'_>]) -> Result<(), RecordError> {
        let fixed = [
            "rank",
            "evaluation",
            "cost",
            "cost_standard_error",
            "starts",
            "violation",
            "search_evaluation",
            "search_cost",
            "search_cost_standard_error",
            "search_starts",
            "final_evaluation",
            "final_cost",
            "final_cost_standard_error",
            "final_starts",
            "final_violation",
        ];
        let columns = words(&fixed).chain(self.parameters.iter().map(Axis::column));
        let mut table = Table::create(&folder.join("best.csv"), columns)?;
        for (rank, Ranked { evaluation, search, last }) in (1..).zip(ranked) {
            let starts = |one: &Evaluation| u64::from(one.starts);
            let violation = |one: &Evaluation| finite(Some(one.fitness.violation));
            table.count(rank);
            table.count(evaluation.number);
            cost_with_error(&mut table, Some(evaluation));
            table.count(starts(evaluation));
            table.number(violation(evaluation));
            table.count(search.map(|search| search.number));
            cost_with_error(&mut table, *search);
            table.count(search.map(starts));
            table.count(last.map(|last| last.number));
            cost_with_error(&mut table, *last);
            table.count(last.map(starts));
            table.number(last.and_then(violation));
            parameters(&mut table, &self.parameters, &evaluation.candidate.values);
            table.end_row()?;
        }
        table.flush()
    }
}

fn cost_with_error(table: &mut Table, evaluation: Option<&Evaluation>) {
    table.number(evaluation.and_then(|evaluation| evaluation.fitness.costs.first().copied()));
    table.number(evaluation.and_then(error_of));
}

/// The standard error of its first cost; nothing from a single start, of which none is known.
pub(super) fn error_of(evaluation: &Evaluation) -> Option<f64> {
    finite(evaluation.standard_errors().first().copied())
}

fn finite(number: Option<f64>) -> Option<f64> {
    number.filter(|number| number.is_finite())
}

fn parameters(table: &mut Table, axes: &[Axis], values: &[f64]) {
    for (axis, value) in axes.iter().zip(values) {
        if axis.is_numeric() {
            table.number(axis.number(*value));
        } else {
            table.word(&axis.label(*value));
        }
    }
}

#[cfg(test)]
#[path = "records_tests.rs"]
mod tests;
