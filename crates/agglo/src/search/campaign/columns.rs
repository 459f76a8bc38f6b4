//! The tables of searches and studies: a line declares a column that all of them have. Columns of costs, parameters and
//! outcomes, which each campaign has of its own, follow them.

use super::archive::Evaluation;
use super::records::error_of;
use crate::folder::names;
use crate::record::columns::{Table, Tables, count, count_or_none, number_or_none, word};

/// Candidates.
#[rustfmt::skip]
pub static EVALUATIONS: Table<Evaluation> = Table { file: names::EVALUATIONS, columns: &[
    count("evaluation", "evaluation", "its number, from zero", |one: &Evaluation| one.number),
    count("generation", "generation", "number of its batch, from zero", |one: &Evaluation| one.generation),
    word("stage", "stage", "`search`, `polish`, `confirm` or `final`", |one: &Evaluation| one.stage.word()),
    word("status", "status", "`ok`, `infeasible`, `failed` or `excluded`", |one: &Evaluation| one.status.word()),
    count("replicates", "replicates", "random replicates that count", |one: &Evaluation| u64::from(one.replicates)),
    count_or_none("repeats", "repeats", "the earlier evaluation with the same values, whose replicates these are", |one: &Evaluation| one.repeats),
    number_or_none("violation", "", "violation", "by how much it misses the limits", |one: &Evaluation| finite(one.fitness.violation)),
] };

/// A replicate that counts.
pub struct ReplicateRow {
    /// Number of its evaluation.
    pub evaluation: u64,
    /// Its number.
    pub replicate: u32,
    /// Its seed.
    pub seed: u64,
}

/// Simulations that count.
#[rustfmt::skip]
pub static RUNS: Table<ReplicateRow> = Table { file: names::RUNS, columns: &[
    count("evaluation", "evaluation", "number of the candidate's", |run: &ReplicateRow| run.evaluation),
    count("replicate", "replicate", "its number, from zero", |run: &ReplicateRow| u64::from(run.replicate)),
    count("seed", "seed", "of the simulation", |run: &ReplicateRow| run.seed),
] };

/// A batch that was evaluated, with sums over all so far.
pub struct GenerationRow {
    /// Its number.
    pub generation: u64,
    /// What it was for.
    pub stage: &'static str,
    /// Evaluations, runs, failures, candidates that were not run, and those that miss a limit, so far.
    pub sums: [u64; 5],
    /// Lowest and mean cost of those of the batch that keep the limits.
    pub costs: [Option<f64>; 2],
    /// The best so far.
    pub best: Option<Standing>,
}

/// Generations.
#[rustfmt::skip]
pub static GENERATIONS: Table<GenerationRow> = Table { file: names::GENERATIONS, columns: &[
    count("generation", "generation", "its number, from zero", |batch: &GenerationRow| batch.generation),
    word("stage", "stage", "`search`, `polish`, `confirm` or `final`", |batch: &GenerationRow| batch.stage),
    count("evaluations", "evaluations", "so far", |batch: &GenerationRow| batch.sums[0]),
    count("runs", "runs", "so far", |batch: &GenerationRow| batch.sums[1]),
    count("failures", "failures", "candidates that could not be run, so far", |batch: &GenerationRow| batch.sums[2]),
    count("excluded", "excluded", "candidates that miss a constraint between parameters and were not run, so far", |batch: &GenerationRow| batch.sums[3]),
    number_or_none("cost_lowest", "", "lowest cost", "of those of the generation that keep the limits", |batch: &GenerationRow| batch.costs[0]),
    number_or_none("cost_mean", "", "mean cost", "of the same", |batch: &GenerationRow| batch.costs[1]),
    count_or_none("best_evaluation", "best evaluation", "so far", |batch: &GenerationRow| Some(batch.best.as_ref()?.number)),
    number_or_none("best_cost", "", "its cost", "", |batch: &GenerationRow| batch.best.as_ref()?.cost),
    number_or_none("best_cost_standard_error", "", "standard error of its cost", "", |batch: &GenerationRow| batch.best.as_ref()?.error),
    number_or_none("best_violation", "", "its violation", "by how much it misses the limits", |batch: &GenerationRow| batch.best.as_ref()?.violation),
    count("infeasible", "infeasible", "candidates of the search that miss a limit, so far", |batch: &GenerationRow| batch.sums[4]),
] };

