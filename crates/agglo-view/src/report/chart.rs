//! A chart as the page draws it.

use serde::Serialize;

use super::table::Table;
use agglo::folder::names;
use agglo::record::{About, Panel};
use agglo::text::readable;

/// Rows of a table that a chart shows at the most.
const MOST_ROWS: usize = 2_000;

/// A chart.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Chart {
    /// Name in the page.
    pub id: String,
    /// Heading.
    pub title: String,
    /// What it shows.
    pub caption: String,
    /// Its figures in words, for those who cannot see it.
    #[serde(skip)]
    pub words: Vec<String>,
    /// What the page draws.
    pub kind: Kind,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// What is drawn.
    pub series: Vec<Series>,
}

/// How a chart is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Lines.
    #[default]
    Lines,
    /// Points.
    Points,
    /// Bars.
    Bars,
    /// Colors over two axes.
    Map,
    /// An axis for each dimension, a line for each point.
    Parallel,
}

/// An axis.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Axis {
    /// What it counts.
    pub label: String,
    /// In which unit; empty for pure numbers.
    pub unit: String,
    /// Whether it is logarithmic.
    pub log: bool,
    /// Names of the places 0, 1, 2 ...; none where the axis counts.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub names: Vec<String>,
}

/// Something that is drawn.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Series {
    /// Its name in the legend.
    pub name: String,
    /// Horizontal places.
    pub x: Vec<f64>,
    /// Heights; those that are not finite are gaps.
    pub y: Vec<f64>,
    /// How uncertain the heights are, up and down.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub error: Vec<f64>,
    /// What pointing at each point says besides.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub text: Vec<String>,
    /// Colors of a map, one row for each height.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub z: Vec<Vec<f64>>,
    /// What the colors stand for.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub label: String,
    /// The color of each point or line.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub colors: Vec<f64>,
    /// Whether large color values are the bright ones of parallel coordinates, and not small ones.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub ascending: bool,
    /// The axes of parallel coordinates.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub dimensions: Vec<Dimension>,
}

/// An axis of parallel coordinates.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Dimension {
    /// What it is.
    pub label: String,
    /// A value for each line.
    pub values: Vec<f64>,
    /// Places that have names, and the names; none where the axis counts.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tickvals: Vec<f64>,
    /// See `tickvals`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ticktext: Vec<String>,
}

impl Axis {
    /// An axis that counts evenly.
    pub fn new(label: &str, unit: &str) -> Self {
        Self { label: label.to_owned(), unit: unit.to_owned(), ..Self::default() }
    }

    /// An axis that counts in decades, or evenly.
    #[must_use]
    pub fn log(self, log: bool) -> Self {
        Self { log, ..self }
    }
}

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
                series.push(Series { name: column.label.to_owned(), x, y, ..Series::default() });
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
            kind: Kind::Lines,
            x: Axis::new("time", "s"),
            y: Axis::new(label, unit),
            series,
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

impl Series {
    /// "kinetic: 1.2 J at first, 0.3 J at last, 0.1 J to 1.4 J between".
    pub fn in_words(&self, unit: &str) -> String {
        let shown: Vec<f64> = self.y.iter().copied().filter(|value| value.is_finite()).collect();
        let (Some(first), Some(last)) = (shown.first(), shown.last()) else {
            return format!("{} has no values", self.name);
        };
        let extreme = |take: fn(f64, f64) -> f64, start| shown.iter().copied().fold(start, take);
        let (least, most) = (extreme(f64::min, f64::INFINITY), extreme(f64::max, f64::NEG_INFINITY));
        let [first, last, least, most] = [first, last, &least, &most].map(|value| readable(*value, unit));
        format!("{}: {first} at first, {last} at last, {least} to {most} between", self.name)
    }
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
        assert_eq!(chart.series.len(), 1, "what stays 0 or is absent is left out");
        assert_eq!(
            (&chart.series[0].x[..], &chart.series[0].y[..]),
            (&[0.0, 1.0, 2.0][..], &[3.0, 2.0, 1.0][..])
        );
        assert_eq!(chart.words, ["a: 3 J at first, 1 J at last, 1 J to 3 J between"]);
        assert_none!(lines().chart(&table(0)));
    }

    #[test]
    fn long_tables_are_thinned_to_the_last_row_and_say_so() {
        let chart = lines().chart(&table(5000)).unwrap();
        let x = &chart.series[0].x;
        assert_eq!((x[0], x[1], *x.last().unwrap()), (0.0, 3.0, 4999.0));
        assert_at_most!(x.len(), MOST_ROWS + 1);
        assert!(chart.caption.contains("Of 5000 rows 1668 are shown"), "{}", chart.caption);
    }
}
