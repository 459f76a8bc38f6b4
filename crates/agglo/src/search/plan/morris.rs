//! Steps of one parameter at a time from many places: elementary effects.
//!
//! # Equation
//! ```text
//! EE_i = (y(x + Δ e_i) - y(x))/Δ,   Δ = p/(2 (p - 1)),   x on a grid of p levels in [0, 1]^d           SA1
//! ```
//! A trajectory starts at a random point of the grid and moves once along each axis, in random order.
//!
//! # Source
//! M. D. Morris, *Factorial sampling plans for preliminary computational experiments*, Technometrics 33, 161 (1991).
//!
//! # Symbols
//! | symbol | name in code   | unit | meaning                                 |
//! |--------|----------------|------|-----------------------------------------|
//! | p      | `levels`       |      | levels of the grid along each axis      |
//! | Δ      | `step`         |      | length of a step in the unit cube       |
//! |        | `trajectories` |      | how many effects each parameter gets    |
//!
//! # Valid when
//! It ranks parameters cheaply, with `trajectories` × (d + 1) evaluations; it does not say which of them interact.
//!
//! # Compared with others
//! The sampling of `SALib.sample.morris` without its search for trajectories far from each other.
//!
//! # In a campaign
//! ```toml
//! [plan.morris]
//! trajectories = 20
//! levels = 4
//! ```
//!
//! # Example
//! ```
//! use agglo::search::{Morris, Plan};
//! let plan = Plan::Morris(Morris { trajectories: 3, levels: 4 });
//! let points = plan.points(&[None, None], 1);
//! assert_eq!(points.len(), 9);
//! // Neighbors in a trajectory differ in one coordinate, by 2/3.
//! let moved: Vec<f64> = points[0].iter().zip(&points[1]).map(|(a, b)| (a - b).abs()).filter(|d| *d > 0.0).collect();
//! assert!(moved.len() == 1 && (moved[0] - 2.0 / 3.0).abs() < 1e-15);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Draw, stream};
use crate::math::rng::Stream;
use crate::search::optimizer::Point;

/// Steps of one parameter at a time, along trajectories from random places.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Morris {
    /// How many trajectories, at least 2; each has one point more than there are parameters.
    pub trajectories: u32,
    /// Levels along each axis; an even number.
    pub levels: u32,
}

impl Default for Morris {
    fn default() -> Self {
        Self { trajectories: 20, levels: 4 }
    }
}

impl Morris {
    /// Length of a step in the unit cube.
    pub fn step(&self) -> f64 {
        let levels = f64::from(self.levels);
        levels / (2.0 * (levels - 1.0))
    }

    pub(super) fn points(self, dimensions: usize, seed: u64) -> Vec<Point> {
        let mut stream = stream(seed, Draw::Trajectories);
        (0..self.trajectories).flat_map(|_| self.trajectory(dimensions, &mut stream)).collect()
    }

    fn trajectory(self, dimensions: usize, stream: &mut Stream) -> Vec<Point> {
        let half = self.levels / 2;
        let mut ends = Vec::with_capacity(dimensions);
        for _ in 0..dimensions {
            let low = (f64::from(half) * stream.uniform()).floor();
            // Whole numbers of grid levels, so that the upper end is a level to the last bit.
            let [low, high] = [low, low + f64::from(half)].map(|level| level / f64::from(self.levels - 1));
            ends.push(if stream.uniform() < 0.5 { [low, high] } else { [high, low] });
        }
        let mut order: Vec<usize> = (0..dimensions).collect();
        for last in (1..dimensions).rev() {
            order.swap(last, ((last + 1) as f64 * stream.uniform()) as usize);
        }
        let mut point: Point = ends.iter().map(|ends| ends[0]).collect();
        let mut points = vec![point.clone()];
        for axis in order {
            point[axis] = ends[axis][1];
            points.push(point.clone());
        }
        points
    }

    pub(super) fn evaluations(self, dimensions: usize) -> u64 {
        u64::from(self.trajectories) * (dimensions as u64 + 1)
    }

    pub(super) fn faults(self) -> Vec<(&'static str, String)> {
        let mut faults = Vec::new();
        if self.trajectories < 2 {
            faults.push(("trajectories", "at least 2 trajectories are needed".to_owned()));
        }
        if self.levels < 2 || self.levels % 2 == 1 {
            faults.push(("levels", format!("{} is not an even number of 2 or more", self.levels)));
        }
        faults
    }
}
