//! Materials, and what pairs of them have in common.
//!
//! # Equation
//! ```text
//! K(T) = max(K0 exp(-a (T/T* - 1)), K_lim);   a pair has (K_i + K_j)/2                     [A] 35-37
//! 1/E* = (1-ν_i²)/E_i + (1-ν_j²)/E_j                                                      A4
//! 1/G* = 2 (2-ν_i)(1+ν_i)/E_i + 2 (2-ν_j)(1+ν_j)/E_j,   κ = 4 G*/E*                       A6
//! ```
//! κ, tangential over normal contact stiffness, is 2 (1-ν)/(2-ν) for two equal materials.
//!
//! # Source
//! [A] T. I. Zohdi, Comput. Mech. 57, 465 (2016), eqs 35-37; K. L. Johnson, *Contact Mechanics* (1985),
//! sections 4.2 and 7.2.
//!
//! # Symbols
//! | symbol | name in code            | unit | meaning                                         |
//! |--------|-------------------------|------|-------------------------------------------------|
//! | K0     | `contact_stiffness`     | Pa   | contact stiffness at the temperature T*         |
//! | T*     | `reference_temperature` | K    |                                                 |
//! | a      | `sensitivity`           | -    | below T* the factor stiffens, above it softens  |
//! | K_lim  | `lowest_stiffness`      | Pa   | floor                                           |
//! | E*     | `effective_modulus`     | Pa   |                                                 |
//! | κ      | `tangential_ratio`      | -    |                                                 |
//! | ν      | `poisson_ratio`         | -    | 0 if left out                                   |
//!
//! # Valid when
//! The softening is an empirical fit. Temperatures do not change in soft-sphere runs: K is worked out at the
//! start. A material without Young's modulus gives E* = 0 and κ = 0: `hertz`, and `mindlin` without a
//! `stiffness_ratio`, must not be used with it.
//!
//! # Compared with others
//! With T = 300 K below T* = 500 K the paper's factor is above one: K = 1.492e7 Pa from K0 = 1e7 Pa.
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::particles::Material;
//! let clay: Material = serde_json::from_str(r#"{
//!     "density": "2000 kg/m3", "contact_stiffness": "10 MPa",
//!     "softening": {"reference_temperature": "500 K", "sensitivity": 1.0, "lowest_stiffness": "1 MPa"}
//! }"#).unwrap();
//! assert!((clay.stiffness_at(300.0) / (1e7 * 0.4_f64.exp()) - 1.0).abs() < 1e-14);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::units::{Conductivity, Density, Energy, Pressure, SpecificHeat, Stiffness, Temperature, Velocity};

/// What grains are made of. A property that no law of the scenario uses can be left out.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Density.
    pub density: Density,
    /// Speed of sound; `[acoustics]` needs it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sound_speed: Option<Velocity>,
    /// Speed of shear waves, for rays: solids are reflected from and pushed with both waves; below `sound_speed`
    /// times √3/2. To sound the material is a fluid if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shear_sound_speed: Option<Velocity>,
    /// Young's modulus, for `hertz`, and for `mindlin` without `stiffness_ratio`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub youngs_modulus: Option<Pressure>,
    /// Poisson's ratio, for `hertz`, and for `mindlin` without `stiffness_ratio`; from 0 to 0.5.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub poisson_ratio: Option<f64>,
    /// Contact stiffness K, for `strain_power`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact_stiffness: Option<Pressure>,
    /// How heat softens the contact stiffness; not at all if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub softening: Option<Softening>,
    /// Heat capacity C; `reaction_heat`, `activation_energy` and `[impact.cooling]` need it, and without it the
    /// temperature stays.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heat_capacity: Option<SpecificHeat>,
    /// H0: hardness in the limit of great heat, for `impact.restitution.hardness`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardness: Option<Pressure>,
    /// Q: activation energy of softening by heat, per mole, 0 or more; the hardness at T is H0 exp(Q/(R T)). 0 if
    /// left out.
    #[schemars(extend("x-unit" = "J/mol"))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub activation_energy: Option<Energy>,
    /// α: heat of reaction per contact area, 0 or more.
    #[schemars(extend("x-unit" = "J/m^2"))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reaction_heat: Option<Stiffness>,
    /// γ: surface energy; `[impact.fragmentation]` needs it of one material at least. The material does not break
    /// if left out.
    #[schemars(extend("x-unit" = "J/m^2"))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub surface_energy: Option<Stiffness>,
    /// Emissivity, for the radiation of `[impact.cooling]`; from 0 to 1, 0 if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub emissivity: Option<f64>,
    /// Thermal conductivity, only for judging whether grains are at one temperature each (Biot number).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thermal_conductivity: Option<Conductivity>,
}

