//! What is told of a run while it goes on, in plain words.

use std::path::Path;

use super::tail::Tail;
use agglo::folder::names;
use agglo::record::columns::Glance;
use agglo::record::{About, RecordError};
use agglo::run::tables;
use agglo::text::readable;

/// A quantity of the newest row.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// Its name in plain words.
    pub name: &'static str,
    /// Its table in `series/` and its column.
    pub column: (&'static str, &'static str),
    /// Its value in SI units.
    pub value: f64,
    /// Its unit; `%` for a part of one.
    pub unit: &'static str,
}

impl Reading {
    /// The value as people read it: "3.2 mm/s", "41.0 %".
    pub fn text(&self) -> String {
        match self.unit {
            _ if self.value.is_nan() => "-".to_owned(),
            "%" => format!("{:.1} %", 100.0 * self.value),
            unit => readable(self.value, unit),
        }
    }
}

/// A quantity over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Its name in plain words.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Times [s] and values [n]; only where they are finite.
    pub points: Vec<(f64, f64)>,
}

/// The name of a table, and one of its columns that is told of.
type Shown = (&'static str, Glance, &'static About);

/// The tables that quantities come from.
#[derive(Debug)]
pub(super) struct Tables {
    tails: Vec<(&'static str, Tail)>,
    /// What is told of, in its order.
    shown: Vec<Shown>,
}

impl Tables {
    /// Those of a run of hard or of soft spheres in this folder.
    pub fn new(dir: &Path, is_hard: bool) -> Self {
        let mut shown = Vec::new();
        for table in tables(is_hard) {
            let told = |column: &'static About| Some((table.series()?, column.glance?, column));
            shown.extend(table.columns().into_iter().filter_map(told));
        }
        shown.sort_by_key(|(_, glance, _)| glance.place);
        let mut names: Vec<&str> = shown.iter().map(|(table, ..)| *table).collect();
        names.sort_unstable();
        names.dedup();
        let tail = |name: &'static str| (name, Tail::new(&dir.join(names::series(name))));
        Self { tails: names.into_iter().map(tail).collect(), shown }
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

    fn shown(&self) -> impl Iterator<Item = &Shown> {
        let has_rays = self.has_rays();
        self.shown.iter().filter(move |(table, ..)| *table != "rays" || has_rays)
    }

    /// Quantities of the newest rows.
    pub fn quantities(&self) -> Vec<Reading> {
        let quantity = |&(table, _, column): &Shown| {
            let value = self.newest(table, column.name)?;
            let unit = if column.is_part { "%" } else { column.unit };
            Some(Reading { name: column.label, column: (table, column.name), value, unit })
        };
        self.shown().filter_map(quantity).collect()
    }

    /// Curves over time.
    pub fn curves(&self) -> Vec<Curve> {
        let curve = |&(table, _, column): &Shown| {
            let tail = self.tail(table)?;
            let points = tail.column("time_s")?.zip(tail.column(column.name)?);
            let points = points.filter(|(_, value)| value.is_finite()).collect();
            Some(Curve { name: column.label, unit: column.unit, points })
        };
        self.shown().filter(|(_, glance, _)| glance.has_curve).filter_map(curve).collect()
    }
}
