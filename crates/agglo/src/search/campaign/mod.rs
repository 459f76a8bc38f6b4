//! A whole search or study: proposals, random replicates, confirmation of the best, tables and summary in one folder.
//!
//! A campaign is the same to the last bit for any number of threads, and resumed or not. Its optimizer is a function of
//! its seed and of what it was told; decisions look at the replicates in their order; and going on with a campaign means
//! beginning it anew with the replicates that are known from its journal.

mod archive;
mod clock;
mod columns;
mod conduct;
mod confirm;
mod course;
mod error;
mod join;
mod journal;
mod kernels;
mod part;
mod pictures;
mod progress;
mod proposals;
mod records;
mod summary;
mod tables;
mod verbs;
mod watch;

pub use archive::{Evaluation, Stage, Status};
/// The tables of a campaign, with what is told of the columns that all campaigns have.
pub use columns::TABLES;
pub(crate) use columns::is_taken;
pub use conduct::conduct;
pub use course::{Ask, Closing, Course, Polish, Results};
pub use error::CampaignError;
pub use join::join;
pub use kernels::RATES;
pub use part::Part;
pub use pictures::Draw;
pub use progress::{CampaignObserver, CampaignProgress};
pub use summary::{Best, CampaignSummary, FrontPoint, Goal, LimitKept, Named, Noise, Spent};
pub use verbs::{Means, planned, refuse_too_large, resume, run, run_part, way_of};

use std::path::Path;

use crate::folder::CampaignFolder;
use crate::record::door;

/// How a campaign ended without an error.
#[derive(Clone, Debug)]
pub enum CampaignEnding {
    /// It reached its end.
    Finished(Box<CampaignSummary>),
    /// The observer asked to stop; all replicates that ended are kept.
    Interrupted,
}

/// Whether `dir` holds a campaign, and not a run.
pub fn is_one(dir: &Path) -> bool {
    CampaignFolder::holds(dir)
}

/// The summary of the campaign in `dir`, if it has finished.
///
/// The summary is written last, so a campaign without one, or with one that cannot be read, has something left to do.
pub fn finished(dir: &Path) -> Option<CampaignSummary> {
    if !is_one(dir) {
        return None;
    }
    let text = door::read_text(&CampaignFolder::at(dir).summary(), door::MOST_OF_A_TEXT).ok()?;
    serde_json::from_str(&text).ok()
}

#[cfg(test)]
mod saving_tests;
#[cfg(test)]
mod tests;
