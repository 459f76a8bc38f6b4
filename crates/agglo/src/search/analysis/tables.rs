//! Tables of what a study says, as CSV text: a line declares a column that all studies of a kind have.

use super::refinement::{Convergence, Difference, Order, differences, observed_order, settled};
use super::{Axis, ElementaryEffects, Evaluations, Share, elementary_effects, variance_shares};
use crate::folder::names;
use crate::record::Rows;
use crate::record::columns::{Cell, Column, Declared, Table, count, number_or_none, word};
use crate::search::plan::Plan;

/// Mean, standard error, standard deviation and number of replicates of each measure, one line for each candidate; columns
/// `<measure>`, `<measure>_standard_error`, `<measure>_standard_deviation`.
pub fn measures_table(evaluations: &Evaluations) -> String {
    let mut header = vec!["evaluation".to_owned()];
    header.extend(evaluations.parameters.iter().map(Axis::column));
    header.push("replicates".to_owned());
    for axis in &evaluations.measures {
        let name = axis.column();
        header.extend([name.clone(), format!("{name}_standard_error"), format!("{name}_standard_deviation")]);
    }
    let mut lines = Lines::under(header.iter().map(String::as_str));
    for (at, row) in evaluations.rows.iter().enumerate() {
        let values = evaluations.parameters.iter().zip(&row.values).map(|(axis, value)| axis.cell(*value));
        let values: Vec<String> = values.collect();
        let mut cells = vec![Cell::Count(at as u64)];
        cells.extend(values.iter().map(|value| Cell::Word(value)));
        cells.push(Cell::Count(row.replicates.len() as u64));
        for measure in 0..evaluations.measures.len() {
            let moments = row.measure(measure);
            let quantities = [moments.mean, moments.standard_error(), moments.standard_deviation];
            cells.extend(quantities.map(|quantity| finite(quantity).map_or(Cell::Unknown, Cell::Number)));
        }
        lines.add(cells);
    }
    lines.into_text()
}

/// What a plan says: the names of its files and their CSV texts; none for plans that only try values.
///
/// `seed` is the one that the plan was started with.
pub fn study_tables(plan: &Plan, evaluations: &Evaluations, seed: u64) -> Vec<(&'static str, String)> {
    match plan {
        Plan::Grid(_) | Plan::List(_) => Vec::new(),
        Plan::Refinement(refinement) => vec![
            (REFINEMENT.file, convergence(evaluations, refinement.tolerance)),
            (DIFFERENCES.file, differences_of_levels(evaluations, refinement.tolerance)),
        ],
        Plan::Morris(_) => vec![(EFFECTS.file, effects(evaluations))],
        Plan::SobolIndices(indices) => {
            vec![(SHARES.file, shares(evaluations, indices.bootstraps, indices.level, seed))]
        }
    }
}

struct RefinementRow {
    target: String,
    settled_from: String,
    settling: &'static str,
    verdict: Convergence,
}

impl RefinementRow {
    fn order(&self, quantity: fn(&Order) -> f64) -> Option<f64> {
        match &self.verdict {
            Convergence::Converging(order) => finite(quantity(order)),
            _ => None,
        }
    }

    fn asymptotic(&self) -> &'static str {
        match self.verdict {
            Convergence::Converging(Order { is_asymptotic: Some(true), .. }) => "yes",
            Convergence::Converging(Order { is_asymptotic: Some(false), .. }) => "no",
            Convergence::Converging(Order { is_asymptotic: None, .. }) => "unknown",
            _ => "",
        }
    }
}

/// What refinement comes to, target by target.
#[rustfmt::skip]
static REFINEMENT: Table<RefinementRow> = Table { file: names::REFINEMENT, columns: &[
    word("target", "target", "an objective or a measure", |row| &row.target),
    word("settled_from", "settled from", "the level from which on all are settled", |row| &row.settled_from),
    word("settling", "settling", "verdict on the level before the finest", |row| row.settling),
    word("verdict", "verdict", "on convergence", |row| row.verdict.word()),
    number_or_none("order", "", "observed order", "", |row| row.order(|o| o.order)),
    number_or_none("order_standard_error", "", "its standard error", "", |row| row.order(|o| o.order_standard_error)),
    number_or_none("limit", "", "limit", "Richardson's extrapolation", |row| row.order(|o| o.limit)),
    number_or_none("limit_standard_error", "", "its standard error", "", |row| row.order(|o| o.limit_standard_error)),
    number_or_none("grid_convergence_index", "", "grid convergence index", "Roache's, in units of the target", |row| row.order(|o| o.uncertainty)),
    word("asymptotic", "asymptotic", "whether the levels before have the same order: `yes`, `no` or `unknown`", RefinementRow::asymptotic),
] };

