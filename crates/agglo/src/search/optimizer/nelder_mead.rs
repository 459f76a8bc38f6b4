//! Downhill simplex of Nelder and Mead: polishes a point that another method found.
//!
//! # Equation
//! ```text
//! x_r = c + (c - x_w)                                                                            OP4
//!                            reflection of the worst of d + 1 points through the centroid c of the others
//! x_e = c + χ (c - x_w)      expansion, χ = 1 + 2/d
//! x_o = c + γ (c - x_w)      contraction outside, γ = 3/4 - 1/(2 d)
//! x_i = c - γ (c - x_w)      contraction inside
//! x_k = x_b + s (x_k - x_b)  all shrink toward the best, s = 1 - 1/d
//! ```
//! with d = 2 in χ, γ and s for a single parameter. Beyond the bounds lies the mirror image of the unit cube. It stops
//! when the costs of the simplex scatter (standard deviation) by no more than their standard errors (root of the mean
//! square), when they differ by no more than `tolerance`, when the simplex is smaller than 1e-9 of the ranges, or when all evaluations are used.
//!
//! # Source
//! J. A. Nelder and R. Mead, Comput. J. 7, 308 (1965); F. Gao and L. Han, *Implementing the Nelder-Mead simplex
//! algorithm with adaptive parameters*, Comput. Optim. Appl. 51, 259 (2012). It is the "post-genetic operation" that
//! T. I. Zohdi, Proc. R. Soc. Lond. A 460, 3421 (2004), section 7, leaves open, without gradients.
//!
//! # Symbols
//! | symbol   | name in code | unit | meaning                                         |
//! |----------|--------------|------|-------------------------------------------------|
//! | x_b, x_w | `simplex`    | 1    | best and worst point, as parts of the ranges    |
//! | c        | `centroid`   | 1    | mean of all points but the worst                |
//! | χ, γ, s  | `factors`    | 1    | how far is expanded, contracted, shrunk         |
//! | d        | `dimensions` | 1    | parameters                                      |
//!
//! # Valid when
//! Few parameters (up to about ten), one cost, little noise, a start near the lowest point.
//!
//! # Compared with others
//! As `Nelder-Mead` of SciPy with `adaptive=True`, but that it stops where the costs are noise, and that bounds are mirrors and
//! not edges to which points are clipped.
//!
//! # In a campaign
//! ```toml
//! # From the best point of another method; alone it is [method.nelder_mead].
//! [polish]
//! evaluations = 200
//! ```
//!
//! # Example
//! ```
//! use agglo::search::functions::{Noisy, TestFunction, minimize};
//! use agglo::search::optimizer::NelderMead;
//! let valley = Noisy { function: TestFunction::Rosenbrock, sigma: 0.0, seed: 1 };
//! let polish = NelderMead { start: vec![0.3, 0.35], evaluations: 400, ..Default::default() };
//! let best = minimize(&mut polish.start(2), 400, |point, n| valley.fitness(point, n));
//! assert!(TestFunction::Rosenbrock.at(&best.expect("points were told")) < 1e-8);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Candidate, Fault, Optimizer, Point, mirrored, start_faults};
use crate::search::Fitness;

/// A simplex smaller than this part of the ranges has converged.
const SMALLEST: f64 = 1e-9;

/// Downhill simplex.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct NelderMead {
    /// Most points evaluated; at least one more than parameters.
    pub evaluations: usize,
    /// Where it starts, as parts of the ranges; the middle if left out.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub start: Point,
    /// Edge of the first simplex, as a part of each range; above 0, at most 0.5.
    pub step: f64,
    /// Costs that differ by less are equal; 0 or more.
    pub tolerance: f64,
}

impl Default for NelderMead {
    fn default() -> Self {
        Self { evaluations: 200, start: Vec::new(), step: 0.05, tolerance: 1e-12 }
    }
}

impl NelderMead {
    /// Begins a search over so many parameters.
    pub fn start(&self, dimensions: usize) -> impl Optimizer + use<> {
        Search::new(self.clone(), dimensions)
    }

    pub(super) fn faults(&self, dimensions: usize) -> Vec<Fault> {
        let mut faults = start_faults(&self.start, dimensions);
        if self.evaluations <= dimensions {
            let message = format!("{} do not make a simplex of {} points", self.evaluations, dimensions + 1);
            faults.push(("evaluations", message));
        }
        if !(self.step > 0.0 && self.step <= 0.5) {
            faults.push(("step", format!("{} is not above 0 and at most 0.5", self.step)));
        }
        if !(self.tolerance >= 0.0 && self.tolerance.is_finite()) {
            faults.push(("tolerance", format!("{} is not 0 or more", self.tolerance)));
        }
        faults
    }
}

