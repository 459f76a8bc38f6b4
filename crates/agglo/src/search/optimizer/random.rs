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
//! use agglo::search::optimizer::Random;
//! let bowl = Noisy { function: TestFunction::Sphere, sigma: 0.0, seed: 1 };
//! let mut search = Random { points: 1000 }.start(1, 7);
//! let best = minimize(&mut search, 1000, |point, n| bowl.fitness(point, n)).expect("1000 points");
//! // The nearest of 1000 points is 1/2000 from the middle on average, further than ten times that in e^-10 of all cases.
//! assert!((best[0] - 0.5).abs() < 0.005);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::samples::Samples;
use super::{Fault, Optimizer, Part, stream, uniform_point};

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
    /// Begins a search over so many parameters.
    pub fn start(&self, dimensions: usize, seed: u64) -> impl Optimizer + use<> {
        let mut stream = stream(seed, Part::Points);
        Samples::new(self.points, move || uniform_point(&mut stream, dimensions))
    }

    pub(super) fn faults(&self) -> Vec<Fault> {
        if self.points == 0 { vec![("points", "at least 1 point is needed".into())] } else { Vec::new() }
    }
}
