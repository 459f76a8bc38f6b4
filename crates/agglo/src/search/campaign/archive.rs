//! All that was evaluated.

use crate::search::analysis::Moments;
use crate::search::student::quantile;
use crate::search::{Candidate, Fitness};

use super::summary::Noise;

/// What an evaluation was for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// The search itself, or the plan of a study.
    Search,
    /// Improving the best of the search.
    Polish,
    /// Fresh replicates for the best.
    Confirm,
    /// Further fresh replicates for the one that was chosen by these.
    Final,
    /// The run of the best and what is made of all that is known.
    Close,
}

impl Stage {
    /// Whether its evaluations are compared with one another to find the best.
    pub fn is_search(self) -> bool {
        matches!(self, Self::Search | Self::Polish)
    }

    /// Its word in tables.
    pub fn word(self) -> &'static str {
        match self {
            Self::Search => "search",
            Self::Polish => "polish",
            Self::Confirm => "confirm",
            Self::Final => "final",
            Self::Close => "close",
        }
    }
}

/// How an evaluation ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// It keeps all limits.
    Ok,
    /// It misses a limit.
    Infeasible,
    /// It misses a constraint between parameters and was not run.
    Excluded,
    /// A replicate failed.
    Failed,
}

impl Status {
    /// Its word in tables.
    pub fn word(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::Infeasible => "infeasible",
            Self::Excluded => "excluded",
            Self::Failed => "failed",
        }
    }
}

/// A candidate and how good it is.
#[derive(Clone, Debug)]
pub struct Evaluation {
    /// Its number, from 0.
    pub number: u64,
    /// What it was for.
    pub stage: Stage,
    /// Number of its batch, from 0.
    pub generation: u64,
    /// What was evaluated.
    pub candidate: Candidate,
    /// How it ended.
    pub status: Status,
    /// Random replicates that count.
    pub replicates: u32,
    /// Number of the earlier evaluation with the same values, whose replicates these are.
    pub repeats: Option<u64>,
    /// How good it is.
    pub fitness: Fitness,
    /// Quantities of its replicates that count, one for each column of the model: `[replicates][columns]`.
    pub quantities: Vec<Vec<f64>>,
    /// Costs of its replicates that count: `[replicates][objectives]`.
    pub costs: Vec<Vec<f64>>,
}

impl Evaluation {
    /// Whether it has quantities.
    pub fn has_quantities(&self) -> bool {
        matches!(self.status, Status::Ok | Status::Infeasible)
    }

    /// Standard errors of its mean costs; not numbers from a single replicate.
    pub fn standard_errors(&self) -> Vec<f64> {
        let known = |error: &f64| if self.replicates > 1 { *error } else { f64::NAN };
        self.fitness.standard_errors.iter().map(known).collect()
    }

    /// Means of its quantities over its replicates, one for each column of the model; empty if it failed.
    pub fn mean_quantities(&self) -> Vec<f64> {
        let replicates = if self.has_quantities() { self.quantities.as_slice() } else { &[] };
        let columns = replicates.first().map_or(0, Vec::len);
        let mean = |k: usize| {
            replicates.iter().map(|quantities| quantities[k]).sum::<f64>() / replicates.len() as f64
        };
        (0..columns).map(mean).collect()
    }
}

/// All that was evaluated, and counts of it.
#[derive(Debug, Default)]
pub struct Archive {
    /// In the order of their numbers.
    pub evaluations: Vec<Evaluation>,
    /// Replicates that count.
    pub runs: u64,
    /// Candidates that failed.
    pub failures: u64,
    /// Candidates that were not run.
    pub excluded: u64,
    /// Candidates of search and polish that miss a limit.
    pub infeasible: u64,
    /// Candidates whose values had been evaluated before.
    pub repeats: u64,
    /// What the stages have come to.
    pub spent: Spent,
    /// The best of search and polish.
    best: Option<usize>,
    scatter: Scatter,
}

/// Candidates and replicates of each stage, in the order of the stages.
#[derive(Clone, Debug, Default)]
pub struct Spent(pub Vec<(Stage, u64, u64)>);