/// What was asked last.
#[derive(Clone, Debug)]
enum Stage {
    /// All points, or all but the best.
    Simplex,
    Reflection,
    /// The reflected point is in hand.
    Expansion(Candidate),
    OutsideContraction(Candidate),
    InsideContraction,
}

struct Search {
    parameters: NelderMead,
    stage: Stage,
    evaluations: usize,
    /// Points of a whole simplex.
    size: usize,
    /// Best first once evaluated; points are not yet mirrored into the cube.
    simplex: Vec<Candidate>,
    asked: Vec<Point>,
}

impl Search {
    fn new(parameters: NelderMead, dimensions: usize) -> Self {
        let first =
            if parameters.start.is_empty() { vec![0.5; dimensions] } else { parameters.start.clone() };
        let mut asked = vec![first.clone(); dimensions + 1];
        for (axis, point) in asked[1..].iter_mut().enumerate() {
            let inward = if first[axis] + parameters.step > 1.0 { -parameters.step } else { parameters.step };
            point[axis] += inward;
        }
        let size = dimensions + 1;
        Self { parameters, stage: Stage::Simplex, evaluations: 0, size, simplex: Vec::new(), asked }
    }

    fn dimensions(&self) -> usize {
        self.simplex.len() - 1
    }

    /// The centroid of all but the worst, plus `factor` times the way to it from the worst.
    fn along(&self, factor: f64) -> Point {
        let d = self.dimensions();
        let worst = &self.simplex[d].point;
        let centroid = |axis: usize| self.simplex[..d].iter().map(|c| c.point[axis]).sum::<f64>() / d as f64;
        (0..d).map(|axis| centroid(axis) * (1.0 + factor) - factor * worst[axis]).collect()
    }

    /// Expansion, contraction and shrinkage.
    fn factors(&self) -> [f64; 3] {
        let d = self.dimensions().max(2) as f64;
        [1.0 + 2.0 / d, 0.75 - 0.5 / d, 1.0 - 1.0 / d]
    }

    fn next(&mut self, stage: Stage, factor: f64) {
        self.stage = stage;
        self.asked = vec![self.along(factor)];
    }

    /// Starts an iteration; all points of the simplex are evaluated.
    fn reflect(&mut self) {
        self.simplex.sort_by(|a, b| a.fitness.compare(&b.fitness));
        self.next(Stage::Reflection, 1.0);
    }

    fn replace_worst(&mut self, candidate: Candidate) {
        self.simplex.pop();
        self.simplex.push(candidate);
        self.reflect();
    }

    fn shrink(&mut self) {
        let [_, _, shrinkage] = self.factors();
        let best = self.simplex[0].point.clone();
        self.stage = Stage::Simplex;
        let toward = |point: &Point| best.iter().zip(point).map(|(b, x)| b + shrinkage * (x - b)).collect();
        self.asked = self.simplex[1..].iter().map(|candidate| toward(&candidate.point)).collect();
        self.simplex.truncate(1);
    }

    /// Whether the costs scatter no more than by chance.
    fn is_noise(&self) -> bool {
        let count = self.simplex.len() as f64;
        let mean = self.simplex.iter().map(|c| c.fitness.cost()).sum::<f64>() / count;
        let scatter: f64 = self.simplex.iter().map(|c| (c.fitness.cost() - mean).powi(2)).sum();
        let error = |c: &Candidate| c.fitness.standard_errors.first().copied().unwrap_or(0.0);
        let noise: f64 = self.simplex.iter().map(|c| error(c).powi(2)).sum();
        noise > 0.0 && scatter / (count - 1.0) <= noise / count
    }

    fn has_converged(&self) -> bool {
        if !matches!(self.stage, Stage::Reflection) {
            return false;
        }
        let [best, .., worst] = self.simplex.as_slice() else { return false };
        let flat = best.fitness.violation == worst.fitness.violation
            && (worst.fitness.cost() - best.fitness.cost() <= self.parameters.tolerance || self.is_noise());
        let apart = |c: &Candidate| {
            c.point.iter().zip(&best.point).fold(0.0_f64, |most, (x, b)| most.max((x - b).abs()))
        };
        flat || self.simplex.iter().map(apart).fold(0.0, f64::max) < SMALLEST
    }

