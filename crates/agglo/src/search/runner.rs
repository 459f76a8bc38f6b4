//! Who runs the simulations of a campaign.

use std::fmt;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use super::{Prepared, Trouble, columns};
use crate::run::{self, Ending};
use crate::scenario::Scenario;

/// A simulation of a campaign: a candidate's scenario with the seed of a replicate.
#[derive(Clone, Copy, Debug)]
pub struct Replicate<'a> {
    /// The candidate's scenario, with any seed.
    pub candidate: &'a Prepared,
    /// Its seed.
    pub seed: u64,
    /// The folder that its tables are relative to.
    pub folder: &'a Path,
    /// Which quantities of its summary are wanted.
    pub columns: &'a [String],
}

/// Runs the simulations of a campaign: this process, or workers elsewhere. What a simulation comes to depends on its scenario
/// and seed alone, and on the [`function`](Self::function) if there is one, not on who runs it.
pub trait Runner: fmt::Debug + Send + Sync {
    /// The quantities of one simulation, one for each column; not a number where it has none. It is called from as many threads as
    /// the campaign has, and ends early once `stop` is set.
    ///
    /// # Errors
    /// [`Trouble::Failed`] for a simulation that failed, which is written down as such; [`Trouble::Stopped`] where there is nothing
    /// to be written down.
    fn run(&self, replicate: &Replicate<'_>, stop: &AtomicBool) -> Result<Vec<f64>, Trouble>;

    /// The name of what the quantities come from where they are not those of runs. A campaign goes on with this one alone.
    fn function(&self) -> Option<&str> {
        None
    }
}

/// Runs simulations on the thread that asks for them.
#[derive(Clone, Copy, Debug)]
pub struct Here;

impl Runner for Here {
    fn run(&self, replicate: &Replicate<'_>, stop: &AtomicBool) -> Result<Vec<f64>, Trouble> {
        let Replicate { candidate, seed, folder, columns } = replicate;
        quantities(candidate.scenario(), *seed, folder, columns, stop)
    }
}

/// What a scenario with this seed comes to: the quantities of its summary of these names, not a number where it has none.
///
/// # Errors
/// [`Trouble`].
pub fn quantities(
    scenario: &Scenario,
    seed: u64,
    folder: &Path,
    columns: &[String],
    stop: &AtomicBool,
) -> Result<Vec<f64>, Trouble> {
    let scenario = Scenario { seed, ..scenario.clone() };
    match run::quiet(&scenario, folder, stop) {
        Ok(Ending::Finished(summary)) => Ok(columns::pick(&summary, columns)),
        Ok(Ending::Interrupted(_)) => Err(Trouble::Stopped),
        Err(error) => Err(Trouble::Failed(error.to_string())),
    }
}
