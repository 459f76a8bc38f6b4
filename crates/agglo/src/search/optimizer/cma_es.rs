//! Covariance matrix adaptation (CMA-ES): a normal distribution learns the shape of the valley that it descends.
//!
//! # Equation
//! ```text
//! x_k = m + σ y_k,  y_k ~ N(0, C);   m <- m + σ Σ w_k y_k over the better half                 OP1
//! C <- (1 + c_1 δ - c_1 - c_μ Σ w_k) C + c_1 p_c p_cᵀ + c_μ Σ w_k y_k y_kᵀ   over all, w_k < 0 in the worse half
//! σ <- σ exp((c_σ/d_σ) (|p_σ|/E|N(0, I)| - 1))
//! ```
//! Step sizes, paths and weights are the tutorial's, negative ones included. Around them:
//! * Bounds: the plane outside the unit cube is its mirror image, x = y for y in [0, 1] and 2 - y in [1, 2] and so on,
//!   so every y has a cost and the distribution needs no correction. Its standard deviations are kept below 1/2.
//! * Limits: points are ranked feasible ones first, then by how far they miss, failures last. A generation of nothing but
//!   failures teaches nothing and is drawn again.
//! * Noise: if the mean squared standard error of a generation's costs is more than half of the variance of its costs,
//!   the ranks say little, and the next generation is 1.2 times larger (up to `most_growth` times the first), else it is
//!   smaller again by as much. Where no standard errors are told the population stays what it is.
//! * End: a run stops when its steps are below 1e-11, when its best costs differ by no more than `tolerance` over
//!   10 + 30 d/λ generations, or when C is too thin to compute with. Then the population grows and another run starts at a
//!   point drawn uniformly (IPOP), until all `evaluations` are used or `restarts` runs have followed the first; the last
//!   generation is as large as what is left.
//! * Recommendation: the mean of the distribution, not the best point seen, which with noise is a lucky one. It is asked
//!   as the last point of each run, so that it is evaluated; after several runs the best of these counts.
//!
//! # Source
//! N. Hansen, *The CMA evolution strategy: a tutorial*, arXiv:1604.00772 (2016), appendix A; restarts: A. Auger and
//! N. Hansen, *A restart CMA evolution strategy with increasing population size*, CEC (2005). The rule for noise is ours;
//! it stands in the place of the re-evaluations of N. Hansen et al., IEEE Trans. Evol. Comput. 13, 180 (2009), since an
//! ensemble of random replicates tells the standard error at no cost.
//!
//! # Symbols
//! | symbol | name in code          | unit | meaning                                       |
//! |--------|-----------------------|------|-----------------------------------------------|
//! | m      | `mean`                | 1    | middle of the distribution, in the unit cube  |
//! | σ      | `sigma`               | 1    | its size                                      |
//! | C      | `covariance`          | 1    | its shape                                     |
//! | λ      | `population`          | 1    | points in a generation                        |
//! | d      | `dimensions`          | 1    | parameters                                    |
//! | p_σ, p_c | `path_sigma`, `path` | 1   | the way that the mean has gone                |
//!
//! # Valid when
//! One cost; up to about a hundred parameters.
//!
//! # Compared with others
//! The population is half as large again as the tutorial's 4 + 3 ln d: with noise or many valleys that finds lower points
//! (Rastrigin's function in 10 dimensions), and costs little where there are none.
//!
//! # In a campaign
//! ```toml
//! [method.cma_es]
//! evaluations = 1000
//! step = 0.2
//! ```
//!
//! # Example
//! ```
//! use agglo::search::functions::{Noisy, TestFunction, minimize};
//! use agglo::search::optimizer::CmaEs;
//! let bowl = Noisy { function: TestFunction::Sphere, sigma: 0.0, seed: 1 };
//! let mut search = CmaEs { evaluations: 2000, ..Default::default() }.start(5, 1);
//! let best = minimize(&mut search, 2000, |point, n| bowl.fitness(point, n)).expect("points were told");
//! assert!(TestFunction::Sphere.at(&best) < 1e-10);
//! ```

mod distribution;
#[cfg(test)]
mod tests;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use self::distribution::{Distribution, Draw, Rates};
use super::{
    Candidate, Fault, Optimizer, Part, Point, keep_best, mirrored, start_faults, stream, uniform_point,
};
use crate::math::rng::Stream;
use crate::search::Fitness;

/// Points that a generation learns from at the least.
const LEAST: usize = 4;
/// Above this part of the variance of the costs noise makes the population grow.
const MOST_NOISE: f64 = 0.5;
/// How fast.
const GROWTH: f64 = 1.2;
/// Largest standard deviation of a coordinate, as a part of its range.
const WIDEST: f64 = 0.5;