    fn judge_reflection(&mut self, reflected: Candidate) {
        let [expansion, contraction, _] = self.factors();
        let better = |than: &Candidate| reflected.fitness.compare(&than.fitness).is_lt();
        let d = self.dimensions();
        if better(&self.simplex[0]) {
            self.next(Stage::Expansion(reflected), expansion);
        } else if better(&self.simplex[d - 1]) {
            self.replace_worst(reflected);
        } else if better(&self.simplex[d]) {
            self.next(Stage::OutsideContraction(reflected), contraction);
        } else {
            self.next(Stage::InsideContraction, -contraction);
        }
    }

    fn judge(&mut self, candidate: Candidate) {
        let better = |than: &Candidate| candidate.fitness.compare(&than.fitness).is_lt();
        match std::mem::replace(&mut self.stage, Stage::Simplex) {
            Stage::Simplex | Stage::Reflection => self.judge_reflection(candidate),
            Stage::Expansion(reflected) => {
                let kept = if better(&reflected) { candidate } else { reflected };
                self.replace_worst(kept);
            }
            Stage::OutsideContraction(reflected) if better(&reflected) => self.replace_worst(candidate),
            Stage::InsideContraction if self.simplex.last().is_some_and(better) => {
                self.replace_worst(candidate);
            }
            Stage::OutsideContraction(_) | Stage::InsideContraction => self.shrink(),
        }
    }
}

impl Optimizer for Search {
    fn ask(&mut self) -> Vec<Point> {
        let left = self.parameters.evaluations.saturating_sub(self.evaluations);
        if left == 0 || self.has_converged() {
            return Vec::new();
        }
        // Of a simplex that shrinks as many points as the budget allows.
        self.asked.truncate(left);
        self.asked.iter().map(|point| point.iter().copied().map(mirrored).collect()).collect()
    }

    fn tell(&mut self, fitnesses: &[Fitness]) {
        self.evaluations += fitnesses.len();
        let mut told = super::candidates(&mut self.asked, fitnesses).collect::<Vec<_>>();
        if matches!(self.stage, Stage::Simplex) {
            self.simplex.append(&mut told);
            if self.simplex.len() == self.size {
                self.reflect();
            }
        } else if let Some(candidate) = told.pop() {
            self.judge(candidate);
        }
    }

    fn recommended(&self) -> Option<Point> {
        let in_hand = match &self.stage {
            Stage::Expansion(reflected) | Stage::OutsideContraction(reflected) => Some(reflected),
            _ => None,
        };
        let best = self.simplex.iter().chain(in_hand).min_by(|a, b| a.fitness.compare(&b.fitness))?;
        Some(best.point.iter().copied().map(mirrored).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::functions::{Noisy, TestFunction, minimize};

    /// Gao and Han: the adaptive simplex reaches the lowest point of the sphere in 10 dimensions.
    #[test]
    fn reaches_the_bottom_of_a_bowl() {
        let parameters =
            NelderMead { start: vec![0.6; 10], evaluations: 3000, tolerance: 1e-14, ..Default::default() };
        let noisy = Noisy { function: TestFunction::Sphere, sigma: 0.0, seed: 1 };
        let best = minimize(&mut parameters.start(10), 3000, |point, n| noisy.fitness(point, n)).unwrap();
        assert!(TestFunction::Sphere.at(&best) < 1e-10, "{}", TestFunction::Sphere.at(&best));
    }

    /// Noise of 0.5 on a bowl of curvature 2 x 10.24² in the cube: beyond the first simplex it stops soon.
    #[test]
    fn noise_stops_it() {
        let parameters = NelderMead { start: vec![0.51; 4], evaluations: 5000, ..Default::default() };
        let noisy = Noisy { function: TestFunction::Sphere, sigma: 0.5, seed: 1 };
        let mut evaluations = 0;
        minimize(&mut parameters.start(4), 5000, |point, n| {
            evaluations = n + 1;
            noisy.fitness(point, n)
        });
        assert!((5..200).contains(&evaluations), "{evaluations}");
    }

    /// The lowest point of a slope lies in the corner of the cube.
    #[test]
    fn stays_within_the_bounds() {
        let parameters = NelderMead { start: vec![0.9; 3], evaluations: 600, ..Default::default() };
        let best = minimize(&mut parameters.start(3), 600, |point, _| {
            assert_all!(point.iter(), |x| (0.0..=1.0).contains(x));
            Fitness::new(vec![-point.iter().sum::<f64>()])
        })
        .unwrap();
        assert!(best.iter().all(|x| *x > 0.999), "{best:?}");
    }
}
