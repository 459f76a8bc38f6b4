//! Functions with a known lowest point, to try optimizers on; with noise if wanted.
//!
//! # Equation
//! ```text
//! sphere      f = Σ x_i²                                                          |x_i| <= 5.12
//! Rosenbrock  f = Σ 100 (x_(i+1) - x_i²)² + (1 - x_i)²                            -5 <= x_i <= 10
//! Rastrigin   f = Σ x_i² + 10 (1 - cos 2π x_i)                                    |x_i| <= 5.12
//! Ackley      f = 20 (1 - exp(-0.2 √(Σ x_i²/d))) + e - exp(Σ cos(2π x_i)/d)       |x_i| <= 32.768
//! Griewank    f = 1 + Σ x_i²/4000 - Π cos(x_i/√i)                                 |x_i| <= 600
//! ```
//! All are 0 at their lowest point: x_i = 1 for Rosenbrock's, x_i = 0 for the others.
//!
//! # Source
//! D. H. Ackley, *A Connectionist Machine for Genetic Hillclimbing* (1987); A. O. Griewank, J. Optim. Theory Appl. 34,
//! 11 (1981); L. A. Rastrigin, *Systems of Extremal Control* (1974); H. H. Rosenbrock, Comput. J. 3, 175 (1960).
//!
//! # Example
//! ```
//! use agglo::search::functions::TestFunction;
//! let x = [0.5, -1.0];
//! assert!((TestFunction::Rastrigin.value(&x) - (0.25 + 20.0 + 1.0)).abs() < 1e-12);
//! ```

use std::f64::consts::{E, TAU};

use super::Fitness;
use super::optimizer::{Optimizer, Point};
use crate::math::rng::{Purpose, Stream};

/// A function to try optimizers on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TestFunction {
    /// One round bowl.
    Sphere,
    /// One long, bent valley.
    Rosenbrock,
    /// A bowl with 11 local lowest points in each direction.
    Rastrigin,
    /// A plain with small pits around a funnel.
    Ackley,
    /// A wide bowl with small ripples.
    Griewank,
}

impl TestFunction {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::Sphere, Self::Rosenbrock, Self::Rastrigin, Self::Ackley, Self::Griewank];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sphere => "sphere",
            Self::Rosenbrock => "Rosenbrock",
            Self::Rastrigin => "Rastrigin",
            Self::Ackley => "Ackley",
            Self::Griewank => "Griewank",
        }
    }

    /// Lower and upper bound of every coordinate.
    pub fn bounds(self) -> (f64, f64) {
        match self {
            Self::Sphere | Self::Rastrigin => (-5.12, 5.12),
            Self::Rosenbrock => (-5.0, 10.0),
            Self::Ackley => (-32.768, 32.768),
            Self::Griewank => (-600.0, 600.0),
        }
    }

    /// Every coordinate of its lowest point.
    pub fn optimum(self) -> f64 {
        if self == Self::Rosenbrock { 1.0 } else { 0.0 }
    }

    /// Its value at `x` `[d]`.
    pub fn value(self, x: &[f64]) -> f64 {
        let squares = || x.iter().map(|x| x * x).sum::<f64>();
        match self {
            Self::Sphere => squares(),
            Self::Rosenbrock => x.windows(2).map(rosenbrock).sum(),
            Self::Rastrigin => x.iter().map(|x| x * x + 10.0 * (1.0 - (TAU * x).cos())).sum(),
            Self::Ackley => {
                let dimensions = x.len() as f64;
                let ripples = x.iter().map(|x| (TAU * x).cos()).sum::<f64>() / dimensions;
                20.0 * (1.0 - (-0.2 * (squares() / dimensions).sqrt()).exp()) + E - ripples.exp()
            }
            Self::Griewank => {
                let ripple = |(i, x): (usize, &f64)| (x / ((i + 1) as f64).sqrt()).cos();
                1.0 + squares() / 4000.0 - x.iter().enumerate().map(ripple).product::<f64>()
            }
        }
    }

    /// Its value at a point of the unit cube that spans its bounds.
    pub fn at(self, point: &[f64]) -> f64 {
        let (lower, upper) = self.bounds();
        let x: Point = point.iter().map(|u| lower + u * (upper - lower)).collect();
        self.value(&x)
    }
}

