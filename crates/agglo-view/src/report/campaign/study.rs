//! Charts of studies.

use super::folder::Folder;
use crate::report::chart::{Axis, Chart, Kind, Series};
use agglo::folder::names::{MEASURES, SENSITIVITY};
use agglo::record::Sheet;
use agglo::search::Plan;

/// Charts of this many outcomes at the most.
const MOST_OUTCOMES: usize = 8;

/// The charts; those without data are left out.
pub fn charts(folder: &Folder) -> Vec<Chart> {
    match folder.campaign.as_ref().and_then(|campaign| campaign.plan.as_ref()) {
        None => Vec::new(),
        Some(Plan::Morris(_)) => each_target(&folder.sensitivity, effects),
        Some(Plan::SobolIndices(_)) => each_target(&folder.sensitivity, shares),
        Some(Plan::Grid(_) | Plan::List(_) | Plan::Refinement(_)) => outcomes(folder),
    }
}

/// Means of each outcome over the parameter; of several parameters the parallel coordinates tell.
fn outcomes(folder: &Folder) -> Vec<Chart> {
    let parameters = folder.parameters();
    let (&[parameter], sheet) = (parameters.as_slice(), &folder.measures) else { return Vec::new() };
    let Some(words) = sheet.words(parameter) else { return Vec::new() };
    let is_number = words.iter().all(|word| word.parse::<f64>().is_ok());
    let x: Vec<f64> = if is_number {
        sheet.numbers(parameter).unwrap_or_default()
    } else {
        (0..words.len()).map(|at| at as f64).collect()
    };
    let names = if is_number { Vec::new() } else { words.iter().map(|word| (*word).to_owned()).collect() };
    let refines = matches!(
        folder.campaign.as_ref().and_then(|campaign| campaign.plan.as_ref()),
        Some(Plan::Refinement(_))
    );
    let axis = Axis { names, ..Axis::new(parameter, "") }.log(refines && is_number);
    let chart = |(number, name): (usize, &String)| {
        let error = sheet.numbers(&format!("{name}_standard_error"))?;
        let series =
            Series { name: name.clone(), x: x.clone(), y: sheet.numbers(name)?, error, ..Series::default() };
        Some(Chart {
            id: format!("outcome-{number}"),
            title: format!("{name} over {parameter}"),
            caption: format!("Means over random replicates with their standard errors. From {MEASURES}."),
            words: vec![series.in_words("")],
            kind: Kind::Points,
            x: axis.clone(),
            y: Axis::new(name, ""),
            series: vec![series],
        })
    };
    let is_outcome = |name: &&String| sheet.place(&format!("{name}_standard_error")).is_some();
    let outcomes = sheet.names.iter().filter(is_outcome).take(MOST_OUTCOMES);
    outcomes.enumerate().filter_map(chart).collect()
}

/// A chart for each target of a study of sensitivity.
fn each_target(sheet: &Sheet, chart: fn(&Sheet, &str) -> Option<Chart>) -> Vec<Chart> {
    let mut targets = sheet.words("target").unwrap_or_default();
    targets.dedup();
    let charts = targets.iter().take(MOST_OUTCOMES).enumerate().filter_map(|(number, target)| {
        let mut of_it = sheet.clone();
        of_it.keep("target", target);
        let chart = chart(&of_it, target)?;
        // Of what does not vary or is not known there is nothing to draw; the page says so in words.
        let is_known = chart.series.iter().any(|series| series.y.iter().any(|value| value.is_finite()));
        is_known.then(|| Chart { id: format!("sensitivity-{number}"), ..chart })
    });
    charts.collect()
}

/// The parameters as the names of an axis.
fn parameters(sheet: &Sheet) -> Option<Axis> {
    let names = sheet.words("parameter")?.into_iter().map(str::to_owned).collect();
    Some(Axis { names, ..Axis::new("parameter", "") })
}

fn bars(sheet: &Sheet, name: &str, column: &str, error: Vec<f64>) -> Option<Series> {
    let y = sheet.numbers(column)?;
    let x = (0..y.len()).map(|at| at as f64).collect();
    Some(Series { name: name.to_owned(), x, y, error, ..Series::default() })
}

fn said(axis: &Axis, series: &[Series]) -> Vec<String> {
    let figure = |value: &f64| if value.is_finite() { format!("{value:.4}") } else { "not known".to_owned() };
    let of = |one: &Series| {
        let pairs = axis.names.iter().zip(&one.y).map(|(name, value)| format!("{name} {}", figure(value)));
        format!("{}: {}", one.name, pairs.collect::<Vec<_>>().join(", "))
    };
    series.iter().map(of).collect()
}

fn effects(sheet: &Sheet, target: &str) -> Option<Chart> {
    let x = parameters(sheet)?;
    let series = vec![
        bars(sheet, "mean size μ*", "mean_size", sheet.numbers("mean_size_standard_error")?)?,
        bars(sheet, "deviation σ", "standard_deviation", Vec::new())?,
        bars(sheet, "of which chance", "noise", Vec::new())?,
    ];
    Some(Chart {
        title: format!("What moves {target}"),
        caption: format!(
            "Elementary effects of Morris: a large mean size matters, a large deviation interacts or bends. From {SENSITIVITY}."
        ),
        words: said(&x, &series),
        kind: Kind::Bars,
        x,
        y: Axis::new("effect of the whole range", ""),
        series,
        ..Chart::default()
    })
}

fn shares(sheet: &Sheet, target: &str) -> Option<Chart> {
    let x = parameters(sheet)?;
    let half = |lower: &str, upper: &str| -> Option<Vec<f64>> {
        let (lower, upper) = (sheet.numbers(lower)?, sheet.numbers(upper)?);
        Some(lower.iter().zip(upper).map(|(lower, upper)| (upper - lower) / 2.0).collect())
    };
    let series = vec![
        bars(sheet, "alone", "first", half("first_lower", "first_upper")?)?,
        bars(sheet, "with all interactions", "total", half("total_lower", "total_upper")?)?,
    ];
    Some(Chart {
        title: format!("What {target} varies with"),
        caption: format!(
            "Sobol indices: shares of the variance; bars of error are as long as the intervals of confidence. From \
             {SENSITIVITY}."
        ),
        words: said(&x, &series),
        kind: Kind::Bars,
        x,
        y: Axis::new("share of the variance", ""),
        series,
        ..Chart::default()
    })
}
