//! The one reader of tables: numbers and words.

use std::path::Path;

use csv::{ReaderBuilder, StringRecord};

use super::door;

/// A table as it stands in its file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sheet {
    /// Names of the columns.
    pub names: Vec<String>,
    /// Rows, each with an entry for every column.
    pub rows: Vec<Vec<String>>,
    /// Rows that are cut or damaged and were left out.
    pub dropped: usize,
}

impl Sheet {
    /// Reads a table; rows of another length than the header are left out and counted.
    ///
    /// # Errors
    /// Why it cannot be read.
    pub fn read(path: &Path) -> Result<Self, String> {
        Self::read_with(path, true)
    }

    /// The same; without `quotes` they are letters as any other, and a stray one does not swallow the rows after it.
    ///
    /// # Errors
    /// Why it cannot be read.
    pub fn read_with(path: &Path, quotes: bool) -> Result<Self, String> {
        // Bytes that are no text become entries that are no numbers.
        let bytes = door::read(path, door::MOST_OF_A_TABLE).map_err(|error| error.to_string())?;
        let text = String::from_utf8_lossy(&bytes);
        let mut rows = rows(&text, quotes).map(|row| row.iter().map(str::to_owned).collect());
        let Some(names) = rows.next() else { return Err("it is empty".to_owned()) };
        let mut rows: Vec<Vec<String>> = rows.collect();
        let all = rows.len();
        // The last row of a file that does not end its last line may have lost digits.
        if !text.ends_with('\n') {
            rows.pop();
        }
        rows.retain(|row| row.len() == names.len());
        Ok(Self { dropped: all - rows.len(), names, rows })
    }

    /// The place of the column of that name.
    pub fn place(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// The column of that name.
    pub fn words(&self, name: &str) -> Option<Vec<&str>> {
        let at = self.place(name)?;
        Some(self.rows.iter().map(|row| row[at].as_str()).collect())
    }

    /// The column of that name as numbers; an entry that is none is NaN.
    pub fn numbers(&self, name: &str) -> Option<Vec<f64>> {
        Some(self.words(name)?.into_iter().map(|entry| entry.parse().unwrap_or(f64::NAN)).collect())
    }

    /// Keeps the rows that have this word in this column; all where there is no such column.
    pub fn keep(&mut self, name: &str, word: &str) {
        if let Some(at) = self.place(name) {
            self.rows.retain(|row| row[at] == word);
        }
    }
}

/// The rows of a text, whatever the numbers of their entries; without `quotes` these are letters as any other.
pub fn rows(text: &str, quotes: bool) -> impl Iterator<Item = StringRecord> {
    let mut reader = ReaderBuilder::new();
    let reader = reader.has_headers(false).flexible(true).quoting(quotes).from_reader(text.as_bytes());
    // Text has no rows that cannot be read.
    reader.into_records().flatten()
}
