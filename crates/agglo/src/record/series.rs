//! Tables that grow by a row now and then.

use std::fmt::Write as _;
use std::fs::{File, OpenOptions};
use std::io::{BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::{RecordError, atomic};
use crate::folder::{Mark, Marking, files};
use crate::text::Number;

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
    marking: Marking,
    line: String,
}

impl Series {
    /// Begins a table, in place of what was there.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn create(path: &Path, columns: &[&str]) -> Result<Self, RecordError> {
        let file = files::create(path).map_err(RecordError::file("create", path))?;
        let mut series = Self::over(path, columns.len(), file, Marking::default());
        series.line.push_str(&columns.join(","));
        series.end_line()?;
        Ok(series)
    }

    /// Opens a table that is to go on at a mark that [`Series::mark`] gave; it is not changed yet.
    ///
    /// # Errors
    /// [`RecordError::Shorter`] where the table has fewer bytes, [`RecordError::Foreign`] where they are others,
    /// [`RecordError::File`].
    pub fn check(path: &Path, columns: &[&str], mark: Mark) -> Result<Opened, RecordError> {
        let mut options = OpenOptions::new();
        let file = files::open(path, options.read(true).write(true));
        let file = file.map_err(RecordError::file("reopen", path))?;
        let found = file.metadata().map_err(RecordError::file("reopen", path))?.len();
        if found < mark.bytes {
            return Err(RecordError::Shorter { path: path.to_owned(), found, expected: mark.bytes });
        }
        let marking = Marking::of(&file, mark.bytes).map_err(RecordError::file("read", path))?;
        if marking.mark() == mark {
            return Ok(Opened { path: path.to_owned(), columns: columns.len(), file, marking });
        }
        let header =
            first_line(&file, columns.join(",").len() + 1).map_err(RecordError::file("read", path))?;
        let reason = if header == (columns.join(",") + "\n").as_bytes() {
            "what the run had written there was changed since, or is of another run"
        } else {
            "its first line is not that of the run's table"
        };
        Err(RecordError::Foreign { path: path.to_owned(), reason: reason.to_owned() })
    }

    fn over(path: &Path, columns: usize, file: File, marking: Marking) -> Self {
        Self { path: path.to_owned(), columns, file: BufWriter::new(file), marking, line: String::new() }
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
        self.marking.add(self.line.as_bytes());
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

    /// Length and checksum of the table so far, rows not yet flushed included.
    pub fn mark(&self) -> Mark {
        self.marking.mark()
    }
}

/// The first bytes of a file.
fn first_line(mut file: &File, bytes: usize) -> std::io::Result<Vec<u8>> {
    let mut line = Vec::new();
    file.seek(SeekFrom::Start(0))?;
    file.take(bytes as u64).read_to_end(&mut line)?;
    Ok(line)
}

/// A table that is as it was at its mark, and may hold rows beyond.
#[derive(Debug)]
pub struct Opened {
    path: PathBuf,
    columns: usize,
    file: File,
    marking: Marking,
}

impl Opened {
    /// Drops what is beyond the mark and goes on from there.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn cut(self) -> Result<Series, RecordError> {
        let Self { path, columns, file, marking } = self;
        let mut file = atomic::alone(&path, file)?;
        let bytes = marking.mark().bytes;
        let cut = file.set_len(bytes).and_then(|()| file.seek(SeekFrom::Start(bytes)));
        cut.map_err(RecordError::file("cut", &path))?;
        Ok(Series::over(&path, columns, file, marking))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use agglo_testing::AWKWARD;

    fn read(path: &Path) -> Vec<Vec<f64>> {
        let text = std::fs::read_to_string(path).unwrap();
        text.lines().skip(1).map(|line| line.split(',').map(|word| word.parse().unwrap()).collect()).collect()
    }

    #[test]
    fn numbers_come_back_bit_by_bit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("series.csv");
        let rows =
            [[0.1, 1.0 / 3.0, f64::MIN_POSITIVE], [f64::MAX, 0.0, 5e-324], [1e22, 123_456_789.125, 2.5e-7]];
        let mut series = Series::create(&path, &["time_s", "kinetic_energy_j", "speed_m_s"]).unwrap();
        for row in &rows {
            series.row(row).unwrap();
        }
        series.flush().unwrap();
        assert_eq!(series.mark().bytes, path.metadata().unwrap().len());
        let bits = |row: &[f64]| row.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
        for (written, read) in rows.iter().zip(read(&path)) {
            assert_eq!(bits(written), bits(&read));
        }
        let header = std::fs::read_to_string(&path).unwrap();
        assert_starts!(
            header,
            "time_s,kinetic_energy_j,speed_m_s\n0.1,0.3333333333333333,2.2250738585072014e-308\n"
        );
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
        let mark = series.mark();
        series.row(&[1.0, 2.0]).unwrap();
        series.row(&[2.0, 3.0]).unwrap();
        drop(series);
        let mut again = Series::check(&path, &["time_s", "count"], mark).unwrap().cut().unwrap();
        assert_eq!(again.mark(), mark);
        again.row(&[1.0, 20.0]).unwrap();
        assert_matches!(again.row(&[1.0]), Err(RecordError::Shape { found: 1, expected: 2, .. }));
        again.sync().unwrap();
        assert_eq!(read(&path), [[0.0, 1.0], [1.0, 20.0]]);
        let longer = Mark { bytes: 1000, ..mark };
        let error = Series::check(&path, &["time_s", "count"], longer).unwrap_err().to_string();
        assert!(error.contains("but the checkpoint was written when it had 1000"), "{error}");
        // The mark goes on over the rows that were added.
        again.row(&[2.0, 3.0]).unwrap();
        again.sync().unwrap();
        let mark = again.mark();
        Series::check(&path, &["time_s", "count"], mark).unwrap();
        let whole = std::fs::read(&path).unwrap();
        for at in 0..whole.len() {
            let mut damaged = whole.clone();
            damaged[at] = 0;
            std::fs::write(&path, &damaged).unwrap();
            let error = Series::check(&path, &["time_s", "count"], mark).unwrap_err().to_string();
            let words = if at < "time_s,count\n".len() { "first line" } else { "was changed since" };
            assert!(error.contains(words), "{error}");
        }
    }

    #[test]
    fn a_place_that_cannot_be_written_is_named() {
        let error = Series::create(Path::new("/nowhere/series.csv"), &["time_s"]).unwrap_err().to_string();
        assert_eq!(error, "cannot create /nowhere/series.csv: no such file or folder");
        #[cfg(target_os = "linux")]
        {
            let device = Path::new("/dev/full");
            let file = OpenOptions::new().write(true).open(device).unwrap();
            let mut full = Series::over(device, 1, file, Marking::default());
            full.row(&[0.0]).unwrap();
            assert_eq!(full.flush().unwrap_err().to_string(), "cannot write /dev/full: the disk is full");
        }
    }
}
