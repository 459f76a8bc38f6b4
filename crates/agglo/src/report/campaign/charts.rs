//! Charts of searches, and those that searches and studies share.

use super::folder::Folder;
use crate::report::chart::{Axis, Chart, Dimension, Kind, Series};
use crate::report::sheet::Sheet;
use crate::scenario::{column, readable};
use crate::search::optimiser::Method;

/// How many of the best make a mean, where the method does not say how many parents it has.
const BEST: usize = 6;

/// The charts; those without data are left out.
pub fn charts(folder: &Folder) -> Vec<Chart> {
    let mut searched = folder.evaluations.clone();
    searched.keep("stage", "search");
    searched.keep("status", "ok");
    let of_search = if folder.is_study() { Vec::new() } else { vec![costs(folder, &searched)] };
    let parallel = if folder.parameters().len() > 1 { parallel(folder, &searched) } else { None };
    of_search.into_iter().chain([front(folder, &searched), candidates(folder), parallel]).flatten().collect()
}

/// The best cost against generations, with the mean of the parents ([B], fig. 4).
fn costs(folder: &Folder, searched: &Sheet) -> Option<Chart> {
    let sheet = &folder.generations;
    let column = |name: &str| sheet.numbers(name);
    let generation = column("generation")?;
    let best = column("best_cost")?;
    let (kept, mean) = mean_of_best(folder, searched, &generation)?;
    let line = |name: &str, y: Vec<f64>| Series {
        name: name.to_owned(),
        x: generation.clone(),
        y,
        ..Series::default()
    };
    let errors = column("best_cost_standard_error")?;
    let mut series = vec![
        Series { error: errors, ..line("best so far", best) },
        line(&format!("mean of the best {kept} so far"), mean),
    ];
    series.push(line("lowest of the generation", column("cost_lowest")?));
    series.push(line("mean of the generation", column("cost_mean")?));
    if generation.is_empty() {
        return None;
    }
    let goal = folder.goals().first().cloned().unwrap_or_default();
    Some(Chart {
        id: "cost".to_owned(),
        title: "Cost against generation".to_owned(),
        caption: format!(
            "The lowest mean cost so far with its standard error, and the mean of the best {kept} so far, which are the \
             parents of a search that keeps them; in the last generations the best are polished or run again. Costs of \
             the best are too good where they scatter. From generations.csv and evaluations.csv."
        ),
        words: series.iter().map(|series| series.in_words("")).collect(),
        x: Axis::new("generation", ""),
        y: Axis::new(&goal, ""),
        series,
        ..Chart::default()
    })
}

/// How many best candidates, and the mean of their costs after each generation.
fn mean_of_best(folder: &Folder, searched: &Sheet, generations: &[f64]) -> Option<(usize, Vec<f64>)> {
    let kept = match folder.campaign.as_ref().and_then(|campaign| campaign.method.as_ref()) {
        Some(Method::PublishedGenetic(genetic)) => genetic.parents,
        _ => BEST,
    };
    let of = searched.numbers("generation")?;
    let cost = searched.numbers(folder.costs().first()?)?;
    let mean = |generation: &f64| {
        let so_far = of.iter().zip(&cost).filter(|(of, cost)| *of <= generation && cost.is_finite());
        let mut costs: Vec<f64> = so_far.map(|(_, cost)| *cost).collect();
        costs.sort_by(f64::total_cmp);
        costs.truncate(kept);
        if costs.is_empty() { f64::NAN } else { costs.iter().sum::<f64>() / costs.len() as f64 }
    };
    Some((kept, generations.iter().map(mean).collect()))
}

/// Every candidate's cost with its error.
fn candidates(folder: &Folder) -> Option<Chart> {
    let costs = folder.costs();
    let &[cost] = costs.as_slice() else { return None };
    let sheet = &folder.evaluations;
    let (number, stage, status) =
        (sheet.numbers("evaluation")?, sheet.words("stage")?, sheet.words("status")?);
    let (cost, error) = (sheet.numbers(cost)?, sheet.numbers(&format!("{cost}_standard_error"))?);
    let mut stages: Vec<&str> = stage.clone();
    stages.dedup();
    let mut series = Vec::new();
    for one in ["search", "polish", "confirm"] {
        let rows: Vec<usize> = (0..number.len())
            .filter(|&row| stage[row] == one && status[row] != "failed" && cost[row].is_finite())
            .collect();
        let take = |column: &[f64]| rows.iter().map(|&row| column[row]).collect::<Vec<_>>();
        let name = match one {
            "search" => "candidates",
            "polish" => "polished",
            _ => "run again",
        };
        if !rows.is_empty() {
            let text = rows.iter().map(|&row| in_words(folder, row)).collect();
            let (x, y, error) = (take(&number), take(&cost), take(&error));
            series.push(Series { name: name.to_owned(), x, y, error, text, ..Series::default() });
        }
    }
    if series.is_empty() {
        return None;
    }
    Some(Chart {
        id: "candidates".to_owned(),
        title: "Every candidate".to_owned(),
        caption: "Mean cost of each candidate with its standard error, in the order in which they were tried. From \
                  evaluations.csv."
            .to_owned(),
        words: series.iter().map(|series| series.in_words("")).collect(),
        kind: Kind::Points,
        x: Axis::new("candidate", ""),
        y: Axis::new(folder.goals().first()?, ""),
        series,
    })
}

