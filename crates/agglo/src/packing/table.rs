//! Grains from a CSV table.
//!
//! The first line names the columns: `x_m`, `y_m`, `z_m`, and optionally `radius_m`, `temperature_K`, the three `vx_m_s`,
//! `vy_m_s`, `vz_m_s`, the three `wx_rad_s`, `wy_rad_s`, `wz_rad_s`, `primaries` and `id`, in any order. A column `cluster` is for
//! whoever reads the table: it must have whole numbers, and is not taken. Lines that begin with `#` are passed over.

use std::ops::Range;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::TableGrain;
use crate::math::Vec3;
use crate::record::door;
use crate::text::cell;
use crate::units::{Dimension, Frequency, Length, Temperature, Velocity, kind_of};

const COLUMNS: [&str; 14] = [
    "x_m",
    "y_m",
    "z_m",
    "radius_m",
    "vx_m_s",
    "vy_m_s",
    "vz_m_s",
    "wx_rad_s",
    "wy_rad_s",
    "wz_rad_s",
    "temperature_K",
    "primaries",
    "cluster",
    "id",
];
/// What the columns with quantities are, each with the range of its kind.
const DIMENSIONS: [Dimension; PRIMARIES] = {
    let (length, velocity, turning) = (Length::DIMENSION, Velocity::DIMENSION, Frequency::DIMENSION);
    let heat = Temperature::DIMENSION;
    [length, length, length, length, velocity, velocity, velocity, turning, turning, turning, heat]
};
/// Names of the columns with quantities, for whoever writes such a table.
pub(crate) const QUANTITIES: &[&str] = COLUMNS.split_at(PRIMARIES).0;
/// Columns that every table has.
const POSITION: Range<usize> = 0..3;
const RADIUS: usize = 3;
/// Columns of which a table has all or none.
const VELOCITY: Range<usize> = 4..7;
/// The same.
const ANGULAR_VELOCITY: Range<usize> = 7..10;
const TEMPERATURE: usize = 10;
const PRIMARIES: usize = 11;
const CLUSTER: usize = 12;
const ID: usize = 13;
/// The largest count or number of a table.
const MOST_COUNTED: u32 = 1_000_000_000;

/// Why a table gives no grains.
#[derive(Debug, Error)]
pub enum TableError {
    /// A table that cannot be opened or read.
    #[error("cannot read the table {file}: {source}", file = .file.display())]
    Unreadable {
        /// The table.
        file: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A table with a bad header or entry.
    #[error("{file}, line {line}, column {column}: {reason}", file = .file.display())]
    Table {
        /// The table.
        file: PathBuf,
        /// Line, from 1.
        line: u64,
        /// Name of the column, or its number from 1 where it has no good name.
        column: String,
        /// What is wrong.
        reason: String,
    },
}

/// Reads the table.
///
/// # Errors
/// [`TableError::Unreadable`] or [`TableError::Table`] with line and column.
pub fn read(file: &Path) -> Result<Vec<TableGrain>, TableError> {
    let unreadable = |source| TableError::Unreadable { file: file.to_owned(), source };
    parse(&door::read_text(file, door::MOST_OF_A_TABLE).map_err(unreadable)?, file)
}

/// Reads a table; `file` is for messages.
///
/// Numbers need none of the finer points of CSV, and messages need exact lines, which readers of CSV that pass over empty lines
/// do not have; so lines are split here.
fn parse(text: &str, file: &Path) -> Result<Vec<TableGrain>, TableError> {
    let fault =
        |line, column: String, reason| Err(TableError::Table { file: file.to_owned(), line, column, reason });
    let mut lines = lines(text);
    let Some((header, line)) = lines.next() else {
        return fault(1, "x_m".to_owned(), "the table is empty".to_owned());
    };
    let header = entries(header);
    let places = columns(&header, file, line)?;
    let mut grains = Vec::new();
    for (row, line) in lines {
        let row = entries(row);
        if row.len() != header.len() {
            let reason = format!("{} entries where the header has {}", row.len(), header.len());
            return fault(line, row.len().min(header.len()).to_string(), reason);
        }
        grains.push(Entries { row: &row, places: &places, file, line }.grain()?);
    }
    if grains.is_empty() {
        return fault(line, "x_m".to_owned(), "the table has no rows".to_owned());
    }
    Ok(grains)
}

/// Lines that say something, each with its number from 1.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (&str, u64)> {
    let lines = text.trim_start_matches('\u{feff}').lines().zip(1_u64..);
    lines.filter(|(line, _)| !line.trim().is_empty() && !line.starts_with('#'))
}

