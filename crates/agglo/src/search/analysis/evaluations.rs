//! The evaluations of a search or study as plain data.

use super::{Axis, Level, Moments, Replicates};

/// All evaluations of a search or study, in their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Evaluations {
    /// One line that says what it is.
    pub title: String,
    /// What was varied. Choices between numbers are quantities; `labels` are for choices between words.
    pub parameters: Vec<Axis>,
    /// What was to be small or large: none, one or two.
    pub objectives: Vec<Objective>,
    /// Quantities of each replicate that the tables show.
    pub measures: Vec<Axis>,
    /// Whether replicate k of all candidates has the same seed.
    pub replicates: Replicates,
    /// The evaluations.
    pub rows: Vec<EvaluationRow>,
}

/// What was to be small or large.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Objective {
    /// The quantity.
    pub axis: Axis,
    /// Whether it was to be large: its cost is minus its value.
    pub is_to_be_large: bool,
}

/// What tables and pictures show of candidates: an objective with its own sign, or a measure that is none.
#[derive(Clone, Copy, Debug)]
pub struct Target<'a> {
    /// The quantity.
    pub axis: &'a Axis,
    source: Source,
}

#[derive(Clone, Copy, Debug)]
enum Source {
    /// Number of the objective, and its sign.
    Objective(usize, f64),
    /// Number of the measure.
    Measure(usize),
}

/// One candidate and what came of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EvaluationRow {
    /// Its point of the unit cube.
    pub point: Vec<f64>,
    /// Values of the parameters: numbers in SI units; of words the number in the list.
    pub values: Vec<f64>,
    /// Mean costs, one for each objective; none if it failed.
    pub costs: Vec<f64>,
    /// Their standard errors; not numbers where they are not known.
    pub standard_errors: Vec<f64>,
    /// Costs of each replicate: `replicate_costs[replicate][objective]`; may be left empty in a search.
    pub replicate_costs: Vec<Vec<f64>>,
    /// What came of it.
    pub status: Status,
    /// In which batch of proposals it was, from 0.
    pub generation: u32,
    /// Measures of each replicate: `replicates[replicate][measure]`; may be left empty in a search.
    pub replicates: Vec<Vec<f64>>,
}

/// What came of a candidate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Status {
    /// It keeps all limits.
    #[default]
    Feasible,
    /// It misses a limit of the outcome.
    Infeasible,
    /// A replicate of it failed.
    Failed,
    /// It misses a constraint between parameters and was not run.
    Excluded,
}

/// Costs up to the end of a generation.
#[derive(Clone, Debug, PartialEq)]
pub struct Generation {
    /// Its number, from 0.
    pub number: u32,
    /// Row of the best candidate so far; none while there is none that keeps the limits.
    pub best: Option<usize>,
    /// Least, median and largest first cost of the generation's feasible candidates; not numbers if there are none.
    pub costs: [f64; 3],
    /// Their mean.
    pub mean: f64,
}

impl EvaluationRow {
    /// First cost of a candidate that keeps all limits.
    pub fn feasible_cost(&self) -> Option<f64> {
        self.costs.first().copied().filter(|cost| self.status == Status::Feasible && cost.is_finite())
    }

    /// Moments over the replicates of the measure with this number.
    pub fn measure(&self, number: usize) -> Moments {
        let values: Vec<f64> =
            self.replicates.iter().filter_map(|replicate| replicate.get(number).copied()).collect();
        Moments::of(&values)
    }

    /// Values of a target in each replicate.
    pub fn values(&self, target: &Target<'_>) -> Vec<f64> {
        match target.source {
            Source::Objective(number, sign) => {
                self.replicate_costs.iter().filter_map(|costs| Some(sign * costs.get(number)?)).collect()
            }
            Source::Measure(number) => {
                self.replicates.iter().filter_map(|replicate| replicate.get(number).copied()).collect()
            }
        }
    }

    /// Mean and standard error of a target. None if the candidate failed.
    fn target(&self, target: &Target<'_>) -> Option<[f64; 2]> {
        if self.status == Status::Failed || self.status == Status::Excluded {
            return None;
        }
        let pair = match target.source {
            Source::Objective(number, sign) => [
                sign * self.costs.get(number)?,
                self.standard_errors.get(number).copied().unwrap_or(f64::NAN),
            ],
            Source::Measure(number) => {
                let moments = self.measure(number);
                [moments.mean, moments.standard_error()]
            }
        };
        pair[0].is_finite().then_some(pair)
    }
}

impl Objective {
    /// 1, or -1 where it was to be large: its value is so many times its cost.
    pub fn sign(&self) -> f64 {
        if self.is_to_be_large { -1.0 } else { 1.0 }
    }
}

