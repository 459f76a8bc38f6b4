//! Tables of what a study says, as CSV text.

use super::refinement::{Convergence, Level, observed_order, settled};
use super::{Axis, Evaluations, elementary_effects, variance_shares};
use crate::search::plan::Plan;

/// Mean, standard error, standard deviation and number of starts of each measure, one line for each candidate; columns
/// `<measure>`, `<measure>_standard_error`, `<measure>_standard_deviation`.
pub fn measures_table(evaluations: &Evaluations) -> String {
    let mut header = vec!["evaluation".to_owned()];
    header.extend(evaluations.parameters.iter().map(Axis::column));
    header.push("starts".to_owned());
    for axis in &evaluations.measures {
        let name = axis.column();
        header.extend([name.clone(), format!("{name}_standard_error"), format!("{name}_standard_deviation")]);
    }
    let mut table = String::new();
    add(&mut table, &header);
    for (number, row) in evaluations.rows.iter().enumerate() {
        let mut cells = vec![number.to_string()];
        cells.extend(evaluations.parameters.iter().zip(&row.values).map(|(axis, value)| axis.cell(*value)));
        cells.push(row.starts.len().to_string());
        for measure in 0..evaluations.measures.len() {
            let moments = row.measure(measure);
            let [error, deviation] = [moments.standard_error(), moments.standard_deviation]
                .map(|v| if moments.count > 1 { v } else { f64::NAN });
            cells.extend([moments.mean, error, deviation].map(cell));
        }
        add(&mut table, &cells);
    }
    table
}

/// What a plan says: the name of its file and its CSV text; none for plans that only try values.
///
/// `seed` is the one that the plan was started with.
pub fn study_table(plan: &Plan, evaluations: &Evaluations, seed: u64) -> Option<(&'static str, String)> {
    match plan {
        Plan::Grid(_) | Plan::List(_) => None,
        Plan::Refinement(refinement) => {
            Some(("refinement.csv", convergence(evaluations, refinement.tolerance)))
        }
        Plan::Morris(_) => Some(("sensitivity.csv", effects(evaluations))),
        Plan::SobolIndices(indices) => {
            Some(("sensitivity.csv", shares(evaluations, indices.bootstraps, indices.level, seed)))
        }
    }
}

/// Levels of a refinement study for one target, from coarse to fine, and the fineness of each; failed ones are left out.
///
/// Where the parameter rises (rays, grains) the size is 1 over it, where it falls (steps) the parameter itself; of words
/// there are no sizes, and the order is then not known.
pub(super) fn levels(evaluations: &Evaluations, target: usize) -> (Vec<Level>, Vec<f64>) {
    let is_word = evaluations.parameters.first().is_some_and(|axis| !axis.labels.is_empty());
    let fineness = |row: usize| evaluations.rows[row].values.first().copied().unwrap_or(f64::NAN);
    let last = evaluations.rows.len().saturating_sub(1);
    let rises = last > 0 && fineness(last) > fineness(0);
    let size = |row: usize| match (is_word, rises) {
        (true, _) => f64::NAN,
        (false, true) => 1.0 / fineness(row),
        (false, false) => fineness(row),
    };
    let outcomes = evaluations.target(target);
    let whole = outcomes.iter().enumerate().filter_map(|(row, outcome)| outcome.map(|pair| (row, pair)));
    whole
        .map(|(row, [mean, standard_error])| (Level { size: size(row), mean, standard_error }, fineness(row)))
        .unzip()
}

fn convergence(evaluations: &Evaluations, tolerance: f64) -> String {
    let mut table = "target,settled_from,verdict,order,order_standard_error,limit,limit_standard_error,\
                     grid_convergence_index,asymptotic\n"
        .to_owned();
    for (number, axis) in evaluations.targets().into_iter().enumerate() {
        let (levels, fineness) = levels(evaluations, number);
        let from = settled(&levels, tolerance)
            .map_or_else(String::new, |level| evaluations.parameters[0].cell(fineness[level]));
        let verdict = observed_order(&levels);
        let mut cells = vec![axis.column(), from, verdict.word().to_owned()];
        match verdict {
            Convergence::Converging(o) => {
                let figures =
                    [o.order, o.order_standard_error, o.limit, o.limit_standard_error, o.uncertainty];
                cells.extend(figures.map(cell));
                cells
                    .push(o.is_asymptotic.map_or("unknown", |yes| if yes { "yes" } else { "no" }).to_owned());
            }
            _ => cells.extend(vec![String::new(); 6]),
        }
        add(&mut table, &cells);
    }
    table
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

fn effects(evaluations: &Evaluations) -> String {
    let mut table =
        "target,parameter,mean_effect,mean_size,mean_size_standard_error,standard_deviation,noise,effects\n"
            .to_owned();
    let points: Vec<Vec<f64>> = evaluations.rows.iter().map(|row| row.point.clone()).collect();
    for (number, target) in evaluations.targets().into_iter().enumerate() {
        let effects = elementary_effects(&points, &evaluations.target(number));
        for (axis, e) in evaluations.parameters.iter().zip(effects) {
            let mut cells = vec![target.column(), axis.name.clone()];
            cells.extend([e.mean, e.mean_size, e.standard_error, e.standard_deviation, e.noise].map(cell));
            cells.push(e.count.to_string());
            add(&mut table, &cells);
        }
    }
    table
}

fn shares(evaluations: &Evaluations, bootstraps: u32, level: f64, seed: u64) -> String {
    let mut table =
        "target,parameter,first,first_lower,first_upper,total,total_lower,total_upper,variance,noise_share,blocks\n".to_owned();
    for (number, target) in evaluations.targets().into_iter().enumerate() {
        let outcomes = evaluations.target(number);
        let shares = variance_shares(evaluations.parameters.len(), &outcomes, bootstraps, level, seed);
        for (axis, s) in evaluations.parameters.iter().zip(&shares.parameters) {
            let [[a, b], [c, d]] = [s.first_interval, s.total_interval];
            let mut cells = vec![target.column(), axis.name.clone()];
            cells.extend([s.first, a, b, s.total, c, d, shares.variance, shares.noise_share].map(cell));
            cells.push(shares.blocks.to_string());
            add(&mut table, &cells);
        }
    }
    table
}

fn add(table: &mut String, cells: &[String]) {
    // Formulas may hold commas.
    let quoted = |cell: &String| {
        if cell.contains([',', '"']) { format!("\"{}\"", cell.replace('"', "\"\"")) } else { cell.clone() }
    };
    table.push_str(&cells.iter().map(quoted).collect::<Vec<_>>().join(","));
    table.push('\n');
}

/// A number with as few digits as bring back the same bits; empty where there is none.
fn cell(value: f64) -> String {
    if value.is_nan() { String::new() } else { format!("{value}") }
}
