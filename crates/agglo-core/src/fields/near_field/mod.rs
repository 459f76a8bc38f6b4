//! Attraction and repulsion between grains at a distance ([A] 28): the laws, and how far they are followed.
//!
//! # Equation
//! ```text
//! F_i = sum of F_ij over all j with d_ij <= cutoff                                        [A] 28
//! U(d) = ∫ F dd from d to the cut-off, or to infinity
//! ```
//!
//! # Source
//! [A] T. I. Zohdi, Comput. Mech. 57, 465 (2016), eq. 28; `coulomb` and `van_der_waals` name theirs.
//!
//! # Signs
//! As in contact: a force > 0 repels. Energies are zero at infinity, or at the cut-off where there is one.
//!
//! # Symbols
//! | symbol | name in code | unit | meaning                                              |
//! |--------|--------------|------|------------------------------------------------------|
//! | F_ij   | `law`        | N    | of the one law that is chosen                        |
//! | d_ij   | `distance`   | m    | of the centers                                       |
//! |        | `cutoff`     | m    | beyond it a pair is left out; all pairs if not given |
//! |        | `truncation` | -    | largest part of the force that may be left out       |
//!
//! # Valid when
//! Pairs add up. What the cut-off leaves out is measured at the start, on up to 400 grains; it may grow as grains spread or
//! clump.
//!
//! # Compared with others
//! One law at a time, where LAMMPS adds up several with `pair_style hybrid/overlay`. The force is cut off, the energy is
//! shifted to zero there, so that a pair that comes in or goes out keeps its energy.
//!
//! # In a scenario
//! ```toml
//! [fields.near_field]
//! cutoff = "5 cm"
//! truncation = 0.05
//! law.van_der_waals = { hamaker = "1e-19 J", smallest_gap = "0.4 nm" }
//! ```

mod coulomb;
mod power_pair;
mod van_der_waals;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use coulomb::Coulomb;
pub use power_pair::{PowerPair, Scaling};
pub use van_der_waals::VanDerWaals;

use crate::math::Pace;
use crate::units::Length;

/// The near field: a law, and how far it is followed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NearField {
    /// The law.
    pub law: NearFieldLaw,
    /// Distance of centers beyond which it is left out, above the largest diameter; all pairs if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cutoff: Option<Length>,
    /// Largest error of the forces (root mean square, over that of all pairs) that the cut-off may cause at the
    /// start; more is refused.
    #[serde(default = "default_truncation")]
    pub truncation: f64,
}

fn default_truncation() -> f64 {
    0.05
}

/// The closed set of near-field laws.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum NearFieldLaw {
    /// a1 d^-b1 - a2 d^-b2.
    PowerPair(PowerPair),
    /// Electrostatic force between the grains' charges.
    Coulomb(Coulomb),
    /// Hamaker's force between spheres.
    VanDerWaals(VanDerWaals),
}

/// What a grain is to the near field.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Source {
    /// Mass [kg].
    pub mass: f64,
    /// Radius [m].
    pub radius: f64,
    /// Charge [C].
    pub charge: f64,
    /// Sign c of [A] 28: 1 or -1.
    pub polarity: f64,
}

impl NearFieldLaw {
    /// Repulsion [N] of two grains at a distance of centers [m].
    #[inline]
    pub fn force(&self, a: &Source, b: &Source, distance: f64) -> f64 {
        match self {
            Self::PowerPair(law) => law.force(a, b, distance),
            Self::Coulomb(law) => law.force(a, b, distance),
            Self::VanDerWaals(law) => law.force(a, b, distance),
        }
    }

    /// Energy [J]; minus its slope over the distance is the force.
    pub fn energy(&self, a: &Source, b: &Source, distance: f64) -> f64 {
        match self {
            Self::PowerPair(law) => law.energy(a, b, distance),
            Self::Coulomb(law) => law.energy(a, b, distance),
            Self::VanDerWaals(law) => law.energy(a, b, distance),
        }
    }

    /// Size of the gradient of the force [N/m], or a bound on it, at a distance of centers [m].
    pub fn gradient(&self, a: &Source, b: &Source, distance: f64) -> f64 {
        match self {
            Self::PowerPair(law) => law.gradient(a, b, distance),
            Self::Coulomb(law) => law.gradient(a, b, distance),
            Self::VanDerWaals(law) => law.gradient(a, b, distance),
        }
    }

    /// Whether the gradient has a bound however close grains come.
    pub fn is_capped(&self) -> bool {
        matches!(self, Self::VanDerWaals(_))
    }
}

impl NearField {
    /// Repulsion [N] of two grains at a distance of centers [m]; 0 beyond the cut-off.
    #[inline]
    pub fn force(&self, a: &Source, b: &Source, distance: f64) -> f64 {
        if self.is_beyond(distance) { 0.0 } else { self.law.force(a, b, distance) }
    }

    /// How fast two grains are at a distance of centers [m], by the gradient of the force; at closest approach where
    /// that is to come.
    pub fn pace(&self, a: &Source, b: &Source, distance: f64) -> Pace {
        if self.is_beyond(distance) {
            return Pace::NONE;
        }
        Pace::of_spring(self.law.gradient(a, b, distance), a.mass * b.mass / (a.mass + b.mass))
    }

