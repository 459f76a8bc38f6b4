//! Pairs of grains that are bonded, from a CSV table.
//!
//! The first line names the columns: `grain_i` and `grain_j`, in any order, with the ids of grains. Lines that begin with `#` are passed over.

use std::collections::BTreeMap;
use std::path::Path;

use super::table::{TableError, entries, lines};
use crate::particles::ById;
use crate::record::door;
use crate::text::cell;

const COLUMNS: [&str; 2] = ["grain_i", "grain_j"];

/// The pairs of a table, as places of grains, the lower id first.
///
/// # Errors
/// [`TableError::Unreadable`] or [`TableError::Table`] with line and column.
pub(crate) fn pairs(file: &Path, grains: &ById) -> Result<Vec<[u32; 2]>, TableError> {
    let unreadable = |source| TableError::Unreadable { file: file.to_owned(), source };
    parse(&door::read_text(file, door::MOST_OF_A_TABLE).map_err(unreadable)?, file, grains)
}

fn parse(text: &str, file: &Path, grains: &ById) -> Result<Vec<[u32; 2]>, TableError> {
    let fault = |line, column: &str, reason| {
        let (file, column) = (file.to_owned(), column.to_owned());
        Err(TableError::Table { file, line, column, reason })
    };
    let mut lines = lines(text);
    let Some((header, line)) = lines.next() else {
        return fault(
            1,
            COLUMNS[0],
            "the table is empty; without bonds it has this line alone: grain_i,grain_j".to_owned(),
        );
    };
    let header = entries(header);
    if header != COLUMNS && header != [COLUMNS[1], COLUMNS[0]] {
        let reason = format!("found `{}`; grain_i,grain_j is wanted", cell(&header.join(",")));
        return fault(line, COLUMNS[0], reason);
    }
    let mut known: BTreeMap<[u32; 2], u64> = BTreeMap::new();
    let mut pairs = Vec::new();
    for (row, line) in lines {
        let row = entries(row);
        if row.len() != 2 {
            return fault(line, COLUMNS[0], format!("{} entries where the header has 2", row.len()));
        }
        let mut pair = [(0, 0); 2];
        for (grain, (text, column)) in pair.iter_mut().zip(row.iter().zip(&header)) {
            let found = text.parse().ok().and_then(|id| Some((id, grains.find(id)? as u32)));
            let Some(found) = found else {
                return fault(line, column, format!("there is no grain `{}`", cell(text)));
            };
            *grain = found;
        }
        pair.sort_unstable();
        let (places, pair) = (pair.map(|(_, place)| place), pair.map(|(id, _)| id));
        if pair[0] == pair[1] {
            return fault(line, header[1], format!("grain {} is bonded to itself", pair[0]));
        }
        if let Some(before) = known.insert(pair, line) {
            return fault(
                line,
                header[1],
                format!("{} and {} are bonded in line {before} already", pair[0], pair[1]),
            );
        }
        pairs.push(places);
    }
    Ok(pairs)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse_text(text: &str) -> Result<Vec<[u32; 2]>, String> {
        parse(text, Path::new("bonds.csv"), &ById::of(&[0, 1, 2, 3, 40])).map_err(|error| error.to_string())
    }

    #[test]
    fn reads_pairs_with_their_lower_grain_first() {
        assert_eq!(parse_text("# bonds\ngrain_j, grain_i\n0,40\n\n3,1\n"), Ok(vec![[0, 4], [1, 3]]));
        assert_eq!(parse_text("grain_i,grain_j\n"), Ok(Vec::new()));
    }

    #[test]
    fn faults_have_line_and_column() {
        for (text, words) in [
            ("", "bonds.csv, line 1, column grain_i: the table is empty"),
            ("i,j\n0,1\n", "line 1, column grain_i: found `i,j`; grain_i,grain_j is wanted"),
            ("grain_i,grain_j\n0,1\n0\n", "line 3, column grain_i: 1 entries where the header has 2"),
            ("grain_i,grain_j\n0,5\n", "line 2, column grain_j: there is no grain `5`"),
            ("grain_i,grain_j\n-1,1\n", "line 2, column grain_i: there is no grain `-1`"),
            ("grain_i,grain_j\n2,2\n", "line 2, column grain_j: grain 2 is bonded to itself"),
            ("grain_i,grain_j\n1,2\n\n2,1\n", "line 4, column grain_j: 1 and 2 are bonded in line 2 already"),
        ] {
            assert_contains!(parse_text(text).unwrap_err(), words);
        }
    }
}