impl Spent {
    fn add(&mut self, evaluation: &Evaluation, replicates: u64) {
        match self.0.last_mut().filter(|(stage, ..)| *stage == evaluation.stage) {
            Some((_, candidates, runs)) => (*candidates, *runs) = (*candidates + 1, *runs + replicates),
            None => self.0.push((evaluation.stage, 1, replicates)),
        }
    }
}

/// Costs of the replicates of all candidates about their means.
#[derive(Clone, Copy, Debug, Default)]
struct Scatter {
    squares: f64,
    freedom: u64,
    replicates: u64,
    candidates: u64,
}

impl Scatter {
    fn add(&mut self, costs: &Moments) {
        let replicates = costs.count as u64;
        if replicates > 1 {
            self.squares += costs.standard_deviation * costs.standard_deviation * (replicates - 1) as f64;
            self.freedom += replicates - 1;
        }
        self.replicates += replicates;
        self.candidates += 1;
    }
}

impl Archive {
    /// Adds an evaluation.
    pub fn add(&mut self, evaluation: Evaluation) {
        let new = if evaluation.repeats.is_some() { 0 } else { u64::from(evaluation.replicates) };
        self.runs += new;
        self.repeats += u64::from(evaluation.repeats.is_some());
        self.infeasible += u64::from(evaluation.status == Status::Infeasible && evaluation.stage.is_search());
        self.spent.add(&evaluation, new);
        self.failures += u64::from(evaluation.status == Status::Failed);
        self.excluded += u64::from(evaluation.status == Status::Excluded);
        let costs: Vec<f64> = evaluation.costs.iter().filter_map(|costs| costs.first().copied()).collect();
        if evaluation.has_quantities() && !costs.is_empty() && evaluation.repeats.is_none() {
            self.scatter.add(&Moments::of(&costs));
        }
        let is_better = |best: usize| evaluation.fitness.compare(&self.evaluations[best].fitness).is_lt();
        let counts = evaluation.stage.is_search() && !evaluation.fitness.is_failure();
        if counts && self.best.is_none_or(is_better) {
            self.best = Some(self.evaluations.len());
        }
        self.evaluations.push(evaluation);
    }

    /// The evaluation of this number, if it is here: a part of a study has some of them.
    pub fn numbered(&self, number: u64) -> Option<&Evaluation> {
        let at = self.evaluations.binary_search_by_key(&number, |evaluation| evaluation.number).ok()?;
        Some(&self.evaluations[at])
    }

    /// The best of search and polish.
    pub fn best(&self) -> Option<&Evaluation> {
        self.best.map(|best| &self.evaluations[best])
    }

    /// The best of search and polish, best first, each set of values once.
    pub fn ranked(&self, most: usize) -> Vec<&Evaluation> {
        let mut all = self.with_costs();
        // The sort is stable: of equals the first one evaluated comes first.
        all.sort_by(|a, b| a.fitness.compare(&b.fitness));
        let mut ranked: Vec<&Evaluation> = Vec::with_capacity(most.min(all.len()));
        for evaluation in all {
            if ranked.len() >= most {
                break;
            }
            if ranked.iter().all(|better| better.candidate.values != evaluation.candidate.values) {
                ranked.push(evaluation);
            }
        }
        ranked
    }

    fn with_costs(&self) -> Vec<&Evaluation> {
        let all = self.evaluations.iter();
        all.filter(|one| one.stage.is_search() && !one.fitness.is_failure()).collect()
    }

    /// Those that no other dominates, in the order of their first cost, each set of values once.
    pub fn front(&self) -> Vec<&Evaluation> {
        let mut front: Vec<&Evaluation> = Vec::new();
        for evaluation in self.with_costs() {
            let is_beaten = |other: &&Evaluation| {
                other.fitness.dominates(&evaluation.fitness)
                    || other.candidate.values == evaluation.candidate.values
            };
            if !front.iter().any(is_beaten) {
                front.retain(|other| !evaluation.fitness.dominates(&other.fitness));
                front.push(evaluation);
            }
        }
        front.sort_by(|a, b| a.fitness.cost().total_cmp(&b.fitness.cost()));
        front
    }

