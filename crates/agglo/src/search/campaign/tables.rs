//! The tables of a campaign as files. They are written in the order of evaluations and replicates, whoever ended first.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use crate::folder::files;
use crate::record::columns::{Cell, Column, Declared};
use crate::record::{RecordError, Rows, Unknown};

/// A CSV table of declared columns and of more that the campaign has of its own. What cannot be had is an empty cell.
#[derive(Debug)]
pub struct Table {
    path: PathBuf,
    rows: Rows<BufWriter<File>>,
}

impl Table {
    /// Begins a table in the folder, in place of what was there.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn begin(folder: &Path, table: &dyn Declared, more: &[String]) -> Result<Self, RecordError> {
        let path = folder.join(table.file());
        let file = files::create(&path).map_err(RecordError::file("create", &path))?;
        let mut begun = Self { path, rows: Rows::over(BufWriter::new(file), Unknown::Empty) };
        let names = table.names();
        begun.row(names.into_iter().chain(more.iter().map(String::as_str)).map(Cell::Word))?;
        Ok(begun)
    }

    /// Adds a row.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn put<'a, S>(
        &mut self,
        columns: &'a [Column<S>],
        of: &'a S,
        more: impl IntoIterator<Item = Cell<'a>>,
    ) -> Result<(), RecordError> {
        self.row(columns.iter().map(|column| column.cell(of)).chain(more))
    }

    fn row<'a>(&mut self, cells: impl Iterator<Item = Cell<'a>>) -> Result<(), RecordError> {
        self.rows.row(cells).map_err(RecordError::file("write", &self.path))
    }

    /// Hands all rows to the operating system.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn flush(&mut self) -> Result<(), RecordError> {
        self.rows.flush().map_err(RecordError::file("write", &self.path))
    }
}
