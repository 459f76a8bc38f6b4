//! Which values a study tries. All points are known before the first run.

mod grid;
mod list;
mod morris;
mod refinement;
mod sobol_indices;
#[cfg(test)]
mod tests;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use grid::Grid;
pub use list::List;
pub use morris::Morris;
pub use refinement::Refinement;
pub use sobol_indices::SobolIndices;

use super::Fitness;
use super::optimizer::{Optimizer, Point};
use crate::math::rng::{Purpose, Stream};

/// Most evaluations of a study.
const MOST: u64 = 1_000_000;

/// Which values a study tries.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Plan {
    /// Every combination of the parameters' values.
    Grid(Grid),
    /// The parameters' lists side by side: the first values together, then the second ones, and so on.
    List(List),
    /// One parameter from coarse to fine: when does the outcome settle, and at which order does it converge?
    Refinement(Refinement),
    /// Which parameters matter, by steps of one parameter at a time (elementary effects).
    Morris(Morris),
    /// What share of the outcome's variance each parameter has, alone and with the others.
    SobolIndices(SobolIndices),
}

impl Plan {
    /// All points, in the order in which they are evaluated.
    ///
    /// `levels` has the number of different values of each parameter, none where it is continuous.
    pub fn points(&self, levels: &[Option<usize>], seed: u64) -> Vec<Point> {
        match self {
            Self::Grid(grid) => grid.points(levels),
            Self::List(_) => List::points(levels),
            Self::Refinement(_) => Refinement::points(levels),
            Self::Morris(morris) => morris.points(levels.len(), seed),
            Self::SobolIndices(indices) => indices.points(levels.len(), seed),
        }
    }

    /// How many points there are; `levels` as in [`Plan::points`].
    pub fn evaluations(&self, levels: &[Option<usize>]) -> u64 {
        match self {
            Self::Grid(grid) => grid.evaluations(levels),
            Self::List(_) | Self::Refinement(_) => {
                levels.iter().flatten().max().map_or(0, |&most| most as u64)
            }
            Self::Morris(morris) => morris.evaluations(levels.len()),
            Self::SobolIndices(indices) => indices.evaluations(levels.len()),
        }
    }

    /// Something that proposes all points at once and then is done; `levels` as in [`Plan::points`].
    pub fn start(&self, levels: &[Option<usize>], seed: u64) -> Box<dyn Optimizer> {
        Box::new(Laid { left: self.points(levels, seed), asked: Vec::new(), best: None })
    }

    /// What is wrong with it: key and message; `levels` as in [`Plan::points`].
    pub fn faults(&self, levels: &[Option<usize>]) -> Vec<(&'static str, String)> {
        let mut faults = match self {
            Self::Grid(grid) => grid.faults(),
            Self::List(_) => List::faults(levels),
            Self::Refinement(refinement) => refinement.faults(levels),
            Self::Morris(morris) => morris.faults(),
            Self::SobolIndices(indices) => indices.faults(),
        };
        let evaluations = self.evaluations(levels);
        if evaluations > MOST {
            faults.push((self.word(), format!("{evaluations} evaluations are more than {MOST}")));
        }
        faults
    }

    /// The word that stands for it in a file.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Grid(_) => "grid",
            Self::List(_) => "list",
            Self::Refinement(_) => "refinement",
            Self::Morris(_) => "morris",
            Self::SobolIndices(_) => "sobol_indices",
        }
    }
}

/// The coordinate of value number `number` of `levels`: the middle of its part of the axis.
fn coordinate(number: usize, levels: usize) -> f64 {
    (number as f64 + 0.5) / levels as f64
}

/// What random numbers of a plan are for; apart from those of the optimizers.
#[derive(Clone, Copy)]
#[repr(u32)]
enum Draw {
    Trajectories = 1000,
    Bases = 1001,
}

fn stream(seed: u64, draw: Draw) -> Stream {
    Stream::new(seed, Purpose::Search, draw as u32)
}

/// Proposes the points of a plan and remembers which was best.
struct Laid {
    left: Vec<Point>,
    asked: Vec<Point>,
    best: Option<(Point, Fitness)>,
}

impl Optimizer for Laid {
    fn ask(&mut self) -> Vec<Point> {
        self.asked = std::mem::take(&mut self.left);
        self.asked.clone()
    }

    fn tell(&mut self, fitnesses: &[Fitness]) {
        for (point, fitness) in self.asked.drain(..).zip(fitnesses) {
            let is_better = self.best.as_ref().is_none_or(|(_, best)| fitness.compare(best).is_lt());
            if is_better && !fitness.is_failure() {
                self.best = Some((point, fitness.clone()));
            }
        }
    }

    fn recommended(&self) -> Option<Point> {
        self.best.as_ref().map(|(point, _)| point.clone())
    }
}