/// The parameters of a candidate, a line each.
fn in_words(folder: &Folder, row: usize) -> String {
    let parameters = folder.parameters();
    let named = parameters.iter().filter_map(|name| {
        let entry = &folder.evaluations.rows[row][folder.evaluations.place(name)?];
        let value = entry.parse().map_or_else(|_| entry.clone(), |value: f64| readable(value, ""));
        Some(format!("{name} = {value}"))
    });
    named.collect::<Vec<_>>().join("<br>")
}

/// Candidates by two costs, and those that no other beats in both.
fn front(folder: &Folder, searched: &Sheet) -> Option<Chart> {
    let costs = folder.costs();
    let &[first, second] = costs.as_slice() else { return None };
    let goals = folder.goals();
    let all = Series {
        name: "candidates".to_owned(),
        x: searched.numbers(first)?,
        y: searched.numbers(second)?,
        ..Series::default()
    };
    let mut front: Vec<[f64; 2]> = folder
        .summary
        .iter()
        .flat_map(|summary| &summary.front)
        .filter_map(|point| Some([*point.costs.first()?, *point.costs.get(1)?]))
        .collect();
    front.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let beaten = Series {
        name: "beaten by no other".to_owned(),
        x: front.iter().map(|point| point[0]).collect(),
        y: front.iter().map(|point| point[1]).collect(),
        ..Series::default()
    };
    let [firsts, seconds] = [0, 1].map(|at| column(&front.iter().map(|point| point[at]).collect::<Vec<_>>()));
    let words =
        firsts.iter().zip(&seconds).map(|(a, b)| format!("{} = {a} with {} = {b}", goals[0], goals[1]));
    Some(Chart {
        id: "front".to_owned(),
        title: "Front".to_owned(),
        caption: "Mean costs of all candidates; those on the front are beaten by no other in both. From \
                  evaluations.csv and summary.json."
            .to_owned(),
        words: words.collect(),
        kind: Kind::Points,
        x: Axis::new(&goals[0], ""),
        y: Axis::new(&goals[1], ""),
        series: vec![all, beaten],
    })
}

/// A line for each candidate through its parameters and costs.
fn parallel(folder: &Folder, searched: &Sheet) -> Option<Chart> {
    if searched.rows.is_empty() {
        return None;
    }
    let (costs, goals) = (folder.costs(), folder.goals());
    let parameters = folder.parameters().into_iter().filter_map(|name| dimension(searched, name, name));
    let outcomes = costs.iter().zip(&goals).filter_map(|(name, goal)| dimension(searched, name, goal));
    let dimensions: Vec<Dimension> = parameters.chain(outcomes).collect();
    let colors = searched.numbers(costs.first()?)?;
    let label = goals.first()?.clone();
    Some(Chart {
        id: "parallel".to_owned(),
        title: "Parameters and costs".to_owned(),
        caption: "A line for each candidate; bright ones are better. Drag along an axis to choose a range, drag a name \
                  to move its axis. From evaluations.csv."
            .to_owned(),
        words: vec![format!("{} candidates over {} axes", searched.rows.len(), dimensions.len())],
        kind: Kind::Parallel,
        series: vec![Series { label, colors, dimensions, ..Series::default() }],
        ..Chart::default()
    })
}

fn dimension(sheet: &Sheet, name: &str, label: &str) -> Option<Dimension> {
    let label = label.to_owned();
    let words = sheet.words(name)?;
    if words.iter().all(|word| word.is_empty() || word.parse::<f64>().is_ok()) {
        return Some(Dimension { label, values: sheet.numbers(name)?, ..Dimension::default() });
    }
    let mut names = words.clone();
    names.sort_unstable();
    names.dedup();
    let place = |word: &&str| names.iter().position(|name| name == word).map_or(f64::NAN, |at| at as f64);
    Some(Dimension {
        label,
        values: words.iter().map(place).collect(),
        tickvals: (0..names.len()).map(|at| at as f64).collect(),
        ticktext: names.iter().map(|name| (*name).to_owned()).collect(),
    })
}
