//! Random search: points drawn uniformly. What every other method must beat.
//!
//! # Equation
//! ```text
//! x_i uniform in [0, 1], each apart                                                             OP6
//! P(no point of n is in a part q of the box) = (1 - q)^n
//! ```
//!
//! # Source
//! S. H. Brooks, *A discussion of random methods for seeking maxima*, Oper. Res. 6, 244 (1958).
//!
//! # Symbols
//! | symbol | name in code | unit | meaning                                    |
//! |--------|--------------|------|--------------------------------------------|
//! | x_i    | `Point`      | 1    | parameter i, as a part of its range        |
//! | n      | `points`     | 1    | how many points                            |
//!
//! # Valid when
//! Always; how good its best is depends on the part of the box that is as good, not on the number of parameters.
//!
//! # Compared with others
//! `sobol` fills the box more evenly with as many points. Two objectives are fine: all points that none beats are the front.
//!
//! # In a campaign
//! ```toml
//! [method.random]
//! points = 1000
//! ```
//!
//! # Example
//! ```
//! use agglo::search::functions::{TestFunction, minimize, Noisy};
//! use agglo::search::optimizer::{Method, Random};
//! let bowl = Noisy { function: TestFunction::Sphere, sigma: 0.0, seed: 1 };
//! let mut search = Method::Random(Random { points: 1000 }).start(1, 1, 7);
//! let best = minimize(search.as_mut(), 1000, |point, n| bowl.fitness(point, n)).expect("1000 points");
//! // The nearest of 1000 points is 1/2000 from the middle on average, further than ten times that in e^-10 of all cases.
//! assert!((best[0] - 0.5).abs() < 0.005);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Candidate, Fault, Optimizer, Part, Point, candidates, keep_best, stream, uniform_point};
use crate::math::rng::Stream;
use crate::search::Fitness;

/// Points in one batch; none depends on another, so this only says how often results are seen.
pub(super) const BATCH: usize = 32;

/// Points drawn uniformly.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Random {
    /// How many points; at least 1.
    pub points: usize,
}

impl Default for Random {
    fn default() -> Self {
        Self { points: 1000 }
    }
}

impl Random {
    pub(super) fn start(&self, dimensions: usize, seed: u64) -> impl Optimizer + use<> {
        Search {
            left: self.points,
            dimensions,
            stream: stream(seed, Part::Points),
            asked: Vec::new(),
            best: None,
        }
    }

    pub(super) fn faults(&self) -> Vec<Fault> {
        if self.points == 0 { vec![("points", "at least 1 point is needed".into())] } else { Vec::new() }
    }
}

struct Search {
    left: usize,
    dimensions: usize,
    stream: Stream,
    asked: Vec<Point>,
    best: Option<Candidate>,
}

impl Optimizer for Search {
    fn ask(&mut self) -> Vec<Point> {
        let count = self.left.min(BATCH);
        self.left -= count;
        self.asked = (0..count).map(|_| uniform_point(&mut self.stream, self.dimensions)).collect();
        self.asked.clone()
    }

    fn tell(&mut self, fitnesses: &[Fitness]) {
        keep_best(&mut self.best, candidates(&mut self.asked, fitnesses));
    }

    fn recommended(&self) -> Option<Point> {
        self.best.as_ref().map(|best| best.point.clone())
    }
}
