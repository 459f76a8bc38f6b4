//! Electrostatic force between charged grains.
//!
//! # Equation
//! ```text
//! F = q_i q_j / (4 π ε0 ε_r d²),   U = q_i q_j / (4 π ε0 ε_r d)                           A8
//! ```
//!
//! # Source
//! C.-A. de Coulomb (1785); J. D. Jackson, *Classical Electrodynamics*.
//!
//! # Symbols
//! | symbol | name in code            | unit | meaning                                        |
//! |--------|-------------------------|------|------------------------------------------------|
//! | q      | `charge`                | C    | charge of a grain; like charges repel          |
//! | ε_r    | `relative_permittivity` | -    | of the medium: 1 in vacuum, 80 in water        |
//! | d      | `distance`              | m    | of the centers                                 |
//!
//! # Valid when
//! Charge is spread evenly over each grain and stays there; induced charges and screening by ions are left
//! out. The force falls off too slowly for a cut-off: sums over a cloud do not converge.
//!
//! # Compared with others
//! `coul/cut` of LAMMPS in SI units, with the energy taken from the cut-off where there is one.
//!
//! # In a scenario
//! ```toml
//! [[grains]]
//! material = "grain"
//! size.constant.radius = "1 mm"
//! placement.list.positions = [["0 m", "0 m", "0 m"], ["0 m", "0 m", "1 cm"]]
//! charge = "1 nC"
//!
//! [fields.near_field.law.coulomb]
//! relative_permittivity = 80.0
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::fields::near_field::{Coulomb, NearLaw, Source};
//! let a = Source { charge: 1e-9, ..Default::default() };
//! let force = Coulomb { relative_permittivity: 1.0 }.force(&a, &a, 0.01);
//! assert!((force / 8.987_551_79e-5 - 1.0).abs() < 1e-8);
//! ```

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{NearLaw, Source};
use crate::constants::VACUUM_PERMITTIVITY;
use crate::law::{Context, Faults, Law};

/// Coulomb's law.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Coulomb {
    /// Relative permittivity of the medium.
    #[serde(default = "one")]
    pub relative_permittivity: f64,
}

fn one() -> f64 {
    1.0
}

impl Law for Coulomb {
    fn faults(&self, faults: &mut Faults, _: &Context<'_>) {
        faults.above_zero("relative_permittivity", self.relative_permittivity);
    }
}

impl NearLaw for Coulomb {
    #[inline]
    fn force(&self, a: &Source, b: &Source, distance: f64) -> f64 {
        self.energy(a, b, distance) / distance
    }

    /// Along the line of centers, where it is largest.
    #[inline]
    fn gradient(&self, a: &Source, b: &Source, distance: f64) -> f64 {
        2.0 * self.force(a, b, distance).abs() / distance
    }

    /// Zero at infinity.
    #[inline]
    fn energy(&self, a: &Source, b: &Source, distance: f64) -> f64 {
        a.charge * b.charge / (4.0 * PI * VACUUM_PERMITTIVITY * self.relative_permittivity * distance)
    }

    fn slowest_decay(&self) -> f64 {
        2.0
    }

    fn is_by_charge(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Coulomb's constant 8.987551786e9 N m²/C² (CODATA 2022), ten digits.
    #[test]
    fn a_coulomb_a_metre_apart() {
        let one = Source { charge: 1.0, ..Source::default() };
        let minus = Source { charge: -1.0, ..Source::default() };
        let law = Coulomb { relative_permittivity: 1.0 };
        assert_close!(law.force(&one, &one, 1.0), 8.987_551_786e9, 1e-9, "in N");
        assert_eq!(law.force(&one, &minus, 1.0), -law.force(&one, &one, 1.0));
        let water = Coulomb { relative_permittivity: 80.0 };
        assert_close!(water.force(&one, &one, 2.0) * 320.0, law.force(&one, &one, 1.0), 1e-15);
    }
}
