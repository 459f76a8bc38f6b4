//! A table that grows while it is read.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use agglo::record::sheet::rows;
use agglo::record::{RecordError, door};

/// The rows of a table so far.
#[derive(Debug)]
pub(super) struct Tail {
    path: PathBuf,
    /// Bytes that are read: whole lines.
    read: u64,
    columns: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Tail {
    /// A table of which nothing is read yet; it need not be there yet.
    pub fn new(path: &Path) -> Self {
        Self { path: path.to_owned(), read: 0, columns: Vec::new(), rows: Vec::new() }
    }

    /// Reads the lines that are new; half a line is left for the next time.
    pub fn read(&mut self) -> Result<(), RecordError> {
        let mut file = match door::open(&self.path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
            opened => opened.map_err(RecordError::file("read", &self.path))?,
        };
        let mut text = String::new();
        let fresh = self.fresh(&mut file, &mut text);
        fresh.map_err(RecordError::file("read", &self.path))?;
        let whole = text.rfind('\n').map_or(0, |last| last + 1);
        self.read += whole as u64;
        for row in rows(&text[..whole], false) {
            if self.columns.is_empty() {
                self.columns = row.iter().map(str::to_owned).collect();
            } else {
                self.rows.push(row.iter().map(|word| word.parse().unwrap_or(f64::NAN)).collect());
            }
        }
        Ok(())
    }

    /// What is new; all of a table that was cut back.
    fn fresh(&mut self, file: &mut File, text: &mut String) -> io::Result<()> {
        if file.metadata()?.len() < self.read {
            *self = Self::new(&self.path);
        }
        file.seek(SeekFrom::Start(self.read))?;
        file.take(door::MOST_OF_A_TABLE).read_to_string(text)?;
        Ok(())
    }

    /// The values of a column; nothing where there is no such column.
    pub fn column(&self, name: &str) -> Option<impl DoubleEndedIterator<Item = f64>> {
        let at = self.columns.iter().position(|known| known == name)?;
        Some(self.rows.iter().filter_map(move |row| row.get(at).copied()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    fn column(tail: &Tail, name: &str) -> Vec<f64> {
        tail.column(name).into_iter().flatten().collect()
    }

    #[test]
    fn rows_come_as_they_are_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        let mut tail = Tail::new(&path);
        tail.read().unwrap();
        assert_empty!(column(&tail, "x_m"));
        let mut file = File::create(&path).unwrap();
        for (part, wanted) in [
            ("time_s,x", vec![]),
            ("_m\n0.5,1e-3\n1.", vec![1e-3]),
            ("0,NaN\n2.0,7.0\n", vec![1e-3, f64::NAN, 7.0]),
        ] {
            file.write_all(part.as_bytes()).unwrap();
            tail.read().unwrap();
            let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&column(&tail, "x_m")), bits(&wanted));
        }
        // A resumed run cuts its tables.
        std::fs::write(&path, "time_s,x_m\n0.5,3\n").unwrap();
        tail.read().unwrap();
        assert_eq!((column(&tail, "x_m"), column(&tail, "time_s")), (vec![3.0], vec![0.5]));
        assert_none!(tail.column("y_m").map(Iterator::collect::<Vec<_>>));
    }
}
