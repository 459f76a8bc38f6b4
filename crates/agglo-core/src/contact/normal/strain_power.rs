//! Repulsion from the power of an overlap strain over the contact area.
//!
//! # Equation
//! ```text
//! F = K ℰ^p A,   ℰ = δ/(R_i + R_j),   U = ∫ K ℰ^p A dδ                                    [A] 13-15
//! ```
//!
//! # Source
//! [A] T. I. Zohdi, Comput. Mech. 57, 465 (2016), eqs 11-15; A from eqs 64-69, see [`ContactGeometry::area`].
//!
//! # Symbols
//! | symbol | name in code      | unit | meaning                                                    |
//! |--------|-------------------|------|------------------------------------------------------------|
//! | K      | `geometry.stiffness` | Pa   | mean of the grains' `contact_stiffness`, softened by heat  |
//! | p      | `exponent`        | -    | power of the strain, > -1                                  |
//! | ℰ      | `geometry.strain()`  | -    | overlap over the sum of the radii                          |
//! | A      | `geometry.area()`    | m²   | disc in which the spheres cut each other                   |
//!
//! # Critical step
//! ω² = k/m* at the largest overlap that the limits allow, of each grain with the smallest and the largest; looked
//! at every 100 steps.
//!
//! # Valid when
//! The contact is a model of a soft coating or of crushed asperities; K is fitted, not a material's modulus.
//! Nothing in the law itself limits the strain. For unequal spheres the force falls again once the smaller
//! one is nearly swallowed, and vanishes where it is.
//!
//! # Compared with others
//! The law of the paper and of its author's books; no other public code has it. Near touching
//! F = 2 π K R* δ^(p+1) / (R_i + R_j)^p: for p = 2 a force that grows like δ³, far softer at first than Hertz.
//!
//! # In a scenario
//! ```toml
//! [materials.grain]
//! contact_stiffness = "10 MPa"
//! softening = { reference_temperature = "500 K", sensitivity = 1.0, lowest_stiffness = "1 MPa" }
//!
//! [contact.normal.strain_power]
//! exponent = 2.0
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::contact::{PairConstants, ContactGeometry, normal::{NormalLaw, StrainPower}};
//! let geometry = ContactGeometry::new([1.0, 1.0], [1.0, 1.0], [1e7, 1e7], 1.8);
//! let by_hand = 1e7 * 0.1 * 0.1 * std::f64::consts::PI * (1.0 - 0.81);
//! let force = StrainPower { exponent: 2.0 }.force(&PairConstants::default(), &geometry);
//! assert!((force / by_hand - 1.0).abs() < 1e-14);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::NormalLaw;
use crate::contact::{ContactGeometry, PairConstants};
use crate::law::{Context, Faults, Law, Needs};
use crate::math::{Pace, Real};
use crate::particles::Property;
use crate::particles::property::{CONTACT_STIFFNESS, SOFTENING};

/// F = K E^p A; K is the materials' `contact_stiffness`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StrainPower {
    /// Power p of the strain.
    #[serde(default = "two")]
    pub exponent: f64,
}

fn two() -> f64 {
    2.0
}

/// strain^exponent, with the usual square worked out directly.
#[inline(always)]
pub(in crate::contact) fn strain_power<F: Real>(strain: F, exponent: f64) -> F {
    if exponent == 2.0 { strain * strain } else { strain.powf(exponent) }
}

impl Law for StrainPower {
    const READS: &'static [Property] = &[CONTACT_STIFFNESS, SOFTENING];

    fn needs(&self) -> Needs {
        Needs::always(&[CONTACT_STIFFNESS])
    }

    fn faults(&self, faults: &mut Faults, _: &Context<'_>) {
        faults.exponent("exponent", self.exponent);
    }
}

impl NormalLaw for StrainPower {
    #[inline(always)]
    fn force<F: Real>(&self, _: &PairConstants<F>, geometry: &ContactGeometry<F>) -> F {
        geometry.stiffness * strain_power(geometry.strain(), self.exponent) * geometry.area()
    }

    fn energy(&self, _: &PairConstants, geometry: &ContactGeometry) -> f64 {
        geometry.stiffness * geometry.strain_integral(self.exponent)
    }

    /// Negative where a much smaller grain is nearly swallowed.
    #[inline(always)]
    fn tangent_stiffness<F: Real>(&self, _: &PairConstants<F>, geometry: &ContactGeometry<F>) -> F {
        let growth = F::of(self.exponent) * geometry.area_over_overlap() + geometry.area_slope();
        geometry.stiffness * strain_power(geometry.strain(), self.exponent) * growth
    }

    /// How fast the contact is at this overlap or on the way to it: that of unequal grains is stiffest before the
    /// smaller one is swallowed.
    fn pace(&self, pair: &PairConstants, geometry: &ContactGeometry) -> Pace {
        let at = |part: f64| {
            self.tangent_stiffness(pair, &ContactGeometry { overlap: part * geometry.overlap, ..*geometry })
        };
        let stiffest = [1.0, 0.75, 0.5, 0.25].map(at).into_iter().fold(0.0, f64::max);
        Pace::of_spring(stiffest, geometry.effective_mass)
    }

    /// The force grows like overlap^(p+1), since the area grows like the overlap.
    #[inline]
    fn exponent(&self) -> f64 {
        self.exponent + 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Near touching F = 2 π K R* δ³ / S² for p = 2; the next term is of relative order δ/R* = 1e-8.
    #[test]
    fn limit_near_touching() {
        let (radii, overlap) = ([0.05, 0.02], 1e-10);
        let geometry = ContactGeometry::new(radii, [1.0; 2], [2e7, 4e7], 0.07 - overlap);
        let effective = 0.05 * 0.02 / 0.07;
        let delta = geometry.overlap;
        let by_hand = 2.0 * std::f64::consts::PI * 3e7 * effective * delta.powi(3) / (0.07 * 0.07);
        let law = StrainPower { exponent: 2.0 };
        assert_close!(law.force(&PairConstants::default(), &geometry), by_hand, 1e-7, "in N");
        let ratio = law.tangent_stiffness(&PairConstants::default(), &geometry) * delta / by_hand;
        assert_near!(ratio, 3.0, 1e-6);
    }
}
