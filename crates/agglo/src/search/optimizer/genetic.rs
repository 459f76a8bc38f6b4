//! Genetic algorithm with simulated binary crossover and polynomial mutation; of two costs it finds the front (NSGA-II).
//!
//! # Equation
//! ```text
//! c_1,2 = ((a + b) ∓ β |b - a|)/2,   p(β) = (η + 1) β^η/2 for β <= 1, (η + 1) β^-(η+2)/2 above     OP2
//! y = x + δ,   p(δ) = (η + 1)(1 - |δ|)^η/2, |δ| <= 1                                              OP3
//! ```
//! each cut at the bounds and normalized again. One generation: parents are winners of tournaments of two; a pair is
//! crossed with `crossover` probability, each of its coordinates with probability 1/2; each coordinate of a child mutates
//! with probability 1/d, and one at least if the child is the copy of a parent. The best of parents and children survive.
//!
//! Better is: feasible, then less violation, then the smaller cost. With two costs it is the earlier front of points that
//! do not dominate one another, then, within a front, the larger crowding distance.
//!
//! # Source
//! K. Deb and R. B. Agrawal, Complex Systems 9, 115 (1995) (crossover); K. Deb and M. Goyal, Comput. Sci. Inform. 26, 30
//! (1996) (mutation); K. Deb, Comput. Methods Appl. Mech. Eng. 186, 311 (2000) (limits); K. Deb, A. Pratap, S. Agarwal
//! and T. Meyarivan, IEEE Trans. Evol. Comput. 6, 182 (2002) (NSGA-II).
//!
//! # Symbols
//! | symbol | name in code                           | unit | meaning                             |
//! |--------|----------------------------------------|------|-------------------------------------|
//! | a, b   | parents                                | 1    | coordinates in the unit cube        |
//! | c      | children                               | 1    |                                     |
//! | η      | `crossover_index`, `mutation_index`    | 1    | the larger, the nearer to parents   |
//! | d      | `dimensions`                           | 1    | parameters                          |
//!
//! # Valid when
//! One or two costs. With noise the best of the population has been lucky; one cost with noise is a case for CMA-ES.
//!
//! # Compared with others
//! Both children keep the same distance to their parents' middle, so that a pair's mean is kept also near bounds; the
//! published code cuts the two sides separately.
//!
//! # In a campaign
//! ```toml
//! [method.genetic]
//! population = 40
//! generations = 50
//! ```
//!
//! # Example
//! ```
//! use agglo::search::Fitness;
//! use agglo::search::functions::minimize;
//! use agglo::search::optimizer::Genetic;
//! // Near to 0 and near to 1 at once: every point between is on the front.
//! let mut search = Genetic { generations: 20, ..Default::default() }.start(1, 2, 1);
//! let costs = |x: f64| Fitness::new(vec![x.powi(2), (1.0 - x).powi(2)]);
//! let knee = minimize(&mut search, 2000, |point, _| costs(point[0])).expect("points were told");
//! assert!((knee[0] - 0.5).abs() < 0.05);
//! ```

mod survival;
mod variation;

use std::cmp::Ordering;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use self::variation::{cross, mutate, mutate_coordinate};
use super::{Candidate, Fault, Optimizer, Part, Point, candidates, stream, uniform_point};
use crate::math::rng::Stream;
use crate::search::Fitness;

/// Genetic algorithm with simulated binary crossover.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Genetic {
    /// Points in a generation; even, at least 4.
    pub population: usize,
    /// Generations after the first; 0 or more.
    pub generations: usize,
    /// Probability that a pair is crossed; 0 to 1.
    pub crossover: f64,
    /// How near children are to their parents; 0 or more.
    pub crossover_index: f64,
    /// How small mutations are; 0 or more.
    pub mutation_index: f64,
}

impl Default for Genetic {
    fn default() -> Self {
        Self { population: 40, generations: 50, crossover: 0.9, crossover_index: 15.0, mutation_index: 20.0 }
    }
}

impl Genetic {
    /// Begins a search over so many parameters for one cost or two.
    pub fn start(&self, dimensions: usize, objectives: usize, seed: u64) -> impl Optimizer + use<> {
        Search {
            parameters: self.clone(),
            dimensions,
            objectives,
            generation: 0,
            parents: Vec::new(),
            asked: Vec::new(),
            points: stream(seed, Part::Points),
            mating: stream(seed, Part::Mating),
        }
    }

    pub(super) fn faults(&self) -> Vec<Fault> {
        let mut faults = Vec::new();
        if self.population < 4 || self.population % 2 == 1 {
            faults.push(("population", format!("{} is not even and at least 4", self.population)));
        }
        if !(0.0..=1.0).contains(&self.crossover) {
            faults.push(("crossover", format!("{} is not a probability, from 0 to 1", self.crossover)));
        }
        for (key, index) in
            [("crossover_index", self.crossover_index), ("mutation_index", self.mutation_index)]
        {
            if !(0.0..=1e3).contains(&index) {
                faults.push((key, format!("{index} is not from 0 to 1000")));
            }
        }
        faults
    }
}

