//! Attraction beyond a critical overlap strain.
//!
//! # Equation
//! ```text
//! ℰ >= ℰ*:  F_i = K_nb ℰ^pb A n   and   K_rb |v_t| A Δt τ                                  [A] 25, 26
//! U(δ) = -∫ K_nb ℰ^pb A dδ from δ* = ℰ* (R_i + R_j) to δ
//! ```
//!
//! # Source
//! [A] T. I. Zohdi, Comput. Mech. 57, 465 (2016), eqs 25-26.
//!
//! # Symbols
//! | symbol | name in code           | unit | meaning                                            |
//! |--------|------------------------|------|----------------------------------------------------|
//! | K_nb   | `stiffness`            | Pa   | normal bonding constant                            |
//! | p_b    | `exponent`             | -    | power of the strain                                |
//! | K_rb   | `tangential_stiffness` | Pa/m | tangential bonding constant                        |
//! | ℰ*     | `threshold_strain`     | -    | overlap strain from which the bond acts            |
//! | ℰ      | `geometry.strain()`       | -    | overlap over the sum of the radii                  |
//! | A      | `geometry.area()`         | m²   | disc in which the spheres cut each other           |
//! | τ      |                        | -    | direction of j's slip relative to i                |
//!
//! # Critical step
//! ω² = 4 (7/2) K A/m* across the contact, at the overlap of the moment; looked at every step.
//!
//! # Valid when
//! To reproduce the paper only. The bond acts while grains overlap, so it cannot resist tension; with
//! K_nb < K and p_b = p, as in the paper's example, contact and bond together always repel and nothing holds
//! an agglomerate together. The tangential part carries the time step and vanishes with it. The paper does
//! not give ℰ*.
//!
//! # Compared with others
//! Not an adhesive: see `beam` for cement that carries tension.
//!
//! # In a scenario
//! ```toml
//! [bonds.strain_bond]
//! stiffness = "1 MPa"
//! exponent = 2.0
//! tangential_stiffness = "1e9 Pa/m"
//! threshold_strain = 0.001
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::contact::{ContactGeometry, bond::StrainBond};
//! use agglo::units::Quantity;
//! let bond = StrainBond {
//!     stiffness: Quantity(1e6), exponent: 2.0, tangential_stiffness: Quantity(1e3), threshold_strain: 0.05,
//! };
//! let geometry = ContactGeometry::new([1.0, 1.0], [1.0, 1.0], [1e7, 1e7], 1.8);
//! assert!((bond.attraction(&geometry) / (1e6 * 0.01 * geometry.area()) - 1.0).abs() < 1e-12);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::contact::normal::NormalLaw;
use crate::contact::normal::strain_power::{StrainPower, strain_power};
use crate::contact::{ContactGeometry, PairConstants};
use crate::law::{Context, Faults, Law};
use crate::math::{Pace, Real};
use crate::units::{AreaStiffness, Pressure};

/// K_nb E^pb A toward the partner, and K_rb |v_t| A dt along the slip, while E >= E*.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StrainBond {
    /// K_nb: stiffness along the normal.
    pub stiffness: Pressure,
    /// Power p_b of the strain.
    pub exponent: f64,
    /// K_rb: stiffness across it, per contact area.
    pub tangential_stiffness: AreaStiffness,
    /// ℰ*: overlap strain from which the bond acts, from 0 to 1.
    pub threshold_strain: f64,
}

impl Law for StrainBond {
    fn faults(&self, faults: &mut Faults, _: &Context<'_>) {
        faults.not_negative("stiffness", self.stiffness);
        faults.not_negative("tangential_stiffness", self.tangential_stiffness);
        faults.exponent("exponent", self.exponent);
        faults.within("threshold_strain", self.threshold_strain, 0.0, 1.0);
    }

    fn notes(&self, _: &Context<'_>) -> Vec<String> {
        let note = "bonds.strain_bond acts only between overlapping grains, cannot resist tension, and its tangential part is proportional to the step; beam bonds hold grains together";
        vec![note.to_owned()]
    }

    fn warnings(&self) -> &'static [&'static str] {
        &[
            "bonds.strain_bond acts in contact only: it cannot resist tension, and its tangential force carries \
           the time step",
        ]
    }
}

impl StrainBond {
    /// Where the bond acts: in contact, from its threshold on.
    #[inline(always)]
    pub fn acts<F: Real>(&self, geometry: &ContactGeometry<F>) -> F::Mask {
        let is_pressed = (F::of(self.threshold_strain) * geometry.radius_sum).at_most(geometry.overlap);
        F::both(F::of(0.0).below(geometry.overlap), is_pressed)
    }

