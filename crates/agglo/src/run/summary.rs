//! What a run came to, in one table and one file.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::scenario::readable;

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
        // A struct of numbers and strings always has a text; numbers that are not finite become null.
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
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
            Self::Hard(summary) => &summary.version,
        }
    }

    /// The summary as rows of a table: what, how much.
    pub fn table(&self) -> Vec<(String, String)> {
        match self {
            Self::Soft(summary) => summary.table(),
            Self::Hard(summary) => summary.table(),
        }
    }
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
