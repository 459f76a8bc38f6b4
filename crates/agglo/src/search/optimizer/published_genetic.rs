//! The published genetic algorithm: ranked strings mate with their neighbors, parents are kept, the box shrinks.
//!
//! # Equation
//! ```text
//! λ¹ = Φ¹ A + (1 - Φ¹) B,   λ² = Φ² A + (1 - Φ²) B                                          [B] 7
//! ```
//! with a fresh Φ, uniform in [0, 1], for each component of each offspring. One generation:
//! 1. the first has S random strings; later ones the K best of the last, K offspring of these and M new random ones;
//! 2. those that are new are evaluated; parents keep the costs that they have;
//! 3. all S are ranked: feasible ones first, see [`Fitness::compare`];
//! 4. the K best mate in ranked pairs, first with second, third with fourth and so on, two offspring each;
//! 5. the others are dropped.
//!
//! After every `rescale_every` generations the box from which new strings are drawn is centered on the best string and
//! its edges are `shrink` times as long; what sticks out of the original box is cut off. Offspring lie between parents
//! and need no bounds.
//!
//! # Source
//! T. I. Zohdi, Proc. R. Soc. Lond. A 460, 3421 (2004), section 7, steps 1-6, and section 8 for S = 20, K = 6, M = 8 and
//! four generations between rescalings. How much the box shrinks is not published.
//!
//! # Symbols
//! | symbol | name in code | unit | meaning                                    |
//! |--------|--------------|------|--------------------------------------------|
//! | S      | `population` | 1    | strings in a generation                    |
//! | K      | `parents`    | 1    | best strings kept                          |
//! |        | `offspring`  | 1    | of these; as many as parents in [B]        |
//! | M      | S - 2 K      | 1    | new random strings                         |
//! | A, B   | `Point`      | 1    | parameters as parts of their ranges        |
//!
//! # Valid when
//! The costs carry little noise: a parent that was lucky once keeps its rank until it is beaten.
//!
//! # Compared with others
//! Step 4 can be read as pairs 1-2, 2-3, 3-4 or as all 20 strings mating; section 8, "six new offspring were produced from
//! the top six parents", says that three pairs mate, and each parent has its turn with 1-2, 3-4, 5-6.
//!
//! # In a campaign
//! ```toml
//! [method.published_genetic]
//! population = 20
//! parents = 6
//! offspring = 6
//! generations = 25
//! ```
//!
//! # Example
//! ```
//! use agglo::search::optimizer::{Optimizer, PublishedGenetic};
//! let mut search = PublishedGenetic::default().start(10, 1);
//! assert_eq!(search.ask().len(), 20);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Candidate, Fault, Optimizer, Part, Point, candidates, stream, uniform_point};
use crate::math::rng::Stream;
use crate::search::Fitness;

/// The genetic algorithm of [B] 7.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct PublishedGenetic {
    /// Strings in a generation; parents, offspring and at least 0 new ones.
    pub population: usize,
    /// How many of the best strings are kept; even, at least 2.
    pub parents: usize,
    /// How many offspring they have; even, at most as many as parents.
    pub offspring: usize,
    /// Generations between rescalings of the box; 0: it is never rescaled.
    pub rescale_every: usize,
    /// What the edges of the box are multiplied by at each rescaling; above 0, at most 1.
    pub shrink: f64,
    /// Generations after the first; 0 or more.
    pub generations: usize,
}

impl Default for PublishedGenetic {
    fn default() -> Self {
        Self { population: 20, parents: 6, offspring: 6, rescale_every: 4, shrink: 0.8, generations: 100 }
    }
}

impl PublishedGenetic {
    /// Begins a search over so many parameters.
    pub fn start(&self, dimensions: usize, seed: u64) -> impl Optimizer + use<> {
        Search {
            parameters: self.clone(),
            generation: 0,
            lower: vec![0.0; dimensions],
            upper: vec![1.0; dimensions],
            parents: Vec::new(),
            asked: Vec::new(),
            points: stream(seed, Part::Points),
            weights: stream(seed, Part::Mating),
        }
    }

    pub(super) fn faults(&self) -> Vec<Fault> {
        let mut faults = Vec::new();
        if self.parents < 2 || self.parents % 2 == 1 {
            faults.push(("parents", format!("{} cannot mate in pairs", self.parents)));
        }
        if self.offspring % 2 == 1 || self.offspring > self.parents {
            let message =
                format!("{} are not two for each of {} pairs or fewer", self.offspring, self.parents / 2);
            faults.push(("offspring", message));
        }
        if self.population < self.parents + self.offspring {
            faults.push(("population", "it has no room for the parents and their offspring".into()));
        }
        if !(self.shrink > 0.0 && self.shrink <= 1.0) {
            faults.push(("shrink", format!("{} is not above 0 and at most 1", self.shrink)));
        }
        faults
    }
}

struct Search {
    parameters: PublishedGenetic,
    /// How many are evaluated.
    generation: usize,
    /// The box from which new strings are drawn.
    lower: Point,
    upper: Point,
    /// Best first.
    parents: Vec<Candidate>,
    asked: Vec<Point>,
    points: Stream,
    weights: Stream,
}