    /// Energy [J] whose slope the force is: zero at infinity, or from the cut-off on where there is one.
    pub fn energy(&self, a: &Source, b: &Source, distance: f64) -> f64 {
        match self.cutoff {
            Some(cutoff) if distance > cutoff.si() => 0.0,
            Some(cutoff) => self.law.energy(a, b, distance) - self.law.energy(a, b, cutoff.si()),
            None => self.law.energy(a, b, distance),
        }
    }

    #[inline]
    fn is_beyond(&self, distance: f64) -> bool {
        self.cutoff.is_some_and(|cutoff| distance > cutoff.si())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::check::assert_slope;
    use crate::units::Quantity;

    const A: Source = Source { mass: 2.0, radius: 1e-3, charge: 3e-9, polarity: 1.0 };
    const B: Source = Source { mass: 5.0, radius: 4e-3, charge: -1e-9, polarity: -1.0 };

    fn every_law() -> Vec<NearFieldLaw> {
        let mut laws: Vec<NearFieldLaw> =
            [(Scaling::Mass, 2.0, 4.0), (Scaling::Surface, 1.0, 3.0), (Scaling::Volume, 0.5, 1.0)]
                .map(|(scaling, attraction_exponent, repulsion_exponent)| {
                    let (attraction, repulsion) = (2.0, 3e-3);
                    let pair =
                        PowerPair { scaling, attraction, attraction_exponent, repulsion, repulsion_exponent };
                    NearFieldLaw::PowerPair(pair)
                })
                .to_vec();
        laws.push(NearFieldLaw::Coulomb(Coulomb { relative_permittivity: 80.0 }));
        let (hamaker, smallest_gap) = (Quantity(1e-19), Quantity(4e-7));
        laws.push(NearFieldLaw::VanDerWaals(VanDerWaals { hamaker, smallest_gap }));
        laws
    }

    #[test]
    fn force_is_minus_the_slope_of_energy_with_and_without_cutoff() {
        for law in every_law() {
            for cutoff in [None, Some(Quantity(0.08))] {
                let near = NearField { law: law.clone(), cutoff, truncation: 0.05 };
                for distance in [0.006, 0.01, 0.05] {
                    let energy = |d| -near.energy(&A, &B, d);
                    assert_slope(distance, energy, |d| near.force(&A, &B, d));
                    assert_eq!(near.force(&A, &B, distance), near.force(&B, &A, distance));
                }
            }
        }
    }

    /// ω² is the gradient over m* = 2 x 5/7 kg, whichever of the two is asked first; nothing beyond the cut-off.
    #[test]
    fn pace_of_unequal_grains() {
        for law in every_law() {
            let near = NearField { law: law.clone(), cutoff: Some(Quantity(0.08)), truncation: 0.05 };
            for (a, b) in [(&A, &B), (&B, &A)] {
                let by_hand = law.gradient(a, b, 0.01) * 7.0 / 10.0;
                assert_close!(near.pace(a, b, 0.01).square, by_hand, 1e-14, "in 1/s², {law:?}");
                assert_eq!(near.pace(a, b, 0.081), Pace::NONE);
            }
        }
    }

    /// Against a central difference of the force; a bound where two terms of a power pair differ in sign.
    #[test]
    fn the_gradient_is_the_slope_of_the_force() {
        for law in every_law() {
            for distance in [0.006_000_1, 0.01, 0.05] {
                let h = 1e-4 * (distance - 0.005);
                let slope = (law.force(&A, &B, distance + h) - law.force(&A, &B, distance - h)) / (2.0 * h);
                let across = law.force(&A, &B, distance) / distance;
                let gradient = law.gradient(&A, &B, distance);
                assert!(gradient >= (1.0 - 1e-6) * slope.abs().max(across.abs()), "{law:?} {distance}");
                if !matches!(law, NearFieldLaw::PowerPair(_)) {
                    assert!((gradient / slope.abs() - 1.0).abs() < 1e-6, "{law:?} {distance}");
                }
            }
        }
        let (hamaker, smallest_gap) = (Quantity(1e-19), Quantity(4e-10));
        let capped = VanDerWaals { hamaker, smallest_gap };
        let grain = Source { radius: 1e-6, ..Source::default() };
        // A R*/(3 g³) at the smallest gap, to O(g/R).
        let by_hand = 1e-19 * 0.5e-6 / (3.0 * 4e-10_f64.powi(3));
        for distance in [2e-6, 2e-6 + 4e-10] {
            assert_close!(capped.gradient(&grain, &grain, distance), by_hand, 1e-3);
        }
    }

    #[test]
    fn beyond_the_cutoff_there_is_nothing() {
        for law in every_law() {
            let near = NearField { law, cutoff: Some(Quantity(0.02)), truncation: 0.05 };
            assert_eq!([near.force(&A, &B, 0.021), near.energy(&A, &B, 0.021)], [0.0, 0.0]);
            assert_eq!(near.energy(&A, &B, 0.02), 0.0);
        }
    }
}
