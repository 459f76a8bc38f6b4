//! What is recorded of hard spheres: energies and counts, merges and fragmentations, means for a macroscale code.

mod events;
mod homogenized;
mod ledger;

pub use events::{Descent, EventKind, GrainEvent};
pub use homogenized::Homogenized;
pub(super) use homogenized::homogenize;
pub use ledger::{Balance, Counts, Flows, HardLedger, SphereEnergy};
pub(super) use ledger::{momentum, stored};
