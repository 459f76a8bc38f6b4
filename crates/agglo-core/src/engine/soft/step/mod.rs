//! What drives time: the two schemes, and how long a step may be.

pub(super) mod advance;
pub(super) mod change;
pub(super) mod finish;
pub(super) mod staggered;
pub(super) mod step_size;
#[cfg(test)]
mod step_size_tests;
pub(super) mod tempo;
pub(super) mod verlet;
