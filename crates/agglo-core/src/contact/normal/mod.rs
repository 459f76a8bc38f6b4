//! Elastic laws along the line of centers; what a law takes away is the business of [`super::damping`].

mod hertz;
mod hooke;
pub(in crate::contact) mod strain_power;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use hertz::Hertz;
pub use hooke::Hooke;
pub use strain_power::StrainPower;

use super::{PairConstants, Touch};
use crate::math::Pace;

/// The closed set of elastic normal laws.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Normal {
    /// Force from the power of a strain over the contact area (Zohdi 2016, eqs 11-15).
    StrainPower(StrainPower),
    /// Hertz.
    Hertz(Hertz),
    /// Linear spring.
    Hooke(Hooke),
}

macro_rules! dispatch {
    ($self:ident, $law:ident => $call:expr) => {
        match $self {
            Normal::StrainPower($law) => $call,
            Normal::Hertz($law) => $call,
            Normal::Hooke($law) => $call,
        }
    };
}

impl Normal {
    /// Repulsion [N].
    #[inline]
    pub fn force(&self, pair: &PairConstants, touch: &Touch) -> f64 {
        dispatch!(self, law => law.force(pair, touch))
    }

    /// Energy stored [J]; the force is its slope over the overlap.
    pub fn energy(&self, pair: &PairConstants, touch: &Touch) -> f64 {
        dispatch!(self, law => law.energy(pair, touch))
    }

    /// Slope of the force over the overlap [N/m].
    #[inline]
    pub fn tangent_stiffness(&self, pair: &PairConstants, touch: &Touch) -> f64 {
        dispatch!(self, law => law.tangent_stiffness(pair, touch))
    }

    /// How fast a contact is that reaches this overlap.
    pub fn pace(&self, pair: &PairConstants, touch: &Touch) -> Pace {
        dispatch!(self, law => law.pace(pair, touch))
    }

    /// n where the force grows like overlap^n at small overlap.
    #[inline]
    pub fn exponent(&self) -> f64 {
        dispatch!(self, law => law.exponent())
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
                let touch = |overlap| Touch {
                    overlap,
                    ..Touch::new(radii, [1.0, 2.0], [1e7, 3e7], radii[0] + radii[1])
                };
                for part in [1e-5, 1e-2, 0.2, 0.9] {
                    let at = part * radii[0];
                    let force = |x| law.force(&pair, &touch(x));
                    assert_slope(at, |x| law.energy(&pair, &touch(x)), force);
                    assert_slope(at, force, |x| law.tangent_stiffness(&pair, &touch(x)));
                }
            }
        }
    }

    /// At touching all laws give nothing, and at tiny overlap force grows like overlap^exponent (1e-6: O(δ/R)).
    #[test]
    fn edges_and_exponents() {
        let pair = PairConstants { effective_modulus: 3e9, ..Default::default() };
        for law in every_law() {
            let touch = |overlap| Touch { overlap, ..Touch::new([1.0, 0.5], [1.0; 2], [1e7; 2], 1.5) };
            assert_eq!([law.force(&pair, &touch(0.0)), law.energy(&pair, &touch(0.0))], [0.0, 0.0]);
            assert_finite!(law.tangent_stiffness(&pair, &touch(0.0)));
            let ratio = law.force(&pair, &touch(2e-9)) / law.force(&pair, &touch(1e-9));
            assert_near!(ratio.log2(), law.exponent(), 1e-6);
        }
    }
}