fn rosenbrock(pair: &[f64]) -> f64 {
    100.0 * (pair[1] - pair[0] * pair[0]).powi(2) + (1.0 - pair[0]).powi(2)
}

/// A function with normally distributed noise on top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noisy {
    /// What lies below.
    pub function: TestFunction,
    /// Standard deviation of the noise.
    pub sigma: f64,
    /// Seed of the noise.
    pub seed: u64,
}

impl Noisy {
    /// What evaluation number `evaluation` finds at a point of the unit cube.
    pub fn fitness(&self, point: &[f64], evaluation: u64) -> Fitness {
        let value = self.function.at(point);
        if self.sigma == 0.0 {
            return Fitness::new(vec![value]);
        }
        let mut noise = Stream::new(self.seed, Purpose::Sampling, 0);
        noise.jump_to(evaluation);
        let cost = value + self.sigma * noise.normal();
        Fitness { standard_errors: vec![self.sigma], ..Fitness::new(vec![cost]) }
    }
}

/// Lets an optimizer search until it is done or `most` points are evaluated; `evaluate` gets a point and its number.
///
/// Gives the point that it recommends.
pub fn minimize(
    optimizer: &mut dyn Optimizer,
    most: u64,
    mut evaluate: impl FnMut(&[f64], u64) -> Fitness,
) -> Option<Point> {
    let mut evaluations = 0;
    loop {
        let points = optimizer.ask();
        if points.is_empty() || evaluations + points.len() as u64 > most {
            return optimizer.recommended();
        }
        let fitnesses: Vec<Fitness> =
            (evaluations..).zip(&points).map(|(n, point)| evaluate(point, n)).collect();
        evaluations += points.len() as u64;
        optimizer.tell(&fitnesses);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lowest_points_are_zero_and_lowest() {
        for function in TestFunction::ALL {
            let at = |shift| function.value(&[function.optimum() + shift; 10]);
            // Round-off of sums of ten terms of up to e^1 and of 20.
            assert!(at(0.0).abs() < 1e-14, "{function:?} {}", at(0.0));
            assert_above!(at(1e-3), 1e-6);
            assert_above!(at(-1e-3), 1e-6);
            let (lower, upper) = function.bounds();
            let in_cube = (function.optimum() - lower) / (upper - lower);
            assert_below!(function.at(&[in_cube; 10]).abs(), 1e-10);
        }
    }

    /// By hand.
    #[test]
    fn values_elsewhere() {
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * b, "{a} {b}");
        near(TestFunction::Sphere.value(&[1.0, 2.0, 3.0]), 14.0);
        near(TestFunction::Rosenbrock.value(&[0.0, 2.0, 1.0]), 401.0 + 901.0);
        near(TestFunction::Rastrigin.value(&[0.5, 0.25]), 20.25 + 10.0625);
        let expected = 20.0 * (1.0 - (-0.2 * 2.5_f64.sqrt()).exp()) + E - 1.0_f64.exp();
        near(TestFunction::Ackley.value(&[1.0, 2.0]), expected);
        near(TestFunction::Griewank.value(&[0.0, 20.0]), 1.1 - (20.0 / 2.0_f64.sqrt()).cos());
    }

    /// The mean of 10,000 deviates is within five standard errors, their variance within five of its own.
    #[test]
    fn noise_belongs_to_the_number() {
        let noisy = Noisy { function: TestFunction::Sphere, sigma: 2.0, seed: 3 };
        let cost = |n| noisy.fitness(&[0.5, 0.5], n).cost();
        assert_eq!(cost(7), cost(7));
        let count = 10_000;
        let mean = (0..count).map(cost).sum::<f64>() / count as f64;
        let variance = (0..count).map(|n| cost(n).powi(2)).sum::<f64>() / count as f64;
        assert_below!(mean.abs(), 5.0 * 2.0 / 100.0);
        assert_close!(variance, 4.0, 5.0 * 2.0_f64.sqrt() / 100.0);
    }
}
