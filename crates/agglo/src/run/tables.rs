//! The tables of a run as one: made, cut back and put onto the disk together.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::folder::Mark;
use crate::record::{Cell, Opened, RecordError, Series};

/// Tables by their place in the run's folder, with the names of their columns.
pub type Layout = &'static [(&'static str, &'static [&'static str])];

/// Columns that are `NaN` where there is nothing to be told; in all others, and anything infinite, that is an error.
const MAY_BE_UNKNOWN: [&str; 2] = ["fractal_dimension", "mean_free_time_s"];

/// Lengths and checksums of the tables' files.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TablesState {
    marks: Vec<Mark>,
}

impl TablesState {
    /// Opens the tables' files of a run that is to go on. None is changed: all are looked at before the first is cut.
    pub fn check(&self, layout: Layout, folder: &Path) -> Result<Vec<Opened>, RecordError> {
        if self.marks.len() != layout.len() {
            let reason = "the checkpoint knows other tables".to_owned();
            return Err(RecordError::Foreign { path: folder.to_owned(), reason });
        }
        let tables = layout.iter().zip(&self.marks);
        tables.map(|((place, columns), mark)| Series::check(&folder.join(place), columns, *mark)).collect()
    }
}

/// The tables of a run, in the order of their layout.
#[derive(Debug)]
pub struct Tables {
    layout: Layout,
    series: Vec<Series>,
}

impl Tables {
    /// Makes the tables' files below the run's folder.
    pub fn create(layout: Layout, folder: &Path) -> Result<Self, RecordError> {
        let make = |(place, columns): &(&str, &[&str])| Series::create(&folder.join(place), columns);
        Ok(Self { layout, series: layout.iter().map(make).collect::<Result<_, _>>()? })
    }

    /// Cuts the tables back to their marks and goes on from there.
    pub fn resume(layout: Layout, opened: Vec<Opened>) -> Result<Self, RecordError> {
        Ok(Self { layout, series: opened.into_iter().map(Opened::cut).collect::<Result<_, _>>()? })
    }

    /// Marks of the files.
    pub fn state(&self) -> TablesState {
        TablesState { marks: self.series.iter().map(Series::mark).collect() }
    }

    /// Hands all rows to the operating system.
    pub fn flush(&mut self) -> Result<(), RecordError> {
        self.series.iter_mut().try_for_each(Series::flush)
    }

    /// Puts all rows onto the disk.
    pub fn sync(&mut self) -> Result<(), RecordError> {
        self.series.iter_mut().try_for_each(Series::sync)
    }

    /// Adds one row to each of the first tables.
    pub fn rows<const N: usize>(&mut self, rows: [Vec<f64>; N]) -> Result<(), RecordError> {
        rows.into_iter().enumerate().try_for_each(|(table, row)| self.row(table, &row))
    }

    /// Adds a row to the table with this number.
    pub fn row(&mut self, table: usize, row: &[f64]) -> Result<(), RecordError> {
        self.refuse_not_finite(table, row.iter().copied().enumerate())?;
        self.series[table].row(row)
    }

    /// Adds a row of mixed cells to the table with this number.
    pub fn cells(&mut self, table: usize, cells: &[Cell]) -> Result<(), RecordError> {
        let number = |(at, cell): (usize, &Cell)| match cell {
            Cell::Number(value) => Some((at, *value)),
            Cell::Count(_) | Cell::Word(_) => None,
        };
        self.refuse_not_finite(table, cells.iter().enumerate().filter_map(number))?;
        self.series[table].cells(cells)
    }

    /// All rows of a run come by here: none has a figure that is not finite where one is due.
    fn refuse_not_finite(
        &self,
        table: usize,
        mut row: impl Iterator<Item = (usize, f64)>,
    ) -> Result<(), RecordError> {
        let (place, columns) = self.layout[table];
        let name = |at: usize| columns.get(at).copied().unwrap_or_default();
        let is_odd = |&(at, value): &(usize, f64)| {
            !(value.is_finite() || value.is_nan() && MAY_BE_UNKNOWN.contains(&name(at)))
        };
        match row.find(is_odd) {
            None => Ok(()),
            Some((at, _)) => Err(RecordError::NotFinite { path: place.into(), column: name(at).to_owned() }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAYOUT: Layout = &[("a.csv", &["time_s", "fractal_dimension"]), ("b.csv", &["event", "kind"])];

    #[test]
    fn figures_that_are_not_finite_are_not_written() {
        let folder = tempfile::tempdir().unwrap();
        let mut tables = Tables::create(LAYOUT, folder.path()).unwrap();
        tables.row(0, &[-0.0, f64::NAN]).unwrap();
        tables.cells(1, &[Cell::Number(1.0), Cell::Word("merge")]).unwrap();
        for row in [[f64::NAN, 0.0], [f64::INFINITY, 0.0], [0.0, f64::INFINITY], [0.0, f64::NEG_INFINITY]] {
            let error = tables.row(0, &row).unwrap_err().to_string();
            let column = if row[0].is_finite() { "fractal_dimension" } else { "time_s" };
            assert!(error.contains(&format!("a.csv: {column} is not finite")), "{error}");
        }
        assert_err!(tables.cells(1, &[Cell::Number(f64::NAN), Cell::Word("merge")]));
        tables.flush().unwrap();
        let written = std::fs::read_to_string(folder.path().join("a.csv")).unwrap();
        assert_eq!(written, "time_s,fractal_dimension\n0,NaN\n");
    }
}
