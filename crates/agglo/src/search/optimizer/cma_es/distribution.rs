//! The normal distribution that CMA-ES draws from, and how it learns; numbers are those of the tutorial's appendix A.

use crate::math::rng::Stream;
use crate::search::optimizer::eigen;

/// Constants that belong to a population and a number of dimensions: the tutorial's table 1.
#[derive(Clone, Debug)]
pub(super) struct Rates {
    /// Of the ranked points, best first; the worse half has weights below 0.
    pub weights: Vec<f64>,
    /// μ_eff: how many equally weighted parents would have the same variance.
    pub effective_parents: f64,
    path_sigma: f64,
    damping: f64,
    path: f64,
    rank_one: f64,
    rank_mu: f64,
}

impl Rates {
    pub fn new(population: usize, dimensions: usize) -> Self {
        let n = dimensions as f64;
        let half = (0.5 * (population as f64 + 1.0)).ln();
        let mut weights: Vec<f64> = (1..=population).map(|rank| half - (rank as f64).ln()).collect();
        let parents = population / 2;
        let effective = |part: &[f64]| {
            let (sum, squares) = part.iter().fold((0.0, 0.0), |(sum, squares), w| (sum + w, squares + w * w));
            sum * sum / squares
        };
        let mu = effective(&weights[..parents]);
        let mu_negative = effective(&weights[parents..]);
        let rank_one = 2.0 / ((n + 1.3).powi(2) + mu);
        let rank_mu = (1.0 - rank_one).min(2.0 * (0.25 + mu + 1.0 / mu - 2.0) / ((n + 2.0).powi(2) + mu));
        // Equations (50) to (53): negative weights must leave the covariance positive definite.
        let negative_sum = (1.0 + rank_one / rank_mu)
            .min(1.0 + 2.0 * mu_negative / (mu + 2.0))
            .min((1.0 - rank_one - rank_mu) / (n * rank_mu));
        let positive: f64 = weights.iter().filter(|w| **w > 0.0).sum();
        let negative: f64 = weights.iter().filter(|w| **w < 0.0).sum();
        for w in &mut weights {
            *w *= if *w >= 0.0 { 1.0 / positive } else { -negative_sum / negative };
        }
        let path_sigma = (mu + 2.0) / (n + mu + 5.0);
        Self {
            weights,
            effective_parents: mu,
            path_sigma,
            damping: 1.0 + 2.0 * (((mu - 1.0) / (n + 1.0)).sqrt() - 1.0).max(0.0) + path_sigma,
            path: (4.0 + mu / n) / (n + 4.0 + 2.0 * mu / n),
            rank_one,
            rank_mu,
        }
    }
}

/// A point drawn: x = mean + σ step, step = B D deviate.
#[derive(Clone, Debug)]
pub(super) struct Draw {
    pub step: Vec<f64>,
    /// Squared length of the deviate.
    square: f64,
}

/// Mean, step size and covariance, with the paths that they learn from.
#[derive(Clone, Debug)]
pub(super) struct Distribution {
    pub mean: Vec<f64>,
    pub sigma: f64,
    /// C `[d, d]`.
    covariance: Vec<f64>,
    /// B `[d, d]`: eigenvectors of C, one a column.
    basis: Vec<f64>,
    /// D `[d]`: roots of the eigenvalues of C.
    pub scales: Vec<f64>,
    path_sigma: Vec<f64>,
    path: Vec<f64>,
    generation: i32,
    /// Room for the eigenvalue problem.
    work: Vec<f64>,
}

impl Distribution {
    /// A round one.
    pub fn new(mean: Vec<f64>, sigma: f64) -> Self {
        let d = mean.len();
        Self {
            mean,
            sigma,
            covariance: eigen::identity(d),
            basis: eigen::identity(d),
            scales: vec![1.0; d],
            path_sigma: vec![0.0; d],
            path: vec![0.0; d],
            generation: 0,
            work: vec![0.0; d * d],
        }
    }

    /// Draws a step: equations (38) and (39).
    pub fn draw(&self, stream: &mut Stream) -> Draw {
        let mut step = vec![0.0; self.mean.len()];
        let mut square = 0.0;
        for (k, scale) in self.scales.iter().enumerate() {
            let deviate = stream.normal();
            square += deviate * deviate;
            for (entry, row) in step.iter_mut().zip(self.basis.chunks_exact(self.mean.len())) {
                *entry += row[k] * scale * deviate;
            }
        }
        Draw { step, square }
    }

    /// The coordinates of what was drawn: equation (40).
    pub fn point(&self, draw: &Draw) -> impl Iterator<Item = f64> {
        self.mean.iter().zip(&draw.step).map(|(m, y)| m + self.sigma * y)
    }

