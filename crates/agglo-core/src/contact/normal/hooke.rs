//! Linear spring along the line of centers.
//!
//! # Equation
//! ```text
//! F = k δ,   U = k δ²/2                                                                   A4
//! ```
//!
//! # Source
//! P. A. Cundall and O. D. L. Strack, Géotechnique 29, 47 (1979).
//!
//! # Symbols
//! | symbol | name in code | unit | meaning                              |
//! |--------|--------------|------|--------------------------------------|
//! | k      | `stiffness`  | N/m  | spring constant of every contact     |
//! | δ      | `overlap`    | m    | R_i + R_j - distance, > 0 in contact |
//!
//! # Critical step
//! ω² = k/m* of each grain with the smallest and the largest; looked at every 100 steps.
//!
//! # Valid when
//! k is chosen so that δ ≪ R; contact lasts π √(m*/k) without damping, whatever the speed.
//!
//! # Compared with others
//! `hooke` of LAMMPS and LIGGGHTS with the stiffness given directly, not derived from a characteristic speed.
//!
//! # In a scenario
//! ```toml
//! [contact.normal.hooke]
//! stiffness = "10 kN/m"
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::contact::{PairConstants, ContactGeometry, normal::{Hooke, NormalLaw}};
//! let law = Hooke { stiffness: agglo::units::Quantity(1e3) };
//! let geometry = ContactGeometry { overlap: 1e-6, ..Default::default() };
//! assert_eq!(law.force(&PairConstants::default(), &geometry), 1e3 * 1e-6);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::NormalLaw;
use crate::contact::{ContactGeometry, PairConstants};
use crate::law::{Context, Faults, Law, note_if};
use crate::math::Real;
use crate::units::Stiffness;

/// A linear spring.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Hooke {
    /// Spring constant of every contact.
    pub stiffness: Stiffness,
}

impl Law for Hooke {
    fn faults(&self, faults: &mut Faults, _: &Context<'_>) {
        faults.positive("stiffness", self.stiffness);
    }

    fn notes(&self, context: &Context<'_>) -> Vec<String> {
        let note = "contact.normal.hooke: one stiffness for all sizes of grains";
        note_if(context.groups > 1, note)
    }
}

impl NormalLaw for Hooke {
    #[inline(always)]
    fn force<F: Real>(&self, _: &PairConstants<F>, geometry: &ContactGeometry<F>) -> F {
        F::of(self.stiffness.si()) * geometry.overlap
    }

    fn energy(&self, _: &PairConstants, geometry: &ContactGeometry) -> f64 {
        0.5 * self.stiffness.si() * geometry.overlap * geometry.overlap
    }

    #[inline(always)]
    fn tangent_stiffness<F: Real>(&self, _: &PairConstants<F>, _: &ContactGeometry<F>) -> F {
        F::of(self.stiffness.si())
    }

    #[inline]
    fn exponent(&self) -> f64 {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::collision::HeadOn;
    use crate::contact::normal::Normal;
    use crate::units::Quantity;

    /// Half a period of the oscillator: π √(m*/k), amplitude v √(m*/k); Runge-Kutta to 1e-8.
    #[test]
    fn contact_lasts_half_a_period() {
        let rebound = HeadOn {
            pair: PairConstants::default(),
            geometry: ContactGeometry::new([1.0, 2.0], [2.0, 2.0], [0.0; 2], 3.0),
            normal: &Normal::Hooke(Hooke { stiffness: Quantity(100.0) }),
            damping: None,
            speed: 0.3,
        }
        .integrate(1e-4);
        assert_close!(rebound.duration, std::f64::consts::PI * 0.1, 1e-8, "in s");
        assert_close!(rebound.largest_overlap, 0.03, 1e-6, "in m");
    }
}
