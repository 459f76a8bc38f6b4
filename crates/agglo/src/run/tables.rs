//! The tables of a run as one: made, cut back and put onto the disk together.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::folder::Mark;
use crate::record::columns::{Declared, Table};
use crate::record::{Opened, RecordError, Series};

/// Lengths and checksums of the tables' files.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TablesState {
    marks: Vec<Mark>,
}

impl TablesState {
    /// Opens the tables' files of a run that is to go on. None is changed: all are looked at before the first is cut.
    pub fn check(&self, layout: &[&dyn Declared], folder: &Path) -> Result<Vec<Opened>, RecordError> {
        if self.marks.len() != layout.len() {
            let reason = "the checkpoint knows other tables".to_owned();
            return Err(RecordError::Foreign { path: folder.to_owned(), reason });
        }
        let tables = layout.iter().zip(&self.marks);
        tables.map(|(table, mark)| Series::check(&folder.join(table.file()), &table.names(), *mark)).collect()
    }
}

/// The tables of a run, in the order of their layout.
#[derive(Debug)]
pub struct Tables {
    layout: Vec<&'static dyn Declared>,
    series: Vec<Series>,
}

impl Tables {
    /// Makes the tables' files below the run's folder.
    pub fn create(layout: Vec<&'static dyn Declared>, folder: &Path) -> Result<Self, RecordError> {
        let make = |table: &&dyn Declared| Series::create(&folder.join(table.file()), &table.names());
        let series = layout.iter().map(make).collect::<Result<_, _>>()?;
        Ok(Self { layout, series })
    }

    /// Cuts the tables back to their marks and goes on from there.
    pub fn resume(layout: Vec<&'static dyn Declared>, opened: Vec<Opened>) -> Result<Self, RecordError> {
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

    /// Adds a row to a table of the layout.
    ///
    /// All rows of a run come by here: none has a quantity that is not finite where one is due.
    pub fn put<S>(&mut self, table: &Table<S>, of: &S) -> Result<(), RecordError> {
        let at = self.layout.iter().position(|known| known.file() == table.file);
        let unknown = || RecordError::Foreign {
            path: table.file.into(),
            reason: "it is no table of this run".to_owned(),
        };
        self.series[at.ok_or_else(unknown)?].put(table.columns, of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::columns::{number, number_or_none, word};

    static NUMBERS: Table<[f64; 2]> = Table {
        file: "a.csv",
        columns: &[
            number("time_s", "s", "", "", |row| row[0]),
            number_or_none("gap_m", "m", "", "", |row| (row[1] != 0.0).then_some(row[1])),
        ],
    };
    static WORDS: Table<f64> = Table {
        file: "b.csv",
        columns: &[number("event", "", "", "", |row| *row), word("kind", "", "", |_| "merge")],
    };

    fn layout() -> Vec<&'static dyn Declared> {
        vec![&NUMBERS, &WORDS]
    }

    #[test]
    fn quantities_that_are_not_finite_are_not_written() {
        let folder = tempfile::tempdir().unwrap();
        let mut tables = Tables::create(layout(), folder.path()).unwrap();
        tables.put(&NUMBERS, &[-0.0, 0.0]).unwrap();
        tables.put(&WORDS, &1.0).unwrap();
        for row in [[f64::NAN, 0.0], [f64::INFINITY, 0.0], [0.0, f64::INFINITY], [0.0, f64::NAN]] {
            let error = tables.put(&NUMBERS, &row).unwrap_err().to_string();
            let column = if row[0].is_finite() { "gap_m" } else { "time_s" };
            assert!(error.contains(&format!("a.csv: {column} is not finite")), "{error}");
        }
        assert_err!(tables.put(&WORDS, &f64::NAN));
        tables.flush().unwrap();
        let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
        assert_eq!(
            (read("a.csv"), read("b.csv")),
            ("time_s,gap_m\n0,NaN\n".into(), "event,kind\n1,merge\n".into())
        );
        let stranger: Table<f64> = Table { file: "c.csv", columns: &[] };
        assert_contains!(tables.put(&stranger, &0.0).unwrap_err().to_string(), "no table of this run");
    }
}
