//! The parameters' lists side by side.
//!
//! # Equation
//! ```text
//! point k: choice k of every parameter,   k = 1 ... n                                           SA7
//! ```
//!
//! # Source
//! None: what is tried is written in the file.
//!
//! # Symbols
//! | symbol | name in code | unit | meaning                                |
//! |--------|--------------|------|----------------------------------------|
//! | n      | `rows`       | 1    | length of the lists, equal for all     |
//!
//! # Valid when
//! Every parameter has `choices`, and all have equally many.
//!
//! # Compared with others
//! `grid` tries every combination of the same choices.
//!
//! # In a campaign
//! ```toml
//! [[parameters]]
//! name = "step"
//! key = "time.end"
//! range.choices = ["1 us", "2 us", "4 us"]
//!
//! [plan.list]
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::coordinate;
use crate::search::optimizer::Point;

/// The first values of all parameters together, then the second ones, and so on: lists of choices that are equally long.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct List {}

impl List {
    pub(super) fn points(levels: &[Option<usize>]) -> Vec<Point> {
        let rows = levels.iter().flatten().copied().max().unwrap_or(0);
        let place =
            |row: usize, levels: &Option<usize>| levels.map_or(0.5, |l| coordinate(row.min(l - 1), l));
        (0..rows).map(|row| levels.iter().map(|levels| place(row, levels)).collect()).collect()
    }

    pub(super) fn faults(levels: &[Option<usize>]) -> Vec<(&'static str, String)> {
        let mut lengths: Vec<usize> = levels.iter().flatten().copied().collect();
        let all_are_lists = lengths.len() == levels.len();
        lengths.dedup();
        let message = match (all_are_lists, lengths.as_slice()) {
            (false, _) => "every parameter of a list needs choices".to_owned(),
            (true, [_]) => return Vec::new(),
            (true, lengths) => {
                let words: Vec<String> = lengths.iter().map(usize::to_string).collect();
                format!("lists side by side are equally long; these have {}", words.join(", "))
            }
        };
        vec![("list", message)]
    }
}
