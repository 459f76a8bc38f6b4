//! Optimizers: they propose points and are told how good these are.
//!
//! They know nothing of scenarios, of threads or of time. A search is resumed by asking and telling again.

mod cma_es;
mod eigen;
mod external;
mod genetic;
mod nelder_mead;
mod published_genetic;
mod random;
mod samples;
mod sobol;
#[cfg(test)]
mod tests;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use cma_es::CmaEs;
pub use external::External;
pub use genetic::Genetic;
pub use nelder_mead::NelderMead;
pub use published_genetic::PublishedGenetic;
pub use random::Random;
pub use sobol::Sobol;

use super::Fitness;
use crate::math::rng::{Purpose, Stream};

/// A point of the unit cube, one coordinate in [0, 1] for each parameter.
pub type Point = Vec<f64>;

/// A key of a method's parameters and what is wrong with its value.
pub type Fault = (&'static str, String);

/// Proposes points and learns how good they are. What it asks is a function of its seed and of what it was told.
pub trait Optimizer: Send {
    /// Points to be evaluated next; none if the search is over.
    fn ask(&mut self) -> Vec<Point>;

    /// How good the points of the last [`Optimizer::ask`] are, in their order.
    fn tell(&mut self, fitnesses: &[Fitness]);

    /// The point that it would choose now; with noise that need not be the one with the lowest cost seen.
    fn recommended(&self) -> Option<Point>;

    /// Whether it cannot go on, as may be with a program outside: the campaign stops then, and can be gone on with.
    fn has_failed(&self) -> bool {
        false
    }
}

/// How the space is searched.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Method {
    /// Covariance matrix adaptation; heeds noise.
    CmaEs(CmaEs),
    /// Genetic algorithm with simulated binary crossover; finds fronts of two costs.
    Genetic(Genetic),
    /// The genetic algorithm of [B] 7.
    PublishedGenetic(PublishedGenetic),
    /// Downhill simplex: polishes a given point.
    NelderMead(NelderMead),
    /// Points drawn uniformly.
    Random(Random),
    /// Points that fill the space evenly.
    Sobol(Sobol),
    /// Points that a program outside proposes.
    External(External),
}

impl Default for Method {
    fn default() -> Self {
        Self::CmaEs(CmaEs::default())
    }
}

/// Most evaluations of a search.
const MOST: usize = 100_000_000;

impl Method {
    /// An optimizer over `dimensions` parameters for `objectives` costs; its parameters have no faults. None where its points come
    /// from outside.
    pub fn start(&self, dimensions: usize, objectives: usize, seed: u64) -> Option<Box<dyn Optimizer>> {
        Some(match self {
            Self::CmaEs(parameters) => Box::new(parameters.start(dimensions, seed)),
            Self::Genetic(parameters) => Box::new(parameters.start(dimensions, objectives, seed)),
            Self::PublishedGenetic(parameters) => Box::new(parameters.start(dimensions, seed)),
            Self::NelderMead(parameters) => Box::new(parameters.start(dimensions)),
            Self::Random(parameters) => Box::new(parameters.start(dimensions, seed)),
            Self::Sobol(parameters) => Box::new(parameters.start(dimensions, seed)),
            Self::External(_) => return None,
        })
    }

    /// The word that stands for it in a file.
    pub fn word(&self) -> &'static str {
        match self {
            Self::CmaEs(_) => "cma_es",
            Self::Genetic(_) => "genetic",
            Self::PublishedGenetic(_) => "published_genetic",
            Self::NelderMead(_) => "nelder_mead",
            Self::Random(_) => "random",
            Self::Sobol(_) => "sobol",
            Self::External(_) => "external",
        }
    }

    /// Points that it asks for at the most.
    pub fn evaluations(&self) -> usize {
        match self {
            Self::CmaEs(method) => method.evaluations,
            Self::Genetic(method) => method.population.saturating_mul(method.generations.saturating_add(1)),
            Self::PublishedGenetic(method) => {
                let young = method.population.saturating_sub(method.parents);
                method.population.saturating_add(method.generations.saturating_mul(young))
            }
            Self::NelderMead(method) => method.evaluations,
            Self::Random(method) => method.points,
            Self::Sobol(method) => method.points,
            Self::External(method) => method.evaluations,
        }
    }

    /// What is wrong with its parameters: key and message.
    pub fn faults(&self, dimensions: usize, objectives: usize) -> Vec<Fault> {
        let mut faults = match self {
            Self::CmaEs(parameters) => parameters.faults(dimensions),
            Self::Genetic(parameters) => parameters.faults(),
            Self::PublishedGenetic(parameters) => parameters.faults(),
            Self::NelderMead(parameters) => parameters.faults(dimensions),
            Self::Random(parameters) => parameters.faults(),
            Self::Sobol(parameters) => parameters.faults(dimensions),
            Self::External(parameters) => parameters.faults(),
        };
        let finds_fronts =
            matches!(self, Self::Genetic(_) | Self::Random(_) | Self::Sobol(_) | Self::External(_));
        if objectives != 1 && !finds_fronts {
            let message =
                format!("this method makes 1 cost small, not {objectives}; `genetic` finds fronts of 2");
            faults.push(("objectives", message));
        }
        if self.evaluations() > MOST {
            let message = format!("{} evaluations are more than {MOST}", self.evaluations());
            faults.push(("evaluations", message));
        }
        if dimensions == 0 {
            faults.push(("parameters", "there is nothing to vary".into()));
        }
        faults
    }
}

/// What a stream of an optimizer's random numbers is for.
#[derive(Clone, Copy)]
#[repr(u32)]
enum Part {
    /// Points of the whole box or of a part of it.
    Points = 0,
    /// How parents are chosen and mixed.
    Mating = 1,
    /// Where a distribution is sampled.
    Deviates = 2,
}

fn stream(seed: u64, part: Part) -> Stream {
    Stream::new(seed, Purpose::Search, part as u32)
}

/// A point drawn uniformly from the unit cube.
fn uniform_point(stream: &mut Stream, dimensions: usize) -> Point {
    (0..dimensions).map(|_| stream.uniform()).collect()
}

/// The coordinate in [0, 1] that `y` is a mirror image of.
fn mirrored(y: f64) -> f64 {
    let folded = y.rem_euclid(2.0);
    folded.min(2.0 - folded)
}

/// What is wrong with the point where a search is to start.
fn start_faults(start: &[f64], dimensions: usize) -> Vec<Fault> {
    let mut faults = Vec::new();
    if !start.is_empty() && start.len() != dimensions {
        faults.push(("start", format!("it has {} numbers for {dimensions} parameters", start.len())));
    }
    if let Some(x) = start.iter().find(|x| !(0.0..=1.0).contains(*x)) {
        faults.push(("start", format!("{x} is not a part of a range, from 0 to 1")));
    }
    faults
}

/// A point and how good it is.
#[derive(Clone, Debug)]
struct Candidate {
    point: Point,
    fitness: Fitness,
}

/// What was asked with what was told, in order.
fn candidates(asked: &mut Vec<Point>, fitnesses: &[Fitness]) -> impl Iterator<Item = Candidate> {
    asked.drain(..).zip(fitnesses).map(|(point, fitness)| Candidate { point, fitness: fitness.clone() })
}

/// Puts the best of the new ones in the place of `best` if it is better.
fn keep_best(best: &mut Option<Candidate>, new: impl Iterator<Item = Candidate>) {
    for candidate in new {
        if best.as_ref().is_none_or(|best| candidate.fitness.compare(&best.fitness).is_lt()) {
            *best = Some(candidate);
        }
    }
}
