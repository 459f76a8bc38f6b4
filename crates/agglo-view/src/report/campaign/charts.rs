//! Charts of searches, and those that searches and studies share.

use super::folder::Folder;
use crate::chart::{Axis, Candidates, Chart, Curves, Drawn, Look, Series, Spread, good, narrowed};
use agglo::folder::names::{EVALUATIONS, GENERATIONS, SUMMARY};
use agglo::record::Sheet;
use agglo::search::analysis::Moments;
use agglo::search::optimizer::Method;
use agglo::text::{column, readable};

/// How many of the best make a mean, where the method does not say how many parents it has.
const BEST: usize = 6;

/// The charts; those without data are left out.
pub fn charts(folder: &Folder) -> Vec<Chart> {
    let mut searched = folder.evaluations.clone();
    searched.keep("stage", "search");
    searched.keep("status", "ok");
    let of_search = if folder.is_study() { Vec::new() } else { vec![costs(folder, &searched)] };
    let parallel = if folder.parameters().len() > 1 { parallel(folder, &searched) } else { None };
    let pairs = parallel.as_ref().filter(|_| !folder.is_study()).and_then(|all| pairs(folder, all));
    let shared = [front(folder, &searched), candidates(folder), parallel, pairs];
    of_search.into_iter().chain(shared).flatten().collect()
}

