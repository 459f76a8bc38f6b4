//! A volume that is drawn out or pressed together, and space with it.
//!
//! # Equation
//! ```text
//! D_k(t) = D_k(0) exp(ε̇_k t)                                                          B1
//! r' = v + ε̇ (r - r_c),   m v' = F                                                    B2
//! P = -sum over pairs of F_ij · (ε̇ r_ij)                                              B3
//! ```
//! Places follow the volume, velocities are those beside its flow: so do contacts, dashpots and friction see v_j - v_i + ε̇ r_ij, and
//! the power P that the volume puts in is what the pairs' forces do on that flow.
//!
//! # Source
//! B1 and B2: D. J. Evans and G. P. Morriss, *Statistical Mechanics of Nonequilibrium Liquids* (1990), without their term
//! -ε̇ p, so that free grains keep their velocities; B3 follows.
//!
//! # Symbols
//! | symbol | name in code     | unit | meaning                                                          |
//! |--------|------------------|------|------------------------------------------------------------------|
//! | D_k    |                  | m    | half the edge along axis k                                       |
//! | ε̇_k    | `strain_rate`    | 1/s  | growth of the edge over its length; below 0 it becomes shorter   |
//! | r_c    |                  | m    | middle of the volume, which stays                                |
//! | r_ij   |                  | m    | from grain i to the nearest image of grain j                     |
//! | F_ij   |                  | N    | force on j                                                       |
//! |        | `solid_fraction` | -    | volume of the grains over that of the volume where it stops      |
//!
//! # Critical step
//! Neighbors come nearer by ε̇ Δt of their distance in a step: the automatic step keeps that below 1e-3.
//!
//! # Valid when
//! ε̇ is small beside the rates of contacts and collisions, or the volume presses on grains faster than they can give way.
//!
//! # Compared with others
//! LAMMPS' `fix deform erate ... remap x` moves places likewise; its granular dashpots and friction do not see the flow, and its
//! work is in no sum.
//!
//! # In a scenario
//! ```toml
//! [volume]
//! lower = ["-1 cm", "-1 cm", "-1 cm"]
//! upper = ["1 cm", "1 cm", "1 cm"]
//! deformation = { strain_rate = ["-10 1/s", "-10 1/s", "-10 1/s"], solid_fraction = 0.6 }
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::units::{Frequency, Triple, vector};

/// How the volume is drawn out or pressed together along axes on which space repeats itself, its middle where it is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Deformation {
    /// Growth of each edge over its length and time, such as `"-10 1/s"`; below 0 it becomes shorter.
    pub strain_rate: Triple<Frequency>,
    /// Volume of the grains over that of the volume at which it stops; at the end of the run if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub solid_fraction: Option<f64>,
}

/// Longest step times the largest rate of strain.
const LARGEST_STRAIN: f64 = 1e-3;

impl Deformation {
    /// Longest step [s] that resolves it.
    pub fn longest_step(&self) -> f64 {
        let fastest =
            vector(self.strain_rate).to_array().into_iter().fold(0.0, |most: f64, rate| most.max(rate.abs()));
        LARGEST_STRAIN / fastest
    }

    /// When it stops [s], in a volume [m³] with grains of this volume [m³]; never if it does not come to that.
    pub fn end(&self, volume: f64, solid: f64) -> f64 {
        let growth: f64 = vector(self.strain_rate).to_array().iter().sum();
        self.solid_fraction.map_or(f64::INFINITY, |fraction| {
            let end = (solid / (fraction * volume)).ln() / growth;
            if end.is_nan() || end < 0.0 { f64::INFINITY } else { end }
        })
    }
}
