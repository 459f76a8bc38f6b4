//! Materials, and what pairs of them have in common.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::contact::PairConstants;
use crate::units::{Density, Pressure, Temperature, Velocity};

/// What grains are made of. A property that no law of the scenario uses can be left out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Density.
    pub density: Density,
    /// Speed of sound, for rays.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sound_speed: Option<Velocity>,
    /// Young's modulus, for Hertz contact.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub youngs_modulus: Option<Pressure>,
    /// Poisson's ratio, for Hertz contact and Mindlin friction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub poisson_ratio: Option<f64>,
    /// Contact stiffness K, for `strain_power`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact_stiffness: Option<Pressure>,
    /// How heat softens the contact stiffness; not at all if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub softening: Option<Softening>,
}

/// K = max(K0 exp(-a (T/T* - 1)), K_lim) ([A] 35-36).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Softening {
    /// T*: the temperature at which the stiffness is K0.
    pub reference_temperature: Temperature,
    /// a.
    pub sensitivity: f64,
    /// K_lim.
    pub lowest_stiffness: Pressure,
}

/// Properties that belong to a pair of materials and override those of the laws.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mixture {
    /// The two materials' names.
    pub between: [String; 2],
    /// Normal restitution.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f64>,
    /// Static friction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub static_friction: Option<f64>,
    /// Dynamic friction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dynamic_friction: Option<f64>,
}

impl Material {
    /// Contact stiffness [Pa] at a temperature [K]; 0 where the material has none.
    pub fn stiffness_at(&self, temperature: f64) -> f64 {
        let cold = self.contact_stiffness.map_or(0.0, |stiffness| stiffness.si());
        match &self.softening {
            None => cold,
            Some(law) => {
                let hotter = temperature / law.reference_temperature.si() - 1.0;
                (cold * (-law.sensitivity * hotter).exp()).max(law.lowest_stiffness.si())
            }
        }
    }
}

/// The constants of every pair of materials, by their numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PairTable {
    count: usize,
    pairs: Vec<PairConstants>,
}

impl PairTable {
    /// Works out the table; materials are numbered in the order of the map.
    pub fn new(materials: &BTreeMap<String, Material>, mixtures: &[Mixture]) -> Self {
        let names: Vec<&String> = materials.keys().collect();
        let count = names.len();
        let mut pairs = Vec::with_capacity(count * count);
        for a in &names {
            for b in &names {
                let own = mixtures.iter().find(|mixture| {
                    let [c, d] = &mixture.between;
                    (c == *a && d == *b) || (c == *b && d == *a)
                });
                pairs.push(constants_of(&materials[*a], &materials[*b], own));
            }
        }
        Self { count, pairs }
    }

    /// The constants of the materials with these numbers.
    #[inline]
    pub fn of(&self, a: u32, b: u32) -> &PairConstants {
        &self.pairs[a as usize * self.count + b as usize]
    }
}

fn constants_of(a: &Material, b: &Material, own: Option<&Mixture>) -> PairConstants {
    let mut constants = PairConstants::default();
    if let (Some(ea), Some(eb)) = (a.youngs_modulus, b.youngs_modulus) {
        let (va, vb) = (a.poisson_ratio.unwrap_or(0.0), b.poisson_ratio.unwrap_or(0.0));
        let (ea, eb) = (ea.si(), eb.si());
        constants.effective_modulus = 1.0 / ((1.0 - va * va) / ea + (1.0 - vb * vb) / eb);
        let shear = 1.0 / (2.0 * (2.0 - va) * (1.0 + va) / ea + 2.0 * (2.0 - vb) * (1.0 + vb) / eb);
        constants.tangential_ratio = 4.0 * shear / constants.effective_modulus;
    }
    if let Some(own) = own {
        constants.restitution = own.restitution;
        constants.static_friction = own.static_friction;
        constants.dynamic_friction = own.dynamic_friction;
    }
    constants
}