fn convergence(evaluations: &Evaluations, tolerance: f64) -> String {
    let row = |target: &super::evaluations::Target<'_>| {
        let (levels, fineness) = evaluations.levels(target);
        let (from, settling) = settled(&differences(&levels, tolerance, evaluations.replicates));
        let from = from.map_or_else(String::new, |level| evaluations.parameters[0].cell(fineness[level]));
        RefinementRow {
            target: target.axis.column(),
            settled_from: from,
            settling: settling.word(),
            verdict: observed_order(&levels, evaluations.replicates),
        }
    };
    text(&REFINEMENT, evaluations.targets().iter().map(row))
}

struct DifferenceRow {
    target: String,
    replicates: u64,
    mean: f64,
    difference: Difference,
}

/// How far each level is from the finest one, with its interval. The level itself stands second.
#[rustfmt::skip]
static DIFFERENCES: Table<DifferenceRow> = Table { file: names::DIFFERENCES, columns: &[
    word("target", "target", "an objective or a measure", |row| &row.target),
    count("replicates", "replicates", "that count", |row: &DifferenceRow| row.replicates),
    number_or_none("mean", "", "mean", "over the replicates", |row| finite(row.mean)),
    number_or_none("difference", "", "difference", "the level less the finest", |row| finite(row.difference.value)),
    number_or_none("difference_standard_error", "", "its standard error", "", |row| finite(row.difference.standard_error)),
    number_or_none("difference_lower", "", "its lower bound", "with 95 % confidence", |row| finite(row.difference.value - row.difference.half_width)),
    number_or_none("difference_upper", "", "its upper bound", "with 95 % confidence", |row| finite(row.difference.value + row.difference.half_width)),
    word("settling", "settling", "`settled`, `not_settled` or `not_shown`", |row| row.difference.verdict.word()),
] };

fn differences_of_levels(evaluations: &Evaluations, tolerance: f64) -> String {
    let parameter = &evaluations.parameters[0];
    let level = parameter.column();
    let mut names = DIFFERENCES.names();
    names.insert(1, &level);
    let mut lines = Lines::under(names);
    for target in evaluations.targets() {
        let (levels, fineness) = evaluations.levels(&target);
        let found = differences(&levels, tolerance, evaluations.replicates);
        for ((level, fineness), difference) in levels.iter().zip(fineness).zip(found) {
            let (moments, fineness) = (level.moments(), parameter.cell(fineness));
            let (target, replicates) = (target.axis.column(), moments.count as u64);
            let row = DifferenceRow { target, replicates, mean: moments.mean, difference };
            let mut cells: Vec<Cell<'_>> = cells(DIFFERENCES.columns, &row).collect();
            cells.insert(1, Cell::Word(&fineness));
            lines.add(cells);
        }
    }
    lines.into_text()
}

impl Convergence {
    /// One word for tables.
    pub fn word(&self) -> &'static str {
        match self {
            Self::TooFewLevels => "too_few_levels",
            Self::WithinNoise => "within_noise",
            Self::Oscillating => "oscillating",
            Self::Diverging => "diverging",
            Self::Converging(_) => "converging",
        }
    }
}

struct EffectsRow {
    target: String,
    parameter: String,
    effects: ElementaryEffects,
}

