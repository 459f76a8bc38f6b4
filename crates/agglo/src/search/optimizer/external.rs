//! External proposals: a program outside says which points are tried.
//!
//! # Equation
//! ```text
//! x_{k+1} = g(x_1, c_1, ..., x_k, c_k), g whatever the program makes of points and costs            OP7
//! ```
//!
//! # Source
//! None: it is no method but the place of one.
//!
//! # Symbols
//! | symbol | name in code | unit | meaning                                             |
//! |--------|--------------|------|-----------------------------------------------------|
//! | x_k    | `Point`      | 1    | point k: parameters, as parts of their ranges       |
//! | c_k    | `Fitness`    | -    | costs, standard errors and violation at this point  |
//!
//! # Valid when
//! The program proposes the same points when it is told the same: then a campaign that was stopped goes on with the same bits.
//!
//! # Compared with others
//! The methods of agglo are started by the program itself; a campaign with this one is led by `agglo.search` in Python, or through
//! [`Means::proposer`](crate::search::campaign::Means). The journal, the replicates and the confirmation of the best are the same.
//!
//! # In a campaign
//! ```toml
//! [method.external]
//! evaluations = 200
//! ```
//!
//! # Example
//! ```
//! use agglo::search::optimizer::{External, Optimizer, Point};
//! use agglo::search::Fitness;
//!
//! /// Goes along the diagonal.
//! struct Diagonal(f64);
//! impl Optimizer for Diagonal {
//!     fn ask(&mut self) -> Vec<Point> {
//!         self.0 += 0.25;
//!         vec![vec![self.0; 2]]
//!     }
//!     fn tell(&mut self, _: &[Fitness]) {}
//!     fn recommended(&self) -> Option<Point> {
//!         None
//!     }
//! }
//! let mut led = External { evaluations: 3 }.led_by(Box::new(Diagonal(0.0)));
//! let asked: Vec<Point> = std::iter::from_fn(|| led.ask().pop()).collect();
//! assert_eq!(asked, [[0.25; 2], [0.5; 2], [0.75; 2]]);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Fault, Optimizer, Point};
use crate::search::Fitness;

/// Points that a program outside proposes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct External {
    /// How many points at the most; at least 1.
    pub evaluations: usize,
}

impl Default for External {
    fn default() -> Self {
        Self { evaluations: 1000 }
    }
}

impl External {
    /// The proposals of a program, which end after so many points.
    pub fn led_by(&self, proposer: Box<dyn Optimizer>) -> Box<dyn Optimizer> {
        Box::new(Led { proposer, left: self.evaluations })
    }

    pub(super) fn faults(&self) -> Vec<Fault> {
        if self.evaluations == 0 {
            vec![("evaluations", "at least 1 point is needed".into())]
        } else {
            Vec::new()
        }
    }
}

/// A program's proposals, of which so many are left.
struct Led {
    proposer: Box<dyn Optimizer>,
    left: usize,
}

impl Optimizer for Led {
    fn ask(&mut self) -> Vec<Point> {
        if self.left == 0 {
            return Vec::new();
        }
        let mut points = self.proposer.ask();
        points.truncate(self.left);
        self.left -= points.len();
        points
    }

    fn tell(&mut self, fitnesses: &[Fitness]) {
        self.proposer.tell(fitnesses);
    }

    fn recommended(&self) -> Option<Point> {
        self.proposer.recommended()
    }

    fn has_failed(&self) -> bool {
        self.proposer.has_failed()
    }
}
