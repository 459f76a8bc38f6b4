//! The budget of time: whether a search goes on.
//!
//! The clock is looked at before each few candidates, and what it decides is written into the journal, so that a campaign
//! that is resumed decides the same. Time is kept for what comes after the search: the best are run again, and the run of
//! the best is repeated with frames.

use super::CampaignError;
use super::archive::Archive;
use super::conduct::Stop;
use super::course::Course;
use super::journal::{Journal, Past};
use crate::search::Model;
use crate::search::file::Confirm;
use crate::search::pool::Pool;

/// The budget of time of a campaign.
pub(super) struct Clock<'a> {
    journal: &'a Journal,
    wall_s: &'a dyn Fn() -> f64,
    budget_s: Option<f64>,
    threads: usize,
    /// Replicates that are run after the search.
    afterwards: f64,
    /// Replicates that every candidate gets.
    replicates_at_least: f64,
    /// Replicates that earlier sessions have run.
    replicates_before: u64,
    /// Candidates at which it was decided to go on: the most.
    went_on: Option<u64>,
    /// Candidates at which it was decided to end.
    ended: Option<u64>,
}

impl<'a> Clock<'a> {
    /// With what earlier sessions decided.
    pub fn new(course: &Course<'_>, journal: &'a Journal, past: &Past, wall_s: &'a dyn Fn() -> f64) -> Self {
        let confirm = course.confirm;
        Self {
            journal,
            wall_s,
            budget_s: course.budget_s,
            threads: course.threads.max(1),
            afterwards: replicates_after_the_search(confirm),
            replicates_at_least: f64::from(course.ensemble.least()),
            replicates_before: past.replicates.len() as u64,
            went_on: past.went_on,
            ended: past.ended,
        }
    }

    /// Whether the search was ended for want of time.
    pub fn has_ended(&self) -> bool {
        self.ended.is_some()
    }

    /// How many of the next `wanted` candidates may be evaluated before the clock is looked at again; none if the time is up.
    pub fn allows<M: Model>(
        &mut self,
        archive: &Archive,
        pool: &Pool<'_, M>,
        wanted: usize,
    ) -> Result<usize, Stop> {
        let Some(budget_s) = self.budget_s else { return Ok(wanted) };
        let done = archive.evaluations.len() as u64;
        if let Some(ended) = self.ended {
            return Ok(wanted.min(ended.saturating_sub(done) as usize));
        }
        let count = wanted.min(2 * self.threads);
        if self.went_on.is_some_and(|went_on| done <= went_on) {
            return Ok(count);
        }
        let wall_s = (self.wall_s)();
        let goes_on =
            done == 0 || wall_s + self.still_needed(archive, pool.replicates(), count, wall_s) <= budget_s;
        self.journal.decide(done, goes_on, wall_s).map_err(CampaignError::from)?;
        let kept = if goes_on { &mut self.went_on } else { &mut self.ended };
        *kept = Some(done);
        Ok(if goes_on { count } else { 0 })
    }

    /// Wall time [s] that so many candidates and what follows the search will take, by the replicates so far.
    fn still_needed(&self, archive: &Archive, replicates_now: u64, candidates: usize, wall_s: f64) -> f64 {
        let each = archive.noise().replicates_mean.unwrap_or(self.replicates_at_least);
        let per_replicate = wall_s / (self.replicates_before + replicates_now).max(1) as f64;
        // The run with frames is one replicate on one thread.
        let with_frames = self.threads as f64;
        per_replicate * (candidates as f64 * each + self.afterwards + with_frames)
    }
}

/// Each of the best gets fresh replicates, and where there are several the one that is chosen gets others once more.
fn replicates_after_the_search(confirm: Confirm) -> f64 {
    let again = if confirm.candidates > 1 { confirm.candidates + 1 } else { confirm.candidates };
    f64::from(again) * f64::from(confirm.replicates)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replicates_of_the_confirmation() {
        let replicates = |candidates| replicates_after_the_search(Confirm { candidates, replicates: 10 });
        assert_eq!([0, 1, 2, 6].map(replicates), [0.0, 10.0, 30.0, 70.0]);
    }
}
