//! What a run writes: tables, frames, checkpoints, summaries. Recorders see and never change.
//!
//! Nothing here knows how a run is computed: plain data in, files out.

pub mod atomic;
pub mod checkpoint;
pub mod door;
mod error;
pub mod frames;
mod number;
mod series;
mod visible;

pub use error::RecordError;
#[cfg(test)]
pub(crate) use number::AWKWARD;
pub use number::{Number, fractional, json, not_finite, number};
pub use series::{Cell, Opened, Series};
pub use visible::{cell, visible};
