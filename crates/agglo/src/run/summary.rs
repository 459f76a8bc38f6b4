//! What a run came to, in one table and one file.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::engine::SimError;
use crate::record::json;
use crate::text::{not_finite, readable};

use super::hard::HardSummary;
use super::soft::SoftSummary;

/// What a run came to; `summary.json` holds the same.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Summary {
    /// Of soft spheres.
    Soft(Box<SoftSummary>),
    /// Of hard spheres.
    Hard(Box<HardSummary>),
}

impl Summary {
    /// The text of `summary.json`.
    pub fn to_json(&self) -> String {
        // A struct of numbers and strings always has a text.
        json(self).unwrap_or_default()
    }

    /// The summary itself, if all its quantities are finite: no other is written or handed on. What is not known is `None`.
    ///
    /// # Errors
    /// [`SimError::QuantityNotFinite`] with the first quantity that is not; `time` [s] is when.
    pub(super) fn validated(self, time: f64) -> Result<Self, SimError> {
        match not_finite(&self) {
            Some(quantity) => Err(SimError::QuantityNotFinite { time, quantity }),
            None => Ok(self),
        }
    }

    /// Warnings, with how often each came up.
    pub fn warnings(&self) -> &BTreeMap<String, u64> {
        match self {
            Self::Soft(summary) => &summary.warnings,
            Self::Hard(summary) => &summary.warnings,
        }
    }

    /// Version of agglo that wrote it.
    pub fn version(&self) -> &str {
        match self {
            Self::Soft(summary) => &summary.version,
            Self::Hard(summary) => &summary.run.version,
        }
    }

    /// The same of a run that had these ends [s] before it went on.
    pub(super) fn that_went_on(mut self, ends_before: &[f64]) -> Self {
        let kept = match &mut self {
            Self::Soft(summary) => &mut summary.went_on_from_s,
            Self::Hard(summary) => &mut summary.run.went_on_from_s,
        };
        ends_before.clone_into(kept);
        self
    }

    /// The summary as rows of a table: what, how much.
    pub fn table(&self) -> Vec<(String, String)> {
        let (mut rows, ends) = match self {
            Self::Soft(summary) => (summary.table(), &summary.went_on_from_s),
            Self::Hard(summary) => (summary.table(), &summary.run.went_on_from_s),
        };
        if !ends.is_empty() {
            // Below the simulated time.
            rows.insert(1, ("went on from".to_owned(), format!("{} (--until)", ends_in_words(ends))));
        }
        rows
    }
}

/// "3 s, then 5 s".
pub(super) fn ends_in_words(ends: &[f64]) -> String {
    ends.iter().map(|end| readable(*end, "s")).collect::<Vec<_>>().join(", then ")
}

/// "2 s in 812 steps".
pub(super) fn time_row(time_s: f64, steps: u64, steps_are: &str) -> String {
    format!("{} in {steps} {steps_are}", readable(time_s, "s"))
}

/// "1.30 s on 2 threads".
pub(super) fn wall_row(wall_s: f64, threads: usize) -> String {
    format!("{wall_s:.2} s on {threads} threads")
}

/// "none", "1 kind, 3 in all".
pub(super) fn warnings_row(warnings: &BTreeMap<String, u64>) -> String {
    let all: u64 = warnings.values().sum();
    match warnings.len() {
        0 => "none".to_owned(),
        1 => format!("1 kind, {all} in all"),
        kinds => format!("{kinds} kinds, {all} in all"),
    }
}