/// K = max(K0 exp(-a (T/T* - 1)), K_lim) (Zohdi 2016, eqs 35-36).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Softening {
    /// T*: the temperature at which the stiffness is the one given.
    pub reference_temperature: Temperature,
    /// a, 0 or more.
    pub sensitivity: f64,
    /// K_lim: it gets no softer than this.
    pub lowest_stiffness: Pressure,
}

/// Properties that belong to a pair of materials and override those of the laws.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mixture {
    /// Names of the two materials; a pair stands once.
    pub between: [String; 2],
    /// Restitution, from 0 to 1, for `restitution` damping and for all impacts of hard spheres; the law's if left
    /// out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f64>,
    /// Static friction of soft spheres; the law's if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub static_friction: Option<f64>,
    /// Dynamic friction, not above the static one; for impacts of hard spheres the friction. The law's if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dynamic_friction: Option<f64>,
}

impl Material {
    /// Heat capacity [J/(kg K)]; 0 where it has none.
    pub fn specific_heat(&self) -> f64 {
        self.heat_capacity.map_or(0.0, SpecificHeat::si)
    }

    /// Mass [kg] of a sphere of `radius` [m].
    pub fn mass_of_sphere(&self, radius: f64) -> f64 {
        self.density.si() * 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3)
    }

    /// Contact stiffness [Pa] at a temperature [K]; 0 where the material has none.
    pub fn stiffness_at(&self, temperature: f64) -> f64 {
        let cold = self.contact_stiffness.map_or(0.0, Pressure::si);
        match &self.softening {
            None => cold,
            Some(law) => {
                let hotter = temperature / law.reference_temperature.si() - 1.0;
                (cold * (-law.sensitivity * hotter).exp()).max(law.lowest_stiffness.si())
            }
        }
    }
}

impl Mixture {
    /// What two materials, by their names, have in common, whichever is named first.
    pub fn of<'a>(mixtures: &'a [Self], a: &str, b: &str) -> Option<&'a Self> {
        mixtures.iter().find(|mixture| {
            let [c, d] = &mixture.between;
            (c == a && d == b) || (c == b && d == a)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Quantity;

    fn material(modulus: f64, poisson: f64) -> Material {
        Material {
            density: Quantity(2000.0),
            sound_speed: None,
            youngs_modulus: Some(Quantity(modulus)),
            poisson_ratio: Some(poisson),
            contact_stiffness: Some(Quantity(1e7)),
            softening: Some(Softening {
                reference_temperature: Quantity(500.0),
                sensitivity: 1.0,
                lowest_stiffness: Quantity(1e6),
            }),
            ..Material::default()
        }
    }

    /// The paper's example: 1e7 e^0.4 = 1.4918e7 Pa at 300 K; the floor holds above 500 (1 + ln 10) K.
    #[test]
    fn val_zohdi_2016_softened_stiffness() {
        let one = material(1e9, 0.25);
        assert_close!(one.stiffness_at(300.0), 1.491_824_697_641_27e7, 1e-14);
        assert_eq!(one.stiffness_at(500.0), 1e7);
        assert_above!(one.stiffness_at(1651.0), 1e6);
        assert_eq!(one.stiffness_at(1652.0), 1e6);
        let plain = Material { softening: None, ..one.clone() };
        assert_eq!(plain.stiffness_at(4000.0), 1e7);
        let none = Material { contact_stiffness: None, softening: None, ..one };
        assert_eq!(none.stiffness_at(300.0), 0.0);
    }
}
