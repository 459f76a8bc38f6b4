//! Friction of an impact: an impulse across the normal in proportion to the one along it.
//!
//! # Equation
//! ```text
//! J_t = μ |J_n| against the slip, at most m* |v_t|;   loss = J_t (|v_t| - J_t/(2 m*))      [B] 4.17
//! ```
//! J_t/m_i is taken from the first velocity along the slip and J_t/m_j given to the second. A pair that sticks has
//! J_t = m* |v_t|: one velocity.
//!
//! # Source
//! [B] T. I. Zohdi, Proc. R. Soc. Lond. A 460, 3421 (2004), remark 4.3.
//!
//! # Symbols
//! | symbol | name in code     | unit | meaning                                                     |
//! |--------|------------------|------|-------------------------------------------------------------|
//! | J_t    | `impulse`        | N s  | across the normal                                           |
//! | J_n    | `normal_impulse` | N s  | m* (1 + e) v                                                |
//! | μ      | `friction`       | -    | of the law, or `dynamic_friction` of a pair of materials    |
//! | v_t    | `slip`           | m/s  | relative velocity across the normal                         |
//! | m*     | `reduced_mass`   | kg   | m_i m_j/(m_i + m_j)                                         |
//!
//! # Valid when
//! Spheres do not spin. Friction at the surface would turn them; the paper leaves that out, and so do we.
//!
//! # Compared with others
//! [B] prints no bound (`limit = "published"`): then friction can reverse the slip and, beyond twice the bound, add energy.
//! The bound `no_slip` stops the slip at most. The paper's staggering box leaves out the masses that 4.17 has; they are here.
//!
//! # In a scenario
//! ```toml
//! [impact.tangential]
//! friction = 0.01
//! limit = "no_slip"
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::impact::tangential::SlipLimit;
//! assert_eq!(SlipLimit::NoSlip.impulse(0.1, 5.0, 2.0, 3.0), 0.5);
//! assert_eq!(SlipLimit::NoSlip.impulse(0.1, 90.0, 2.0, 3.0), 6.0); // m* |v_t|
//! assert_eq!(SlipLimit::Published.impulse(0.1, 90.0, 2.0, 3.0), 9.0);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::law::{Context, Faults, Law, note_if};

/// Coulomb friction of an impact, [B] 4.17.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Tangential {
    /// μ: tangential over normal impulse, 0 or more.
    pub friction: f64,
    /// What bounds the impulse.
    #[serde(default)]
    pub limit: SlipLimit,
}

lone_law!(Tangential at "impact", tangential);

impl Law for Tangential {
    const WORDS: &'static [&'static str] = &["no_slip"];

    fn faults(&self, faults: &mut Faults, _: &Context<'_>) {
        faults.zero_or_more("friction", self.friction);
    }

    fn notes(&self, _: &Context<'_>) -> Vec<String> {
        let note = "impact.tangential.limit = published: friction may reverse the slip and create energy; no_slip does not";
        note_if(self.limit == SlipLimit::Published, note)
    }

    fn warnings(&self) -> &'static [&'static str] {
        match self.limit {
            SlipLimit::NoSlip => &[],
            SlipLimit::Published => {
                &["impact.tangential.limit = \"published\": friction can reverse the slip and add energy"]
            }
        }
    }
}

/// What bounds the tangential impulse.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SlipLimit {
    /// It ends the slip at the most.
    #[default]
    NoSlip,
    /// Nothing: it may reverse the slip, as printed.
    Published,
}

impl SlipLimit {
    /// Impulse [N s] against the slip.
    #[inline]
    pub fn impulse(self, friction: f64, normal_impulse: f64, reduced_mass: f64, slip: f64) -> f64 {
        let sliding = friction * normal_impulse;
        match self {
            Self::NoSlip => sliding.min(reduced_mass * slip),
            Self::Published if slip > 0.0 => sliding,
            Self::Published => 0.0,
        }
    }
}

/// Kinetic energy [J] that an impulse [N s] against the slip [m/s] takes.
#[inline]
pub fn loss(impulse: f64, reduced_mass: f64, slip: f64) -> f64 {
    impulse * (slip - 0.5 * impulse / reduced_mass)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two masses, by hand: energies before and after, with velocities from 4.17.
    #[test]
    fn loss_is_the_difference_of_kinetic_energies() {
        let (first, second) = (3.0, 5.0);
        let (v, w) = (4.0, -1.0);
        let (reduced, slip) = (first * second / (first + second), v - w);
        for impulse in [0.0, 0.7, reduced * slip, 2.0 * reduced * slip] {
            let after = 0.5 * first * (v - impulse / first) * (v - impulse / first)
                + 0.5 * second * (w + impulse / second) * (w + impulse / second);
            let before = 0.5 * first * v * v + 0.5 * second * w * w;
            assert_near!(loss(impulse, reduced, slip), before - after, 1e-13);
        }
    }

    /// At the bound the loss is all of m* v_t²/2; without a bound twice that impulse loses nothing, more gains.
    #[test]
    fn the_bound() {
        let bound = SlipLimit::NoSlip.impulse(1e9, 1.0, 2.0, 3.0);
        assert_eq!((bound, loss(bound, 2.0, 3.0)), (6.0, 9.0));
        assert_eq!(loss(12.0, 2.0, 3.0), 0.0);
        assert_below!(loss(SlipLimit::Published.impulse(13.0, 1.0, 2.0, 3.0), 2.0, 3.0), 0.0);
        assert_eq!(SlipLimit::Published.impulse(13.0, 1.0, 2.0, 0.0), 0.0);
        assert_eq!(SlipLimit::NoSlip.impulse(13.0, 1.0, 2.0, 0.0), 0.0);
    }
}