impl Search {
    fn new_string(&mut self) -> Point {
        let mut point = uniform_point(&mut self.points, self.lower.len());
        for ((x, lower), upper) in point.iter_mut().zip(&self.lower).zip(&self.upper) {
            *x = lower + *x * (upper - lower);
        }
        point
    }

    fn offspring(&mut self) -> Vec<Point> {
        let Self { parents, weights, parameters, .. } = self;
        let pairs = parents.chunks_exact(2).flat_map(|pair| [pair, pair]);
        let mut mix = |pair: &[Candidate]| {
            let genes = pair[0].point.iter().zip(&pair[1].point);
            genes.map(|(a, b)| b + weights.uniform() * (a - b)).collect()
        };
        pairs.take(parameters.offspring).map(&mut mix).collect()
    }

    fn rescale(&mut self) {
        let Some(best) = self.parents.first() else { return };
        let times = self.generation / self.parameters.rescale_every;
        let half = 0.5 * self.parameters.shrink.powf(times as f64);
        self.lower = best.point.iter().map(|x| (x - half).max(0.0)).collect();
        self.upper = best.point.iter().map(|x| (x + half).min(1.0)).collect();
    }
}

impl Optimizer for Search {
    fn ask(&mut self) -> Vec<Point> {
        let parameters = &self.parameters;
        if self.generation > parameters.generations {
            return Vec::new();
        }
        let kept = if self.generation == 0 { 0 } else { parameters.parents };
        let evaluated = parameters.population - kept;
        self.asked = self.offspring();
        while self.asked.len() < evaluated {
            let point = self.new_string();
            self.asked.push(point);
        }
        self.asked.clone()
    }

    fn tell(&mut self, fitnesses: &[Fitness]) {
        self.parents.extend(candidates(&mut self.asked, fitnesses));
        self.parents.sort_by(|a, b| a.fitness.compare(&b.fitness));
        self.parents.truncate(self.parameters.parents);
        self.generation += 1;
        if self.parameters.rescale_every > 0 && self.generation.is_multiple_of(self.parameters.rescale_every)
        {
            self.rescale();
        }
    }

    fn recommended(&self) -> Option<Point> {
        self.parents.first().map(|best| best.point.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::functions::{Noisy, TestFunction};

    fn generations(noisy: Noisy, count: usize, mut each: impl FnMut(&[Point], &[Fitness], &Search)) {
        let mut search = Search {
            points: stream(3, Part::Points),
            weights: stream(3, Part::Mating),
            generation: 0,
            lower: vec![0.0; 10],
            upper: vec![1.0; 10],
            parents: Vec::new(),
            asked: Vec::new(),
            parameters: PublishedGenetic::default(),
        };
        let mut evaluations = 0;
        for _ in 0..count {
            let points = search.ask();
            let fitnesses: Vec<Fitness> =
                points.iter().zip(evaluations..).map(|(point, n)| noisy.fitness(point, n)).collect();
            evaluations += points.len() as u64;
            search.tell(&fitnesses);
            each(&points, &fitnesses, &search);
        }
    }

    const NOISY: Noisy = Noisy { function: TestFunction::Ackley, sigma: 0.5, seed: 2 };

    /// [B] 7: "the minimization of the cost function is guaranteed to be monotonically decreasing".
    #[test]
    fn best_never_gets_worse() {
        let mut best = f64::INFINITY;
        generations(NOISY, 100, |_, fitnesses, search| {
            let lowest = fitnesses.iter().map(Fitness::cost).fold(best, f64::min);
            assert_eq!(search.parents[0].fitness.cost(), lowest);
            best = lowest;
        });
    }

    #[test]
    fn twenty_then_fourteen_within_the_bounds() {
        let mut counts = Vec::new();
        generations(NOISY, 30, |points, _, _| {
            counts.push(points.len());
            assert_all!(points.iter().flatten(), |x| (0.0..=1.0).contains(x));
        });
        assert_eq!(counts[0], 20);
        assert_all!(counts[1..].iter(), |&count| count == 14);
    }

    #[test]
    fn offspring_lie_between_ranked_neighbors() {
        let mut parents: Vec<Point> = Vec::new();
        generations(NOISY, 30, |points, _, search| {
            for (child, pair) in points.iter().zip(parents.chunks_exact(2).flat_map(|pair| [pair, pair])) {
                for ((x, a), b) in child.iter().zip(&pair[0]).zip(&pair[1]) {
                    assert_between!(*x, a.min(*b)..=a.max(*b));
                }
            }
            parents = search.parents.iter().map(|parent| parent.point.clone()).collect();
        });
    }

    /// After 4, 8, 12 ... generations the box is 0.8, 0.64, 0.512 ... wide where it is not cut.
    #[test]
    fn box_shrinks_about_the_best() {
        let mut generation = 0;
        generations(NOISY, 80, |_, _, search| {
            generation += 1;
            if generation % 4 == 0 {
                let half = 0.5 * 0.8_f64.powf(f64::from(generation / 4));
                let best = &search.parents[0].point;
                for ((lower, upper), x) in search.lower.iter().zip(&search.upper).zip(best) {
                    assert_eq!([*lower, *upper], [(x - half).max(0.0), (x + half).min(1.0)]);
                }
            }
        });
    }
}
