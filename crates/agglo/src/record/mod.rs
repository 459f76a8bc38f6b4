//! What a run writes: tables, frames, checkpoints, summaries. Recorders see and never change.
//!
//! Nothing here knows how a run is computed: plain data in, files out.

pub mod atomic;
pub mod checkpoint;
pub mod columns;
pub mod door;
mod error;
pub mod frames;
mod json;
mod rows;
mod series;
pub mod sheet;

pub use columns::{About, Cell, Column, Declared, Panel, Table};
pub use error::RecordError;
pub use json::json;
pub use rows::{Rows, Unknown};
pub use series::{Opened, Series};
pub use sheet::Sheet;