/// A candidate that could not be run.
pub struct Failure {
    /// The replicate of it that failed.
    pub run: ReplicateRow,
    /// Why.
    pub reason: String,
}

/// Failures.
#[rustfmt::skip]
pub static FAILURES: Table<Failure> = Table { file: names::FAILURES, columns: &[
    count("evaluation", "evaluation", "number of the candidate's", |failure: &Failure| failure.run.evaluation),
    count("replicate", "replicate", "the one that failed", |failure: &Failure| u64::from(failure.run.replicate)),
    count("seed", "seed", "of the simulation", |failure: &Failure| failure.run.seed),
    word("reason", "reason", "what the simulation said", |failure| &failure.reason),
] };

/// How a candidate stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Standing {
    number: u64,
    cost: Option<f64>,
    error: Option<f64>,
    replicates: u64,
    violation: Option<f64>,
}

impl Standing {
    /// By its first cost.
    pub fn of(one: &Evaluation) -> Self {
        Self {
            number: one.number,
            cost: one.fitness.costs.first().copied(),
            error: error_of(one),
            replicates: u64::from(one.replicates),
            violation: finite(one.fitness.violation),
        }
    }
}

/// One of the best candidates.
pub struct BestRow {
    /// Its rank, from 1.
    pub rank: u64,
    /// As it was run again, or as the search saw it.
    pub evaluation: Standing,
    /// As the search saw it, if it did.
    pub search: Option<Standing>,
    /// As it was run once more after it was chosen.
    pub last: Option<Standing>,
}

/// The best candidates.
#[rustfmt::skip]
pub static BEST: Table<BestRow> = Table { file: names::BEST, columns: &[
    count("rank", "rank", "best first", |row: &BestRow| row.rank),
    count("evaluation", "evaluation", "as it was run again, or as the search saw it", |row: &BestRow| row.evaluation.number),
    number_or_none("cost", "", "cost", "", |row: &BestRow| row.evaluation.cost),
    number_or_none("cost_standard_error", "", "standard error of the cost", "", |row: &BestRow| row.evaluation.error),
    count("replicates", "replicates", "random replicates that count", |row: &BestRow| row.evaluation.replicates),
    number_or_none("violation", "", "violation", "by how much it misses the limits", |row: &BestRow| row.evaluation.violation),
    count_or_none("search_evaluation", "evaluation in the search", "", |row: &BestRow| Some(row.search?.number)),
    number_or_none("search_cost", "", "cost in the search", "too good where costs scatter", |row: &BestRow| row.search?.cost),
    number_or_none("search_cost_standard_error", "", "its standard error", "", |row: &BestRow| row.search?.error),
    count_or_none("search_replicates", "replicates in the search", "", |row: &BestRow| Some(row.search?.replicates)),
    count_or_none("final_evaluation", "last evaluation", "of the one that was chosen", |row: &BestRow| Some(row.last?.number)),
    number_or_none("final_cost", "", "last cost", "of replicates that had no part in choosing it", |row: &BestRow| row.last?.cost),
    number_or_none("final_cost_standard_error", "", "its standard error", "", |row: &BestRow| row.last?.error),
    count_or_none("final_replicates", "last replicates", "", |row: &BestRow| Some(row.last?.replicates)),
    number_or_none("final_violation", "", "last violation", "", |row: &BestRow| row.last?.violation),
] };

/// All of them.
pub const TABLES: Tables = &[&EVALUATIONS, &RUNS, &GENERATIONS, &FAILURES, &BEST];

/// Those that have columns of parameters or outcomes as well.
const SHARED: Tables = &[&EVALUATIONS, &RUNS, &BEST];

/// Whether one of them has a column of this name already.
pub fn is_taken(name: &str) -> bool {
    // Of costs there is one, or two with numbers; of studies each row has a target.
    ["cost_1", "cost_2", "target"].contains(&name) || SHARED.iter().any(|table| table.names().contains(&name))
}

fn finite(number: f64) -> Option<f64> {
    number.is_finite().then_some(number)
}
