//! Pairs of base points and mixtures of them, from which shares of the variance follow.
//!
//! # Equation
//! ```text
//! A, B: N points each;   A_B^(i): the points of A with coordinate i from B           SA2
//! ```
//! The points stand in blocks of d + 2: one of A, its partner of B, and its d mixtures.
//!
//! # Source
//! A. Saltelli et al., *Variance based sensitivity analysis of model output*, Comput. Phys. Commun. 181, 259 (2010).
//!
//! # Symbols
//! | symbol | name in code | unit | meaning                |
//! |--------|--------------|------|------------------------|
//! | N      | `samples`    |      | base points, from a Sobol' sequence of 2d dimensions (random ones for d > 16) |
//! | d      | `dimensions` |      | number of parameters   |
//!
//! # Valid when
//! Parameters vary independently. It costs `samples` × (d + 2) evaluations.
//!
//! # Compared with others
//! The sampling of `SALib.sample.sobol` with `calc_second_order=False`.
//!
//! # In a campaign
//! ```toml
//! [plan.sobol_indices]
//! samples = 256
//! level = 0.95
//! ```
//!
//! # Example
//! ```
//! use agglo::search::{Plan, SobolIndices};
//! let plan = Plan::SobolIndices(SobolIndices { samples: 16, ..SobolIndices::default() });
//! let points = plan.points(&[None, None], 1);
//! assert_eq!(points.len(), 64);
//! // The third point of a block has its first coordinate from the second point, its second one from the first.
//! assert_eq!(points[2], [points[1][0], points[0][1]]);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Draw, stream};
use crate::search::optimizer::{Optimizer, Point, Sobol};

/// Shares of the outcome's variance, for each parameter alone and with all others.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SobolIndices {
    /// Base points, at least 16; powers of two spread best. Each costs as many evaluations as there are parameters and two
    /// more.
    pub samples: u32,
    /// How often the base points are drawn anew, with repetition, for the confidence intervals.
    pub bootstraps: u32,
    /// Confidence level of the intervals.
    pub level: f64,
}

impl Default for SobolIndices {
    fn default() -> Self {
        Self { samples: 256, bootstraps: 1000, level: 0.95 }
    }
}

impl SobolIndices {
    pub(super) fn points(self, dimensions: usize, seed: u64) -> Vec<Point> {
        let bases = bases(self.samples as usize, 2 * dimensions, seed);
        let mut points = Vec::with_capacity(bases.len() * (dimensions + 2));
        for base in &bases {
            let (a, b) = base.split_at(dimensions);
            points.extend([a.to_vec(), b.to_vec()]);
            for axis in 0..dimensions {
                let mut mixed = a.to_vec();
                mixed[axis] = b[axis];
                points.push(mixed);
            }
        }
        points
    }

    pub(super) fn evaluations(self, dimensions: usize) -> u64 {
        u64::from(self.samples) * (dimensions as u64 + 2)
    }

    pub(super) fn faults(self) -> Vec<(&'static str, String)> {
        let mut faults = Vec::new();
        if self.samples < 16 {
            faults.push(("samples", "at least 16 samples are needed".to_owned()));
        }
        if self.bootstraps < 100 {
            faults.push(("bootstraps", "at least 100 are needed for the ends of an interval".to_owned()));
        }
        if !(self.level > 0.0 && self.level < 1.0) {
            faults.push(("level", format!("{} is not between 0 and 1", self.level)));
        }
        faults
    }
}

/// Points of the unit cube of `width` dimensions: a Sobol' sequence as far as its table goes, else random ones.
fn bases(count: usize, width: usize, seed: u64) -> Vec<Point> {
    let sequence = Sobol { points: count };
    if !sequence.faults(width).is_empty() {
        let mut stream = stream(seed, Draw::Bases);
        return (0..count).map(|_| (0..width).map(|_| stream.uniform()).collect()).collect();
    }
    let mut sequence = sequence.start(width, seed);
    let batches = std::iter::from_fn(|| Some(sequence.ask()).filter(|batch| !batch.is_empty()));
    batches.flatten().collect()
}
