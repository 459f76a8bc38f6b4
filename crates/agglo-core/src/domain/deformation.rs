//! A volume that is drawn out or pressed together, and space with it.
//!
//! # Equation
//! ```text
//! L_k(t) = L_k(0) exp(e_k t)                                                          D1
//! r' = v + e (r - c),   m v' = F                                                      D2
//! P = -sum over pairs of F_ij · (e r_ij)                                              D3
//! ```
//! Places follow the volume, velocities are those beside its flow: so do contacts, dashpots and friction see v_j - v_i + e r_ij, and
//! the power P that the volume puts in is what the pairs' forces do on that flow.
//!
//! # Source
//! D1 and D2: D. J. Evans and G. P. Morriss, *Statistical Mechanics of Nonequilibrium Liquids* (1990), chapter 6, without their term
//! -e p, so that free grains keep their velocities; D3 follows.
//!
//! # Symbols
//! | symbol | name in code     | unit | meaning                                                          |
//! |--------|------------------|------|------------------------------------------------------------------|
//! | L_k    | `periods`        | m    | edge along axis k                                                |
//! | e_k    | `strain_rate`    | 1/s  | growth of the edge over its length; below 0 it becomes shorter   |
//! | c      |                  | m    | middle of the volume, which stays                                |
//! | r_ij   |                  | m    | from grain i to the nearest image of grain j                     |
//! | F_ij   |                  | N    | force on j                                                       |
//! |        | `solid_fraction` | -    | volume of the grains over that of the volume where it stops      |
//!
//! # Critical step
//! Neighbors come nearer by e Δt of their distance in a step: the automatic step keeps that below 1e-3.
//!
//! # Valid when
//! e is small beside the rates of contacts and collisions, or the volume presses on grains faster than they can give way.
//!
//! # Compared with others
//! LAMMPS' `fix deform erate ... remap x` moves places likewise; its granular dashpots and friction do not see the flow, and its
//! work is in no sum.
//!
//! # In a scenario
//! ```toml
//! [volume]
//! lower = ["-1 mm", "-1 mm", "-1 mm"]
//! upper = ["1 mm", "1 mm", "1 mm"]
//! deformation = { strain_rate = ["-10 1/s", "-10 1/s", "-10 1/s"], solid_fraction = 0.6 }
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::space::Space;
use super::volume::Volume;
use crate::math::Vec3;
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

/// Space as it is at any time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpaceInTime {
    start: Space,
    strain_rate: Vec3,
    end: f64,
}

impl SpaceInTime {
    /// Space as the faces of a volume make it, among grains of this volume [m³].
    pub fn new(volume: Option<&Volume>, solid: f64) -> Self {
        let start = volume.map_or(Space::OPEN, Volume::space);
        let deformation = volume.and_then(|volume| Some((volume, volume.deformation.as_ref()?)));
        let (strain_rate, end) = deformation.map_or((Vec3::ZERO, 0.0), |(volume, deformation)| {
            (vector(deformation.strain_rate), deformation.end(volume.volume(), solid))
        });
        Self { start, strain_rate, end }
    }

    /// Whether it is another at other times.
    #[inline]
    pub fn changes(&self) -> bool {
        self.strain_rate != Vec3::ZERO
    }

    /// Space at a time [s].
    pub fn at(&self, time: f64) -> Space {
        if !self.changes() {
            return self.start;
        }
        let [lower, upper] = self.start.corners();
        let (middle, half) = ((lower + upper) * 0.5, (upper - lower) * 0.5);
        let factors = self.strain_rate.to_array().map(|rate| (rate * time.min(self.end)).exp());
        let half = Vec3::new(half.x * factors[0], half.y * factors[1], half.z * factors[2]);
        let axes = [0, 1, 2].map(|axis| self.start.repeats_along(axis));
        let now = Space::repeating([middle - half, middle + half], axes);
        if time < self.end { now.strained(self.strain_rate) } else { now }
    }

    /// How places follow it from one time [s] to another.
    pub fn stretch(&self, from: f64, to: f64) -> Option<Stretch> {
        if !self.changes() {
            return None;
        }
        let [lower, upper] = self.start.corners();
        let passed = to.min(self.end) - from.min(self.end);
        let factors = self.strain_rate.to_array().map(|rate| (rate * passed).exp());
        Some(Stretch { middle: (lower + upper) * 0.5, factors: factors.into() })
    }
}

/// How places follow space that changes.
#[derive(Clone, Copy, Debug)]
pub struct Stretch {
    middle: Vec3,
    factors: Vec3,
}

impl Stretch {
    /// Where a place [m] comes to.
    #[inline(always)]
    pub fn of(&self, place: Vec3) -> Vec3 {
        let from = place - self.middle;
        self.middle + Vec3::new(from.x * self.factors.x, from.y * self.factors.y, from.z * self.factors.z)
    }
}
