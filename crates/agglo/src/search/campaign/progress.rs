//! What an observer is told while a campaign goes on.

use std::ops::ControlFlow;

use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use super::Stage;

/// What an observer is told while a campaign goes on, about ten times a second.
#[derive(Clone, Debug)]
pub struct CampaignProgress {
    /// What is to be small or large, of the best candidate so far, and its standard error.
    pub best: Option<(f64, f64)>,
    /// Whether there is something to be small or large.
    pub has_goal: bool,
    /// What happens now.
    pub stage: Stage,
    /// Candidates that were evaluated so far.
    pub evaluations: u64,
    /// Candidates that there will be at most, if that is known.
    pub evaluations_at_most: Option<u64>,
    /// Batches that were evaluated so far.
    pub generations: u64,
    /// Simulations that ended in this session.
    pub replicates: u64,
    /// Simulations in a second of this session.
    pub replicates_per_second: f64,
    /// Candidates that failed so far.
    pub failures: u64,
    /// Wall time that is left [s], if that can be said.
    pub left_s: Option<f64>,
    /// Warnings that came up since the last call.
    pub warnings: Vec<String>,
}

/// As programs are told of it; warnings are told apart.
impl Serialize for CampaignProgress {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("stage", self.stage.word())?;
        map.serialize_entry("evaluations", &self.evaluations)?;
        map.serialize_entry("evaluations_at_most", &self.evaluations_at_most)?;
        map.serialize_entry("batches", &self.generations)?;
        map.serialize_entry("failures", &self.failures)?;
        map.serialize_entry("runs", &self.replicates)?;
        map.serialize_entry("runs_per_s", &self.replicates_per_second)?;
        map.serialize_entry("best", &self.best.map(|(best, _)| best))?;
        map.serialize_entry("best_standard_error", &self.best.map(|(_, error)| error))?;
        map.serialize_entry("left_s", &self.left_s)?;
        map.end()
    }
}

/// Someone who is told of the progress and may ask to stop.
pub type CampaignObserver<'a> = dyn FnMut(&CampaignProgress) -> ControlFlow<()> + Send + 'a;