/// What stands between the commas of a line.
pub(super) fn entries(line: &str) -> Vec<&str> {
    line.split(',').map(|entry| entry.trim().trim_matches('"')).collect()
}

/// Where each known column stands in the table.
fn columns(header: &[&str], file: &Path, line: u64) -> Result<[Option<usize>; COLUMNS.len()], TableError> {
    let fault = |column: String, reason: String| {
        Err(TableError::Table { file: file.to_owned(), line, column, reason })
    };
    let mut places = [None; COLUMNS.len()];
    for (at, name) in header.iter().enumerate() {
        match COLUMNS.iter().position(|known| known == name) {
            Some(known) if places[known].is_none() => places[known] = Some(at),
            Some(_) => {
                return fault((at + 1).to_string(), format!("the column `{}` is there twice", cell(name)));
            }
            None => {
                let reason = format!("`{}` is not known; known are {}", cell(name), COLUMNS.join(", "));
                return fault((at + 1).to_string(), reason);
            }
        }
    }
    let asked = [VELOCITY, ANGULAR_VELOCITY].map(|all| {
        let is_there = places[all.clone()].iter().any(Option::is_some);
        all.filter(move |_| is_there)
    });
    let mut wanted = POSITION.chain(asked.into_iter().flatten());
    match wanted.find(|&at| places[at].is_none()) {
        Some(at) => fault(COLUMNS[at].to_owned(), "the column is missing".to_owned()),
        None => Ok(places),
    }
}

/// One line of the table on its way to a grain.
struct Entries<'a> {
    row: &'a [&'a str],
    places: &'a [Option<usize>; COLUMNS.len()],
    file: &'a Path,
    line: u64,
}

