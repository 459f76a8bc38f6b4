//! Which charts a run gets.

use super::folder::Folder;
use super::lines::{Lines, kept};
use super::pulses;
use super::table::Table;
use super::walls;
use crate::chart::{Axis, Chart, Drawn, Heatmap};
use agglo::folder::names::SIZES;
use agglo::impact::heat::Balance;
use agglo::ledger::entry::hard::UNBALANCED;
use agglo::record::Panel;
use agglo::run;

/// The charts of a run; those without data are left out.
pub fn charts(folder: &Folder) -> Vec<Chart> {
    let is_hard = match &folder.scenario {
        Some(scenario) => scenario.is_hard(),
        None => folder.table("grains").is_some() || folder.table("impacts").is_some(),
    };
    let wanted = lines(is_hard, is_published(folder));
    let mut charts: Vec<Chart> =
        wanted.iter().filter_map(|lines| lines.chart(folder.table(lines.table)?)).collect();
    // Beside the charts of the same quantities over the whole run.
    let after = charts.iter().rposition(|chart| ["rays", "beam"].contains(&chart.id.as_str()));
    let of_pulses = folder.table("rays").map(|rays| pulses::charts(rays, &wanted)).unwrap_or_default();
    let place = after.map_or(charts.len(), |at| at + 1);
    charts.splice(place..place, of_pulses);
    charts.extend(folder.table("sizes").and_then(sizes));
    charts.extend(walls::charts(folder));
    charts
}

/// The charts over time of a kind of run, with the columns that say that they are shown there.
fn lines(is_hard: bool, is_published: bool) -> Vec<Lines> {
    let columns = run::tables(is_hard).iter().flat_map(|table| {
        let name = table.series().unwrap_or_default();
        table.columns().into_iter().map(move |column| (name, column))
    });
    // Only the published balance makes heat from nothing.
    let shown: Vec<_> =
        columns.filter(|(_, column)| is_published || column.name != UNBALANCED.name).collect();
    let lines = |panel: &&'static Panel| {
        let on = shown.iter().filter(|(_, column)| column.panel == Some(*panel));
        let (tables, columns): (Vec<_>, Vec<_>) = on.copied().unzip();
        tables.first().map(|table| Lines { table, panel, columns })
    };
    run::panels(is_hard).iter().filter_map(lines).collect()
}

/// Whether heat follows the published balance.
fn is_published(folder: &Folder) -> bool {
    let impact = folder.scenario.as_ref().and_then(|scenario| scenario.impact());
    impact.is_some_and(|impact| impact.heat.balance == Balance::Published)
}

/// The primaries of a class in words; one without an end has no last number.
fn class_name(lower: f64, upper: f64) -> String {
    if upper.is_nan() {
        format!("{lower} and more")
    } else if upper > lower {
        format!("{lower}–{upper}")
    } else {
        lower.to_string()
    }
}

/// Classes of size over time: how much of the mass is in each.
fn sizes(table: &Table) -> Option<Chart> {
    let [time, lower, upper, part] =
        ["time_s", "lower_primaries", "upper_primaries", "mass_fraction"].map(|name| table.column(name));
    let (time, lower, upper, part) = (time?, lower?, upper?, part?);
    let times = distinct(time);
    let x: Vec<f64> = kept(times.len()).into_iter().map(|at| times[at]).collect();
    let classes = distinct(lower);
    let place = |values: &[f64], value: f64| values.binary_search_by(|known| known.total_cmp(&value)).ok();
    let mut z = vec![vec![0.0; x.len()]; classes.len()];
    let mut names = vec![String::new(); classes.len()];
    for row in 0..time.len() {
        let class = place(&classes, lower[row])?;
        names[class] = class_name(lower[row], upper[row]);
        if let Some(column) = place(&x, time[row]) {
            z[class][column] = part[row];
        }
    }
    let at_last = z.iter().zip(&names).filter_map(|(parts, name)| {
        let part = 100.0 * *parts.last()?;
        (part > 0.0).then(|| format!("{name} primaries: {part:.1} % of the mass at last"))
    });
    let words = at_last.collect();
    Some(Chart {
        id: "sizes".to_owned(),
        title: "Sizes over time".to_owned(),
        caption: format!("How much of the mass is in grains of each class of size. From {SIZES}."),
        words,
        drawn: Drawn::Heatmap(Heatmap {
            x: Axis::new("time", "s"),
            y: Axis { labels: names, ..Axis::new("primaries in a grain", "") },
            shade: Axis::new("part of the mass", ""),
            columns: x,
            rows: (0..classes.len()).map(|class| class as f64).collect(),
            values: z,
        }),
    })
}

fn distinct(column: &[f64]) -> Vec<f64> {
    let mut values = column.to_vec();
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_that_are_not_there_at_a_time_hold_nothing() {
        let names = ["time_s", "lower_primaries", "upper_primaries", "mass_fraction"].map(str::to_owned);
        let columns = vec![
            vec![0.0, 1.0, 1.0, 1.0],
            vec![1.0, 1.0, 2.0, 4.0],
            vec![1.0, 1.0, 3.0, f64::NAN],
            vec![1.0, 0.25, 0.5, 0.25],
        ];
        let chart = sizes(&Table { names: names.to_vec(), columns, dropped: 0 }).unwrap();
        let Drawn::Heatmap(map) = &chart.drawn else { panic!("a map is due") };
        assert_eq!(map.y.labels, ["1", "2–3", "4 and more"]);
        assert_eq!((&map.columns, &map.rows), (&vec![0.0, 1.0], &vec![0.0, 1.0, 2.0]), "times and classes");
        assert_eq!(map.values, [[1.0, 0.25], [0.0, 0.5], [0.0, 0.25]]);
        assert_eq!(chart.words[1], "2–3 primaries: 50.0 % of the mass at last");
        assert_eq!(chart.words[2], "4 and more primaries: 25.0 % of the mass at last");
    }
}

#[cfg(test)]
#[path = "charts_tests.rs"]
mod shown_tests;
