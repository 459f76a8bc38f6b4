//! Charts as data: what is drawn over which axes, said once. [`picture`](crate::plot::picture) makes an SVG file of charts, and a
//! page draws them so that they can be pointed at.

mod good_region;
mod histogram;

use agglo::text::readable;
use serde::Serialize;

pub use agglo::search::analysis::Axis;
pub(crate) use good_region::{good, narrowed};
pub use histogram::Histogram;

/// A chart.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Chart {
    /// Name in a page.
    pub id: String,
    /// Heading.
    pub title: String,
    /// What it shows.
    pub caption: String,
    /// Its quantities in words, for those who cannot see it.
    #[serde(skip)]
    pub words: Vec<String>,
    /// What is drawn.
    #[serde(flatten)]
    pub drawn: Drawn,
}

/// What a chart draws.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Drawn {
    /// Lines, points and what they are held against, over two axes.
    Curves(Curves),
    /// A group of bars for each name.
    Bars(Bars),
    /// Colors over two axes.
    Heatmap(Heatmap),
    /// How often values fall into bins.
    Histogram(Histogram),
    /// An axis for each quantity, side by side, and a line for each candidate.
    Parallel(Candidates),
    /// Each quantity against each other one, a point for each candidate.
    Pairs(Candidates),
}

/// Lines and points over two axes.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Curves {
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// What is drawn, in the order of the legend.
    pub series: Vec<Series>,
    /// What it is held against.
    pub references: Vec<Reference>,
}

/// A line, or points.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Series {
    /// Its name in the legend; empty for none.
    pub name: String,
    /// Horizontal places.
    pub x: Vec<f64>,
    /// Heights; those that are not finite are gaps.
    pub y: Vec<f64>,
    /// How it is drawn.
    pub look: Look,
    /// How far the heights are known.
    pub spread: Spread,
    /// How far the horizontal places are known, up and down; empty where nothing is said of it.
    pub x_errors: Vec<f64>,
    /// What pointing at each point says besides; empty for nothing.
    pub texts: Vec<String>,
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Look {
    /// A line.
    #[default]
    Line,
    /// Points.
    Points,
    /// Points that stand back behind others.
    Faint,
    /// Points on a line.
    Dotted,
    /// Points on stairs that keep the height of the point at the left.
    StairsAfter,
    /// Points on stairs that have the height of the point at the right.
    StairsBefore,
}

/// How far values are known.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Spread {
    /// Nothing is said of it.
    #[default]
    Unknown,
    /// So far up and down; bars at each value. What is not finite is not known.
    Errors(Vec<f64>),
    /// From here to there; bars at each value.
    Intervals(Vec<[f64; 2]>),
    /// From here to there; a band along the line.
    Band(Vec<[f64; 2]>),
}

/// What curves are held against.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reference {
    /// Its name in the legend.
    pub name: String,
    /// Where it lies.
    pub at: Place,
}

/// Where something lies that goes all the way through a chart.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Place {
    /// A line at a height.
    Height(f64),
    /// A line at a horizontal place.
    Across(f64),
    /// All heights from here to there.
    Heights([f64; 2]),
}

/// A group of bars for each name.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Bars {
    /// What the names are of.
    pub label: String,
    /// Names of the groups.
    pub names: Vec<String>,
    /// What the lengths stand for.
    pub axis: Axis,
    /// The bars of each group, in the order of the legend.
    pub series: Vec<Bar>,
}

/// One bar in each group.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Bar {
    /// Its name in the legend.
    pub name: String,
    /// A length for each group.
    pub values: Vec<f64>,
    /// How far the lengths are known.
    pub spread: Spread,
}

/// Colors over two axes.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Heatmap {
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// What the colors stand for.
    pub shade: Axis,
    /// Horizontal places of the columns.
    pub columns: Vec<f64>,
    /// Heights of the rows.
    pub rows: Vec<f64>,
    /// The value of each column, for each row.
    pub values: Vec<Vec<f64>>,
}

/// Candidates with a value of each of some quantities.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Candidates {
    /// The quantities.
    pub axes: Vec<Axis>,
    /// One value for each axis, for each candidate.
    pub rows: Vec<Vec<f64>>,
    /// What the colors stand for.
    pub shade: Axis,
    /// The value that gives each candidate its color.
    pub shades: Vec<f64>,
    /// Whether large color values are good, and not small ones.
    pub is_large_good: bool,
}

impl Default for Drawn {
    fn default() -> Self {
        Self::Curves(Curves::default())
    }
}

impl Chart {
    /// Its lines and points; none where it draws something else.
    pub fn series(&self) -> &[Series] {
        if let Drawn::Curves(curves) = &self.drawn { &curves.series } else { &[] }
    }
}

impl Series {
    /// A line without a spread.
    pub fn new(name: &str, x: Vec<f64>, y: Vec<f64>) -> Self {
        Self { name: name.to_owned(), x, y, ..Self::default() }
    }

    /// Its points.
    pub fn points(&self) -> impl Iterator<Item = [f64; 2]> {
        self.x.iter().zip(&self.y).map(|(x, y)| [*x, *y])
    }

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

impl Spread {
    /// From where to where the value `value` with this number is known; nothing where nothing is known of it.
    pub fn of(&self, number: usize, value: f64) -> Option<[f64; 2]> {
        let interval = match self {
            Self::Unknown => None,
            Self::Errors(errors) => errors.get(number).map(|error| [value - error, value + error]),
            Self::Intervals(ends) | Self::Band(ends) => ends.get(number).copied(),
        };
        interval.filter(|[low, high]| low.is_finite() && high.is_finite() && high > low)
    }
}

impl Candidates {
    /// Candidates whose values are all finite, each with its color value: the best first, equal ones in their order.
    pub fn ranked(&self) -> Vec<(&Vec<f64>, f64)> {
        let is_whole = |(row, shade): &(&Vec<f64>, f64)| {
            row.len() == self.axes.len() && shade.is_finite() && row.iter().all(|value| value.is_finite())
        };
        let mut ranked: Vec<_> = self.rows.iter().zip(self.shades.iter().copied()).filter(is_whole).collect();
        let sign = if self.is_large_good { -1.0 } else { 1.0 };
        ranked.sort_by(|a, b| (sign * a.1).total_cmp(&(sign * b.1)));
        ranked
    }
}
