//! How a domain reaches the others.

use std::fmt;
use std::sync::Arc;

/// The way to the other domains.
pub trait Link: fmt::Debug + Send + Sync {
    /// How many domains there are.
    fn domains(&self) -> usize;

    /// Which one this is, from 0 on.
    fn number(&self) -> usize;

    /// Gives all domains a message, and takes those of all, in the order of their numbers. All domains do so equally often; a
    /// number arrives with all its bits.
    fn exchange(&self, own: Vec<f64>) -> Vec<Arc<[f64]>>;
}