struct Search {
    parameters: Genetic,
    dimensions: usize,
    objectives: usize,
    /// How many are evaluated.
    generation: usize,
    /// Best first.
    parents: Vec<Ranked>,
    asked: Vec<Point>,
    points: Stream,
    mating: Stream,
}

/// A candidate and where it stands.
#[derive(Clone, Debug)]
struct Ranked {
    candidate: Candidate,
    /// Number of its front, the best is 0; with one cost its place.
    front: usize,
    /// Crowding distance; infinite at the ends of a front.
    distance: f64,
}

impl Ranked {
    fn compare(&self, other: &Self) -> Ordering {
        self.front.cmp(&other.front).then(other.distance.total_cmp(&self.distance))
    }
}

impl Search {
    fn winner(&mut self) -> usize {
        let mut draw = || (self.mating.uniform() * self.parents.len() as f64) as usize;
        let (a, b) = (draw(), draw());
        if self.parents[b].compare(&self.parents[a]).is_lt() { b } else { a }
    }

    /// Two children of the winners of two tournaments.
    fn mate(&mut self) -> [Point; 2] {
        let parents = [self.winner(), self.winner()];
        let mut children = parents.map(|parent| self.parents[parent].candidate.point.clone());
        if self.mating.uniform() < self.parameters.crossover {
            cross(&mut children, self.parameters.crossover_index, &mut self.mating);
        }
        for child in &mut children {
            mutate(child, self.parameters.mutation_index, &mut self.mating);
            if parents.iter().any(|parent| self.parents[*parent].candidate.point == *child) {
                let axis = (self.mating.uniform() * child.len() as f64) as usize;
                mutate_coordinate(&mut child[axis], self.parameters.mutation_index, &mut self.mating);
            }
        }
        children
    }
}

impl Optimizer for Search {
    fn ask(&mut self) -> Vec<Point> {
        if self.generation > self.parameters.generations {
            return Vec::new();
        }
        self.asked.clear();
        while self.asked.len() < self.parameters.population {
            if self.generation == 0 {
                self.asked.push(uniform_point(&mut self.points, self.dimensions));
            } else {
                let children = self.mate();
                self.asked.extend(children);
            }
        }
        self.asked.clone()
    }

    fn tell(&mut self, fitnesses: &[Fitness]) {
        let parents = self.parents.drain(..).map(|parent| parent.candidate);
        let all: Vec<Candidate> = parents.chain(candidates(&mut self.asked, fitnesses)).collect();
        let population = self.parameters.population;
        self.parents = if self.objectives == 1 {
            survival::best(all, population)
        } else {
            survival::best_fronts(all, population)
        };
        self.generation += 1;
    }

