//! What share of the outcome's variance each parameter has.
//!
//! # Equation
//! ```text
//! S_i  = 1 - mean((y(B) - y(A_B^(i)))²)/(2 V),   S_Ti = mean((y(A) - y(A_B^(i)))²)/(2 V)           (SA4)
//! ```
//! V is the variance of y over all points of A and B (SA2).
//!
//! # Source
//! M. J. W. Jansen, *Analysis of variance designs for model output*, Comput. Phys. Commun. 117, 35 (1999), as
//! recommended by A. Saltelli et al., Comput. Phys. Commun. 181, 259 (2010), table 2.
//!
//! # Symbols
//! | symbol | name in code | unit            | meaning                                                      |
//! |--------|--------------|-----------------|--------------------------------------------------------------|
//! | S_i    | `first`      |                 | share of the parameter alone                                 |
//! | S_Ti   | `total`      |                 | share of all that it takes part in                           |
//! | V      | `variance`   | the outcome's ² | variance of the outcome when all parameters vary             |
//!
//! # Valid when
//! Parameters vary independently and uniformly in the unit cube. Noise of the random replicates adds to V and to every S_T and
//! lowers every S; `noise_share` says by how much at most. With common random numbers a part of it cancels.
//! Intervals take base points as independent; those of a Sobol' sequence are more even, so the intervals are too wide.
//! An outcome that does not vary beyond round-off has no variance to share out, and a single block tells none: all shares
//! are then not numbers.
//!
//! # Compared with others
//! SALib's first-order index is Saltelli's, this one is Jansen's; its total index is the same as here.
//!
//! # Example
//! ```
//! use agglo::search::analysis::variance_shares;
//! use agglo::search::{Plan, SobolIndices};
//! let plan = SobolIndices { samples: 4096, ..SobolIndices::default() };
//! let points = Plan::SobolIndices(plan).points(&[None, None], 1);
//! // y = 2 a + b: variances 4/12 and 1/12, so shares of 0.8 and 0.2.
//! let outcomes: Vec<_> = points.iter().map(|point| Some([2.0 * point[0] + point[1], 0.0])).collect();
//! let shares = variance_shares(2, &outcomes, plan.bootstraps, plan.level, 1);
//! assert!((shares.parameters[0].total - 0.8).abs() < 0.03 && (shares.parameters[1].first - 0.2).abs() < 0.03);
//! ```

use super::varies;
use crate::math::rng::{Purpose, Stream};

/// Shares of one parameter in the variance; not numbers where there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// Of the parameter alone.
    pub first: f64,
    /// Ends of its confidence interval.
    pub first_interval: [f64; 2],
    /// Of all that it takes part in.
    pub total: f64,
    /// Ends of its confidence interval.
    pub total_interval: [f64; 2],
}

/// Shares of all parameters in the variance.
#[derive(Clone, Debug, PartialEq)]
pub struct VarianceShares {
    /// For each parameter.
    pub parameters: Vec<Share>,
    /// Mean of the outcome; not a number without blocks.
    pub mean: f64,
    /// Its variance when all parameters vary: 0 where round-off is all; not a number with fewer than two blocks.
    pub variance: f64,
    /// Mean square of the outcomes' standard errors, as a part of the variance; not a number where either is not known.
    pub noise_share: f64,
    /// Blocks without a failure, which alone are used.
    pub blocks: usize,
}

