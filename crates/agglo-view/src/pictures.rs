//! Pictures of searches and studies, as SVG files.

use std::path::{Path, PathBuf};

use agglo::folder::names;
use agglo::record::{RecordError, atomic};
use agglo::search::analysis::{
    Convergence, EvaluationRow, Evaluations, Generation, Level, Moments, Objective, Share, Status, Target,
    Verdict, differences, elementary_effects, observed_order, settled, variance_shares, varies,
};
use agglo::search::{Campaign, Plan};

use crate::chart::{
    Axis, Bar, Bars, Candidates, Chart, Curves, Drawn, Histogram, Look, Place, Reference, Series, Spread,
    good, narrowed,
};
use crate::plot::picture as svg_of;

/// Most panels of a picture that has one for each measure.
const PANELS: usize = 6;
/// Most histograms in a picture.
const HISTOGRAMS: usize = 24;

/// Draws a search or study, as [`agglo::search::campaign::run`] asks for it: [`search_pictures`] or [`study_pictures`].
///
/// # Errors
/// [`RecordError::File`].
pub fn campaign_pictures(
    folder: &Path,
    campaign: &Campaign,
    evaluations: &Evaluations,
) -> Result<(), RecordError> {
    match &campaign.plan {
        Some(plan) => study_pictures(folder, plan, evaluations, campaign.seed).map(drop),
        None => search_pictures(folder, evaluations).map(drop),
    }
}

/// Writes `cost.svg`, `parallel.svg`, `pairs.svg` and, for two objectives, `front.svg` into a folder that exists; gives the
/// files written. What there is nothing to show of is left out.
///
/// # Errors
/// [`RecordError::File`].
pub fn search_pictures(folder: &Path, evaluations: &Evaluations) -> Result<Vec<PathBuf>, RecordError> {
    let mut files = Vec::new();
    if evaluations.ranked().is_empty() {
        return Ok(files);
    }
    let mut keep = |name: &str, picture: Picture| picture.write(folder, name).map(|file| files.push(file));
    keep("cost", costs(evaluations))?;
    keep("parallel", parallel(evaluations))?;
    keep("pairs", pairs(evaluations))?;
    if evaluations.objectives.len() == 2 {
        keep("front", front(evaluations))?;
    }
    Ok(files)
}

/// Writes what a study shows into a folder that exists: `refinement.svg`, `sensitivity.svg`, or `outcomes.svg` with the
/// measures over the first parameter, or `parallel.svg`; and `histograms.svg` where candidates have several replicates. Gives the
/// files written.
///
/// # Errors
/// [`RecordError::File`].
pub fn study_pictures(
    folder: &Path,
    plan: &Plan,
    evaluations: &Evaluations,
    seed: u64,
) -> Result<Vec<PathBuf>, RecordError> {
    let mut files = Vec::new();
    if evaluations.rows.is_empty() || evaluations.targets().is_empty() {
        return Ok(files);
    }
    let mut keep = |name: &str, picture: Picture| picture.write(folder, name).map(|file| files.push(file));
    match plan {
        Plan::Refinement(refinement) => keep("refinement", staircase(evaluations, refinement.tolerance))?,
        Plan::Morris(_) => keep("sensitivity", effects(evaluations))?,
        Plan::SobolIndices(indices) => {
            keep("sensitivity", shares(evaluations, indices.bootstraps, indices.level, seed))?;
        }
        Plan::Grid(_) if evaluations.parameters.len() > 1 => keep("parallel", parallel(evaluations))?,
        Plan::Grid(_) | Plan::List(_) => keep("outcomes", outcomes(evaluations))?,
    }
    if evaluations.rows.iter().any(|row| row.replicates.len() >= 8) && !evaluations.measures.is_empty() {
        keep("histograms", histograms(evaluations))?;
    }
    Ok(files)
}

/// Charts that stand in one file.
struct Picture {
    title: String,
    /// What it shows, in words.
    description: String,
    charts: Vec<Chart>,
}

impl Picture {
    fn of(title: String, description: String, drawn: impl IntoIterator<Item = Drawn>) -> Self {
        let chart = |drawn| Chart { drawn, ..Chart::default() };
        Self { title, description, charts: drawn.into_iter().map(chart).collect() }
    }

    fn write(&self, folder: &Path, name: &str) -> Result<PathBuf, RecordError> {
        let path = folder.join(names::picture(name));
        atomic::write(&path, svg_of(&self.title, &self.description, &self.charts).as_bytes())?;
        Ok(path)
    }
}

