//! The tables of a run as one: made, cut back and put onto the disk together.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::record::{Cell, RecordError, Series};

/// Tables by their place in the run's folder, with the names of their columns.
pub type Layout = &'static [(&'static str, &'static [&'static str])];

/// Lengths of the tables' files [bytes].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TablesState {
    positions: Vec<u64>,
}

impl TablesState {
    fn files(&self, layout: Layout, folder: &Path) -> impl Iterator<Item = (PathBuf, u64)> {
        layout.iter().zip(&self.positions).map(move |((place, _), bytes)| (folder.join(place), *bytes))
    }
}

/// The tables of a run, in the order of their layout.
#[derive(Debug)]
pub struct Tables {
    series: Vec<Series>,
}

impl Tables {
    /// Makes the tables' files below the run's folder.
    pub fn create(layout: Layout, folder: &Path) -> Result<Self, RecordError> {
        let make = |(place, columns): &(&str, &[&str])| Series::create(&folder.join(place), columns);
        Ok(Self { series: layout.iter().map(make).collect::<Result<_, _>>()? })
    }

    /// Opens the tables' files and cuts them back. All are looked at before the first is cut: a run that cannot go on
    /// stays as it is.
    pub fn resume(layout: Layout, folder: &Path, state: &TablesState) -> Result<Self, RecordError> {
        state.files(layout, folder).try_for_each(|(path, bytes)| Series::check(&path, bytes))?;
        let open = |(path, bytes): (PathBuf, u64)| Series::reopen_at(&path, bytes);
        Ok(Self { series: state.files(layout, folder).map(open).collect::<Result<_, _>>()? })
    }

    /// Lengths of the files.
    pub fn state(&self) -> TablesState {
        TablesState { positions: self.series.iter().map(Series::position).collect() }
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
        rows.into_iter().enumerate().try_for_each(|(table, row)| self.row(table, row))
    }

    /// Adds a row to the table with this number.
    pub fn row(&mut self, table: usize, mut row: Vec<f64>) -> Result<(), RecordError> {
        // An empty sum may be a negative zero, which no reader expects.
        for value in &mut row {
            *value += 0.0;
        }
        self.series[table].row(&row)
    }

    /// Adds a row of mixed cells to the table with this number.
    pub fn cells(&mut self, table: usize, cells: &[Cell]) -> Result<(), RecordError> {
        self.series[table].cells(cells)
    }
}
