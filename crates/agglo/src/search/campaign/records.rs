//! What is written of each evaluation, as the columns of [`super::columns`] have it.

use std::path::Path;

use super::archive::{Archive, Evaluation, Stage, Status};
use super::columns::{BEST, BestRow, EVALUATIONS, FAILURES, Failure, GENERATIONS, GenerationRow, RUNS};
use super::columns::{ReplicateRow, Standing};
use super::tables::Table;
use crate::record::RecordError;
use crate::record::columns::{Cell, Declared};
use crate::search::Axis;

/// The tables that grow while a campaign goes on.
#[derive(Debug)]
pub struct Records {
    parameters: Vec<Axis>,
    objectives: usize,
    /// How many quantities are shown.
    shown: usize,
    evaluations: Table,
    runs: Table,
    generations: Table,
    failures: Table,
}

/// A replicate that counts.
#[derive(Clone, Copy, Debug)]
pub struct Replicate<'a> {
    /// Its number.
    pub number: u32,
    /// Its seed.
    pub seed: u64,
    /// Its costs.
    pub costs: &'a [f64],
    /// Its quantities.
    pub quantities: &'a [f64],
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
        let costs = cost_names(objectives);
        let errors = costs.iter().map(|name| format!("{name}_standard_error"));
        let of_candidates = costs.iter().cloned().chain(errors).chain(parameters.iter().map(Axis::column));
        let begin = |table: &dyn Declared, more: Vec<String>| Table::begin(folder, table, &more);
        Ok(Self {
            parameters: parameters.to_vec(),
            objectives,
            shown: columns.len(),
            evaluations: begin(&EVALUATIONS, of_candidates.chain(columns.iter().cloned()).collect())?,
            runs: begin(&RUNS, costs.iter().chain(columns).cloned().collect())?,
            generations: begin(&GENERATIONS, Vec::new())?,
            failures: begin(&FAILURES, Vec::new())?,
        })
    }

    /// Writes an evaluation.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn evaluation(&mut self, evaluation: &Evaluation) -> Result<(), RecordError> {
        let (quantities, errors) = (evaluation.mean_quantities(), evaluation.standard_errors());
        let known = |quantities: &[f64], k: usize| number(quantities.get(k).copied());
        let mut more = Vec::new();
        for of_it in [&evaluation.fitness.costs, &errors] {
            more.extend((0..self.objectives).map(|k| known(of_it, k)));
        }
        let values = parameters(&self.parameters, &evaluation.candidate.values);
        more.extend(values.iter().map(Value::cell));
        more.extend((0..self.shown).map(|k| known(&quantities, k)));
        self.evaluations.put(EVALUATIONS.columns, evaluation, more)
    }

    /// Writes a replicate that counts.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn replicate(&mut self, evaluation: u64, replicate: &Replicate<'_>) -> Result<(), RecordError> {
        let costs = replicate.costs.iter().take(self.objectives).map(|cost| Cell::Number(*cost));
        let quantities = replicate.quantities.iter().take(self.shown).map(|quantity| number(Some(*quantity)));
        let row = ReplicateRow { evaluation, replicate: replicate.number, seed: replicate.seed };
        self.runs.put(RUNS.columns, &row, costs.chain(quantities))
    }

    /// Writes a failure.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn failure(
        &mut self,
        evaluation: u64,
        replicate: u32,
        seed: u64,
        reason: &str,
    ) -> Result<(), RecordError> {
        let failure =
            Failure { run: ReplicateRow { evaluation, replicate, seed }, reason: reason.to_owned() };
        self.failures.put(FAILURES.columns, &failure, [])
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
        let mean = (!costs.is_empty()).then(|| costs.iter().sum::<f64>() / costs.len() as f64);
        let Archive { runs, failures, excluded, infeasible, .. } = archive;
        let row = GenerationRow {
            generation,
            stage: stage.word(),
            sums: [archive.evaluations.len() as u64, *runs, *failures, *excluded, *infeasible],
            costs: [costs.iter().copied().reduce(f64::min), mean],
            best: archive.best().filter(|_| self.objectives > 0).map(Standing::of),
        };
        self.generations.put(GENERATIONS.columns, &row, [])
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
        let names: Vec<String> = self.parameters.iter().map(Axis::column).collect();
        let mut table = Table::begin(folder, &BEST, &names)?;
        for (rank, Ranked { evaluation, search, last }) in (1..).zip(ranked) {
            let row = BestRow {
                rank,
                evaluation: Standing::of(evaluation),
                search: search.map(Standing::of),
                last: last.map(Standing::of),
            };
            let values = parameters(&self.parameters, &evaluation.candidate.values);
            table.put(BEST.columns, &row, values.iter().map(Value::cell))?;
        }
        table.flush()
    }
}

/// The standard error of its first cost; nothing from a single replicate, of which none is known.
pub(super) fn error_of(evaluation: &Evaluation) -> Option<f64> {
    evaluation.standard_errors().first().copied().filter(|error| error.is_finite())
}

/// A number as far as it is one.
fn number(value: Option<f64>) -> Cell<'static> {
    value.filter(|value| value.is_finite()).map_or(Cell::Unknown, Cell::Number)
}

/// The value of a parameter.
pub(super) enum Value {
    Number(f64),
    Word(String),
}

impl Value {
    pub(super) fn cell(&self) -> Cell<'_> {
        match self {
            Self::Number(value) => Cell::Number(*value),
            Self::Word(word) => Cell::Word(word),
        }
    }
}

pub(super) fn parameters(axes: &[Axis], values: &[f64]) -> Vec<Value> {
    let value = |(axis, value): (&Axis, &f64)| {
        if axis.is_numeric() { Value::Number(axis.number(*value)) } else { Value::Word(axis.label(*value)) }
    };
    axes.iter().zip(values).map(value).collect()
}

#[cfg(test)]
#[path = "records_tests.rs"]
mod tests;
