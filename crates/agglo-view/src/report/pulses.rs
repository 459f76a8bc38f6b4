//! Charts of single pulses: rays fly for milliseconds where a run lasts for seconds, so that over the whole run their
//! curves are needles.

use super::lines::Lines;
use super::table::Table;
use crate::chart::{Axis, Chart, Curves, Drawn, Series};
use agglo::folder::names::RAYS;

/// Rows of a pulse from which on its course can be seen.
const FEWEST_ROWS: usize = 5;
/// Pulses that one chart shows at the most.
const MOST_PULSES: usize = 8;

/// A table from a launch until the rays are gone, with times since the launch.
struct Pulse {
    number: usize,
    rows: Table,
}

/// Rays in flight after each launch, and `lines` of the table of rays for the first pulse; none where rows are too far
/// apart to show a pulse.
pub fn charts(rays: &Table, lines: &[Lines]) -> Vec<Chart> {
    let pulses = pulses(rays);
    let Some(first) = pulses.first() else { return Vec::new() };
    let zoomed = lines.iter().filter(|lines| lines.table == "rays").filter_map(|lines| {
        let mut chart = lines.chart(&first.rows)?;
        if let Drawn::Curves(curves) = &mut chart.drawn {
            curves.x = since_launch();
        }
        chart.id.push_str("-pulse");
        chart.title = format!("{}, pulse {}", chart.title, first.number);
        Some(chart)
    });
    std::iter::once(in_flight(&pulses)).chain(zoomed).collect()
}

fn since_launch() -> Axis {
    Axis::new("time since the launch", "s")
}

fn in_flight(pulses: &[Pulse]) -> Chart {
    let series: Vec<Series> = pulses
        .iter()
        .take(MOST_PULSES)
        .map(|pulse| {
            let column = |name: &str| pulse.rows.column(name).map(<[f64]>::to_vec).unwrap_or_default();
            Series::new(&format!("pulse {}", pulse.number), column("time_s"), column("in_flight"))
        })
        .collect();
    let left_out = if pulses.len() > series.len() {
        format!(" Of {} pulses {} are shown.", pulses.len(), series.len())
    } else {
        String::new()
    };
    Chart {
        id: "rays-of-pulses".to_owned(),
        title: "Rays in flight after each launch".to_owned(),
        caption: format!("How long rays stay among the grains. From {RAYS}.{left_out}"),
        words: series.iter().map(|series| series.in_words("")).collect(),
        drawn: Drawn::Curves(Curves {
            x: since_launch(),
            y: Axis::new("rays in flight", ""),
            series,
            references: Vec::new(),
        }),
    }
}

/// The pulses that have rows enough: each from the row before its first rays to the first row without rays, or to the
/// next launch.
fn pulses(rays: &Table) -> Vec<Pulse> {
    let (Some(time), Some(launched), Some(flying)) =
        (rays.column("time_s"), rays.column("pulses"), rays.column("in_flight"))
    else {
        return Vec::new();
    };
    let mut found = Vec::new();
    let mut row = 0;
    while let Some(first) = (row..time.len()).find(|&at| flying[at] > 0.0) {
        let goes_on = |at: &usize| flying[*at] > 0.0 && launched[*at] == launched[first];
        let after = (first..time.len()).find(|at| !goes_on(at)).unwrap_or(time.len());
        let is_gone = after < time.len() && launched[after] == launched[first];
        let end = if is_gone { after + 1 } else { after };
        // The row at the launch has no rays of this pulse yet.
        let start = first.saturating_sub(1);
        if end - first >= FEWEST_ROWS {
            let part = |(name, column): (&String, &Vec<f64>)| {
                let from = if name == "time_s" { time[start] } else { 0.0 };
                column[start..end].iter().map(|value| value - from).collect()
            };
            let columns = rays.names.iter().zip(&rays.columns).map(part).collect();
            let rows = Table { names: rays.names.clone(), columns, dropped: 0 };
            found.push(Pulse { number: launched[first] as usize, rows });
        }
        row = after.max(first + 1);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::testing::about;
    use agglo::record::{About, Panel};

    /// Launches at 1 s and 3 s, rays for half a second each, a row every 0.1 s then and every second otherwise.
    fn rays() -> Table {
        let mut rows = vec![[0.0, 0.0, 0.0]];
        for (launch, before) in [(1.0, 0.0), (3.0, 1.0)] {
            rows.push([launch, before, 0.0]);
            for tenth in 1..=6_u32 {
                let flying = f64::from(60 - 10 * tenth);
                rows.push([launch + 0.1 * f64::from(tenth), before + 1.0, flying]);
            }
            rows.push([launch + 1.0, before + 1.0, 0.0]);
        }
        let names = ["time_s", "pulses", "in_flight"].map(str::to_owned).to_vec();
        let columns = (0..3).map(|at| rows.iter().map(|row| row[at]).collect()).collect();
        Table { names, columns, dropped: 0 }
    }

    static COLUMN: About = about("in_flight", "", "in flight");
    static PANEL: Panel = Panel { id: "rays", title: "Rays", about: "Rays.", label: "how many", unit: "" };

    fn lines() -> [Lines; 1] {
        [Lines { table: "rays", panel: &PANEL, columns: vec![&COLUMN] }]
    }

    #[test]
    fn pulses_begin_at_their_launch_and_end_when_rays_are_gone() {
        let charts = charts(&rays(), &lines());
        let ids: Vec<&str> = charts.iter().map(|chart| chart.id.as_str()).collect();
        assert_eq!(ids, ["rays-of-pulses", "rays-pulse"]);
        let names: Vec<&str> = charts[0].series().iter().map(|series| series.name.as_str()).collect();
        assert_eq!(names, ["pulse 1", "pulse 2"]);
        for series in charts[0].series() {
            assert_eq!(series.y, [0.0, 50.0, 40.0, 30.0, 20.0, 10.0, 0.0]);
            let off = series.x.iter().zip(0..).map(|(x, tenth)| (x - 0.1 * f64::from(tenth)).abs());
            assert!(off.fold(0.0, f64::max) < 1e-12, "{:?}", series.x);
        }
        let Drawn::Curves(curves) = &charts[1].drawn else { panic!("lines are due") };
        assert_eq!((charts[1].title.as_str(), &*curves.x.name), ("Rays, pulse 1", "time since the launch"));
    }

    #[test]
    fn rows_that_are_too_far_apart_show_no_pulse() {
        let mut sparse = rays();
        for column in &mut sparse.columns {
            *column = column.iter().copied().step_by(3).collect();
        }
        assert_empty!(charts(&sparse, &lines()));
        assert_empty!(charts(&Table::default(), &lines()));
    }
}
