//! One parameter from coarse to fine.

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