    /// Learns from the draws, ranked best first: equations (41) to (47).
    pub fn learn(&mut self, ranked: &[&Draw], rates: &Rates) {
        let n = self.mean.len() as f64;
        let mut mean_step = vec![0.0; self.mean.len()];
        for (draw, weight) in ranked.iter().zip(&rates.weights).filter(|(_, weight)| **weight > 0.0) {
            mean_step.iter_mut().zip(&draw.step).for_each(|(sum, y)| *sum += weight * y);
        }
        self.mean.iter_mut().zip(&mean_step).for_each(|(m, y)| *m += self.sigma * y);
        let whitened = self.whitened(&mean_step);
        advance(&mut self.path_sigma, &whitened, rates.path_sigma, rates.effective_parents);
        let length = norm(&self.path_sigma);
        let expected = n.sqrt() * (1.0 - 0.25 / n + 1.0 / (21.0 * n * n));
        self.generation += 1;
        let settled = (1.0 - (1.0 - rates.path_sigma).powi(2 * self.generation)).sqrt();
        let stalled = length / settled >= (1.4 + 2.0 / (n + 1.0)) * expected;
        if stalled {
            self.path.iter_mut().for_each(|p| *p *= 1.0 - rates.path);
        } else {
            advance(&mut self.path, &mean_step, rates.path, rates.effective_parents);
        }
        self.sigma *= ((rates.path_sigma / rates.damping) * (length / expected - 1.0)).min(1.0).exp();
        self.adapt(ranked, rates, stalled);
    }

    /// The covariance: equation (47).
    fn adapt(&mut self, ranked: &[&Draw], rates: &Rates, stalled: bool) {
        let d = self.mean.len();
        let forgiven = if stalled { rates.rank_one * rates.path * (2.0 - rates.path) } else { 0.0 };
        let kept = 1.0 + forgiven - rates.rank_one - rates.rank_mu * rates.weights.iter().sum::<f64>();
        self.covariance.iter_mut().for_each(|c| *c *= kept);
        add_outer(&mut self.covariance, &self.path, rates.rank_one);
        for (draw, weight) in ranked.iter().zip(&rates.weights) {
            let scale = if *weight < 0.0 { d as f64 / draw.square } else { 1.0 };
            add_outer(&mut self.covariance, &draw.step, rates.rank_mu * weight * scale);
        }
        self.decompose();
    }

    /// B and D from C: the old basis nearly diagonalizes the new C, so few rotations are needed.
    fn decompose(&mut self) {
        let d = self.mean.len();
        let Self { covariance, basis, work, .. } = self;
        let mut image = vec![0.0; d];
        for k in 0..d {
            for (entry, row) in image.iter_mut().zip(covariance.chunks_exact(d)) {
                *entry = row.iter().zip(basis.chunks_exact(d)).map(|(c, b)| c * b[k]).sum();
            }
            for l in 0..d {
                work[l * d + k] = image.iter().zip(basis.chunks_exact(d)).map(|(y, b)| y * b[l]).sum();
            }
        }
        eigen::diagonalize(work, basis, d);
        for (k, scale) in self.scales.iter_mut().enumerate() {
            *scale = work[k * d + k].max(0.0).sqrt();
        }
    }

    /// C^(-1/2) y.
    fn whitened(&self, y: &[f64]) -> Vec<f64> {
        let d = y.len();
        let mut sum = vec![0.0; d];
        for (k, scale) in self.scales.iter().enumerate() {
            let along: f64 = y.iter().zip(self.basis.chunks_exact(d)).map(|(y, row)| y * row[k]).sum();
            let part = if *scale > 0.0 { along / scale } else { 0.0 };
            sum.iter_mut().zip(self.basis.chunks_exact(d)).for_each(|(sum, row)| *sum += part * row[k]);
        }
        sum
    }

    /// Largest standard deviation of a coordinate.
    pub fn widest(&self) -> f64 {
        let d = self.mean.len();
        self.sigma * self.covariance.iter().step_by(d + 1).fold(0.0_f64, |most, c| most.max(*c)).sqrt()
    }

    /// Ratio of the largest to the smallest eigenvalue of C.
    pub fn condition(&self) -> f64 {
        let (least, most) =
            self.scales.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), s| (a.min(*s), b.max(*s)));
        (most / least).powi(2)
    }
}

/// p <- (1 - c) p + √(c (2 - c) μ_eff) y.
fn advance(path: &mut [f64], y: &[f64], rate: f64, effective_parents: f64) {
    let gain = (rate * (2.0 - rate) * effective_parents).sqrt();
    path.iter_mut().zip(y).for_each(|(p, y)| *p = (1.0 - rate) * *p + gain * y);
}

fn add_outer(matrix: &mut [f64], y: &[f64], factor: f64) {
    for (row, a) in matrix.chunks_exact_mut(y.len()).zip(y) {
        row.iter_mut().zip(y).for_each(|(entry, b)| *entry += factor * (a * b));
    }
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[cfg(test)]
#[path = "distribution_tests.rs"]
mod tests;
