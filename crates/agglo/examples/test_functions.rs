//! How well the optimizers do: 2,000 evaluations of test functions in 10 dimensions, with and without noise.
//!
//! `cargo run --release -p agglo --example test_functions -- 20` prints, for each method and function, the median over 20
//! seeds of the noise-free value at the point recommended. All lowest values are 0.

#![allow(clippy::print_stdout, reason = "it is a program")]

use std::error::Error;

use agglo::math::rng::{Purpose, Stream};
use agglo::search::Fitness;
use agglo::search::functions::{Noisy, TestFunction, minimize};
use agglo::search::optimizer::{CmaEs, Genetic, Method, NelderMead, PublishedGenetic, Random, Sobol};

const DIMENSIONS: usize = 10;
const EVALUATIONS: usize = 2000;

/// Functions with the standard deviation of their noise.
const FUNCTIONS: [(TestFunction, f64); 5] = [
    (TestFunction::Rastrigin, 2.0),
    (TestFunction::Ackley, 0.5),
    (TestFunction::Griewank, 0.2),
    (TestFunction::Sphere, 0.5),
    (TestFunction::Rosenbrock, 5.0),
];

/// A row of the table: what it is called, the method under a seed, and whether it is told how large the noise is.
type Row = (&'static str, fn(u64) -> Method, bool);

const ROWS: [Row; 7] = [
    ("cma_es", cma_es, true),
    ("cma_es, noise not told", cma_es, false),
    (
        "genetic",
        |_| Method::Genetic(Genetic { generations: EVALUATIONS / 40 - 1, ..Default::default() }),
        true,
    ),
    ("published_genetic", published_genetic, true),
    ("nelder_mead, from anywhere", nelder_mead, false),
    ("sobol", |_| Method::Sobol(Sobol { points: EVALUATIONS }), true),
    ("random", |_| Method::Random(Random { points: EVALUATIONS }), true),
];

fn cma_es(_: u64) -> Method {
    Method::CmaEs(CmaEs { evaluations: EVALUATIONS, ..Default::default() })
}

fn published_genetic(_: u64) -> Method {
    let generations = (EVALUATIONS - 20) / 14;
    Method::PublishedGenetic(PublishedGenetic { generations, ..Default::default() })
}

/// Its default start, the middle, is the lowest point of most of these functions.
fn nelder_mead(seed: u64) -> Method {
    let mut stream = Stream::new(seed, Purpose::Sampling, 1);
    let start = (0..DIMENSIONS).map(|_| stream.uniform()).collect();
    Method::NelderMead(NelderMead { evaluations: EVALUATIONS, start, ..Default::default() })
}

fn value(row: &Row, noisy: Noisy) -> f64 {
    let (_, method, told) = row;
    let Some(mut search) = method(noisy.seed).start(DIMENSIONS, 1, noisy.seed) else { return f64::NAN };
    let recommended = minimize(search.as_mut(), EVALUATIONS as u64, |point, number| {
        let fitness = noisy.fitness(point, number);
        if *told { fitness } else { Fitness::new(fitness.costs) }
    });
    recommended.map_or(f64::NAN, |point| noisy.function.at(&point))
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    0.5 * (values[(values.len() - 1) / 2] + values[values.len() / 2])
}

fn main() -> Result<(), Box<dyn Error>> {
    let seeds: u64 = std::env::args().nth(1).map_or(Ok(20), |seeds| seeds.parse())?;
    print!("{:28}", "noise, standard deviation");
    for (function, sigma) in FUNCTIONS {
        print!(" {:>12} {sigma:3} {:>8}", function.name(), 0);
    }
    println!();
    for row in &ROWS {
        print!("{:28}", row.0);
        for (function, sigma) in FUNCTIONS {
            let over_seeds = |sigma| {
                median((0..seeds.max(1)).map(|seed| value(row, Noisy { function, sigma, seed })).collect())
            };
            print!(" {:>16.3} {:>8.2e}", over_seeds(sigma), over_seeds(0.0));
        }
        println!();
    }
    Ok(())
}
