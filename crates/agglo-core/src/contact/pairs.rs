//! What pairs of materials have in common in contact, worked out once for each pair.

use std::collections::BTreeMap;

use super::laws::ContactLaws;
use super::pair_constants::PairConstants;
use crate::particles::{Material, Mixture};

/// The constants of every pair of materials, by their numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PairTable {
    count: usize,
    pairs: Vec<PairConstants>,
}

impl PairTable {
    /// Works out the table for laws of contact; materials are numbered in the order of the map.
    pub fn new(
        materials: &BTreeMap<String, Material>,
        mixtures: &[Mixture],
        laws: Option<&ContactLaws>,
    ) -> Self {
        let count = materials.len();
        let mut pairs = Vec::with_capacity(count * count);
        for (a, one) in materials {
            for (b, other) in materials {
                let mut constants = PairConstants::of_elastic(one, other);
                if let Some(laws) = laws {
                    laws.settle(&mut constants, Mixture::of(mixtures, a, b));
                }
                pairs.push(constants);
            }
        }
        Self { count, pairs }
    }

    /// The constants of all pairs where there is one material alone.
    pub fn only(&self) -> Option<&PairConstants> {
        if let [only] = &self.pairs[..] { Some(only) } else { None }
    }

    /// The constants of the materials with these numbers.
    #[inline]
    pub fn of(&self, a: u32, b: u32) -> &PairConstants {
        &self.pairs[a as usize * self.count + b as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::damping::{Damping, Restitution, damping_ratio};
    use crate::contact::friction::{Friction, Mindlin};
    use crate::contact::normal::{Hertz, Normal};
    use crate::contact::pair_constants::tests::material;

    /// What a pair of materials has by itself takes the place of what the laws say, for that pair alone.
    #[test]
    fn the_table_is_symmetric_and_knows_mixtures() {
        let names = ["clay", "sand", "steel"].map(str::to_owned);
        let of = [material(1e9, 0.1), material(7e10, 0.2), material(2e11, 0.3)];
        let materials: BTreeMap<String, Material> = names.iter().cloned().zip(of).collect();
        let mixture = Mixture {
            between: [names[2].clone(), names[0].clone()],
            restitution: Some(0.6),
            static_friction: None,
            dynamic_friction: Some(0.2),
        };
        let laws = ContactLaws {
            normal: Some(Normal::Hertz(Hertz {})),
            custom: None,
            damping: Some(Damping::Restitution(Restitution { restitution: 0.9 })),
            friction: Some(Friction::Mindlin(Mindlin {
                static_friction: 0.5,
                dynamic_friction: None,
                stiffness_ratio: None,
                dashpot: 0.0,
            })),
        };
        let table = PairTable::new(&materials, &[mixture], Some(&laws));
        for a in 0..3 {
            for b in 0..3 {
                let (pair, mirrored) = (table.of(a, b), table.of(b, a));
                assert_eq!(pair.damping_ratio, mirrored.damping_ratio);
                assert_near!(pair.effective_modulus / mirrored.effective_modulus, 1.0, 1e-15);
                let of_its_own = a + b == 2 && a != b;
                let restitution = if of_its_own { 0.6 } else { 0.9 };
                assert_eq!(pair.damping_ratio, damping_ratio(restitution), "pair {a} {b}");
                assert_eq!(pair.dynamic_friction, if of_its_own { 0.2 } else { 0.5 }, "pair {a} {b}");
                assert_eq!(pair.static_friction, 0.5);
            }
        }
    }
}
