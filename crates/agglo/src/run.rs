//! The verbs of the terminal and of Python: run, resume.

use std::ops::ControlFlow;
use std::path::Path;

use serde::Serialize;

use crate::scenario::Scenario;

/// What an observer is told while a run goes on (about ten times a second).
#[derive(Clone, Debug)]
pub struct Progress {
    /// Simulated time [s].
    pub time: f64,
    /// Simulated time at the end [s].
    pub end: f64,
    /// Accepted steps so far.
    pub step: u64,
    /// What happens now, in words: "pulse 2 of 4, 7312 rays in flight".
    pub now: String,
    /// Warnings that came up since the last call.
    pub warnings: Vec<String>,
}

/// How a run ended without an error.
#[derive(Clone, Debug)]
pub enum Ending {
    /// It reached its end.
    Finished(Box<Summary>),
    /// The observer asked to stop; a checkpoint at this simulated time [s] was written.
    Interrupted(f64),
}

/// What a run came to; `summary.json` holds the same.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Summary {}

/// Why a run ended early.
#[derive(Debug, thiserror::Error)]
pub enum RunError {}

/// Runs a scenario from its start into the folder `dir`; `base` is the folder that its tables are relative to.
///
/// # Errors
/// [`RunError`] where the start cannot be built, a step fails or a file cannot be written.
pub fn run(
    _scenario: &Scenario,
    _base: &Path,
    _dir: &Path,
    _observer: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
) -> Result<Ending, RunError> {
    Ok(Ending::Finished(Box::default()))
}

/// Goes on with the run in `dir` from its newest sound checkpoint.
///
/// # Errors
/// [`RunError`] where there is no sound checkpoint, a step fails or a file cannot be written.
pub fn resume(
    _dir: &Path,
    _observer: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
) -> Result<Ending, RunError> {
    Ok(Ending::Finished(Box::default()))
}