/// A line through points with a band about it.
fn line(name: &str, points: impl Iterator<Item = [f64; 2]>, band: Vec<[f64; 2]>) -> Series {
    let (x, y) = points.map(|[x, y]| (x, y)).unzip();
    let spread = if band.is_empty() { Spread::Unknown } else { Spread::Band(band) };
    Series { spread, ..Series::new(name, x, y) }
}

fn titled(evaluations: &Evaluations, what: &str) -> String {
    if evaluations.title.is_empty() { what.to_owned() } else { format!("{}: {what}", evaluations.title) }
}

fn cost_axis(evaluations: &Evaluations) -> Axis {
    evaluations.objectives.first().map_or_else(|| Axis::new("cost", ""), |first| first.axis.clone())
}

/// What a value of the first objective is times its cost: 1, or -1 where it was to be large.
fn sign(evaluations: &Evaluations) -> f64 {
    evaluations.objectives.first().map_or(1.0, Objective::sign)
}

fn is_to_be_large(evaluations: &Evaluations) -> bool {
    sign(evaluations) < 0.0
}

/// The first objective over the generations, and below the measures of the best candidate so far.
fn costs(evaluations: &Evaluations) -> Picture {
    let generations = evaluations.generations();
    let sign = sign(evaluations);
    let at = |g: &Generation, cost: f64| [f64::from(g.number), sign * cost];
    let with_costs = || generations.iter().filter(|g| g.mean.is_finite());
    let best_row = |g: &Generation| Some((f64::from(g.number), &evaluations.rows[g.best?]));
    let best = || generations.iter().filter_map(best_row);
    let x = Axis::new("generation", "");
    let best_costs = best().map(|(number, row)| [number, sign * row.costs[0]]);
    let best_errors = best().map(|(_, row)| around(sign * row.costs[0], row.standard_errors.first()));
    let ends = with_costs().map(|g| [sign * g.costs[0], sign * g.costs[2]]);
    let series = vec![
        line("best so far ± standard error", best_costs, best_errors.collect()),
        line("mean, least to largest", with_costs().map(|g| at(g, g.mean)), ends.collect()),
        line("median", with_costs().map(|g| at(g, g.costs[1])), Vec::new()),
    ];
    let curves = |y: Axis, series| Drawn::Curves(Curves { x: x.clone(), y, series, references: Vec::new() });
    let mut panels = vec![curves(cost_axis(evaluations), series)];
    let has_replicates = best().all(|(_, row)| !row.replicates.is_empty());
    // A measure that is the objective itself is in the first panel already.
    let is_new =
        |axis: &Axis| evaluations.objectives.iter().all(|objective| objective.axis.name != axis.name);
    let measures = evaluations.measures.iter().enumerate().filter(|(_, axis)| has_replicates && is_new(axis));
    for (number, axis) in measures.take(PANELS - 1) {
        let moments = || best().map(|(generation, row)| (generation, row.measure(number)));
        let means = moments().map(|(generation, m)| [generation, m.mean]);
        let errors = moments().map(|(_, m)| around(m.mean, Some(&m.standard_error()))).collect();
        panels.push(curves(axis.clone(), vec![line("of the best so far", means, errors)]));
    }
    let (first, last) = (best().next(), best().next_back());
    let cost = |row: Option<(f64, &EvaluationRow)>| row.map_or(f64::NAN, |(_, row)| sign * row.costs[0]);
    let words =
        format!("In {} generations the best goes from {} to {}.", generations.len(), cost(first), cost(last));
    Picture::of(titled(evaluations, "cost by generation"), words, panels)
}

fn around(value: f64, error: Option<&f64>) -> [f64; 2] {
    let error = known(error);
    [value - error, value + error]
}

