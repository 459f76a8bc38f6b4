//! Warnings of a run, told once and counted.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// Warnings by their text, with how often each came up.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Warnings {
    counts: BTreeMap<String, u64>,
    #[serde(skip)]
    fresh: Vec<String>,
}

impl Warnings {
    /// Counts a warning; the first time it is also told.
    pub fn add(&mut self, text: &str) {
        self.add_times(text, 1);
    }

    /// Counts a warning that came up several times at once.
    pub fn add_times(&mut self, text: &str, times: u64) {
        if let Some(count) = self.counts.get_mut(text) {
            *count += times;
        } else {
            self.counts.insert(text.to_owned(), times);
            self.fresh.push(text.to_owned());
        }
    }

    /// Those that came up for the first time since the last call.
    pub fn take_fresh(&mut self) -> Vec<String> {
        std::mem::take(&mut self.fresh)
    }

    /// All, with how often each came up.
    pub fn counts(&self) -> &BTreeMap<String, u64> {
        &self.counts
    }
}
