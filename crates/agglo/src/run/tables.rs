//! The tables of a run as one: made, cut back and put onto the disk together.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::folder::Mark;
use crate::record::{Cell, Opened, RecordError, Series};

/// Tables by their place in the run's folder, with the names of their columns.
pub type Layout = &'static [(&'static str, &'static [&'static str])];

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
    series: Vec<Series>,
}

impl Tables {
    /// Makes the tables' files below the run's folder.
    pub fn create(layout: Layout, folder: &Path) -> Result<Self, RecordError> {
        let make = |(place, columns): &(&str, &[&str])| Series::create(&folder.join(place), columns);
        Ok(Self { series: layout.iter().map(make).collect::<Result<_, _>>()? })
    }

    /// Cuts the tables back to their marks and goes on from there.
    pub fn resume(opened: Vec<Opened>) -> Result<Self, RecordError> {
        Ok(Self { series: opened.into_iter().map(Opened::cut).collect::<Result<_, _>>()? })
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
