//! Hertz contact: elastic repulsion of two smooth spheres.
//!
//! # Equation
//! ```text
//! F = (4/3) E* √R* δ^(3/2),   U = (8/15) E* √R* δ^(5/2),   dF/dδ = 2 E* √(R* δ)           [A] 70
//! ```
//!
//! # Source
//! K. L. Johnson, *Contact Mechanics* (1985), section 4.2; [A] T. I. Zohdi, Comput. Mech. 57, 465 (2016).
//!
//! # Symbols
//! | symbol | name in code        | unit | meaning                                       |
//! |--------|---------------------|------|-----------------------------------------------|
//! | δ      | `overlap`           | m    | R_i + R_j - distance, > 0 in contact          |
//! | R*     | `effective_radius`  | m    | R_i R_j / (R_i + R_j)                         |
//! | E*     | `effective_modulus` | Pa   | 1/E* = (1-ν_i²)/E_i + (1-ν_j²)/E_j            |
//! | F      | `force`             | N    | repulsion                                     |
//! | U      | `energy`            | J    | stored                                        |
//!
//! # Critical step
//! ω² = k/m* at the largest overlap that the limits allow, of each grain with the smallest and the largest, not
//! below Rayleigh's (2/T)², T = π R √(ρ/G)/(0.1631 ν + 0.8766); looked at every 100 steps.
//!
//! # Valid when
//! δ ≪ R*, no adhesion, no plasticity, impact slower than the sound in the grains.
//!
//! # Compared with others
//! The same elastic part as `hertz` of LIGGGHTS and `hertz/material` of LAMMPS. The contact radius is
//! √(R* δ); the disc of [`ContactGeometry::area`] is twice as large as its circle.
//!
//! # In a scenario
//! ```toml
//! [materials.grain]
//! youngs_modulus = "70 GPa"
//! poisson_ratio = 0.22
//!
//! [contact.normal.hertz]
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::contact::{PairConstants, ContactGeometry, normal::{Hertz, NormalLaw}};
//! let pair = PairConstants { effective_modulus: 1e9, ..Default::default() };
//! let geometry = ContactGeometry { overlap: 1e-6, effective_radius: 1e-3, ..Default::default() };
//! let by_hand = 4.0 / 3.0 * 1e9 * (1e-3_f64).sqrt() * (1e-6_f64).powf(1.5);
//! assert!((Hertz {}.force(&pair, &geometry) / by_hand - 1.0).abs() < 1e-14);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::NormalLaw;
use crate::contact::{ContactGeometry, PairConstants};
use crate::law::{Law, Needs};
use crate::math::{Pace, Real};
use crate::particles::property::{POISSON_RATIO, YOUNGS_MODULUS};
use crate::particles::{Material, Property};

/// Hertz contact; its only constants are the materials' Young's moduli and Poisson's ratios.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Hertz {}

impl Law for Hertz {
    const READS: &'static [Property] = &[YOUNGS_MODULUS, POISSON_RATIO];

    fn needs(&self) -> Needs {
        Needs::always(Self::READS)
    }
}

impl NormalLaw for Hertz {
    #[inline(always)]
    fn force<F: Real>(&self, pair: &PairConstants<F>, geometry: &ContactGeometry<F>) -> F {
        F::of(2.0 / 3.0) * geometry.overlap * self.tangent_stiffness(pair, geometry)
    }

    fn energy(&self, pair: &PairConstants, geometry: &ContactGeometry) -> f64 {
        0.4 * geometry.overlap * self.force(pair, geometry)
    }

    #[inline(always)]
    fn tangent_stiffness<F: Real>(&self, pair: &PairConstants<F>, geometry: &ContactGeometry<F>) -> F {
        F::of(2.0) * pair.effective_modulus * (geometry.effective_radius * geometry.overlap).sqrt()
    }

    #[inline]
    fn exponent(&self) -> f64 {
        1.5
    }

    /// Rayleigh's wave: the time π R √(ρ/G)/(0.1631 ν + 0.8766) of Y. Li, Y. Xu and C. Thornton, Powder Technol. 160, 219
    /// (2005), as a critical step. Nothing for a material without a Young's modulus.
    fn wave_pace(&self, material: &Material, radius: f64) -> Pace {
        let Some(modulus) = material.youngs_modulus else { return Pace::NONE };
        let poisson = material.poisson_ratio.unwrap_or(0.0);
        let shear = modulus.si() / (2.0 * (1.0 + poisson));
        let time = std::f64::consts::PI * radius * (material.density.si() / shear).sqrt()
            / (0.1631 * poisson + 0.8766);
        Pace { square: 4.0 / (time * time), rate: 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::collision::HeadOn;
    use crate::contact::normal::Normal;

    /// Chung and Ooi (2011), test 1: two equal spheres of radius 10 mm at +-10 m/s; overlap, force and duration.
    #[test]
    fn val_chung_ooi_2011_two_spheres() {
        let cases = [
            ("glass", 48e9, 0.20, 2800.0, [274.11e-6, 10.697e3, 40.34e-6]),
            ("limestone", 20e9, 0.25, 2500.0, [368.30e-6, 7.108e3, 54.20e-6]),
        ];
        for (name, modulus, poisson, density, expected) in cases {
            let mass = density * 4.0 / 3.0 * std::f64::consts::PI * 1e-6;
            let effective_modulus = modulus / (2.0 * (1.0 - poisson * poisson));
            let rebound = HeadOn {
                pair: PairConstants { effective_modulus, ..Default::default() },
                geometry: ContactGeometry::new([0.01; 2], [mass; 2], [0.0; 2], 0.02),
                normal: &Normal::Hertz(Hertz {}),
                damping: None,
                speed: 20.0,
            }
            .integrate(2e-9);
            let found = [rebound.largest_overlap, rebound.largest_force, rebound.duration];
            for (value, wanted) in found.iter().zip(expected) {
                // Half a unit of the last published digit is 2e-4 at most.
                assert!((value / wanted - 1.0).abs() < 2e-4, "{name}: {value} {wanted}");
            }
        }
    }
}
