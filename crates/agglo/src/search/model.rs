//! What a campaign evaluates: something that gives quantities for a candidate and a seed.

use std::sync::atomic::AtomicBool;

use super::Fitness;

/// A point of the unit cube and what it stands for.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// The point, one coordinate in [0, 1] for each parameter.
    pub point: Vec<f64>,
    /// The values of the parameters: SI units; the number of a choice in its list, from 0.
    pub values: Vec<f64>,
    /// By how much it misses the constraints between parameters; 0 if it keeps them.
    pub violation: f64,
}

/// Why a replicate gave no quantities.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Trouble {
    /// It failed: the reason.
    Failed(String),
    /// It was asked to stop.
    Stopped,
}

/// Something that gives quantities for a candidate and a seed.
pub trait Model: Sync {
    /// What is worked out once for a candidate.
    type Prepared: Send + Sync;

    /// Names of the quantities, with their units: `growth_deficit`, `temperature_mean_K`.
    fn columns(&self) -> &[String];

    /// Those of them that tables, summaries and pages show, which come first.
    fn shown(&self) -> &[String] {
        self.columns()
    }

    /// What a point stands for.
    fn candidate(&self, point: &[f64]) -> Candidate;

    /// Works out what all replicates of a candidate share.
    ///
    /// # Errors
    /// Why the candidate cannot be run.
    fn prepare(&self, candidate: &Candidate) -> Result<Self::Prepared, String>;

    /// The quantities of one replicate, one for each column.
    ///
    /// # Errors
    /// [`Trouble`].
    fn run(&self, prepared: &Self::Prepared, seed: u64, stop: &AtomicBool) -> Result<Vec<f64>, Trouble>;

    /// The costs of one replicate from its quantities; one for each objective.
    fn costs(&self, candidate: &Candidate, quantities: &[f64]) -> Vec<f64>;

    /// How good a candidate is by the quantities of its replicates.
    fn fitness(&self, candidate: &Candidate, replicates: &[Vec<f64>]) -> Fitness;
}
