//! The one writer of tables: rows of cells as CSV.

use std::fmt::Write as _;
use std::io::{self, Write};

use csv::Writer;

use super::columns::Cell;
use crate::text::Number;

/// What stands for what cannot be had.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// `NaN`: in tables over time, whose entries are all numbers.
    NotANumber,
    /// Nothing: in tables of searches and studies.
    Empty,
}

/// Writes rows. Numbers have as few digits as bring back the same bits; words are in quotes where they would break the table
/// (RFC 4180).
#[derive(Debug)]
pub struct Rows<W: Write> {
    writer: Writer<W>,
    unknown: Unknown,
    text: String,
}

impl<W: Write> Rows<W> {
    /// Goes on after what `inner` has already.
    pub fn over(inner: W, unknown: Unknown) -> Self {
        Self { writer: Writer::from_writer(inner), unknown, text: String::new() }
    }

    /// Adds an entry to the row.
    ///
    /// # Errors
    /// What the writer below says.
    pub fn cell(&mut self, cell: Cell<'_>) -> io::Result<()> {
        self.text.clear();
        // Writing to a string cannot fail.
        let _ = match cell {
            Cell::Number(value) => write!(self.text, "{}", Number(value)),
            Cell::Count(count) => write!(self.text, "{count}"),
            Cell::Unknown if self.unknown == Unknown::NotANumber => write!(self.text, "{}", Number(f64::NAN)),
            Cell::Unknown => Ok(()),
            Cell::Word(word) => return Ok(self.writer.write_field(word)?),
        };
        Ok(self.writer.write_field(&self.text)?)
    }

    /// Ends the row.
    ///
    /// # Errors
    /// What the writer below says; also where it has another number of entries than the first one.
    pub fn end(&mut self) -> io::Result<()> {
        Ok(self.writer.write_record(None::<&[u8]>)?)
    }

    /// Adds a row.
    ///
    /// # Errors
    /// What the writer below says.
    pub fn row<'a>(&mut self, cells: impl IntoIterator<Item = Cell<'a>>) -> io::Result<()> {
        cells.into_iter().try_for_each(|cell| self.cell(cell))?;
        self.end()
    }

    /// Hands all rows on.
    ///
    /// # Errors
    /// What the writer below says.
    pub fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }

    /// What is written into; rows that were not [handed on](Self::flush) are not there yet.
    pub fn inner(&self) -> &W {
        self.writer.get_ref()
    }
}

impl Rows<Vec<u8>> {
    /// A table in memory.
    pub fn in_memory() -> Self {
        Self::over(Vec::new(), Unknown::Empty)
    }

    /// Its text.
    pub fn into_text(self) -> String {
        // Memory takes all, and only text goes in.
        String::from_utf8(self.writer.into_inner().unwrap_or_default()).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use agglo_testing::AWKWARD;

    #[test]
    fn awkward_numbers_come_back() {
        let mut rows = Rows::in_memory();
        for value in AWKWARD {
            rows.row([Cell::Number(value), Cell::Count(1512)]).unwrap();
        }
        let text = rows.into_text();
        let read = text.lines().map(|line| line.strip_suffix(",1512").unwrap().parse().unwrap());
        assert_eq!(read.collect::<Vec<f64>>(), AWKWARD);
        assert!(text.lines().all(|line| line.len() <= 24 + 5), "{text}");
    }

    #[test]
    fn words_that_would_break_the_table_are_in_quotes() {
        let mut rows = Rows::in_memory();
        for word in ["plain", "with, comma", "a \"word\"\nbelow"] {
            rows.row([Cell::Unknown, Cell::Number(0.1), Cell::Count(7), Cell::Word(word)]).unwrap();
        }
        let wanted = ",0.1,7,plain\n,0.1,7,\"with, comma\"\n,0.1,7,\"a \"\"word\"\"\nbelow\"\n";
        assert_eq!(rows.into_text(), wanted);
    }

    #[test]
    fn what_is_unknown_is_no_number_where_all_are_numbers() {
        let mut rows = Rows::over(Vec::new(), Unknown::NotANumber);
        rows.row([Cell::Unknown, Cell::Number(-0.0)]).unwrap();
        assert_eq!(rows.into_text(), "NaN,0\n");
    }
}
