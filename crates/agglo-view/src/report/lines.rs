//! Charts over time of what tables hold.

use super::table::Table;
use crate::chart::{Axis, Chart, Curves, Drawn, Series};
use agglo::folder::names;
use agglo::record::{About, Panel};

/// Rows of a table that a chart shows at the most.
const MOST_ROWS: usize = 2_000;

/// What a chart over time shows of a table.
pub struct Lines {
    /// Name of the table.
    pub table: &'static str,
    /// The chart.
    pub panel: &'static Panel,
    /// The columns that it shows.
    pub columns: Vec<&'static About>,
}

impl Lines {
    /// The chart; nothing where the table has none of the columns, or no rows, or all of them stay 0.
    pub fn chart(&self, table: &Table) -> Option<Chart> {
        let time = table.column("time_s")?;
        let kept = kept(time.len());
        let thin = |column: &[f64]| kept.iter().map(|&row| column[row]).collect::<Vec<_>>();
        let mut series: Vec<Series> = Vec::new();
        for column in &self.columns {
            let moves = |values: &&[f64]| values.iter().any(|value| *value != 0.0 && value.is_finite());
            if let Some(values) = table.column(column.name).filter(moves) {
                let (x, y) = (thin(time), thin(values));
                series.push(Series::new(column.label, x, y));
            }
        }
        if series.is_empty() {
            return None;
        }
        let left_out = if kept.len() < time.len() {
            format!(" Of {} rows {} are shown.", time.len(), kept.len())
        } else {
            String::new()
        };
        let Panel { id, title, about, label, unit } = self.panel;
        Some(Chart {
            id: (*id).to_owned(),
            title: (*title).to_owned(),
            caption: format!("{about} From {}.{left_out}", names::series(self.table)),
            words: series.iter().map(|series| series.in_words(unit)).collect(),
            drawn: Drawn::Curves(Curves {
                x: Axis::new("time", "s"),
                y: Axis::new(label, unit),
                series,
                references: Vec::new(),
            }),
        })
    }
}

/// Which of so many rows are shown: evenly spaced ones, and the last.
pub fn kept(rows: usize) -> Vec<usize> {
    let mut kept: Vec<usize> = (0..rows).step_by(rows.div_ceil(MOST_ROWS).max(1)).collect();
    if kept.last().is_some_and(|last| last + 1 < rows) {
        kept.push(rows - 1);
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::testing::about;

    static COLUMNS: [About; 3] =
        [about("a_J", "J", "a"), about("zero_J", "J", "zero"), about("absent_J", "J", "absent")];
    static PANEL: Panel = Panel { id: "t", title: "T", about: "A thing.", label: "thing", unit: "J" };

    fn lines() -> Lines {
        Lines { table: "t", panel: &PANEL, columns: COLUMNS.iter().collect() }
    }

    fn table(rows: usize) -> Table {
        let time: Vec<f64> = (0..rows).map(|row| row as f64).collect();
        let names = ["time_s", "a_J", "zero_J"].map(str::to_owned).to_vec();
        let a = time.iter().map(|time| 3.0 - time).collect();
        Table { names, columns: vec![time, a, vec![0.0; rows]], dropped: 0 }
    }

    #[test]
    fn a_chart_has_the_tables_numbers_and_says_them() {
        let chart = lines().chart(&table(3)).unwrap();
        assert_eq!(chart.series().len(), 1, "what stays 0 or is absent is left out");
        assert_eq!(
            (&chart.series()[0].x[..], &chart.series()[0].y[..]),
            (&[0.0, 1.0, 2.0][..], &[3.0, 2.0, 1.0][..])
        );
        assert_eq!(chart.words, ["a: 3 J at first, 1 J at last, 1 J to 3 J between"]);
        assert_none!(lines().chart(&table(0)));
    }

    #[test]
    fn long_tables_are_thinned_to_the_last_row_and_say_so() {
        let chart = lines().chart(&table(5000)).unwrap();
        let x = &chart.series()[0].x;
        assert_eq!((x[0], x[1], *x.last().unwrap()), (0.0, 3.0, 4999.0));
        assert_at_most!(x.len(), MOST_ROWS + 1);
        assert!(chart.caption.contains("Of 5000 rows 1668 are shown"), "{}", chart.caption);
    }
}
