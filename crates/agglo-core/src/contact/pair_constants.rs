//! What two materials have in common in contact.

use crate::math::lanes::Lanes;
use crate::particles::Material;

/// The constants of a pair of materials, ready for the laws: what a law has by itself, or the pair instead.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PairConstants<F = f64> {
    /// E* [Pa]: 1/E* = (1-ν_i²)/E_i + (1-ν_j²)/E_j.
    pub effective_modulus: F,
    /// Tangential over normal contact stiffness; 4 G*/E* (Mindlin) if the law has none of its own.
    pub tangential_ratio: F,
    /// Part of critical damping [-] that gives the restitution.
    pub damping_ratio: F,
    /// Static friction [-].
    pub static_friction: F,
    /// Dynamic friction [-].
    pub dynamic_friction: F,
}

impl<F: Lanes> PairConstants<F> {
    /// The same in every lane.
    #[inline(always)]
    pub fn of(one: &PairConstants) -> Self {
        Self {
            effective_modulus: F::of(one.effective_modulus),
            tangential_ratio: F::of(one.tangential_ratio),
            damping_ratio: F::of(one.damping_ratio),
            static_friction: F::of(one.static_friction),
            dynamic_friction: F::of(one.dynamic_friction),
        }
    }

    /// Those of a pair for each lane.
    #[inline(always)]
    pub fn from_lanes<'a>(pair: impl Fn(usize) -> &'a PairConstants) -> Self {
        Self {
            effective_modulus: F::from_lanes(|lane| pair(lane).effective_modulus),
            tangential_ratio: F::from_lanes(|lane| pair(lane).tangential_ratio),
            damping_ratio: F::from_lanes(|lane| pair(lane).damping_ratio),
            static_friction: F::from_lanes(|lane| pair(lane).static_friction),
            dynamic_friction: F::from_lanes(|lane| pair(lane).dynamic_friction),
        }
    }

    /// Those in a lane.
    #[inline(always)]
    pub fn lane(&self, lane: usize) -> PairConstants {
        PairConstants {
            effective_modulus: self.effective_modulus.lane(lane),
            tangential_ratio: self.tangential_ratio.lane(lane),
            damping_ratio: self.damping_ratio.lane(lane),
            static_friction: self.static_friction.lane(lane),
            dynamic_friction: self.dynamic_friction.lane(lane),
        }
    }
}

impl PairConstants {
    /// What follows from the elastic constants of two materials; 0 where one has none.
    pub(super) fn of_elastic(a: &Material, b: &Material) -> Self {
        let mut constants = Self::default();
        if let (Some(ea), Some(eb)) = (a.youngs_modulus, b.youngs_modulus) {
            let (va, vb) = (a.poisson_ratio.unwrap_or(0.0), b.poisson_ratio.unwrap_or(0.0));
            let (ea, eb) = (ea.si(), eb.si());
            constants.effective_modulus = 1.0 / ((1.0 - va * va) / ea + (1.0 - vb * vb) / eb);
            let shear = 1.0 / (2.0 * (2.0 - va) * (1.0 + va) / ea + 2.0 * (2.0 - vb) * (1.0 + vb) / eb);
            constants.tangential_ratio = 4.0 * shear / constants.effective_modulus;
        }
        constants
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::units::Quantity;

    pub(in crate::contact) fn material(modulus: f64, poisson: f64) -> Material {
        Material {
            density: Quantity(2000.0),
            youngs_modulus: Some(Quantity(modulus)),
            poisson_ratio: Some(poisson),
            ..Material::default()
        }
    }

    /// Equal materials: E* = E/(2 (1-ν²)), κ = 2 (1-ν)/(2-ν); against a rigid one both as 1/E -> 0.
    #[test]
    fn pair_constants_in_closed_form() {
        for poisson in [0.0, 0.2, 0.3, 0.5] {
            let equal = PairConstants::of_elastic(&material(4e10, poisson), &material(4e10, poisson));
            let modulus = 2e10 / (1.0 - poisson * poisson);
            assert_close!(equal.effective_modulus, modulus, 1e-14);
            let ratio = 2.0 * (1.0 - poisson) / (2.0 - poisson);
            assert_close!(equal.tangential_ratio, ratio, 1e-14);
            let rigid = PairConstants::of_elastic(&material(4e10, poisson), &material(1e40, 0.1));
            assert_close!(rigid.effective_modulus, 2.0 * modulus, 1e-14);
        }
        // By hand: 0.96/70e9 + 0.91/40e9 and 2 (1.8·1.2/70e9 + 1.7·1.3/40e9).
        let unlike = PairConstants::of_elastic(&material(7e10, 0.2), &material(4e10, 0.3));
        let modulus = 1.0 / (0.96 / 7e10 + 0.91 / 4e10);
        let shear = 0.5 / (2.16 / 7e10 + 2.21 / 4e10);
        assert_close!(unlike.effective_modulus, modulus, 1e-14);
        assert_close!(unlike.tangential_ratio, 4.0 * shear / modulus, 1e-14);
    }
}