/// Every candidate across its parameters and its first objective, or its first measure in a study without objectives.
fn parallel(evaluations: &Evaluations) -> Picture {
    let targets = evaluations.targets();
    let Some(target) = targets.first() else { return Picture::of(String::new(), String::new(), []) };
    let outcomes = evaluations.target(target);
    let feasible = evaluations.rows.iter().zip(&outcomes).filter(|(row, _)| row.status == Status::Feasible);
    let known = feasible.filter_map(|(row, outcome)| Some((row, (*outcome)?[0])));
    let with_outcome =
        |(row, outcome): (&EvaluationRow, f64)| ([&row.values[..], &[outcome]].concat(), outcome);
    let (rows, shades): (Vec<Vec<f64>>, Vec<f64>) = known.map(with_outcome).unzip();
    let is_large_good = is_to_be_large(evaluations);
    let extreme = if is_large_good { "largest" } else { "smallest" };
    let words = format!(
        "Each of {} lines is a candidate that keeps all limits; those with the {extreme} {} are thick and on top.",
        rows.len(),
        target.axis.name
    );
    let axes = evaluations.parameters.iter().cloned().chain([target.axis.clone()]).collect();
    let candidates = Candidates { axes, rows, shade: target.axis.clone(), shades, is_large_good };
    Picture::of(titled(evaluations, "all candidates"), words, [Drawn::Parallel(candidates)])
}

/// The best quarter of the candidates, but at least 50, in all pairs of the parameters that it narrows most.
fn pairs(evaluations: &Evaluations) -> Picture {
    let ranked = evaluations.ranked();
    let good = good(&ranked);
    // Scatter in the cube.
    let scatter = |axis: usize| {
        let places: Vec<f64> =
            good.iter().filter_map(|&(row, _)| evaluations.rows[row].point.get(axis).copied()).collect();
        Moments::of(&places).standard_deviation
    };
    let shown = narrowed(evaluations.parameters.len(), scatter);
    let which = if shown.len() < evaluations.parameters.len() {
        "the parameters narrowed most"
    } else {
        "parameters"
    };
    let values = |row: &EvaluationRow| shown.iter().map(|&axis| row.values[axis]).collect();
    let is_large_good = is_to_be_large(evaluations);
    let words = format!(
        "The best {} of {} candidates that keep all limits, in all pairs of {which}; the best are {} and on top.",
        good.len(),
        ranked.len(),
        if is_large_good { "bright" } else { "dark" }
    );
    let candidates = Candidates {
        axes: shown.iter().map(|&axis| evaluations.parameters[axis].clone()).collect(),
        rows: good.iter().map(|&(row, _)| values(&evaluations.rows[row])).collect(),
        shade: cost_axis(evaluations),
        shades: good.iter().map(|&(_, cost)| sign(evaluations) * cost).collect(),
        is_large_good,
    };
    Picture::of(titled(evaluations, "the good region"), words, [Drawn::Pairs(candidates)])
}

fn front(evaluations: &Evaluations) -> Picture {
    let best = evaluations.front();
    let is_shown = |row: &EvaluationRow| row.feasible_cost().is_some() && row.costs.len() == 2;
    let [x, y] = [&evaluations.objectives[0], &evaluations.objectives[1]];
    let of = |is_on_front: bool| -> Vec<&EvaluationRow> {
        let all = evaluations.rows.iter().enumerate();
        let on = all.filter(|(number, row)| is_shown(row) && best.contains(number) == is_on_front);
        on.map(|(_, row)| row).collect()
    };
    let series = |name: &str, look: Look, rows: &[&EvaluationRow]| {
        let column = |number: usize, sign: f64| rows.iter().map(|row| sign * row.costs[number]).collect();
        Series { look, ..Series::new(name, column(0, x.sign()), column(1, y.sign())) }
    };
    let mut front = of(true);
    front.sort_by(|a, b| (x.sign() * a.costs[0]).total_cmp(&(x.sign() * b.costs[0])));
    let errors = |number: usize| front.iter().map(|row| known(row.standard_errors.get(number))).collect();
    // What lies on the bad side of the stairs is beaten.
    let look = if x.is_to_be_large { Look::StairsBefore } else { Look::StairsAfter };
    let on_front =
        Series { spread: Spread::Errors(errors(1)), x_errors: errors(0), ..series("front", look, &front) };
    let curves = Curves {
        x: x.axis.clone(),
        y: y.axis.clone(),
        series: vec![series("beaten", Look::Faint, &of(false)), on_front],
        references: Vec::new(),
    };
    let words = format!("{} candidates are beaten by no other in both costs.", best.len());
    Picture::of(titled(evaluations, "two costs"), words, [Drawn::Curves(curves)])
}

