//! Grains of a control volume between two steps of a macroscale code.

use serde::{Deserialize, Serialize};

use super::grown::Grown;
use crate::particles::Particles;

/// The grains of a control volume between two steps. Velocities and temperatures may be changed freely.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MicroState {
    /// The columns. Names stay with their grains; what comes out of a merge keeps the heavier partner's.
    pub grains: Particles,
    /// What they keep of their parts [n].
    pub grown: Vec<Grown>,
    /// Mean radius of the first state [m], which growth is measured by.
    pub reference_radius: f64,
    /// Steps made so far; random numbers of a step belong to it.
    pub step: u32,
}