    /// The best; of a front the point nearest to the lowest of each cost, in units of the front's extent.
    fn recommended(&self) -> Option<Point> {
        let front: Vec<&Candidate> = self
            .parents
            .iter()
            .take_while(|parent| parent.front == 0)
            .map(|parent| &parent.candidate)
            .collect();
        survival::nearest_to_ideal(&front).map(|candidate| candidate.point.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::functions::{Noisy, TestFunction, minimize};

    /// With parents kept the lowest cost never rises, and the bowl's bottom is found.
    #[test]
    fn finds_the_bottom_of_a_bowl() {
        let noisy = Noisy { function: TestFunction::Sphere, sigma: 0.0, seed: 1 };
        let parameters = Genetic { generations: 150, ..Default::default() };
        let mut search = parameters.start(10, 1, 1);
        let best = minimize(&mut search, 10_000, |point, n| {
            assert_all!(point.iter(), |x| (0.0..=1.0).contains(x));
            noisy.fitness(point, n)
        });
        // Random points of as many evaluations have about 15.
        assert_below!(TestFunction::Sphere.at(&best.unwrap()), 1e-3);
    }

    fn search(parameters: Genetic, parents: &[Point]) -> Search {
        let ranked = |(front, point): (usize, &Point)| Ranked {
            candidate: Candidate { point: point.clone(), fitness: Fitness::new(vec![front as f64]) },
            front,
            distance: f64::INFINITY,
        };
        Search {
            dimensions: parents[0].len(),
            objectives: 1,
            generation: 1,
            parents: parents.iter().enumerate().map(ranked).collect(),
            asked: Vec::new(),
            points: stream(1, Part::Points),
            mating: stream(1, Part::Mating),
            parameters,
        }
    }

    /// A thousand coordinates of two parents, 0.1 apart, far from bounds: half of them are crossed, with the mean spread
    /// (η + 1)/2 (1/(η + 2) + 1/η) of the crossover's own index, and one in a thousand mutates, by 1/(η + 2) of the mutation's
    /// own index. The two indices are far apart, so that one taken for the other shows.
    #[test]
    fn each_index_has_its_own_part() {
        let dimensions = 1000;
        let parameters =
            Genetic { crossover: 1.0, crossover_index: 3.0, mutation_index: 80.0, ..Default::default() };
        let parents = [vec![0.45; dimensions], vec![0.55; dimensions]];
        let mut search = search(parameters, &parents);
        let (mut matings, mut crossed, mut spread) = (0, 0, 0.0);
        let (mut mutated, mut change) = (0, 0.0);
        while matings < 300 {
            let [a, b] = search.mate();
            let middle = |k: usize| 0.5 * (a[k] + b[k]) - 0.5;
            // Where one parent won both tournaments there is nothing to cross.
            let is_crossed = a.iter().zip(&b).filter(|(a, b)| (*a - *b).abs() > 1e-9).count() > 100;
            if !is_crossed {
                continue;
            }
            matings += 1;
            for k in 0..dimensions {
                let is_parents = |x: f64| (x - 0.45).abs() < 1e-12 || (x - 0.55).abs() < 1e-12;
                if middle(k).abs() > 1e-12 {
                    // One of the two has moved; both at once in one place of a million.
                    mutated += 1;
                    change += 2.0 * middle(k).abs();
                } else if !(is_parents(a[k]) && is_parents(b[k])) {
                    crossed += 1;
                    spread += (a[k] - b[k]).abs() / 0.1;
                }
            }
        }
        let coordinates = f64::from(matings) * dimensions as f64;
        let (part, mean) = (f64::from(crossed) / coordinates, spread / f64::from(crossed));
        // 300,000 coordinates: 0.1 % of scatter of the part, 5 sigma of 0.6/√150,000 of the spread.
        assert!((part - 0.5).abs() < 0.005, "part crossed: found {part}, expected 0.5");
        let wanted = 2.0 * (1.0 / 5.0 + 1.0 / 3.0);
        assert!((mean - wanted).abs() < 0.008, "mean spread: found {mean}, expected {wanted} of index 3");
        let rate = f64::from(mutated) / f64::from(matings);
        // 600 mutations: 4 % of scatter, of their length too.
        assert!((rate - 2.0).abs() < 0.4, "mutations of a pair: found {rate}, expected 2");
        let length = change / f64::from(mutated);
        let wanted = 1.0 / 82.0;
        assert!(
            (length / wanted - 1.0).abs() < 0.2,
            "length of mutations: found {length}, expected {wanted} of index 80"
        );
    }

    /// Of n parents the winner of a tournament of two is the k-th best with probability ((n - k + 1)² - (n - k)²)/n².
    #[test]
    fn the_better_of_two_mates() {
        let parents: Vec<Point> = (0..4).map(|k| vec![0.1 * f64::from(k)]).collect();
        let mut search = search(Genetic::default(), &parents);
        let mut wins = [0_u32; 4];
        (0..16_000).for_each(|_| wins[search.winner()] += 1);
        for (won, wanted) in wins.into_iter().zip([7000.0, 5000.0, 3000.0, 1000.0]) {
            // Five times the root of the count.
            assert!((f64::from(won) - wanted).abs() < 400.0, "{wins:?} of 16,000, expected 7:5:3:1");
        }
    }

    /// ZDT1 (E. Zitzler, K. Deb, L. Thiele, Evol. Comput. 8, 173 (2000)): f1 = x1, f2 = g (1 - √(f1/g)), g = 1 + 9 mean.
    fn zdt1(point: &[f64]) -> Fitness {
        let g = 1.0 + 9.0 * point[1..].iter().sum::<f64>() / (point.len() - 1) as f64;
        Fitness::new(vec![point[0], g * (1.0 - (point[0] / g).sqrt())])
    }

    /// Area dominated up to (1.1, 1.1): the whole front has 1.21 - 1/3.
    #[test]
    fn covers_the_front_of_zdt1() {
        let parameters = Genetic { population: 100, generations: 250, ..Default::default() };
        let mut search = Search {
            dimensions: 30,
            objectives: 2,
            generation: 0,
            parents: Vec::new(),
            asked: Vec::new(),
            points: stream(1, Part::Points),
            mating: stream(1, Part::Mating),
            parameters,
        };
        minimize(&mut search, 30_000, |point, _| zdt1(point));
        let mut front: Vec<[f64; 2]> = search
            .parents
            .iter()
            .filter(|parent| parent.front == 0)
            .map(|parent| [parent.candidate.fitness.costs[0], parent.candidate.fitness.costs[1]])
            .collect();
        front.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let rights = front.iter().skip(1).map(|next| next[0]).chain([1.1]);
        let area: f64 =
            front.iter().zip(rights).map(|(point, right)| (right - point[0]) * (1.1 - point[1])).sum();
        // A hundred evenly spread points leave steps of 1/2 (1/100)(1) in all; Deb et al. run as many evaluations.
        let whole = 1.21 - 1.0 / 3.0;
        assert!(area < whole && area > whole - 0.012, "{area} of {whole}");
    }
}
