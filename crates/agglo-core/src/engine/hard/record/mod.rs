//! What is recorded of hard spheres: energies and counts, merges and fragmentations, means for a macroscale code.

mod counts;
mod events;
mod homogenized;
mod stored;

pub use counts::Counts;
pub use events::{Descent, EventKind, GrainEvent};
pub use homogenized::Homogenized;
pub(super) use homogenized::homogenize;
pub(super) use stored::{momentum, opening, stored};
