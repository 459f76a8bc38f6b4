//! How the outcomes of a study scatter among random replicates.

use super::folder::Folder;
use crate::chart::{Axis, Chart, Drawn, Histogram};
use agglo::folder::names::RUNS;
use agglo::search::analysis::Moments;
use agglo::text::with_error;

/// Replicates of a candidate from which on their distribution can be seen.
const FEWEST: usize = 8;
/// Charts at the most.
const MOST: usize = 8;

/// A histogram for each outcome of each candidate, as long as there is room; none where there are few replicates.
pub fn charts(folder: &Folder) -> Vec<Chart> {
    let (Some(of), Some(numbers)) =
        (folder.runs.numbers("evaluation"), folder.evaluations.numbers("evaluation"))
    else {
        return Vec::new();
    };
    let outcomes: Vec<(&str, Vec<f64>)> =
        folder.outcomes().into_iter().filter_map(|name| Some((name, folder.runs.numbers(name)?))).collect();
    let of_candidate = |(row, number): (usize, &f64)| -> Vec<Chart> {
        let is_of = |run: &usize| of[*run] == *number;
        let runs: Vec<usize> = (0..of.len()).filter(is_of).collect();
        let chart = |(name, values): &(&str, Vec<f64>)| {
            let values: Vec<f64> =
                runs.iter().map(|run| values[*run]).filter(|value| value.is_finite()).collect();
            (values.len() >= FEWEST).then(|| histogram(name, &candidate(folder, row, *number), &values))
        };
        outcomes.iter().filter_map(chart).collect()
    };
    let mut charts: Vec<Chart> = numbers.iter().enumerate().flat_map(of_candidate).take(MOST).collect();
    for (number, chart) in charts.iter_mut().enumerate() {
        chart.id = format!("distribution-{number}");
    }
    charts
}

/// How a candidate is called: by the value of its only parameter, or by its number.
fn candidate(folder: &Folder, row: usize, number: f64) -> String {
    let sheet = &folder.evaluations;
    match folder.parameters().as_slice() {
        &[name] => sheet.words(name).map(|words| format!("{name} = {}", words[row])),
        _ => None,
    }
    .unwrap_or_else(|| format!("candidate {number}"))
}

fn histogram(outcome: &str, candidate: &str, values: &[f64]) -> Chart {
    let moments = Moments::of(values);
    let mean = Some([moments.mean, moments.standard_error()]);
    Chart {
        title: format!("{outcome}, {candidate}"),
        caption: format!("How single replicates scatter, and their mean. From {RUNS}."),
        words: vec![format!(
            "{} replicates, {outcome} on average {}",
            values.len(),
            with_error(moments.mean, moments.standard_error())
        )],
        drawn: Drawn::Histogram(Histogram { mean, ..Histogram::of(Axis::new(outcome, ""), values) }),
        ..Chart::default()
    }
}
