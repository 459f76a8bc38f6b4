//! Tables of a run, read back as columns.

use std::path::Path;

use agglo::record::{About, Sheet};

/// A table of numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Names of the columns, with their units: `time_s`.
    pub names: Vec<String>,
    /// The columns, one value a row.
    pub columns: Vec<Vec<f64>>,
    /// Rows that are cut or damaged and were left out.
    pub dropped: usize,
}

impl Table {
    /// Reads a table; rows of another length than the header, or with what is no finite number, are left out and
    /// counted. Those of `columns` that may be empty may have gaps.
    ///
    /// # Errors
    /// Why it cannot be read.
    pub fn read(path: &Path, columns: &[&About]) -> Result<Self, String> {
        let Sheet { names, rows, dropped } = Sheet::read_with(path, false)?;
        let mut table = Self { columns: vec![Vec::new(); names.len()], names, dropped };
        for row in rows {
            // A damaged row has entries that are no finite numbers, but for gaps where there may be some.
            let number = |(entry, name): (&String, &String)| {
                let value: f64 = entry.parse().ok()?;
                let may_be_gap = columns.iter().any(|known| known.name == name && known.may_be_empty);
                (value.is_finite() || value.is_nan() && may_be_gap).then_some(value)
            };
            match row.iter().zip(&table.names).map(number).collect::<Option<Vec<f64>>>() {
                Some(numbers) => {
                    table.columns.iter_mut().zip(numbers).for_each(|(column, value)| column.push(value));
                }
                None => table.dropped += 1,
            }
        }
        Ok(table)
    }

    /// The column of that name.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let at = self.names.iter().position(|known| known == name)?;
        Some(&self.columns[at])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::folder::columns_of;

    #[test]
    fn a_cut_row_is_left_out() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.csv");
        std::fs::write(&path, "time_s,count\n0.0,1\n0.5,2\n1.0").unwrap();
        let table = Table::read(&path, &[]).unwrap();
        assert_eq!(table.column("time_s"), Some(&[0.0, 0.5][..]));
        assert_eq!(table.dropped, 1);
        // 12 could have been 123.
        std::fs::write(&path, "time_s,count\n0.0,1\n0.5,12").unwrap();
        assert_eq!(Table::read(&path, &[]).unwrap().column("count"), Some(&[1.0][..]));
        std::fs::write(&path, "").unwrap();
        assert_err!(Table::read(&path, &[]));
    }

    #[test]
    fn a_damaged_row_is_left_out_and_gaps_stay() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.csv");
        let rows = b"time_s,fractal_dimension\n0.0,1\n0.5,\xff\xfe\n1.0,NaN\n1.5\n2.0,5\n3.0,inf\nNaN,2\n4.0,1,1\n5.0,\"1\n";
        std::fs::write(&path, rows).unwrap();
        let table = Table::read(&path, &columns_of("series/clusters.csv")).unwrap();
        assert_eq!(table.column("time_s"), Some(&[0.0, 1.0, 2.0][..]));
        assert_nan!(table.column("fractal_dimension").unwrap()[1]);
        assert_eq!(table.dropped, 6);
    }
}
