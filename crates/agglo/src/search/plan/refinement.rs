//! One parameter from coarse to fine.
//!
//! # Equation
//! ```text
//! d_k = f_k - f_1,   |d_k| + t s_k <= TOL |f_1|: settled,   |d_k| - t s_k > TOL |f_1|: not settled     CV4
//! ```
//! Levels are numbered from the finest, which stands last in the file. The order of convergence and the extrapolated value
//! come from the three finest levels.
//!
//! # Source
//! P. J. Roache, *Perspective: a method for uniform reporting of grid refinement studies*, J. Fluids Eng. 116, 405 (1994).
//!
//! # Symbols
//! | symbol | name in code | unit        | meaning                                                |
//! |--------|--------------|-------------|--------------------------------------------------------|
//! | f_k    |              | the value's | mean outcome at level k                                |
//! | s_k    |              | the value's | standard error of d_k, start by start where levels share them |
//! | t      |              | 1           | Student's t at 95 %                                    |
//! | TOL    | `tolerance`  | 1           | part of the finest level's value                       |
//!
//! # Valid when
//! There is one parameter, with two or more `choices` from coarse to fine. Neither settled nor unsettled is *not shown*: the
//! starts scatter too much to tell. A single start never shows anything.
//!
//! # Compared with others
//! Grid convergence studies report the index of Roache alone; here an interval tells a difference from the scatter of starts.
//!
//! # In a campaign
//! ```toml
//! [[parameters]]
//! name = "end"
//! key = "time.end"
//! range.choices = ["1 us", "2 us", "4 us"]
//!
//! [plan.refinement]
//! tolerance = 0.01
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::coordinate;
use crate::search::optimizer::Point;

/// One parameter whose choices stand from coarse to fine: rays, step sizes, grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Refinement {
    /// The outcome has settled at a level from which on the differences from the finest one, with their intervals at 95 %
    /// confidence, are within this part of the finest one's value.
    pub tolerance: f64,
}

impl Default for Refinement {
    fn default() -> Self {
        Self { tolerance: 0.01 }
    }
}

impl Refinement {
    pub(super) fn points(levels: &[Option<usize>]) -> Vec<Point> {
        let Some(Some(count)) = levels.first() else { return Vec::new() };
        (0..*count).map(|number| vec![coordinate(number, *count)]).collect()
    }

    pub(super) fn faults(self, levels: &[Option<usize>]) -> Vec<(&'static str, String)> {
        let mut faults = Vec::new();
        if !(self.tolerance > 0.0 && self.tolerance.is_finite()) {
            faults.push(("tolerance", format!("{} is not a positive number", self.tolerance)));
        }
        if !matches!(levels, [Some(2..)]) {
            faults.push(("refinement", "it needs one parameter, with two or more choices".to_owned()));
        }
        faults
    }
}