/// The best cost against generations, with the mean of the parents ([B], fig. 4).
fn costs(folder: &Folder, searched: &Sheet) -> Option<Chart> {
    let sheet = &folder.generations;
    let sign = folder.signs().first().copied().unwrap_or(1.0);
    let column = |name: &str| sheet.numbers(name);
    let signed = |name: &str| Some(column(name)?.into_iter().map(|cost| sign * cost).collect::<Vec<f64>>());
    let generation = column("generation")?;
    let best = signed("best_cost")?;
    // As long as no candidate keeps the limits, the one nearest to them is no best.
    let missed = column("best_violation").unwrap_or_else(|| vec![0.0; best.len()]);
    let of = |is_missed: bool| -> Vec<f64> {
        let shown =
            |(best, missed): (&f64, &f64)| if (*missed > 0.0) == is_missed { *best } else { f64::NAN };
        best.iter().zip(&missed).map(shown).collect()
    };
    let (nearest, best) = (of(true), of(false));
    let (kept, mean) = mean_of_best(folder, searched, &generation)?;
    let line = |name: &str, y: Vec<f64>| Series::new(name, generation.clone(), y);
    let errors = column("best_cost_standard_error")?;
    let mut series = vec![
        Series { spread: Spread::Errors(errors), ..line("best so far", best) },
        line(&format!("mean of the best {kept} so far"), mean.into_iter().map(|cost| sign * cost).collect()),
    ];
    series.push(line("best of the generation", signed("cost_lowest")?));
    series.push(line("mean of the generation", signed("cost_mean")?));
    if nearest.iter().any(|value| value.is_finite()) {
        series.push(line("nearest to the limits so far, which it MISSES", nearest));
    }
    if generation.is_empty() {
        return None;
    }
    let goal = folder.goals().first().cloned().unwrap_or_default();
    Some(Chart {
        id: "cost".to_owned(),
        title: format!("{goal} against generation"),
        caption: format!(
            "The best mean so far with its standard error, and the mean of the best {kept} so far, which are the \
             parents of a search that keeps them; in the last generations the best are polished or run again. What is \
             best is too good where it scatters. Candidates that miss a limit are in no mean. From {GENERATIONS} and \
             {EVALUATIONS}."
        ),
        words: series.iter().map(|series| series.in_words("")).collect(),
        drawn: Drawn::Curves(Curves {
            x: Axis::new("generation", ""),
            y: Axis::new(&goal, ""),
            series,
            references: Vec::new(),
        }),
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

/// Stands for candidates that miss a limit, whatever their stage.
const MISSES: &str = "";

/// Every candidate's goal with its error.
fn candidates(folder: &Folder) -> Option<Chart> {
    let costs = folder.costs();
    let &[cost] = costs.as_slice() else { return None };
    let sheet = &folder.evaluations;
    let (number, stage, status) =
        (sheet.numbers("evaluation")?, sheet.words("stage")?, sheet.words("status")?);
    let sign = folder.signs().first().copied().unwrap_or(1.0);
    let error = sheet.numbers(&format!("{cost}_standard_error"))?;
    let cost: Vec<f64> = sheet.numbers(cost)?.into_iter().map(|cost| sign * cost).collect();
    let mut series = Vec::new();
    let kinds = [
        ("search", "candidates"),
        ("polish", "polished"),
        ("confirm", "run again"),
        ("final", "the best, once more"),
        (MISSES, "MISS A LIMIT"),
    ];
    for (one, name) in kinds {
        let is_of = |row: usize| {
            let misses = status[row] == "infeasible";
            if one == MISSES { misses } else { stage[row] == one && !misses && status[row] != "failed" }
        };
        let rows: Vec<usize> = (0..number.len()).filter(|&row| is_of(row) && cost[row].is_finite()).collect();
        let take = |column: &[f64]| rows.iter().map(|&row| column[row]).collect::<Vec<_>>();
        if !rows.is_empty() {
            let texts = rows.iter().map(|&row| in_words(folder, row)).collect();
            let (look, spread) = (Look::Points, Spread::Errors(take(&error)));
            series.push(Series { look, spread, texts, ..Series::new(name, take(&number), take(&cost)) });
        }
    }
    if series.is_empty() {
        return None;
    }
    Some(Chart {
        id: "candidates".to_owned(),
        title: "Every candidate".to_owned(),
        caption: format!(
            "Mean of each candidate with its standard error, in the order in which they were tried; those that miss a limit \
             by themselves. From {EVALUATIONS}."
        ),
        words: series.iter().map(|series| series.in_words("")).collect(),
        drawn: Drawn::Curves(Curves {
            x: Axis::new("candidate", ""),
            y: Axis::new(folder.goals().first()?, ""),
            series,
            references: Vec::new(),
        }),
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
    let (goals, signs) = (folder.goals(), folder.signs());
    let signed = |name: &str, sign: f64| {
        Some(searched.numbers(name)?.into_iter().map(|cost| sign * cost).collect::<Vec<f64>>())
    };
    let all = Series {
        look: Look::Faint,
        ..Series::new("candidates", signed(first, signs[0])?, signed(second, signs[1])?)
    };
    let mut front: Vec<[f64; 2]> = folder
        .summary
        .iter()
        .flat_map(|summary| &summary.front)
        .filter_map(|point| Some([signs[0] * point.costs.first()?, signs[1] * point.costs.get(1)?]))
        .collect();
    front.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let misses = folder.summary.iter().flat_map(|summary| &summary.front).any(|point| point.violation > 0.0);
    let name = if misses { "beaten by no other, all MISS A LIMIT" } else { "beaten by no other" };
    let [x, y] = [0, 1].map(|at| front.iter().map(|point| point[at]).collect::<Vec<_>>());
    let [firsts, seconds] = [&x, &y].map(|values| column(values));
    // What lies on the bad side of the stairs is beaten.
    let look = if signs[0] < 0.0 { Look::StairsBefore } else { Look::StairsAfter };
    let unbeaten = Series { look, ..Series::new(name, x, y) };
    let words =
        firsts.iter().zip(&seconds).map(|(a, b)| format!("{} = {a} with {} = {b}", goals[0], goals[1]));
    Some(Chart {
        id: "front".to_owned(),
        title: "Front".to_owned(),
        caption: format!(
            "Means of all candidates that keep the limits; those on the front are beaten by no other in both. From \
             {EVALUATIONS} and {SUMMARY}."
        ),
        words: words.collect(),
        drawn: Drawn::Curves(Curves {
            x: Axis::new(&goals[0], ""),
            y: Axis::new(&goals[1], ""),
            series: vec![all, unbeaten],
            references: Vec::new(),
        }),
    })
}

/// A line for each candidate through its parameters and costs.
fn parallel(folder: &Folder, searched: &Sheet) -> Option<Chart> {
    if searched.rows.is_empty() {
        return None;
    }
    let (costs, goals, signs) = (folder.costs(), folder.goals(), folder.signs());
    let parameters = folder.parameters().into_iter().filter_map(|name| column_of(searched, name, name));
    // A study without objectives is colored by the first of its outcomes.
    let first = folder.outcomes().first().map(|name| (*name).to_owned());
    let shown: Vec<(String, String, f64)> = if costs.is_empty() {
        first.iter().map(|name| (name.clone(), name.clone(), 1.0)).collect()
    } else {
        let named = costs.iter().zip(goals).zip(signs);
        named.map(|((cost, goal), sign)| ((*cost).to_owned(), goal, sign)).collect()
    };
    let signed = |(name, goal, sign): &(String, String, f64)| {
        let (axis, values) = column_of(searched, name, goal)?;
        Some((axis, values.iter().map(|value| sign * value).collect()))
    };
    let outcomes: Vec<(Axis, Vec<f64>)> = shown.iter().filter_map(signed).collect();
    let (shade, shades) = outcomes.first().cloned()?;
    let is_large_good = shown.first()?.2 < 0.0;
    let (axes, columns): (Vec<Axis>, Vec<Vec<f64>>) = parameters.chain(outcomes).unzip();
    let rows =
        (0..searched.rows.len()).map(|row| columns.iter().map(|column| column[row]).collect()).collect();
    Some(Chart {
        id: "parallel".to_owned(),
        title: "Parameters and goals".to_owned(),
        caption: format!(
            "A line for each candidate; bright ones are better. Drag along an axis to choose a range, drag a name to move \
             its axis. From {EVALUATIONS}."
        ),
        words: vec![format!("{} candidates over {} axes", searched.rows.len(), axes.len())],
        drawn: Drawn::Parallel(Candidates { axes, rows, shade, shades, is_large_good }),
    })
}

/// The best quarter of the candidates of parallel coordinates, but at least so many, in all pairs of the parameters that they
/// narrow most.
fn pairs(folder: &Folder, parallel: &Chart) -> Option<Chart> {
    let Drawn::Parallel(all) = &parallel.drawn else { return None };
    let ranked = all.ranked();
    let good = good(&ranked);
    if good.is_empty() {
        return None;
    }
    let parameters = folder.parameters().len();
    // Scatter over that of all candidates.
    let scatter = |axis: usize| {
        let [good, all]: [Vec<f64>; 2] =
            [good.iter().map(|(row, _)| row[axis]).collect(), all.rows.iter().map(|row| row[axis]).collect()];
        Moments::of(&good).standard_deviation / Moments::of(&all).standard_deviation
    };
    let shown = narrowed(parameters, scatter);
    let which = if shown.len() < parameters {
        format!("the {} of {parameters} parameters that they narrow most", shown.len())
    } else {
        "parameters".to_owned()
    };
    let values = |row: &[f64]| shown.iter().map(|&axis| row[axis]).collect();
    Some(Chart {
        id: "pairs".to_owned(),
        title: "The good region".to_owned(),
        caption: format!(
            "The best {} of {} candidates that keep the limits, in pairs of {which}; bright ones are better. From \
             {EVALUATIONS}.",
            good.len(),
            ranked.len()
        ),
        words: shown.iter().map(|&axis| range_in_words(all, good, axis)).collect(),
        drawn: Drawn::Pairs(Candidates {
            axes: shown.iter().map(|&axis| all.axes[axis].clone()).collect(),
            rows: good.iter().map(|(row, _)| values(row)).collect(),
            shades: good.iter().map(|(_, shade)| *shade).collect(),
            ..all.clone()
        }),
    })
}

/// "v_m_s from 20 to 31".
fn range_in_words(all: &Candidates, good: &[(&Vec<f64>, f64)], axis: usize) -> String {
    let values = || good.iter().map(|(row, _)| row[axis]);
    let (least, most) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
    let Axis { name, labels, .. } = &all.axes[axis];
    let said = |value: f64| labels.get(value as usize).cloned().unwrap_or_else(|| readable(value, ""));
    format!("{name} from {} to {}", said(least), said(most))
}

/// A column as an axis of that name, and its values: numbers, or places in the list of its words.
fn column_of(sheet: &Sheet, name: &str, label: &str) -> Option<(Axis, Vec<f64>)> {
    let words = sheet.words(name)?;
    if words.iter().all(|word| word.is_empty() || word.parse::<f64>().is_ok()) {
        return Some((Axis::new(label, ""), sheet.numbers(name)?));
    }
    let mut names = words.clone();
    names.sort_unstable();
    names.dedup();
    let place = |word: &&str| names.iter().position(|name| name == word).map_or(f64::NAN, |at| at as f64);
    Some((Axis::choice(label, &names), words.iter().map(place).collect()))
}
