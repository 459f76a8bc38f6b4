//! Two power laws, one that attracts and one that repels.
//!
//! # Equation
//! ```text
//! F_i = s (a1 d^-b1 - a2 d^-b2) n,   s = c_i c_j x_i x_j                                  [A] 28
//! U = s (a2 d^(1-b2)/(b2 - 1) - a1 d^(1-b1)/(b1 - 1)),   for b = 1:  ∓ s a ln(d / 1 m)
//! ```
//! n points from i to j, so the first term attracts; the function `force` returns repulsion, -F_i · n.
//!
//! # Source
//! [A] T. I. Zohdi, Comput. Mech. 57, 465 (2016), eq. 28.
//!
//! # Symbols
//! | symbol | name in code          | unit | meaning                                                   |
//! |--------|-----------------------|------|-----------------------------------------------------------|
//! | a1, b1 | `attraction`, `attraction_exponent` | SI, - | first term                                 |
//! | a2, b2 | `repulsion`, `repulsion_exponent`   | SI, - | second term                                |
//! | x      | `scaling`             |      | mass [kg], surface [m²], volume [m³] or charge [C] of a grain |
//! | c      | `polarity`            | -    | 1 or -1; unlike signs turn both terms round               |
//! | d      | `distance`            | m    | of the centers                                            |
//!
//! # Valid when
//! Coefficients are empirical. With b <= 1 the energy has no zero at infinity: it is taken zero at d = 1 m for
//! b = 1 and at d = 0 below.
//!
//! # Compared with others
//! Mie's and Lennard-Jones' forces are the cases (7, 13); gravity is a1 = G, b1 = 2 with `mass`.
//!
//! # In a scenario
//! ```toml
//! [fields.near_field.law.power_pair]
//! scaling = "mass"
//! attraction = 1.0
//! attraction_exponent = 1.0
//! repulsion = 1.0
//! repulsion_exponent = 2.0
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::fields::near_field::{NearLaw, PowerPair, Scaling, Source};
//! let newton = PowerPair {
//!     scaling: Scaling::Mass, attraction: 6.6743e-11, attraction_exponent: 2.0,
//!     repulsion: 0.0, repulsion_exponent: 2.0,
//! };
//! let earth = Source { mass: 5.972e24, polarity: 1.0, ..Default::default() };
//! let apple = Source { mass: 0.1, polarity: 1.0, ..Default::default() };
//! assert!((newton.force(&earth, &apple, 6.371e6) + 0.982).abs() < 1e-3);
//! ```

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{NearLaw, Source};
use crate::law::{Context, Faults, HIGHEST_EXPONENT, Law};

/// Two power laws; the coefficients are in SI units of whatever makes the force a force.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PowerPair {
    /// What the coefficients are multiplied with.
    pub scaling: Scaling,
    /// a1.
    pub attraction: f64,
    /// b1.
    pub attraction_exponent: f64,
    /// a2.
    pub repulsion: f64,
    /// b2.
    pub repulsion_exponent: f64,
}

/// What the coefficients of [`PowerPair`] scale with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Scaling {
    /// m_i m_j.
    Mass,
    /// Product of the surfaces.
    Surface,
    /// Product of the volumes.
    Volume,
    /// Product of the charges.
    Charge,
}

impl Scaling {
    #[inline]
    fn of(self, source: &Source) -> f64 {
        match self {
            Self::Mass => source.mass,
            Self::Surface => 4.0 * PI * source.radius * source.radius,
            Self::Volume => 4.0 / 3.0 * PI * source.radius * source.radius * source.radius,
            Self::Charge => source.charge,
        }
    }
}

/// d^-b, whole powers worked out by multiplication.
#[inline]
fn inverse_power(distance: f64, exponent: f64) -> f64 {
    if exponent.fract() == 0.0 && exponent.abs() <= 64.0 {
        distance.powi(-(exponent as i32))
    } else {
        distance.powf(-exponent)
    }
}

/// Integral of d^-b from d on, or the logarithm that stands for it.
fn tail(distance: f64, exponent: f64) -> f64 {
    if exponent == 1.0 { -distance.ln() } else { inverse_power(distance, exponent - 1.0) / (exponent - 1.0) }
}

