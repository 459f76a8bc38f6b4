//! Hardness that falls with temperature, by Arrhenius.
//!
//! # Equation
//! ```text
//! H(T) = H0 exp(Q/(R T)),   a pair has min(H_i, H_j)                                    B8
//! ```
//!
//! # Source
//! [B] T. I. Zohdi, Proc. R. Soc. Lond. A 460, 3421 (2004), sections 3 and 6.
//!
//! # Symbols
//! | symbol | name in code             | unit  | meaning                                              |
//! |--------|--------------------------|-------|------------------------------------------------------|
//! | H      | `hardness`               | Pa    | Vickers hardness                                     |
//! | H0     | `limit`                  | Pa    | `hardness` of a material: the limit of great heat    |
//! | Q      | `activation_energy`      | J/mol | 0: the hardness does not depend on temperature       |
//! | R      | `GAS_CONSTANT`           | J/(mol K) |                                                  |
//! | T      | `temperature`            | K     | after the impact has heated the partner              |
//!
//! # Valid when
//! Dislocations move by thermal activation. There is no melting: H never falls below H0.
//!
//! # Compared with others
//! [B] calls H0 the hardness at absolute zero; by the formula it is the limit for T → ∞, and H grows without bound
//! as T goes to zero. At 300 K, Q = 1 kJ/mol gives H = 1.49 H0.
//!
//! # In a scenario
//! ```toml
//! [materials.grain]
//! hardness = "1 MPa"
//! activation_energy = "1 kJ/mol"
//! heat_capacity = "1000 J/(kg K)"
//!
//! [impact.restitution.hardness]
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::impact::softening::Hardness;
//! let silica = Hardness::new(1e6, 1000.0);
//! let by_hand = 1e6 * (1000.0_f64 / (8.314_462_618 * 300.0)).exp();
//! assert!((silica.at(300.0) / by_hand - 1.0).abs() < 1e-14);
//! ```

use crate::constants::GAS_CONSTANT;
use crate::particles::Material;
use crate::units::Quantity;

/// The hardness of one material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hardness {
    limit: f64,
    /// Q/R [K].
    activation_temperature: f64,
}

impl Hardness {
    /// That of a material; nothing where it has none.
    pub fn of(material: &Material) -> Option<Self> {
        Some(Self::new(material.hardness?.si(), material.activation_energy.map_or(0.0, Quantity::si)))
    }

    /// From H0 [Pa] and Q [J/mol].
    pub fn new(limit: f64, activation_energy: f64) -> Self {
        Self { limit, activation_temperature: activation_energy / GAS_CONSTANT }
    }

    /// What no impact can soften: the hardness of a material that has none.
    pub fn infinite() -> Self {
        Self { limit: f64::INFINITY, activation_temperature: 0.0 }
    }

    /// Whether it depends on temperature.
    #[inline]
    pub fn softens(&self) -> bool {
        self.activation_temperature != 0.0
    }

    /// Hardness [Pa] at a temperature [K].
    #[inline]
    pub fn at(&self, temperature: f64) -> f64 {
        if self.softens() {
            self.limit * (self.activation_temperature / temperature).exp()
        } else {
            self.limit
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// exp(Q/(R T)) from mpmath: Q = 500 J/mol at 500 K, Q = 20 kJ/mol at 1000 K.
    #[test]
    fn numbers_by_mpmath() {
        assert_close!(Hardness::new(1.0, 500.0).at(500.0), 1.127_803_972_856_176_5, 1e-14);
        assert_close!(Hardness::new(3e5, 2e4).at(1e3) / 3e5, 11.083_384_565_773_28, 1e-14);
    }

    #[test]
    fn limits() {
        let hard = Hardness::new(2e5, 300.0);
        assert_close!(hard.at(1e12), 2e5, 1e-9);
        assert_above!(hard.at(1.0), 1e15 * hard.at(300.0));
        assert_eq!(Hardness::new(2e5, 0.0).at(0.0), 2e5);
        assert_true!(hard.softens(), "hardness falls with temperature");
        assert_false!(Hardness::infinite().softens(), "hardness falls with temperature");
        assert_eq!(Hardness::infinite().at(300.0), f64::INFINITY);
    }
}
