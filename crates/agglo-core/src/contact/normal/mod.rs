//! Elastic laws along the line of centers; what a law takes away is the business of [`super::damping`].

mod hertz;
mod hooke;
mod law;
pub(in crate::contact) mod strain_power;

pub use law::NormalLaw;

use super::{ContactGeometry, PairConstants};
use crate::math::{Pace, Real};
use crate::particles::Material;

family! {
    /// The closed set of elastic normal laws.
    pub enum Normal at "contact.normal", pages in "contact/normal", each by each_normal ($) {
        StrainPower in strain_power: "Force from the power of a strain over the contact area (Zohdi 2016, eqs 11-15).";
        Hertz in hertz: "Hertz.";
        Hooke in hooke: "Linear spring.";
    }
}

impl Normal {
    /// Repulsion [N].
    #[inline(always)]
    pub fn force<F: Real>(&self, pair: &PairConstants<F>, geometry: &ContactGeometry<F>) -> F {
        each_normal!(self, law => law.force(pair, geometry))
    }

    /// Energy stored [J]; the force is its slope over the overlap.
    pub fn energy(&self, pair: &PairConstants, geometry: &ContactGeometry) -> f64 {
        each_normal!(self, law => law.energy(pair, geometry))
    }

    /// Slope of the force over the overlap [N/m].
    #[inline(always)]
    pub fn tangent_stiffness<F: Real>(&self, pair: &PairConstants<F>, geometry: &ContactGeometry<F>) -> F {
        each_normal!(self, law => law.tangent_stiffness(pair, geometry))
    }

    /// How fast a contact is that reaches this overlap.
    pub fn pace(&self, pair: &PairConstants, geometry: &ContactGeometry) -> Pace {
        each_normal!(self, law => law.pace(pair, geometry))
    }

    /// How fast a wave crosses a grain of this radius [m], where a step must not outrun it either.
    pub fn wave_pace(&self, material: &Material, radius: f64) -> Pace {
        each_normal!(self, law => law.wave_pace(material, radius))
    }

    /// n where the force grows like overlap^n at small overlap.
    #[inline]
    pub fn exponent(&self) -> f64 {
        each_normal!(self, law => law.exponent())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::check::assert_slope;
    use crate::units::Quantity;

    fn every_law() -> Vec<Normal> {
        let powers = [1.0, 1.5, 2.0, 3.0].map(|exponent| Normal::StrainPower(StrainPower { exponent }));
        let mut laws = powers.to_vec();
        laws.push(Normal::Hertz(Hertz {}));
        laws.push(Normal::Hooke(Hooke { stiffness: Quantity(2e4) }));
        laws
    }

    #[test]
    fn force_is_the_slope_of_energy_and_stiffness_that_of_force() {
        let pair = PairConstants { effective_modulus: 3e9, ..Default::default() };
        for law in every_law() {
            for radii in [[1.0, 1.0], [1e-3, 4e-3], [5e-6, 1e-4]] {
                let geometry = |overlap| ContactGeometry {
                    overlap,
                    ..ContactGeometry::new(radii, [1.0, 2.0], [1e7, 3e7], radii[0] + radii[1])
                };
                for part in [1e-5, 1e-2, 0.2, 0.9] {
                    let at = part * radii[0];
                    let force = |x| law.force(&pair, &geometry(x));
                    assert_slope(at, |x| law.energy(&pair, &geometry(x)), force);
                    assert_slope(at, force, |x| law.tangent_stiffness(&pair, &geometry(x)));
                }
            }
        }
    }

    /// At touching all laws give nothing, and at tiny overlap force grows like overlap^exponent (1e-6: O(δ/R)).
    #[test]
    fn edges_and_exponents() {
        let pair = PairConstants { effective_modulus: 3e9, ..Default::default() };
        for law in every_law() {
            let geometry = |overlap| ContactGeometry {
                overlap,
                ..ContactGeometry::new([1.0, 0.5], [1.0; 2], [1e7; 2], 1.5)
            };
            assert_eq!([law.force(&pair, &geometry(0.0)), law.energy(&pair, &geometry(0.0))], [0.0, 0.0]);
            assert_finite!(law.tangent_stiffness(&pair, &geometry(0.0)));
            let ratio = law.force(&pair, &geometry(2e-9)) / law.force(&pair, &geometry(1e-9));
            assert_near!(ratio.log2(), law.exponent(), 1e-6);
        }
    }
}
