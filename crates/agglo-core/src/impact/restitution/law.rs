//! What a law of restitution can do.

use crate::law::Law;

/// Where the restitution of an impact comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rebound {
    /// It is the same for all impacts.
    Constant(f64),
    /// It is solved for together with velocities, temperatures and hardness.
    Hardness,
}

/// What a law of restitution can do.
pub trait RestitutionLaw: Law {
    /// Where the restitution comes from.
    fn rebound(&self) -> Rebound;
}