    /// Attraction [N], zero below the threshold.
    #[inline(always)]
    pub fn attraction<F: Real>(&self, geometry: &ContactGeometry<F>) -> F {
        let strain = geometry.strain().max(F::of(0.0));
        let force = F::of(self.stiffness.si()) * strain_power(strain, self.exponent) * geometry.area();
        F::select(self.acts(geometry), force, F::of(0.0))
    }

    /// Energy [J], zero up to the threshold and negative beyond, since the bond attracts.
    pub fn energy(&self, geometry: &ContactGeometry) -> f64 {
        if !self.acts(geometry) {
            return 0.0;
        }
        let threshold =
            ContactGeometry { overlap: self.threshold_strain.max(0.0) * geometry.radius_sum, ..*geometry };
        let integral = geometry.strain_integral(self.exponent) - threshold.strain_integral(self.exponent);
        -self.stiffness.si() * integral
    }

    /// Tangential force [N] along the relative tangential velocity, from the slip speed [m/s] and the step
    /// [s]. All of its work is lost.
    #[inline(always)]
    pub fn tangential<F: Real>(&self, geometry: &ContactGeometry<F>, slip_speed: F, dt: F) -> F {
        let force = F::of(self.tangential_stiffness.si()) * slip_speed * geometry.area() * dt;
        F::select(self.acts(geometry), force, F::of(0.0))
    }

    /// How fast the bond is at this overlap: its attraction, or its tangential part, which carries the step as that of
    /// `regularized` does.
    pub fn pace(&self, geometry: &ContactGeometry) -> Pace {
        if !self.acts(geometry) {
            return Pace::NONE;
        }
        let bonding = ContactGeometry { stiffness: self.stiffness.si(), ..*geometry };
        let along = StrainPower { exponent: self.exponent }.pace(&PairConstants::default(), &bonding);
        let tangential = 4.0 * self.tangential_stiffness.si() * geometry.area();
        along.max(Pace::of_spring(tangential, geometry.sliding_mass()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::PairConstants;
    use crate::contact::check::assert_slope;
    use crate::contact::normal::StrainPower;
    use crate::units::Quantity;

    fn bond(exponent: f64) -> StrainBond {
        let (stiffness, tangential_stiffness) = (Quantity(1e6), Quantity(1e3));
        StrainBond { stiffness, exponent, tangential_stiffness, threshold_strain: 0.05 }
    }

    #[test]
    fn attraction_is_minus_the_slope_of_energy() {
        for exponent in [1.0, 2.0, 2.5] {
            for radii in [[1.0, 1.0], [1e-3, 3e-3]] {
                let geometry = |overlap| ContactGeometry {
                    overlap,
                    ..ContactGeometry::new(radii, [1.0; 2], [1e7; 2], radii[0] + radii[1])
                };
                let law = bond(exponent);
                for strain in [0.06, 0.1, 0.2] {
                    let at = strain * (radii[0] + radii[1]);
                    assert_slope(at, |x| law.energy(&geometry(x)), |x| -law.attraction(&geometry(x)));
                }
            }
        }
    }

    #[test]
    fn threshold() {
        let at =
            |overlap| ContactGeometry { overlap, ..ContactGeometry::new([1.0; 2], [1.0; 2], [1e7; 2], 2.0) };
        let law = bond(2.0);
        assert_eq!([law.attraction(&at(0.0999)), law.energy(&at(0.0999))], [0.0, 0.0]);
        assert_eq!(law.energy(&at(0.1)), 0.0);
        assert_eq!(law.tangential(&at(0.0999), 1.0, 1.0), 0.0);
        let area = std::f64::consts::PI * (1.0 - 0.81);
        assert_close!(law.tangential(&at(0.2), 2.0, 1e-3), 1e3 * 2.0 * 1e-3 * area, 1e-14);
    }

    /// With the paper's numbers the sum of contact and bond repels at every overlap.
    #[test]
    fn the_papers_bond_never_wins() {
        let contact = StrainPower { exponent: 2.0 };
        for overlap in [0.1, 0.2, 0.5, 1.0] {
            let geometry =
                ContactGeometry { overlap, ..ContactGeometry::new([1.0; 2], [1.0; 2], [1e7; 2], 2.0) };
            let sum = contact.force(&PairConstants::default(), &geometry) - bond(2.0).attraction(&geometry);
            assert_close!(sum, 9e6 * geometry.strain().powi(2) * geometry.area(), 1e-12);
        }
    }
}