/// Each target over the levels of refinement.
fn staircase(evaluations: &Evaluations, tolerance: f64) -> Picture {
    let mut words = Vec::new();
    let mut x = evaluations.parameters[0].clone();
    x.is_log = x.labels.is_empty()
        && evaluations.rows.iter().all(|row| row.values.first().is_some_and(|v| *v > 0.0));
    let panel = |target: Target<'_>| {
        let (levels, fineness) = evaluations.levels(&target);
        let (from, verdict) = settled(&differences(&levels, tolerance, evaluations.replicates));
        let from = from.map(|level| fineness[level]);
        let order = observed_order(&levels, evaluations.replicates);
        words.push(format!("{}: {}", target.axis.name, said(order, from.map(|from| x.cell(from)), verdict)));
        let moments: Vec<Moments> = levels.iter().map(Level::moments).collect();
        let value = moments.last().map_or(f64::NAN, |moments| moments.mean);
        let reference = |name: &str, at: Place| Reference { name: name.to_owned(), at };
        let tolerance = tolerance * value.abs();
        let band = Place::Heights([value - tolerance, value + tolerance]);
        let mut references = vec![reference("within the tolerance of the last", band)];
        references.extend(from.map(|from| reference("settled from", Place::Across(from))));
        if let Convergence::Converging(order) = order {
            references.push(reference("extrapolated", Place::Height(order.limit)));
        }
        let errors = moments.iter().map(|moments| known(Some(&moments.standard_error()))).collect();
        let means = moments.iter().map(|moments| moments.mean).collect();
        let look = Look::Dotted;
        let series = Series { look, spread: Spread::Errors(errors), ..Series::new("", fineness, means) };
        Drawn::Curves(Curves { x: x.clone(), y: target.axis.clone(), series: vec![series], references })
    };
    let panels: Vec<Drawn> = evaluations.targets().into_iter().take(PANELS).map(panel).collect();
    Picture::of(titled(evaluations, "convergence"), words.join(" "), panels)
}

/// An error, or 0, which is not drawn, where it is not known.
fn known(error: Option<&f64>) -> f64 {
    error.copied().filter(|error| error.is_finite()).unwrap_or(0.0)
}

fn said(order: Convergence, from: Option<String>, verdict: Verdict) -> String {
    let settled = match (from, verdict) {
        (Some(from), _) => format!("settled from {from} on"),
        (None, Verdict::NotSettled) => "it has not settled".to_owned(),
        (None, _) => "it is not shown to have settled".to_owned(),
    };
    let order = match order {
        Convergence::TooFewLevels => "too few levels for an order".to_owned(),
        Convergence::WithinNoise => "differences are within the noise, so there is no order".to_owned(),
        Convergence::Oscillating | Convergence::Diverging => "not in the asymptotic range".to_owned(),
        Convergence::Converging(order) => {
            let range = if order.is_asymptotic == Some(false) { ", not in the asymptotic range" } else { "" };
            let error = order.order_standard_error;
            let error = if error.is_finite() { format!(" ± {error:.2}") } else { String::new() };
            format!("order {:.2}{error}{range}", order.order)
        }
    };
    format!("{settled}; {order}.")
}

fn points_of(evaluations: &Evaluations) -> Vec<Vec<f64>> {
    evaluations.rows.iter().map(|row| row.point.clone()).collect()
}

/// Says in the title that a target does not vary, so that a picture without bars explains itself.
fn of_target(evaluations: &Evaluations, what: &str, target: &Target<'_>) -> String {
    let outcomes = evaluations.target(target);
    let does_vary = varies(outcomes.iter().flatten().map(|outcome| outcome[0]));
    let still = if does_vary { "" } else { ", which does not vary" };
    titled(evaluations, &format!("{what} {}{still}", target.axis.name))
}

/// Elementary effects on the first target.
fn effects(evaluations: &Evaluations) -> Picture {
    let target = evaluations.targets()[0];
    let effects = elementary_effects(&points_of(evaluations), &evaluations.target(&target));
    let sizes = Bar {
        name: "mean size of effects ± standard error".to_owned(),
        values: effects.iter().map(|effect| effect.mean_size).collect(),
        spread: Spread::Errors(effects.iter().map(|effect| effect.standard_error).collect()),
    };
    let spreads = Bar {
        name: "standard deviation of effects".to_owned(),
        values: effects.iter().map(|effect| effect.standard_deviation).collect(),
        spread: Spread::Unknown,
    };
    let noise = effects.iter().map(|effect| effect.noise).fold(f64::NAN, f64::max);
    let noise = if noise.is_nan() {
        "how much of them is noise is not known".to_owned()
    } else {
        format!("effects below {noise:.2e} are within the noise")
    };
    let name = &target.axis.name;
    let axis = Axis::new(&format!("change of {name} over the parameter's range"), &target.axis.unit);
    let words = format!("Change of {name} per whole range of each parameter; {noise}.");
    bars(evaluations, of_target(evaluations, "effects on", &target), words, axis, vec![sizes, spreads])
}

