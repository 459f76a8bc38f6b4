//! The tables of a campaign. They are written in the order of evaluations and starts, whoever ended first.

use std::borrow::Cow;
use std::fmt::Write as _;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::folder::files;
use crate::record::RecordError;
use crate::text::Number;

/// A CSV table whose cells may be words.
#[derive(Debug)]
pub struct Table {
    path: PathBuf,
    file: BufWriter<File>,
    line: String,
    is_begun: bool,
}

impl Table {
    /// Begins a table, in place of what was there.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn create<S: AsRef<str>>(
        path: &Path,
        columns: impl IntoIterator<Item = S>,
    ) -> Result<Self, RecordError> {
        let file = files::create(path).map_err(RecordError::file("create", path))?;
        let (path, file) = (path.to_owned(), BufWriter::new(file));
        let mut table = Self { path, file, line: String::new(), is_begun: false };
        columns.into_iter().for_each(|column| table.word(column.as_ref()));
        table.end_row()?;
        Ok(table)
    }

    fn separate(&mut self) {
        if std::mem::replace(&mut self.is_begun, true) {
            self.line.push(',');
        }
    }

    /// Adds a number with as few digits as bring back the same bits; an empty cell if there is none.
    pub fn number(&mut self, value: impl Into<Option<f64>>) {
        self.separate();
        if let Some(value) = value.into() {
            // Writing to a string cannot fail. An empty sum may be a negative zero, which no reader expects.
            let _ = write!(self.line, "{}", Number(value + 0.0));
        }
    }

    /// Adds a whole number; an empty cell if there is none.
    pub fn count(&mut self, value: impl Into<Option<u64>>) {
        self.separate();
        if let Some(value) = value.into() {
            // Writing to a string cannot fail.
            let _ = write!(self.line, "{value}");
        }
    }

    /// Adds words.
    pub fn word(&mut self, word: &str) {
        self.separate();
        self.line.push_str(&quoted(word));
    }

    /// Ends the row.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn end_row(&mut self) -> Result<(), RecordError> {
        self.line.push('\n');
        let written = self.file.write_all(self.line.as_bytes());
        self.line.clear();
        self.is_begun = false;
        written.map_err(RecordError::file("write", &self.path))
    }

    /// Hands all rows to the operating system.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn flush(&mut self) -> Result<(), RecordError> {
        self.file.flush().map_err(RecordError::file("write", &self.path))
    }
}

/// In quotes where the words would break the table (RFC 4180).
fn quoted(word: &str) -> Cow<'_, str> {
    if word.contains([',', '"', '\n', '\r']) {
        Cow::Owned(format!("\"{}\"", word.replace('"', "\"\"")))
    } else {
        Cow::Borrowed(word)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use agglo_testing::AWKWARD;

    #[test]
    fn awkward_numbers_come_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("table.csv");
        let mut table = Table::create(&path, ["a"]).unwrap();
        for value in AWKWARD {
            table.number(value);
            table.end_row().unwrap();
        }
        table.flush().unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        let read = text.lines().skip(1).map(|line| line.parse().unwrap());
        assert_eq!(read.collect::<Vec<f64>>(), AWKWARD);
        assert!(text.lines().all(|line| line.len() <= 24), "{text}");
    }

    #[test]
    fn rows_of_numbers_and_words() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("table.csv");
        let mut table = Table::create(&path, ["a", "b", "c", "d"]).unwrap();
        for word in ["plain", "with, comma", "a \"word\"\nbelow"] {
            table.number(None);
            table.number(0.1);
            table.count(7);
            table.word(word);
            table.end_row().unwrap();
        }
        table.flush().unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        let wanted = "a,b,c,d\n,0.1,7,plain\n,0.1,7,\"with, comma\"\n,0.1,7,\"a \"\"word\"\"\nbelow\"\n";
        assert_eq!(text, wanted);
    }
}
