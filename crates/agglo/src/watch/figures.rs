//! What is told of a run while it goes on, in plain words.

use std::path::Path;

use super::tail::Tail;
use crate::record::RecordError;
use crate::text::readable;

/// A figure of the newest row.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Its name in plain words.
    pub name: &'static str,
    /// Its table in `series/` and its column.
    pub column: (&'static str, &'static str),
    /// Its value in SI units.
    pub value: f64,
    /// Its unit; `%` for a part of one.
    pub unit: &'static str,
}

impl Figure {
    /// The value as people read it: "3.2 mm/s", "41.0 %".
    pub fn text(&self) -> String {
        match self.unit {
            _ if self.value.is_nan() => "-".to_owned(),
            "%" => format!("{:.1} %", 100.0 * self.value),
            unit => readable(self.value, unit),
        }
    }
}

/// A figure over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Its name in plain words.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Times [s] and values [n]; only where they are finite.
    pub points: Vec<(f64, f64)>,
}

/// Name, table, column, unit.
type Row = (&'static str, &'static str, &'static str, &'static str);

const SOFT: &[Row] = &[
    ("dispersion degree", "clusters", "dispersion_degree", "%"),
    ("clusters", "clusters", "clusters", ""),
    ("largest cluster", "clusters", "largest_fraction", "%"),
    ("contacts", "clusters", "contacts", ""),
    ("bonds", "clusters", "bonds", ""),
    ("mean speed", "moments", "mean_speed_m_s", "m/s"),
    ("rays in flight", "rays", "in_flight", ""),
    ("power in flight", "rays", "flying_magnitude", "%"),
    ("kinetic energy", "energy", "kinetic_J", "J"),
    ("step", "steps", "step_size_s", "s"),
    ("energy drift", "energy", "drift_relative", ""),
];
const SOFT_CURVES: &[Row] = &[
    ("dispersion degree", "clusters", "dispersion_degree", ""),
    ("power in flight", "rays", "flying_magnitude", ""),
    ("mean speed", "moments", "mean_speed_m_s", "m/s"),
];
const HARD: &[Row] = &[
    ("grains", "grains", "grains", ""),
    ("mean radius", "grains", "mean_radius_m", "m"),
    ("largest radius", "grains", "largest_radius_m", "m"),
    ("largest grain", "grains", "largest_fraction", "%"),
    ("mean temperature", "grains", "mean_temperature_K", "K"),
    ("mean speed", "grains", "mean_speed_m_s", "m/s"),
    ("impacts", "impacts", "impacts", ""),
    ("merges", "impacts", "merges", ""),
    ("breakages", "impacts", "fragmentations", ""),
    ("time between steps", "steps", "step_size_s", "s"),
    ("energy drift", "energy", "drift_relative", ""),
];
const HARD_CURVES: &[Row] = &[
    ("grains", "grains", "grains", ""),
    ("mean radius", "grains", "mean_radius_m", "m"),
    ("mean temperature", "grains", "mean_temperature_K", "K"),
];

/// The tables that figures come from.
#[derive(Debug)]
pub(super) struct Tables {
    tails: Vec<(&'static str, Tail)>,
    figures: &'static [Row],
    curves: &'static [Row],
}

impl Tables {
    /// Those of a run of hard or of soft spheres in the folder `series`.
    pub fn new(series: &Path, is_hard: bool) -> Self {
        let (names, figures, curves): (&[&'static str], _, _) = if is_hard {
            (&["grains", "impacts", "energy", "steps"], HARD, HARD_CURVES)
        } else {
            (&["clusters", "moments", "rays", "energy", "steps"], SOFT, SOFT_CURVES)
        };
        let tail = |&name: &&'static str| (name, Tail::new(&series.join(format!("{name}.csv"))));
        Self { tails: names.iter().map(tail).collect(), figures, curves }
    }

    /// Reads what is new.
    pub fn read(&mut self) -> Result<(), RecordError> {
        self.tails.iter_mut().try_for_each(|(_, tail)| tail.read())
    }

    fn tail(&self, table: &str) -> Option<&Tail> {
        self.tails.iter().find(|(name, _)| *name == table).map(|(_, tail)| tail)
    }

    /// The newest value of a column.
    pub fn newest(&self, table: &str, column: &str) -> Option<f64> {
        self.tail(table)?.column(column)?.next_back()
    }

    /// Whether there were rays: a run without beams has nothing to tell of them.
    fn has_rays(&self) -> bool {
        self.newest("rays", "pulses").is_some_and(|pulses| pulses > 0.0)
    }

    fn shown<'a>(&self, rows: &'a [Row]) -> impl Iterator<Item = &'a Row> {
        let has_rays = self.has_rays();
        rows.iter().filter(move |(_, table, ..)| *table != "rays" || has_rays)
    }

    /// Figures of the newest rows.
    pub fn figures(&self) -> Vec<Figure> {
        let figure = |&(name, table, column, unit): &Row| {
            Some(Figure { name, column: (table, column), value: self.newest(table, column)?, unit })
        };
        self.shown(self.figures).filter_map(figure).collect()
    }

    /// Curves over time.
    pub fn curves(&self) -> Vec<Curve> {
        let curve = |&(name, table, column, unit): &Row| {
            let tail = self.tail(table)?;
            let points = tail.column("time_s")?.zip(tail.column(column)?);
            let points = points.filter(|(_, value)| value.is_finite()).collect();
            Some(Curve { name, unit, points })
        };
        self.shown(self.curves).filter_map(curve).collect()
    }
}