/// Covariance matrix adaptation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct CmaEs {
    /// Most points evaluated in all; at least 2.
    pub evaluations: usize,
    /// Points in a generation of the first run, at least 4; 6 + 4.5 ln d if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub population: Option<usize>,
    /// Standard deviation of the first points, as a part of each range; above 0, at most 0.5.
    pub step: f64,
    /// Where the first run starts, as parts of the ranges; drawn uniformly if left out.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub start: Point,
    /// Most restarts after runs that came to an end; 0 or more.
    pub restarts: usize,
    /// How many times larger the population is after each restart; at least 1.
    pub growth: f64,
    /// How many times larger noise may make the population; at least 1.
    pub most_growth: f64,
    /// A run ends when its best costs differ by no more; 0 or more.
    pub tolerance: f64,
}

impl Default for CmaEs {
    fn default() -> Self {
        Self {
            evaluations: 1000,
            population: None,
            step: 0.2,
            start: Vec::new(),
            restarts: 9,
            growth: 2.0,
            most_growth: 8.0,
            tolerance: 1e-12,
        }
    }
}

impl CmaEs {
    /// Begins a search over so many parameters.
    pub fn start(&self, dimensions: usize, seed: u64) -> impl Optimizer + use<> {
        Search::new(self.clone(), dimensions, seed)
    }

    pub(super) fn faults(&self, dimensions: usize) -> Vec<Fault> {
        let mut faults = start_faults(&self.start, dimensions);
        if self.evaluations < 2 {
            faults.push(("evaluations", "at least 2 are needed".into()));
        }
        if self.population.is_some_and(|population| population < LEAST) {
            faults.push(("population", format!("at least {LEAST} points are needed")));
        }
        if !(self.step > 0.0 && self.step <= WIDEST) {
            faults.push(("step", format!("{} is not above 0 and at most {WIDEST}", self.step)));
        }
        for (key, factor) in [("growth", self.growth), ("most_growth", self.most_growth)] {
            if !(1.0..=1e3).contains(&factor) {
                faults.push((key, format!("{factor} is not from 1 to 1000")));
            }
        }
        if !(self.tolerance >= 0.0 && self.tolerance.is_finite()) {
            faults.push(("tolerance", format!("{} is not 0 or more", self.tolerance)));
        }
        faults
    }
}

/// What is asked.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stage {
    Generations,
    /// The mean at the end of a run.
    Mean,
    Over,
}

struct Search {
    parameters: CmaEs,
    stage: Stage,
    evaluations: usize,
    restarts: usize,
    /// Points in the first generation of this run.
    least: f64,
    /// Points in the next generation; fractions are kept for its slow growth.
    population: f64,
    rates: Rates,
    distribution: Distribution,
    draws: Vec<Draw>,
    /// Best cost of each generation of this run.
    history: Vec<f64>,
    /// Best of the means at the ends of runs.
    best: Option<Candidate>,
    points: Stream,
    deviates: Stream,
}

impl Search {
    fn new(parameters: CmaEs, dimensions: usize, seed: u64) -> Self {
        let usual = || 6 + (4.5 * (dimensions as f64).ln()) as usize;
        let population = parameters.population.unwrap_or_else(usual);
        let mut points = stream(seed, Part::Points);
        let mean = if parameters.start.is_empty() {
            uniform_point(&mut points, dimensions)
        } else {
            parameters.start.clone()
        };
        Self {
            stage: Stage::Generations,
            evaluations: 0,
            restarts: 0,
            least: population as f64,
            population: population as f64,
            rates: Rates::new(population, dimensions),
            distribution: Distribution::new(mean, parameters.step),
            draws: Vec::new(),
            history: Vec::new(),
            best: None,
            points,
            deviates: stream(seed, Part::Deviates),
            parameters,
        }
    }

    fn mean(&self) -> Point {
        self.distribution.mean.iter().copied().map(mirrored).collect()
    }

    fn left(&self) -> usize {
        self.parameters.evaluations.saturating_sub(self.evaluations)
    }

