//! Tables that grow by a row now and then.

use std::fs::{File, OpenOptions};
use std::io::{BufWriter, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use super::columns::{Cell, Column};
use super::rows::{Rows, Unknown};
use super::{RecordError, atomic};
use crate::folder::{Mark, Marked, Marking, files};

/// A CSV table with one header line; names of columns carry their unit (`time_s`).
///
/// Numbers are written with as few digits as bring back the same bits. What cannot be had is `NaN`.
#[derive(Debug)]
pub struct Series {
    path: PathBuf,
    columns: usize,
    rows: Rows<Marked<BufWriter<File>>>,
}

impl Series {
    /// Begins a table, in place of what was there.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn create(path: &Path, columns: &[&str]) -> Result<Self, RecordError> {
        let file = files::create(path).map_err(RecordError::file("create", path))?;
        let mut series = Self::over(path, columns.len(), file, Marking::default());
        series.row(columns.iter().map(|name| Cell::Word(name)))?;
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
        let due = columns.join(",") + "\n";
        let header = first_line(&file, due.len()).map_err(RecordError::file("read", path))?;
        let reason = if header == due.as_bytes() {
            "what the run had written there was changed since, or is of another run"
        } else {
            "its first line is not that of the run's table"
        };
        Err(RecordError::Foreign { path: path.to_owned(), reason: reason.to_owned() })
    }

    fn over(path: &Path, columns: usize, file: File, marking: Marking) -> Self {
        let rows = Rows::over(Marked::after(BufWriter::new(file), marking), Unknown::NotANumber);
        Self { path: path.to_owned(), columns, rows }
    }

    /// Adds a row of these columns.
    ///
    /// # Errors
    /// [`RecordError::NotFinite`] where an entry is none that can be, [`RecordError::File`].
    pub fn put<S>(&mut self, columns: &[Column<S>], of: &S) -> Result<(), RecordError> {
        let is_odd = |column: &&Column<S>| matches!(column.cell(of), Cell::Number(x) if !x.is_finite());
        if let Some(odd) = columns.iter().find(is_odd) {
            let (path, column) = (self.path.clone(), odd.about.name.to_owned());
            return Err(RecordError::NotFinite { path, column });
        }
        self.row(columns.iter().map(|column| column.cell(of)))
    }

    /// Adds a row.
    ///
    /// # Errors
    /// [`RecordError::Shape`] where the row does not fit the header, [`RecordError::File`].
    pub fn row<'a>(
        &mut self,
        cells: impl IntoIterator<Item = Cell<'a>, IntoIter: ExactSizeIterator>,
    ) -> Result<(), RecordError> {
        let cells = cells.into_iter();
        if cells.len() != self.columns {
            let (path, what) = (self.path.clone(), "a row".to_owned());
            return Err(RecordError::Shape { path, what, found: cells.len(), expected: self.columns });
        }
        self.rows.row(cells).map_err(RecordError::file("write", &self.path))
    }

    /// Hands all rows to the operating system.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn flush(&mut self) -> Result<(), RecordError> {
        self.rows.flush().map_err(RecordError::file("write", &self.path))
    }

    /// Puts all rows onto the disk: to be done before a checkpoint that counts on them.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn sync(&mut self) -> Result<(), RecordError> {
        self.flush()?;
        let file = self.rows.inner().inner().get_ref();
        file.sync_data().map_err(RecordError::file("write", &self.path))
    }

    /// Length and checksum of the table so far, up to the last row that was [handed on](Self::flush).
    pub fn mark(&self) -> Mark {
        self.rows.inner().mark()
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
            series.row(row.map(Cell::Number)).unwrap();
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

    #[test]
    fn reopened_tables_go_on_where_they_were() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("series.csv");
        let mut series = Series::create(&path, &["time_s", "count"]).unwrap();
        series.row([0.0, 1.0].map(Cell::Number)).unwrap();
        series.flush().unwrap();
        let mark = series.mark();
        series.row([1.0, 2.0].map(Cell::Number)).unwrap();
        series.row([2.0, 3.0].map(Cell::Number)).unwrap();
        drop(series);
        let mut again = Series::check(&path, &["time_s", "count"], mark).unwrap().cut().unwrap();
        assert_eq!(again.mark(), mark);
        again.row([1.0, 20.0].map(Cell::Number)).unwrap();
        assert_matches!(
            again.row([Cell::Number(1.0)]),
            Err(RecordError::Shape { found: 1, expected: 2, .. })
        );
        again.sync().unwrap();
        assert_eq!(read(&path), [[0.0, 1.0], [1.0, 20.0]]);
        let longer = Mark { bytes: 1000, ..mark };
        let error = Series::check(&path, &["time_s", "count"], longer).unwrap_err().to_string();
        assert!(error.contains("but the checkpoint was written when it had 1000"), "{error}");
        // The mark goes on over the rows that were added.
        again.row([2.0, 3.0].map(Cell::Number)).unwrap();
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
            full.row([Cell::Number(0.0)]).unwrap();
            assert_eq!(full.flush().unwrap_err().to_string(), "cannot write /dev/full: the disk is full");
        }
    }
}
