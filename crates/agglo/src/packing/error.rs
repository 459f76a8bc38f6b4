//! Why a run has no grains to start with.

use std::path::PathBuf;

use thiserror::Error;

use super::{PackingError, TableError};
use crate::engine::SimError;
use crate::text::{readable, two_digits};

/// Why a run has no grains to start with, or the machine no room for it.
#[derive(Debug, Error)]
pub enum StartError {
    /// The grains cannot be placed as the scenario asks.
    #[error(transparent)]
    Placement(#[from] PackingError),
    /// The machine has less memory or disk than a run would take.
    #[error(
        "the run would take about {} of {what} ({who}), and {} are there: {help}",
        readable(two_digits(*.needed), "B"), readable(two_digits(*.there), "B")
    )]
    NoRoom {
        /// "memory" or "disk".
        what: &'static str,
        /// What it would take [B].
        needed: f64,
        /// What is there [B].
        there: f64,
        /// What takes it.
        who: String,
        /// What to do.
        help: &'static str,
    },
    /// A grain is in a wall.
    #[error(transparent)]
    InWall(SimError),
    /// A table of bonds that cannot be made.
    #[error("start.bonds: {0}")]
    Bonds(TableError),
    /// A run whose state cannot be the start.
    #[error("start.from: {path}: {reason}", path = .path.display())]
    Earlier {
        /// Its folder, or its checkpoint.
        path: PathBuf,
        /// Why.
        reason: String,
    },
}