    /// How much of the differences between candidates may be chance.
    pub fn noise(&self) -> Noise {
        let Scatter { squares, freedom, replicates, candidates } = self.scatter;
        let replicates_mean = (candidates > 0).then(|| replicates as f64 / candidates as f64);
        let deviation = (freedom > 0).then(|| (squares / freedom as f64).sqrt());
        let difference = deviation
            .zip(replicates_mean)
            .map(|(deviation, replicates)| quantile(0.95, freedom) * deviation * (2.0 / replicates).sqrt());
        Noise { replicate_deviation: deviation, replicates_mean, significant_difference: difference }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With these mean costs, and these first costs of its replicates.
    fn scattered(number: u64, costs: &[f64], replicates: &[f64]) -> Evaluation {
        let costs_of_replicates = replicates.iter().map(|cost| vec![*cost]).collect();
        Evaluation { costs: costs_of_replicates, ..evaluation(number, costs) }
    }

    fn evaluation(number: u64, costs: &[f64]) -> Evaluation {
        let candidate = Candidate { point: vec![0.5], values: vec![number as f64], violation: 0.0 };
        let fitness = if costs.is_empty() { Fitness::failed() } else { Fitness::new(costs.to_vec()) };
        let status = if costs.is_empty() { Status::Failed } else { Status::Ok };
        let (stage, generation, replicates) = (Stage::Search, 0, 3);
        let (quantities, costs) = (Vec::new(), Vec::new());
        let repeats = None;
        Evaluation {
            number,
            stage,
            generation,
            candidate,
            status,
            replicates,
            repeats,
            fitness,
            quantities,
            costs,
        }
    }

    fn archive(costs: &[&[f64]]) -> Archive {
        let mut archive = Archive::default();
        for (number, costs) in (0..).zip(costs) {
            archive.add(evaluation(number, costs));
        }
        archive
    }

    fn numbers(evaluations: &[&Evaluation]) -> Vec<u64> {
        evaluations.iter().map(|evaluation| evaluation.number).collect()
    }

    #[test]
    fn best_first_without_failures() {
        let archive = archive(&[&[3.0], &[], &[1.0], &[2.0], &[1.0]]);
        assert_eq!(archive.best().map(|best| best.number), Some(2));
        assert_eq!(numbers(&archive.ranked(3)), [2, 4, 3]);
        assert_eq!((archive.runs, archive.failures), (15, 1));
    }

    #[test]
    fn the_front_is_what_nothing_beats() {
        let archive = archive(&[&[3.0, 1.0], &[3.0, 2.0], &[1.0, 4.0], &[], &[2.0, 2.0], &[2.5, 2.0]]);
        assert_eq!(numbers(&archive.front()), [2, 4, 0]);
    }

    /// Two candidates with 3 and 2 replicates: squares 2 and 0.5 on 2 + 1 degrees of freedom: s = √(2.5/3); 2.5 replicates in
    /// the mean; t(95 %, 3) = 3.182446: the difference is 3.182446 s √(2/2.5).
    #[test]
    fn the_noise_floor_by_hand() {
        let mut archive = Archive::default();
        archive.add(scattered(0, &[2.0], &[1.0, 2.0, 3.0]));
        archive.add(scattered(1, &[0.5], &[0.0, 1.0]));
        archive.add(scattered(2, &[], &[]));
        let noise = archive.noise();
        let deviation = (2.5_f64 / 3.0).sqrt();
        assert_eq!(noise.replicates_mean, Some(2.5));
        // Round-off of a root and its square.
        assert_near!(noise.replicate_deviation.unwrap(), deviation, 1e-15);
        let difference = noise.significant_difference.unwrap();
        // The table's t has seven digits.
        assert!((difference / (3.182_446 * deviation * 0.8_f64.sqrt()) - 1.0).abs() < 1e-6, "{difference}");
        assert_eq!(Archive::default().noise(), Noise::default());
    }
}