impl Entries<'_> {
    fn grain(&self) -> Result<TableGrain, TableError> {
        let vector = |first: usize| -> Result<Option<Vec3>, TableError> {
            let [x, y, z] = [self.number(first)?, self.number(first + 1)?, self.number(first + 2)?];
            Ok(x.zip(y).zip(z).map(|((x, y), z)| Vec3::new(x, y, z)))
        };
        let above_zero = |column: usize, what: &str| match self.number(column)? {
            Some(value) if value <= 0.0 => Err(self.fault(column, format!("{what} must be above zero"))),
            Some(value) if value < kind_of(DIMENSIONS[column]).smallest => {
                let least = kind_of(DIMENSIONS[column]).smallest;
                Err(self.fault(column, format!("{value:e} is below {least:e}, with which one can compute")))
            }
            value => Ok(value),
        };
        self.count(CLUSTER, 0)?;
        Ok(TableGrain {
            // The header has been checked: positions are there.
            position: vector(POSITION.start)?.unwrap_or_default(),
            radius: above_zero(RADIUS, "a radius")?,
            velocity: vector(VELOCITY.start)?,
            angular_velocity: vector(ANGULAR_VELOCITY.start)?,
            temperature: above_zero(TEMPERATURE, "a temperature")?,
            primaries: self.count(PRIMARIES, 1)?,
            id: self.count(ID, 0)?,
        })
    }

    /// A whole number of at least so much.
    fn count(&self, column: usize, least: u32) -> Result<Option<u32>, TableError> {
        let Some(text) = self.places[column].and_then(|at| self.row.get(at)) else { return Ok(None) };
        match text.parse() {
            Ok(count) if (least..=MOST_COUNTED).contains(&count) => Ok(Some(count)),
            _ => {
                let reason = format!("`{}` is no whole number from {least} to {MOST_COUNTED}", cell(text));
                Err(self.fault(column, reason))
            }
        }
    }

    fn number(&self, column: usize) -> Result<Option<f64>, TableError> {
        let Some(text) = self.places[column].and_then(|at| self.row.get(at)) else { return Ok(None) };
        match text.parse::<f64>() {
            // Adding zero takes the sign off a negative zero.
            Ok(value) if kind_of(DIMENSIONS[column]).holds(value) => Ok(Some(value + 0.0)),
            Ok(value) if value.is_finite() => {
                let most = kind_of(DIMENSIONS[column]).largest;
                Err(self.fault(
                    column,
                    format!("{value:e} is beyond what can be computed; at most {most:e} is allowed"),
                ))
            }
            _ => Err(self.fault(column, format!("`{}` is not a finite number", cell(text)))),
        }
    }

    fn fault(&self, column: usize, reason: String) -> TableError {
        let column = COLUMNS[column].to_owned();
        TableError::Table { file: self.file.to_owned(), line: self.line, column, reason }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse_text(text: &str) -> Result<Vec<TableGrain>, String> {
        parse(text, Path::new("grains.csv")).map_err(|error| error.to_string())
    }

    #[test]
    fn reads_columns_in_any_order() {
        let text = "# two grains\nz_m, x_m,y_m,radius_m\n3,1,2e0,0.5\n# between\n-3.5,0,0,1e-6\n";
        let grains = parse_text(text).unwrap();
        let grain = |x, y, z, radius| TableGrain {
            position: Vec3::new(x, y, z),
            radius: Some(radius),
            ..TableGrain::default()
        };
        assert_eq!(grains, [grain(1.0, 2.0, 3.0, 0.5), grain(0.0, 0.0, -3.5, 1e-6)]);
        let moving = parse_text("x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s\n0,0,0,4,5,6\n").unwrap();
        assert_eq!(moving[0].velocity, Some(Vec3::new(4.0, 5.0, 6.0)));
        assert_eq!(moving[0].radius, None);
        let hot = parse_text("temperature_K,x_m,y_m,z_m\n1234.5,0,0,0\n").unwrap();
        assert_eq!((hot[0].temperature, hot[0].velocity), (Some(1234.5), None));
        let grown =
            parse_text("x_m,y_m,z_m,wx_rad_s,wy_rad_s,wz_rad_s,primaries,cluster,id\n0,0,0,7,8,9,12,3,41\n")
                .unwrap();
        let wanted = (Some(Vec3::new(7.0, 8.0, 9.0)), Some(12), Some(41));
        assert_eq!((grown[0].angular_velocity, grown[0].primaries, grown[0].id), wanted);
    }

    #[test]
    fn faults_have_line_and_column() {
        let cases = [
            ("x_m,y_m,z_m\n1,2,3\n1,two,3\n", "grains.csv, line 3, column y_m: `two` is not a finite number"),
            ("x_m,y_m,z_m\n1,2,nan\n", "line 2, column z_m"),
            (
                "x_m,y_m,z_m\n1,2,-1e300\n",
                "column z_m: -1e300 is beyond what can be computed; at most 1e9 is allowed",
            ),
            ("x_m,y_m,z_m,radius_m\n1,2,3,1e300\n", "column radius_m: 1e300 is beyond"),
            ("x_m,y_m,z_m,radius_m\n1,2,3,1e-300\n", "column radius_m: 1e-300 is below 1e-15"),
            ("x_m,y_m,z_m,temperature_K\n1,2,3,1e30\n", "column temperature_K: 1e30 is beyond"),
            ("x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s\n1,2,3,0,1e12,0\n", "column vy_m_s: 1e12 is beyond"),
            ("x_m,y_m,z_m,radius_m\n1,2,3,-1\n", "line 2, column radius_m: a radius must be above zero"),
            (
                "x_m,y_m,z_m,temperature_K\n1,2,3,0\n",
                "line 2, column temperature_K: a temperature must be above zero",
            ),
            ("x_m,y_m,z_m\n\n1,2\n", "line 3, column 2: 2 entries where the header has 3"),
            ("x_m,y_m\n1,2\n", "line 1, column z_m: the column is missing"),
            ("x_m,y_m,z_m,vx_m_s\n1,2,3,4\n", "line 1, column vy_m_s: the column is missing"),
            ("x_m,y_m,z_m,wy_rad_s\n1,2,3,4\n", "line 1, column wx_rad_s: the column is missing"),
            (
                "x_m,y_m,z_m,primaries\n1,2,3,0\n",
                "line 2, column primaries: `0` is no whole number from 1 to",
            ),
            ("x_m,y_m,z_m,cluster\n1,2,3,a\n", "line 2, column cluster: `a` is no whole number from 0 to"),
            ("x,y_m,z_m\n1,2,3\n", "line 1, column 1: `x` is not known; known are x_m, y_m"),
            ("x_m,y_m,z_m,x_m\n1,2,3,4\n", "line 1, column 4: the column `x_m` is there twice"),
            ("x_m,y_m,z_m\n", "no rows"),
            ("", "line 1, column x_m: the table is empty"),
        ];
        for (text, message) in cases {
            let found = parse_text(text).unwrap_err();
            assert!(found.contains(message), "{text:?}: {found}");
        }
        let missing = read(Path::new("/nowhere/grains.csv")).unwrap_err().to_string();
        assert!(missing.starts_with("cannot read the table /nowhere/grains.csv"), "{missing}");
    }
}