/// Shares of `dimensions` parameters from the outcome's mean and standard error at each point of the plan (`[n]`, in its
/// order; none for those that failed; an error that is not known is not a number), with confidence intervals from `bootstraps` draws of the blocks with repetition.
pub fn variance_shares(
    dimensions: usize,
    outcomes: &[Option<[f64; 2]>],
    bootstraps: u32,
    level: f64,
    seed: u64,
) -> VarianceShares {
    let whole = outcomes.chunks_exact(dimensions + 2).filter(|block| block.iter().all(Option::is_some));
    let blocks: Vec<Vec<[f64; 2]>> = whole.map(|block| block.iter().flatten().copied().collect()).collect();
    let terms: Vec<Vec<f64>> = blocks.iter().map(|block| terms(block)).collect();
    let every: Vec<usize> = (0..blocks.len()).collect();
    let all = shares(&terms, &every, dimensions);
    if blocks.len() < 2 || !varies(terms.iter().flat_map(|block| [block[0], block[1]])) {
        return without_variance(dimensions, all.mean, blocks.len());
    }
    let mut draws = Vec::with_capacity(bootstraps as usize);
    let mut stream = Stream::new(seed, Purpose::Sampling, BOOTSTRAP);
    for _ in 0..bootstraps {
        let drawn: Vec<usize> =
            every.iter().map(|_| (stream.uniform() * every.len() as f64) as usize).collect();
        draws.push(shares(&terms, &drawn, dimensions).indices);
    }
    let interval = |number: usize| {
        // A draw of one block again and again may have no variance.
        let shown = |draw: &Vec<f64>| Some(draw[number]).filter(|share| share.is_finite());
        let mut values: Vec<f64> = draws.iter().filter_map(shown).collect();
        values.sort_by(f64::total_cmp);
        [0.5 - 0.5 * level, 0.5 + 0.5 * level].map(|part| quantile(&values, part))
    };
    let parameters = (0..dimensions).map(|axis| Share {
        first: all.indices[axis],
        first_interval: interval(axis),
        total: all.indices[dimensions + axis],
        total_interval: interval(dimensions + axis),
    });
    let squares: f64 = blocks.iter().flatten().map(|[_, error]| error * error).sum();
    let outcomes = blocks.len() * (dimensions + 2);
    VarianceShares {
        parameters: parameters.collect(),
        mean: all.mean,
        variance: all.variance,
        noise_share: squares / outcomes as f64 / all.variance,
        blocks: blocks.len(),
    }
}

fn without_variance(dimensions: usize, mean: f64, blocks: usize) -> VarianceShares {
    let none = f64::NAN;
    let share = Share { first: none, first_interval: [none; 2], total: none, total_interval: [none; 2] };
    let variance = if blocks < 2 { none } else { 0.0 };
    VarianceShares { parameters: vec![share; dimensions], mean, variance, noise_share: none, blocks }
}

/// The stream that blocks are drawn from.
const BOOTSTRAP: u32 = 1002;

/// What a block adds to the sums: y(A), y(B), then the halved squares of (SA4), first and total.
fn terms(block: &[[f64; 2]]) -> Vec<f64> {
    let (a, b) = (block[0][0], block[1][0]);
    let halves = |base: f64| block[2..].iter().map(move |[mixed, _]| 0.5 * (base - mixed) * (base - mixed));
    [a, b].into_iter().chain(halves(b)).chain(halves(a)).collect()
}

struct Shares {
    mean: f64,
    variance: f64,
    /// First indices, then total ones.
    indices: Vec<f64>,
}

fn shares(terms: &[Vec<f64>], drawn: &[usize], dimensions: usize) -> Shares {
    let count = drawn.len() as f64;
    let base = |block: &usize| [terms[*block][0], terms[*block][1]];
    let mean = drawn.iter().flat_map(base).sum::<f64>() / (2.0 * count);
    let squares: f64 = drawn.iter().flat_map(base).map(|y| (y - mean) * (y - mean)).sum();
    let variance = squares / (2.0 * count - 1.0);
    let share = |number: usize| {
        let half = drawn.iter().map(|&block| terms[block][2 + number]).sum::<f64>() / count / variance;
        if number < dimensions { 1.0 - half } else { half }
    };
    Shares { mean, variance, indices: (0..2 * dimensions).map(share).collect() }
}

/// Quantile of sorted numbers, linear between neighbors; not a number if there are none.
fn quantile(sorted: &[f64], part: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else { return f64::NAN };
    let place = part * last as f64;
    let below = (place as usize).min(last);
    let above = (below + 1).min(last);
    sorted[below] + (place - below as f64) * (sorted[above] - sorted[below])
}
