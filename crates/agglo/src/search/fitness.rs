//! How good a candidate is, and which of two is better.

use std::cmp::Ordering;

use serde::{Deserialize, Serialize};

/// How good a candidate is: costs to be made small, and how far it is from what is allowed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fitness {
    /// What is to be small; one entry, or two where a front is sought. Empty if the candidate failed.
    pub costs: Vec<f64>,
    /// Standard errors of the costs over random replicates; 0 where there is no noise or it is not known.
    pub standard_errors: Vec<f64>,
    /// Sum of the relative amounts by which limits are missed; 0 if the candidate is feasible, infinite if it failed.
    pub violation: f64,
}

impl Fitness {
    /// Of a feasible candidate without known noise.
    pub fn new(costs: Vec<f64>) -> Self {
        Self { standard_errors: vec![0.0; costs.len()], costs, violation: 0.0 }
    }

    /// Of a candidate that could not be evaluated.
    pub fn failed() -> Self {
        Self { costs: Vec::new(), standard_errors: Vec::new(), violation: f64::INFINITY }
    }

    /// Whether it keeps all limits.
    pub fn is_feasible(&self) -> bool {
        self.violation == 0.0
    }

    /// Whether it could not be evaluated.
    pub fn is_failure(&self) -> bool {
        self.costs.is_empty()
    }

    /// The first cost; infinite for a failure.
    pub fn cost(&self) -> f64 {
        self.costs.first().copied().unwrap_or(f64::INFINITY)
    }

    /// The better one is less: feasible before not, then the smaller violation, then the smaller first cost.
    ///
    /// Source: K. Deb, *An efficient constraint handling method for genetic algorithms*, Comput. Methods Appl. Mech.
    /// Eng. 186, 311 (2000).
    pub fn compare(&self, other: &Self) -> Ordering {
        self.violation.total_cmp(&other.violation).then(self.cost().total_cmp(&other.cost()))
    }

    /// Whether it is at least as good in every cost and better in one; feasibility goes first.
    pub fn dominates(&self, other: &Self) -> bool {
        if self.violation != other.violation {
            return self.violation < other.violation;
        }
        if self.is_failure() || other.is_failure() {
            return false;
        }
        let mut pairs = self.costs.iter().zip(&other.costs);
        pairs.clone().all(|(a, b)| a <= b) && pairs.any(|(a, b)| a < b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn feasible_goes_before_cheap() {
        let good = Fitness::new(vec![5.0]);
        let cheap = Fitness { violation: 0.1, ..Fitness::new(vec![1.0]) };
        let worse = Fitness { violation: 0.2, ..Fitness::new(vec![0.0]) };
        let mut all = [Fitness::failed(), worse.clone(), cheap.clone(), good.clone()];
        all.sort_by(Fitness::compare);
        assert_eq!(all, [good, cheap, worse, Fitness::failed()]);
    }

    #[test]
    fn dominance_needs_every_cost() {
        let of = |a, b| Fitness::new(vec![a, b]);
        assert_true!(of(1.0, 2.0).dominates(&of(1.0, 3.0)), "fitness of costs in this order");
        assert_false!(of(1.0, 2.0).dominates(&of(1.0, 2.0)), "fitness of costs in this order");
        assert_false!(of(1.0, 3.0).dominates(&of(2.0, 2.0)), "fitness of costs in this order");
        assert_true!(
            of(9.0, 9.0).dominates(&Fitness { violation: 0.1, ..of(1.0, 1.0) }),
            "fitness of costs in this order"
        );
        assert_true!(of(9.0, 9.0).dominates(&Fitness::failed()), "fitness of costs in this order");
        assert_false!(Fitness::failed().dominates(&Fitness::failed()), "fitness of costs in this order");
    }
}