impl Evaluations {
    /// Objectives, then the measures that are none of them.
    pub fn targets(&self) -> Vec<Target<'_>> {
        let objectives = self.objectives.iter().enumerate().map(|(number, objective)| Target {
            axis: &objective.axis,
            source: Source::Objective(number, objective.sign()),
        });
        let is_new =
            |axis: &Axis| self.objectives.iter().all(|objective| objective.axis.column() != axis.column());
        let measures = self.measures.iter().enumerate().filter(|(_, axis)| is_new(axis));
        let measures = measures.map(|(number, axis)| Target { axis, source: Source::Measure(number) });
        objectives.chain(measures).collect()
    }

    /// Mean and standard error of a target for all rows; none for those that failed.
    pub fn target(&self, target: &Target<'_>) -> Vec<Option<[f64; 2]>> {
        self.rows.iter().map(|row| row.target(target)).collect()
    }

    /// Levels of a refinement study for one target, from coarse to fine, and the fineness of each; failed ones are left out.
    ///
    /// Where the parameter rises (rays, grains) the size is 1 over it, where it falls (steps) the parameter itself; of words
    /// there are no sizes, and the order is then not known. Where levels share their replicates, only those count that all
    /// levels have, so that all have met the same luck.
    pub fn levels(&self, target: &Target<'_>) -> (Vec<Level>, Vec<f64>) {
        let is_word = self.parameters.first().is_some_and(|axis| !axis.labels.is_empty());
        let fineness = |row: &EvaluationRow| row.values.first().copied().unwrap_or(f64::NAN);
        let ends = self.rows.first().zip(self.rows.last());
        let rises = ends.is_some_and(|(first, last)| fineness(last) > fineness(first));
        let size = |row: &EvaluationRow| match (is_word, rises) {
            (true, _) => f64::NAN,
            (false, true) => 1.0 / fineness(row),
            (false, false) => fineness(row),
        };
        let whole = self.rows.iter().filter(|row| row.target(target).is_some());
        let level =
            |row: &EvaluationRow| (Level { size: size(row), replicates: row.values(target) }, fineness(row));
        let (mut levels, fineness): (Vec<Level>, Vec<f64>) = whole.map(level).unzip();
        if self.replicates == Replicates::Shared {
            let fewest = levels.iter().map(|level| level.replicates.len()).min().unwrap_or(0);
            let is_known =
                |replicate: &usize| levels.iter().all(|level| level.replicates[*replicate].is_finite());
            let common: Vec<usize> = (0..fewest).filter(is_known).collect();
            for level in &mut levels {
                level.replicates = common.iter().map(|replicate| level.replicates[*replicate]).collect();
            }
        }
        (levels, fineness)
    }

    /// Rows that keep all limits, with their first costs, from the best to the worst; equal ones in the order of evaluation.
    pub fn ranked(&self) -> Vec<(usize, f64)> {
        let costs = self.rows.iter().enumerate().map(|(row, one)| (row, one.feasible_cost()));
        let mut ranked: Vec<(usize, f64)> = costs.filter_map(|(row, cost)| Some((row, cost?))).collect();
        ranked.sort_by(|a, b| a.1.total_cmp(&b.1));
        ranked
    }

    /// How costs went from generation to generation.
    pub fn generations(&self) -> Vec<Generation> {
        let last = self.rows.iter().map(|row| row.generation).max();
        let mut batches: Vec<Vec<usize>> = vec![Vec::new(); last.map_or(0, |last| last as usize + 1)];
        for (number, row) in self.rows.iter().enumerate() {
            batches[row.generation as usize].push(number);
        }
        let mut best: Option<(usize, f64)> = None;
        let of = |(number, batch): (usize, &Vec<usize>)| {
            let costs = batch.iter().filter_map(|&row| Some((row, self.rows[row].feasible_cost()?)));
            let mut sorted: Vec<(usize, f64)> = costs.collect();
            sorted.sort_by(|a, b| a.1.total_cmp(&b.1));
            if let Some(&first) = sorted.first()
                && best.is_none_or(|(_, cost)| first.1 < cost)
            {
                best = Some(first);
            }
            let costs: Vec<f64> = sorted.into_iter().map(|(_, cost)| cost).collect();
            Generation {
                number: number as u32,
                best: best.map(|(row, _)| row),
                costs: [
                    costs.first().copied().unwrap_or(f64::NAN),
                    median(&costs),
                    costs.last().copied().unwrap_or(f64::NAN),
                ],
                mean: costs.iter().sum::<f64>() / costs.len() as f64,
            }
        };
        batches.iter().enumerate().map(of).collect()
    }

    /// Rows that no other feasible row beats in both costs, in the order of the first cost.
    pub fn front(&self) -> Vec<usize> {
        let feasible = |row: &EvaluationRow| row.feasible_cost().is_some() && row.costs.len() == 2;
        let mut rows: Vec<usize> = (0..self.rows.len()).filter(|&row| feasible(&self.rows[row])).collect();
        let cost = |row: usize, number: usize| self.rows[row].costs[number];
        rows.sort_by(|&a, &b| cost(a, 0).total_cmp(&cost(b, 0)).then(cost(a, 1).total_cmp(&cost(b, 1))));
        let mut least = f64::INFINITY;
        rows.retain(|&row| {
            let is_better = cost(row, 1) < least;
            least = least.min(cost(row, 1));
            is_better
        });
        rows
    }
}

/// Median of sorted numbers; not a number if there are none.
fn median(sorted: &[f64]) -> f64 {
    let middle = sorted.len() / 2;
    match sorted.len() {
        0 => f64::NAN,
        count if count % 2 == 1 => sorted[middle],
        _ => 0.5 * (sorted[middle - 1] + sorted[middle]),
    }
}
