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

/// Volume of spheres of these radii [m], in m³.
pub fn volume_of_spheres(radii: impl Iterator<Item = f64>) -> f64 {
    radii.map(|radius| 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3)).sum()
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

    /// When it stops [s], in a volume [m³] with grains of this volume [m³]: never where no solid fraction is given; nothing where it
    /// leads away from that.
    pub fn end(&self, volume: f64, solid: f64) -> Option<f64> {
        let growth: f64 = vector(self.strain_rate).to_array().iter().sum();
        let Some(fraction) = self.solid_fraction else { return Some(f64::INFINITY) };
        let end = (solid / (fraction * volume)).ln() / growth;
        (end.is_finite() && end >= 0.0).then_some(end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Quantity;

    /// By hand: at rates that sum up to -6 1/s a volume is half as large after ln 2/6 s, and never twice as large; at rates that sum up
    /// to 0 it stays as large as it is.
    #[test]
    fn it_ends_at_the_solid_fraction_or_leads_away_from_it() {
        let end = |strain_rate: [f64; 3], solid_fraction| {
            let strain_rate = strain_rate.map(Quantity);
            Deformation { strain_rate, solid_fraction }.end(10.0, 3.0)
        };
        let pressing = [-1.0, -2.0, -3.0];
        assert_near!(end(pressing, Some(0.6)).unwrap(), 2.0_f64.ln() / 6.0, 1e-15, "s");
        assert_eq!(end(pressing, None), Some(f64::INFINITY));
        assert_eq!(end(pressing, Some(0.3)), Some(0.0));
        assert_none!(end(pressing, Some(0.15)));
        assert_none!(end([2.0, -1.0, -1.0], Some(0.6)));
    }
}
