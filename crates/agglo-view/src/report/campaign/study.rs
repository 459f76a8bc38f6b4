//! Charts of studies.

use super::folder::Folder;
use crate::chart::{Axis, Bar, Bars, Chart, Curves, Drawn, Look, Place, Reference, Series, Spread};
use agglo::folder::names::{MEASURES, SENSITIVITY};
use agglo::record::Sheet;
use agglo::search::{Plan, Refinement};

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
    let is_log = refinement(folder).is_some() && is_number;
    let axis = Axis { labels: names, is_log, ..Axis::new(parameter, "") };
    let chart = |(number, name): (usize, &String)| {
        let error = sheet.numbers(&format!("{name}_standard_error"))?;
        let (look, spread) = (Look::Points, Spread::Errors(error));
        let series = Series { look, spread, ..Series::new(name, x.clone(), sheet.numbers(name)?) };
        let references = references(folder, name, &words, &series);
        Some(Chart {
            id: format!("outcome-{number}"),
            title: format!("{name} over {parameter}"),
            caption: format!("Means over random replicates with their standard errors. From {MEASURES}."),
            words: vec![series.in_words("")],
            drawn: Drawn::Curves(Curves {
                x: axis.clone(),
                y: Axis::new(name, ""),
                series: vec![series],
                references,
            }),
        })
    };
    let is_outcome = |name: &&String| sheet.place(&format!("{name}_standard_error")).is_some();
    let outcomes = sheet.names.iter().filter(is_outcome).take(MOST_OUTCOMES);
    outcomes.enumerate().filter_map(chart).collect()
}

fn refinement(folder: &Folder) -> Option<&Refinement> {
    match folder.campaign.as_ref()?.plan.as_ref()? {
        Plan::Refinement(refinement) => Some(refinement),
        _ => None,
    }
}

/// Of a study of refinement: what is within the tolerance of the finest level, and from where on an outcome has settled.
fn references(folder: &Folder, name: &str, levels: &[&str], series: &Series) -> Vec<Reference> {
    let Some((refinement, last)) = refinement(folder).zip(series.y.last()) else { return Vec::new() };
    let reference = |name: &str, at| Reference { name: name.to_owned(), at };
    let tolerance = refinement.tolerance * last.abs();
    let band = Place::Heights([last - tolerance, last + tolerance]);
    let (targets, settled) = (folder.refinement.words("target"), folder.refinement.words("settled_from"));
    let row = targets.iter().flatten().position(|target| *target == name);
    let from = row.zip(settled).map(|(row, settled)| settled[row]);
    let place = from.and_then(|from| levels.iter().position(|level| *level == from));
    let settled = place.map(|place| reference("settled from", Place::Across(series.x[place])));
    [reference("within the tolerance of the last", band)].into_iter().chain(settled).collect()
}

/// A chart for each target of a study of sensitivity.
fn each_target(sheet: &Sheet, draw: fn(&Sheet, &str) -> Option<Chart>) -> Vec<Chart> {
    let mut targets = sheet.words("target").unwrap_or_default();
    targets.dedup();
    let charts = targets.iter().take(MOST_OUTCOMES).enumerate().filter_map(|(number, target)| {
        let mut of_it = sheet.clone();
        of_it.keep("target", target);
        let chart = draw(&of_it, target)?;
        // Of what does not vary or is not known there is nothing to draw; the page says so in words.
        let Drawn::Bars(bars) = &chart.drawn else { return None };
        let is_known = bars.series.iter().any(|bar| bar.values.iter().any(|value| value.is_finite()));
        is_known.then(|| Chart { id: format!("sensitivity-{number}"), ..chart })
    });
    charts.collect()
}

/// A chart of bars for each parameter; its words have their quantities.
fn chart(sheet: &Sheet, title: String, caption: String, axis: &str, series: Vec<Bar>) -> Option<Chart> {
    let names = sheet.words("parameter")?.into_iter().map(str::to_owned).collect();
    let bars = Bars { label: "parameter".to_owned(), names, axis: Axis::new(axis, ""), series };
    Some(Chart { id: String::new(), title, caption, words: said(&bars), drawn: Drawn::Bars(bars) })
}

fn bar(sheet: &Sheet, name: &str, column: &str, spread: Spread) -> Option<Bar> {
    Some(Bar { name: name.to_owned(), values: sheet.numbers(column)?, spread })
}

fn said(bars: &Bars) -> Vec<String> {
    let quantity =
        |value: &f64| if value.is_finite() { format!("{value:.4}") } else { "not known".to_owned() };
    let of = |one: &Bar| {
        let pairs =
            bars.names.iter().zip(&one.values).map(|(name, value)| format!("{name} {}", quantity(value)));
        format!("{}: {}", one.name, pairs.collect::<Vec<_>>().join(", "))
    };
    bars.series.iter().map(of).collect()
}

fn effects(sheet: &Sheet, target: &str) -> Option<Chart> {
    let errors = Spread::Errors(sheet.numbers("mean_size_standard_error")?);
    let series = vec![
        bar(sheet, "mean size μ*", "mean_size", errors)?,
        bar(sheet, "deviation σ", "standard_deviation", Spread::Unknown)?,
        bar(sheet, "of which chance", "noise", Spread::Unknown)?,
    ];
    let caption = format!(
        "Elementary effects of Morris: a large mean size matters, a large deviation interacts or bends. From {SENSITIVITY}."
    );
    chart(sheet, format!("What moves {target}"), caption, "effect of the whole range", series)
}

fn shares(sheet: &Sheet, target: &str) -> Option<Chart> {
    let ends = |lower: &str, upper: &str| -> Option<Spread> {
        let ends = sheet.numbers(lower)?.into_iter().zip(sheet.numbers(upper)?);
        Some(Spread::Intervals(ends.map(|(lower, upper)| [lower, upper]).collect()))
    };
    let series = vec![
        bar(sheet, "alone", "first", ends("first_lower", "first_upper")?)?,
        bar(sheet, "with all interactions", "total", ends("total_lower", "total_upper")?)?,
    ];
    let caption = format!(
        "Sobol indices: shares of the variance; bars of error are the intervals of confidence. From {SENSITIVITY}."
    );
    chart(sheet, format!("What {target} varies with"), caption, "share of the variance", series)
}
