//! Models whose outcome is known, for tests of what evaluates them.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;

use super::analysis::Moments;
use super::functions::TestFunction;
use super::{Candidate, Fitness, Model, Trouble};
use crate::math::rng::{Purpose, Stream};

/// A function with noise, whose replicates may be slow, fail or make an error.
pub struct Analytic {
    pub function: TestFunction,
    pub sigma: f64,
    /// How long the longest replicate takes.
    pub slowest: Duration,
    /// Replicates fail where the first coordinate is below this.
    pub fails_below: f64,
    /// Replicates make an error where the first coordinate is above this.
    pub panics_above: f64,
    /// Candidates are excluded where the second coordinate is above this.
    pub excluded_above: f64,
    /// Candidates cannot be prepared at all.
    pub is_broken: bool,
    /// Values are whole numbers.
    pub is_whole: bool,
    /// A second cost is the squared distance from this point.
    pub second: Option<[f64; 2]>,
    /// How often it was run.
    pub runs: AtomicU64,
    pub columns: Vec<String>,
}

impl Default for Analytic {
    fn default() -> Self {
        Self {
            function: TestFunction::Sphere,
            sigma: 0.0,
            slowest: Duration::ZERO,
            fails_below: -1.0,
            panics_above: 2.0,
            excluded_above: 2.0,
            is_broken: false,
            is_whole: false,
            second: None,
            runs: AtomicU64::new(0),
            columns: vec!["value".to_owned(), "noise".to_owned()],
        }
    }
}

impl Model for Analytic {
    type Prepared = Candidate;

    fn columns(&self) -> &[String] {
        &self.columns
    }

    fn candidate(&self, point: &[f64]) -> Candidate {
        let (lower, upper) = self.function.bounds();
        let value = |u: &f64| lower + u * (upper - lower);
        let values = point.iter().map(|u| if self.is_whole { value(u).round() } else { value(u) }).collect();
        let violation = point.get(1).map_or(0.0, |x| (x - self.excluded_above).max(0.0));
        Candidate { point: point.to_vec(), values, violation }
    }

    fn prepare(&self, candidate: &Candidate) -> Result<Candidate, String> {
        if self.is_broken {
            Err("there is no scenario, \"really\"".to_owned())
        } else {
            Ok(candidate.clone())
        }
    }

    fn run(&self, candidate: &Candidate, seed: u64, stop: &AtomicBool) -> Result<Vec<f64>, Trouble> {
        self.runs.fetch_add(1, Ordering::Relaxed);
        let mut stream = Stream::new(seed, Purpose::Sampling, 0);
        let noise = self.sigma * stream.normal();
        if !self.slowest.is_zero() {
            std::thread::sleep(self.slowest.mul_f64(stream.uniform()));
        }
        if stop.load(Ordering::Relaxed) {
            return Err(Trouble::Stopped);
        }
        let first = candidate.point[0];
        assert!(first <= self.panics_above, "first is {first}");
        if first < self.fails_below {
            return Err(Trouble::Failed("too low,\nfar \"too\" low".to_owned()));
        }
        Ok(vec![self.function.value(&candidate.values), noise])
    }

    fn costs(&self, candidate: &Candidate, quantities: &[f64]) -> Vec<f64> {
        let away =
            |from: [f64; 2]| candidate.values.iter().zip(from).map(|(x, from)| (x - from).powi(2)).sum();
        std::iter::once(quantities[0] + quantities[1]).chain(self.second.map(away)).collect()
    }

    fn fitness(&self, candidate: &Candidate, replicates: &[Vec<f64>]) -> Fitness {
        let costs: Vec<Vec<f64>> =
            replicates.iter().map(|quantities| self.costs(candidate, quantities)).collect();
        let moments = |which: usize| Moments::of(&costs.iter().map(|costs| costs[which]).collect::<Vec<_>>());
        let all: Vec<Moments> = (0..=usize::from(self.second.is_some())).map(moments).collect();
        let error = |moments: &Moments| if moments.count > 1 { moments.standard_error() } else { 0.0 };
        Fitness {
            costs: all.iter().map(|moments| moments.mean).collect(),
            standard_errors: all.iter().map(error).collect(),
            violation: 0.0,
        }
    }
}