impl PowerPair {
    #[inline]
    fn scale(&self, a: &Source, b: &Source) -> f64 {
        a.polarity * b.polarity * self.scaling.of(a) * self.scaling.of(b)
    }
}

impl Law for PowerPair {
    fn faults(&self, faults: &mut Faults, _: &Context<'_>) {
        for (key, exponent) in [
            ("attraction_exponent", self.attraction_exponent),
            ("repulsion_exponent", self.repulsion_exponent),
        ] {
            faults.within(key, exponent, -HIGHEST_EXPONENT, HIGHEST_EXPONENT);
        }
    }
}

impl NearLaw for PowerPair {
    #[inline]
    fn force(&self, a: &Source, b: &Source, distance: f64) -> f64 {
        let repulsion = self.repulsion * inverse_power(distance, self.repulsion_exponent);
        let attraction = self.attraction * inverse_power(distance, self.attraction_exponent);
        self.scale(a, b) * (repulsion - attraction)
    }

    /// A bound along the line of centers and across it.
    fn gradient(&self, a: &Source, b: &Source, distance: f64) -> f64 {
        let term = |size: f64, exponent: f64| {
            size.abs() * exponent.abs().max(1.0) * inverse_power(distance, exponent + 1.0)
        };
        self.scale(a, b).abs()
            * (term(self.repulsion, self.repulsion_exponent)
                + term(self.attraction, self.attraction_exponent))
    }

    /// Zero at infinity where both powers are above 1.
    fn energy(&self, a: &Source, b: &Source, distance: f64) -> f64 {
        let repulsion = self.repulsion * tail(distance, self.repulsion_exponent);
        let attraction = self.attraction * tail(distance, self.attraction_exponent);
        self.scale(a, b) * (repulsion - attraction)
    }

    /// The smaller of the powers whose terms are there.
    fn slowest_decay(&self) -> f64 {
        match (self.attraction == 0.0, self.repulsion == 0.0) {
            (true, _) => self.repulsion_exponent,
            (_, true) => self.attraction_exponent,
            _ => self.attraction_exponent.min(self.repulsion_exponent),
        }
    }

    fn is_by_charge(&self) -> bool {
        self.scaling == Scaling::Charge
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each scaling by hand: 3·2^-2 repels, 5·2^-3 attracts.
    #[test]
    fn scalings_and_signs() {
        let a = Source { mass: 2.0, radius: 0.1, charge: 4.0, polarity: 1.0 };
        let b = Source { mass: 3.0, radius: 0.2, charge: -5.0, polarity: 1.0 };
        let balance = 3.0 / 4.0 - 5.0 / 8.0;
        let sphere = 4.0 / 3.0 * PI;
        let rows = [
            (Scaling::Mass, 6.0),
            (Scaling::Surface, 16.0 * PI * PI * 0.01 * 0.04),
            (Scaling::Volume, sphere * sphere * 0.001 * 0.008),
            (Scaling::Charge, -20.0),
        ];
        for (scaling, product) in rows {
            let law = PowerPair {
                scaling,
                attraction: 5.0,
                attraction_exponent: 3.0,
                repulsion: 3.0,
                repulsion_exponent: 2.0,
            };
            assert_close!(law.force(&a, &b, 2.0), product * balance, 1e-14, "in N");
            let other = Source { polarity: -1.0, ..b };
            assert_eq!(law.force(&a, &other, 2.0), -law.force(&a, &b, 2.0));
        }
    }

    #[test]
    fn energy_vanishes_at_infinity() {
        let law = PowerPair {
            scaling: Scaling::Charge,
            attraction: 1.0,
            attraction_exponent: 2.5,
            repulsion: 1.0,
            repulsion_exponent: 7.0,
        };
        let one = Source { charge: 1.0, polarity: 1.0, ..Source::default() };
        assert_near!(law.energy(&one, &one, 1.0), 1.0 / 6.0 - 1.0 / 1.5, 1e-15, "in J");
        assert_below!(law.energy(&one, &one, 1e9).abs(), 1e-13, "in J");
    }
}
