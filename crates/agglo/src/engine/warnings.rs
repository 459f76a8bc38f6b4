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
        if let Some(count) = self.counts.get_mut(text) {
            *count += 1;
        } else {
            self.counts.insert(text.to_owned(), 1);
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