    /// Whether this run has nothing more to find.
    fn has_converged(&self) -> bool {
        let dimensions = self.distribution.mean.len() as f64;
        let window = 10 + (30.0 * dimensions / self.population).ceil() as usize;
        let flat = self.history.len().checked_sub(window).is_some_and(|from| {
            let (least, most) = self.history[from..]
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), cost| {
                    (least.min(*cost), most.max(*cost))
                });
            most - least <= self.parameters.tolerance
        });
        flat || self.distribution.widest() < 1e-11 || self.distribution.condition() > 1e14
    }

    fn restart(&mut self) {
        self.least *= self.parameters.growth;
        self.restarts += 1;
        if self.restarts > self.parameters.restarts || self.left() == 0 {
            self.stage = Stage::Over;
            return;
        }
        // What is left of the budget is used, with a population that fits into it.
        let most = self.left().saturating_sub(1).max(LEAST) as f64;
        self.least = self.least.min(most);
        self.population = self.least;
        let dimensions = self.distribution.mean.len();
        self.stage = Stage::Generations;
        self.rates = Rates::new(self.population as usize, dimensions);
        let mean = uniform_point(&mut self.points, dimensions);
        self.distribution = Distribution::new(mean, self.parameters.step);
        self.history.clear();
    }

    fn learn(&mut self, fitnesses: &[Fitness]) {
        let mut order: Vec<usize> = (0..fitnesses.len()).collect();
        order.sort_by(|a, b| fitnesses[*a].compare(&fitnesses[*b]));
        let Some(best) = order.first().filter(|best| !fitnesses[**best].is_failure()) else { return };
        self.history.push(fitnesses[*best].cost());
        let ranked: Vec<&Draw> = order.iter().map(|k| &self.draws[*k]).collect();
        self.distribution.learn(&ranked, &self.rates);
        let widest = self.distribution.widest();
        if widest > WIDEST {
            self.distribution.sigma *= WIDEST / widest;
        }
        self.heed_noise(fitnesses);
    }

    /// Makes the population as large as the noise asks for.
    fn heed_noise(&mut self, fitnesses: &[Fitness]) {
        let Some(part) = noise_part(fitnesses) else { return };
        let factor = if part > MOST_NOISE { GROWTH } else { 1.0 / GROWTH };
        let most = self.least * self.parameters.most_growth;
        self.population = (self.population * factor).clamp(self.least, most);
        if self.population as usize != self.rates.weights.len() {
            self.rates = Rates::new(self.population as usize, self.distribution.mean.len());
        }
    }
}

/// Which part of the variance of the feasible costs is noise; nothing if they are too few or their noise is not known.
fn noise_part(fitnesses: &[Fitness]) -> Option<f64> {
    let feasible = || fitnesses.iter().filter(|fitness| fitness.is_feasible() && !fitness.is_failure());
    let count = feasible().count() as f64;
    let squared_error =
        |fitness: &Fitness| fitness.standard_errors.first().map_or(0.0, |error| error * error);
    let noise = feasible().map(squared_error).sum::<f64>() / count;
    if count < 2.0 || noise == 0.0 {
        return None;
    }
    let mean = feasible().map(Fitness::cost).sum::<f64>() / count;
    let variance = feasible().map(|fitness| (fitness.cost() - mean).powi(2)).sum::<f64>() / (count - 1.0);
    Some(noise / variance)
}

impl Optimizer for Search {
    fn ask(&mut self) -> Vec<Point> {
        let population = self.rates.weights.len();
        if self.stage == Stage::Over || self.left() == 0 {
            return Vec::new();
        }
        if self.left() == 1 || self.has_converged() {
            self.stage = Stage::Mean;
            return vec![self.mean()];
        }
        // The last generation is as large as the budget allows, with one point kept for the mean.
        let count = population.min(self.left() - 1);
        if count < population && count >= LEAST {
            self.rates = Rates::new(count, self.distribution.mean.len());
        }
        let Self { distribution, deviates, draws, .. } = self;
        draws.clear();
        draws.extend((0..count).map(|_| distribution.draw(deviates)));
        draws.iter().map(|draw| distribution.point(draw).map(mirrored).collect()).collect()
    }

    fn tell(&mut self, fitnesses: &[Fitness]) {
        self.evaluations += fitnesses.len();
        match (self.stage, fitnesses) {
            (Stage::Mean, [fitness]) => {
                let mean = Candidate { point: self.mean(), fitness: fitness.clone() };
                keep_best(&mut self.best, std::iter::once(mean));
                self.restart();
            }
            // Too few points tell nothing of the shape; the best of them counts all the same.
            _ if fitnesses.len() >= LEAST => self.learn(fitnesses),
            _ => {}
        }
    }

    fn recommended(&self) -> Option<Point> {
        let finished = self.best.as_ref().map(|best| best.point.clone());
        finished.or_else(|| (self.evaluations > 0).then(|| self.mean()))
    }
}
