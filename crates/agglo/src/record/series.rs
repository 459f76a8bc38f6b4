//! Tables that grow by a row now and then.

use std::fmt::Write as _;
use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::{Number, RecordError};

/// An entry of a row that mixes numbers and words.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cell {
    /// A quantity.
    Number(f64),
    /// A name or a count.
    Count(u64),
    /// A word without commas.
    Word(&'static str),
}

/// A CSV table of numbers with one header line; names of columns carry their unit (`time_s`).
///
/// Numbers are written with as few digits as bring back the same bits.
#[derive(Debug)]
pub struct Series {
    path: PathBuf,
    columns: usize,
    file: BufWriter<File>,
    bytes: u64,
    line: String,
}

impl Series {
    /// Begins a table, in place of what was there.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn create(path: &Path, columns: &[&str]) -> Result<Self, RecordError> {
        let file = File::create(path).map_err(RecordError::file("create", path))?;
        let mut series = Self::over(path, columns.len(), file, 0);
        series.line.push_str(&columns.join(","));
        series.end_line()?;
        Ok(series)
    }

    /// Goes on with a table at the length `bytes` that [`Series::position`] gave; later rows are dropped.
    ///
    /// # Errors
    /// [`RecordError::Shorter`] where the table has fewer bytes, [`RecordError::File`].
    pub fn reopen_at(path: &Path, bytes: u64) -> Result<Self, RecordError> {
        Self::check(path, bytes)?;
        let reopen = RecordError::file("reopen", path);
        let file = OpenOptions::new().read(true).write(true).open(path).map_err(reopen)?;
        let mut header = String::new();
        BufReader::new(&file).read_line(&mut header).map_err(RecordError::file("read", path))?;
        let columns = header.trim_end().split(',').count();
        let mut series = Self::over(path, columns, file, bytes);
        let file = series.file.get_mut();
        let cut = file.set_len(bytes).and_then(|()| file.seek(SeekFrom::Start(bytes)));
        cut.map_err(RecordError::file("cut", path))?;
        Ok(series)
    }

    /// Whether a table can be reopened at the length `bytes`; it is not changed.
    ///
    /// # Errors
    /// [`RecordError::Shorter`] where the table has fewer bytes, [`RecordError::File`].
    pub fn check(path: &Path, bytes: u64) -> Result<(), RecordError> {
        let found = path.metadata().map_err(RecordError::file("reopen", path))?.len();
        if found < bytes {
            return Err(RecordError::Shorter { path: path.to_owned(), found, expected: bytes });
        }
        Ok(())
    }

    fn over(path: &Path, columns: usize, file: File, bytes: u64) -> Self {
        Self { path: path.to_owned(), columns, file: BufWriter::new(file), bytes, line: String::new() }
    }

    /// Adds a row.
    ///
    /// # Errors
    /// [`RecordError::Shape`] where the row does not fit the header, [`RecordError::File`].
    pub fn row(&mut self, values: &[f64]) -> Result<(), RecordError> {
        self.check_length(values.len())?;
        for (k, value) in values.iter().enumerate() {
            let comma = if k == 0 { "" } else { "," };
            // Writing to a string cannot fail.
            let _ = write!(self.line, "{comma}{}", Number(*value));
        }
        self.end_line()
    }

    /// Adds a row that mixes numbers and words.
    ///
    /// # Errors
    /// [`RecordError::Shape`] where the row does not fit the header, [`RecordError::File`].
    pub fn cells(&mut self, cells: &[Cell]) -> Result<(), RecordError> {
        self.check_length(cells.len())?;
        for (k, cell) in cells.iter().enumerate() {
            let comma = if k == 0 { "" } else { "," };
            // Writing to a string cannot fail.
            let _ = match cell {
                Cell::Number(value) => write!(self.line, "{comma}{}", Number(*value)),
                Cell::Count(count) => write!(self.line, "{comma}{count}"),
                Cell::Word(word) => write!(self.line, "{comma}{word}"),
            };
        }
        self.end_line()
    }

    fn check_length(&self, found: usize) -> Result<(), RecordError> {
        if found == self.columns {
            return Ok(());
        }
        let (path, what) = (self.path.clone(), "a row".to_owned());
        Err(RecordError::Shape { path, what, found, expected: self.columns })
    }

    fn end_line(&mut self) -> Result<(), RecordError> {
        self.line.push('\n');
        self.file.write_all(self.line.as_bytes()).map_err(RecordError::file("write", &self.path))?;
        self.bytes += self.line.len() as u64;
        self.line.clear();
        Ok(())
    }

    /// Hands all rows to the operating system.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn flush(&mut self) -> Result<(), RecordError> {
        self.file.flush().map_err(RecordError::file("write", &self.path))
    }

    /// Puts all rows onto the disk: to be done before a checkpoint that counts on them.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn sync(&mut self) -> Result<(), RecordError> {
        self.flush()?;
        self.file.get_ref().sync_data().map_err(RecordError::file("write", &self.path))
    }

    /// Length of the table so far [bytes], rows not yet flushed included.
    pub fn position(&self) -> u64 {
        self.bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::AWKWARD;

    fn read(path: &Path) -> Vec<Vec<f64>> {
        let text = std::fs::read_to_string(path).unwrap();
        text.lines().skip(1).map(|line| line.split(',').map(|word| word.parse().unwrap()).collect()).collect()
    }

    #[test]
    fn numbers_come_back_bit_by_bit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("series.csv");
        let rows =
            [[0.1, 1.0 / 3.0, f64::MIN_POSITIVE], [f64::MAX, -0.0, 5e-324], [1e22, 123_456_789.125, 2.5e-7]];
        let mut series = Series::create(&path, &["time_s", "kinetic_energy_j", "speed_m_s"]).unwrap();
        for row in &rows {
            series.row(row).unwrap();
        }
        series.flush().unwrap();
        assert_eq!(series.position(), path.metadata().unwrap().len());
        let bits = |row: &[f64]| row.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
        for (written, read) in rows.iter().zip(read(&path)) {
            assert_eq!(bits(written), bits(&read));
        }
        let header = std::fs::read_to_string(&path).unwrap();
        assert!(header.starts_with(
            "time_s,kinetic_energy_j,speed_m_s\n0.1,0.3333333333333333,2.2250738585072014e-308\n"
        ));
    }

    /// Both kinds of rows, with numbers that other writers lose; counts have no point.
    #[test]
    fn awkward_numbers_come_back_from_every_row() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("series.csv");
        let mut series = Series::create(&path, &["a", "b"]).unwrap();
        for value in AWKWARD {
            series.row(&[value, 1512.0]).unwrap();
            series.cells(&[Cell::Number(value), Cell::Count(1512)]).unwrap();
        }
        series.flush().unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(text.lines().filter(|line| line.ends_with(",1512")).count(), 2 * AWKWARD.len());
        let rows = read(&path);
        for (pair, value) in rows.chunks(2).zip(AWKWARD) {
            assert!(pair.iter().all(|row| row[0].to_bits() == value.to_bits()), "{value:e}");
        }
    }

    #[test]
    fn reopened_tables_go_on_where_they_were() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("series.csv");
        let mut series = Series::create(&path, &["time_s", "count"]).unwrap();
        series.row(&[0.0, 1.0]).unwrap();
        let position = series.position();
        series.row(&[1.0, 2.0]).unwrap();
        series.row(&[2.0, 3.0]).unwrap();
        drop(series);
        let mut again = Series::reopen_at(&path, position).unwrap();
        assert_eq!(again.position(), position);
        again.row(&[1.0, 20.0]).unwrap();
        assert!(matches!(again.row(&[1.0]), Err(RecordError::Shape { found: 1, expected: 2, .. })));
        again.sync().unwrap();
        assert_eq!(read(&path), [[0.0, 1.0], [1.0, 20.0]]);
        let error = Series::reopen_at(&path, 1000).unwrap_err().to_string();
        assert!(error.contains("but the checkpoint was written when it had 1000"), "{error}");
    }

    #[test]
    fn a_place_that_cannot_be_written_is_named() {
        let error = Series::create(Path::new("/nowhere/series.csv"), &["time_s"]).unwrap_err().to_string();
        assert_eq!(error, "cannot create /nowhere/series.csv: no such file or folder");
        #[cfg(target_os = "linux")]
        {
            let mut full = Series::create(Path::new("/dev/full"), &["time_s"]).unwrap();
            assert_eq!(full.flush().unwrap_err().to_string(), "cannot write /dev/full: the disk is full");
        }
    }
}
