//! What a collision does to the spheres of a run.

mod collapse;
mod collision;
mod fragments;
mod resolve;
mod system;

pub(super) use collapse::Collapse;
pub use collision::Change;
pub use system::{HardSystem, HardSystemState};