/// Bars for each parameter.
fn bars(evaluations: &Evaluations, title: String, words: String, axis: Axis, series: Vec<Bar>) -> Picture {
    let names = evaluations.parameters.iter().map(|axis| axis.name.clone()).collect();
    let bars = Bars { label: "parameter".to_owned(), names, axis, series };
    Picture::of(title, words, [Drawn::Bars(bars)])
}

/// Shares in the variance of the first target.
fn shares(evaluations: &Evaluations, bootstraps: u32, level: f64, seed: u64) -> Picture {
    let target = evaluations.targets()[0];
    let outcomes = evaluations.target(&target);
    let shares = variance_shares(evaluations.parameters.len(), &outcomes, bootstraps, level, seed);
    let bar = |name: &str, part: fn(&Share) -> (f64, [f64; 2])| {
        let (values, intervals) = shares.parameters.iter().map(part).unzip();
        Bar { name: name.to_owned(), values, spread: Spread::Intervals(intervals) }
    };
    let alone = bar("alone", |share| (share.first, share.first_interval));
    let total = bar("with all others", |share| (share.total, share.total_interval));
    let noise = if shares.noise_share.is_nan() {
        "how much of the variance is noise of the replicates is not known".to_owned()
    } else {
        format!("noise of the replicates has up to {:.1} % of the variance", 100.0 * shares.noise_share)
    };
    let words =
        format!("Share of each parameter, with {:.0} % confidence intervals; {noise}.", 100.0 * level);
    let axis = Axis::new(&format!("share in the variance of {}", target.axis.name), "");
    let title = of_target(evaluations, "shares in the variance of", &target);
    bars(evaluations, title, words, axis, vec![alone, total])
}

/// Each target over the first parameter, or over the number of the candidate where words are listed.
fn outcomes(evaluations: &Evaluations) -> Picture {
    let x = evaluations.parameters.first().cloned().unwrap_or_default();
    let panel = |target: Target<'_>| {
        let outcomes = evaluations.target(&target);
        let known = evaluations
            .rows
            .iter()
            .zip(&outcomes)
            .filter_map(|(row, outcome)| Some((row.values.first().copied()?, (*outcome)?)));
        let mut known: Vec<(f64, [f64; 2])> = known.collect();
        known.sort_by(|a, b| a.0.total_cmp(&b.0));
        let band = known.iter().map(|(_, [mean, error])| around(*mean, Some(error))).collect();
        let means = known.iter().map(|(x, [mean, _])| [*x, *mean]);
        let series = vec![line("mean ± standard error", means, band)];
        Drawn::Curves(Curves { x: x.clone(), y: target.axis.clone(), series, references: Vec::new() })
    };
    let panels: Vec<Drawn> = evaluations.targets().into_iter().take(PANELS).map(panel).collect();
    let count = evaluations.rows.len();
    let words = format!("Means and standard errors over {} for {count} candidates.", x.name);
    Picture::of(titled(evaluations, "outcomes"), words, panels)
}

/// Replicates of each candidate, for each measure, as long as there is room.
fn histograms(evaluations: &Evaluations) -> Picture {
    let mut panels = Vec::new();
    for (number, row) in evaluations.rows.iter().enumerate().filter(|(_, row)| row.replicates.len() >= 8) {
        let candidate = match (evaluations.parameters.as_slice(), row.values.as_slice()) {
            ([parameter], [value]) => format!("{} = {}", parameter.name, parameter.cell(*value)),
            _ => format!("candidate {number}"),
        };
        for (measure, axis) in evaluations.measures.iter().enumerate() {
            let values: Vec<f64> =
                row.replicates.iter().filter_map(|replicate| replicate.get(measure).copied()).collect();
            let moments = row.measure(measure);
            let named = Axis { name: format!("{}, {candidate}", axis.name), ..axis.clone() };
            let mean = Some([moments.mean, moments.standard_error()]);
            panels.push(Drawn::Histogram(Histogram { mean, ..Histogram::of(named, &values) }));
        }
    }
    panels.truncate(HISTOGRAMS);
    let count = panels.len();
    let words = format!("Values of single replicates, {count} histograms, with mean and standard error.");
    Picture::of(titled(evaluations, "distributions"), words, panels)
}

#[cfg(test)]
#[path = "pictures_tests.rs"]
mod tests;
