//! Every combination of the parameters' values.
//!
//! # Equation
//! ```text
//! points: u_1 x u_2 x ... x u_d,   u_k = {0, 1/(l - 1), ..., 1} between two bounds,   n = Π l_k        SA6
//! ```
//! The last parameter changes fastest. Of choices and whole numbers all values are tried, whatever `levels` says.
//!
//! # Source
//! Factorial design: R. A. Fisher, *The Design of Experiments* (1935).
//!
//! # Symbols
//! | symbol | name in code  | unit | meaning                                     |
//! |--------|---------------|------|---------------------------------------------|
//! | u_k    | `coordinates` | 1    | values of parameter k, as parts of its range |
//! | l      | `levels`      | 1    | values of a parameter between two bounds    |
//! | n      | `evaluations` | 1    | points in all                               |
//!
//! # Valid when
//! Few parameters: the number of points is a product.
//!
//! # Compared with others
//! `morris` needs a number of points that grows with the number of parameters, `sobol` one of your choice.
//!
//! # In a campaign
//! ```toml
//! [plan.grid]
//! levels = 5
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::coordinate;
use crate::search::optimizer::Point;

/// Every combination of the parameters' values; the last parameter changes fastest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Grid {
    /// Values of a parameter between two bounds, the bounds included; choices and whole numbers are all tried. At least 1,
    /// which is the middle.
    pub levels: u32,
}

impl Default for Grid {
    fn default() -> Self {
        Self { levels: 5 }
    }
}

impl Grid {
    pub(super) fn points(&self, levels: &[Option<usize>]) -> Vec<Point> {
        let axes: Vec<Vec<f64>> = levels.iter().map(|levels| self.coordinates(*levels)).collect();
        let mut points = vec![Vec::with_capacity(axes.len())];
        for axis in &axes {
            points = points
                .iter()
                .flat_map(|point| axis.iter().map(|&u| [point.as_slice(), &[u]].concat()))
                .collect();
        }
        points
    }

    fn coordinates(&self, levels: Option<usize>) -> Vec<f64> {
        let wanted = self.levels as usize;
        let spread = |number: usize| number as f64 / (wanted - 1) as f64;
        match levels {
            Some(levels) => (0..levels).map(|number| coordinate(number, levels)).collect(),
            None if wanted < 2 => vec![0.5],
            None => (0..wanted).map(spread).collect(),
        }
    }

    pub(super) fn evaluations(&self, levels: &[Option<usize>]) -> u64 {
        let of = |levels: &Option<usize>| levels.map_or(u64::from(self.levels), |levels| levels as u64);
        levels.iter().fold(1, |product: u64, levels| product.saturating_mul(of(levels)))
    }

    pub(super) fn faults(&self) -> Vec<(&'static str, String)> {
        if self.levels == 0 { vec![("levels", "at least 1 level is needed".to_owned())] } else { Vec::new() }
    }
}
