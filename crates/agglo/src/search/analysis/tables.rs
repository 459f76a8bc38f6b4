//! Tables of what a study says, as CSV text.

use super::refinement::{Convergence, Difference, differences, observed_order, settled};
use super::{Axis, Evaluations, elementary_effects, variance_shares};
use crate::search::plan::Plan;
use crate::text::number;

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
            cells.extend([moments.mean, moments.standard_error(), moments.standard_deviation].map(cell));
        }
        add(&mut table, &cells);
    }
    table
}

/// What a plan says: the names of its files and their CSV texts; none for plans that only try values.
///
/// `seed` is the one that the plan was started with.
pub fn study_tables(plan: &Plan, evaluations: &Evaluations, seed: u64) -> Vec<(&'static str, String)> {
    match plan {
        Plan::Grid(_) | Plan::List(_) => Vec::new(),
        Plan::Refinement(refinement) => vec![
            ("refinement.csv", convergence(evaluations, refinement.tolerance)),
            ("differences.csv", differences_of_levels(evaluations, refinement.tolerance)),
        ],
        Plan::Morris(_) => vec![("sensitivity.csv", effects(evaluations))],
        Plan::SobolIndices(indices) => {
            vec![("sensitivity.csv", shares(evaluations, indices.bootstraps, indices.level, seed))]
        }
    }
}

fn convergence(evaluations: &Evaluations, tolerance: f64) -> String {
    let mut table =
        "target,settled_from,settling,verdict,order,order_standard_error,limit,limit_standard_error,\
                     grid_convergence_index,asymptotic\n"
            .to_owned();
    for target in evaluations.targets() {
        let (levels, fineness) = evaluations.levels(&target);
        let (from, settling) = settled(&differences(&levels, tolerance, evaluations.starts));
        let from = from.map_or_else(String::new, |level| evaluations.parameters[0].cell(fineness[level]));
        let verdict = observed_order(&levels, evaluations.starts);
        let words = [settling.word(), verdict.word()].map(str::to_owned);
        let mut cells = vec![target.axis.column(), from];
        cells.extend(words);
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

/// How far each level is from the finest one, with its interval.
fn differences_of_levels(evaluations: &Evaluations, tolerance: f64) -> String {
    let mut table = format!(
        "target,{},starts,mean,difference,difference_standard_error,difference_lower,difference_upper,settling\n",
        evaluations.parameters[0].column()
    );
    for target in evaluations.targets() {
        let (levels, fineness) = evaluations.levels(&target);
        let found = differences(&levels, tolerance, evaluations.starts);
        for ((level, fineness), difference) in levels.iter().zip(fineness).zip(found) {
            let moments = level.moments();
            let mut cells = vec![target.axis.column(), evaluations.parameters[0].cell(fineness)];
            cells.push(moments.count.to_string());
            let Difference { value, standard_error, half_width, verdict } = difference;
            let ends = [value - half_width, value + half_width];
            cells.extend([moments.mean, value, standard_error, ends[0], ends[1]].map(cell));
            cells.push(verdict.word().to_owned());
            add(&mut table, &cells);
        }
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
    for target in evaluations.targets() {
        let effects = elementary_effects(&points, &evaluations.target(&target));
        for (axis, e) in evaluations.parameters.iter().zip(effects) {
            let mut cells = vec![target.axis.column(), axis.name.clone()];
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
    for target in evaluations.targets() {
        let outcomes = evaluations.target(&target);
        let shares = variance_shares(evaluations.parameters.len(), &outcomes, bootstraps, level, seed);
        for (axis, s) in evaluations.parameters.iter().zip(&shares.parameters) {
            let [[a, b], [c, d]] = [s.first_interval, s.total_interval];
            let mut cells = vec![target.axis.column(), axis.name.clone()];
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
    if value.is_finite() { number(value) } else { String::new() }
}