/// Elementary effects, parameter by parameter.
#[rustfmt::skip]
static EFFECTS: Table<EffectsRow> = Table { file: names::SENSITIVITY, columns: &[
    word("target", "target", "an objective or a measure", |row| &row.target),
    word("parameter", "parameter", "", |row| &row.parameter),
    number_or_none("mean_effect", "", "mean effect", "", |row| finite(row.effects.mean)),
    number_or_none("mean_size", "", "mean size of the effects", "", |row| finite(row.effects.mean_size)),
    number_or_none("mean_size_standard_error", "", "its standard error", "", |row| finite(row.effects.standard_error)),
    number_or_none("standard_deviation", "", "standard deviation of the effects", "", |row| finite(row.effects.standard_deviation)),
    number_or_none("noise", "", "noise", "what of the standard deviation is of the replicates", |row| finite(row.effects.noise)),
    count("effects", "effects", "how many", |row: &EffectsRow| row.effects.count as u64),
] };

fn effects(evaluations: &Evaluations) -> String {
    let points: Vec<Vec<f64>> = evaluations.rows.iter().map(|row| row.point.clone()).collect();
    let rows = evaluations.targets().into_iter().flat_map(|target| {
        let found = elementary_effects(&points, &evaluations.target(&target));
        evaluations.parameters.iter().zip(found).map(move |(axis, effects)| EffectsRow {
            target: target.axis.column(),
            parameter: axis.name.clone(),
            effects,
        })
    });
    text(&EFFECTS, rows)
}

struct ShareRow {
    target: String,
    parameter: String,
    share: Share,
    variance: f64,
    noise_share: f64,
    blocks: u64,
}

/// Shares of the variance, parameter by parameter.
#[rustfmt::skip]
static SHARES: Table<ShareRow> = Table { file: names::SENSITIVITY, columns: &[
    word("target", "target", "an objective or a measure", |row| &row.target),
    word("parameter", "parameter", "", |row| &row.parameter),
    number_or_none("first", "", "first-order share", "", |row| finite(row.share.first)),
    number_or_none("first_lower", "", "its lower bound", "", |row| finite(row.share.first_interval[0])),
    number_or_none("first_upper", "", "its upper bound", "", |row| finite(row.share.first_interval[1])),
    number_or_none("total", "", "total share", "", |row| finite(row.share.total)),
    number_or_none("total_lower", "", "its lower bound", "", |row| finite(row.share.total_interval[0])),
    number_or_none("total_upper", "", "its upper bound", "", |row| finite(row.share.total_interval[1])),
    number_or_none("variance", "", "variance", "of the target", |row| finite(row.variance)),
    number_or_none("noise_share", "", "share of the replicates", "", |row| finite(row.noise_share)),
    count("blocks", "blocks", "how many", |row: &ShareRow| row.blocks),
] };

fn shares(evaluations: &Evaluations, bootstraps: u32, level: f64, seed: u64) -> String {
    let rows = evaluations.targets().into_iter().flat_map(|target| {
        let outcomes = evaluations.target(&target);
        let shares = variance_shares(evaluations.parameters.len(), &outcomes, bootstraps, level, seed);
        let (variance, noise_share, blocks) = (shares.variance, shares.noise_share, shares.blocks as u64);
        evaluations.parameters.iter().zip(shares.parameters).map(move |(axis, share)| {
            let (target, parameter) = (target.axis.column(), axis.name.clone());
            ShareRow { target, parameter, share, variance, noise_share, blocks }
        })
    });
    text(&SHARES, rows)
}

/// A table of declared columns.
fn text<S>(table: &'static Table<S>, rows: impl Iterator<Item = S>) -> String {
    let mut lines = Lines::under(table.names());
    rows.for_each(|row| lines.add(cells(table.columns, &row)));
    lines.into_text()
}

fn cells<'a, S>(columns: &'a [Column<S>], of: &'a S) -> impl Iterator<Item = Cell<'a>> {
    columns.iter().map(|column| column.cell(of))
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// A table in memory, which takes every line.
struct Lines(Rows<Vec<u8>>);

impl Lines {
    fn under<'a>(names: impl IntoIterator<Item = &'a str>) -> Self {
        let mut lines = Self(Rows::in_memory());
        lines.add(names.into_iter().map(Cell::Word));
        lines
    }

    fn add<'a>(&mut self, cells: impl IntoIterator<Item = Cell<'a>>) {
        // Memory takes all.
        let _ = self.0.row(cells);
    }

    fn into_text(self) -> String {
        self.0.into_text()
    }
}
