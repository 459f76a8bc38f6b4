//! Weight, with Archimedes' buoyancy if wanted.
//!
//! # Equation
//! ```text
//! F = m g (1 - ρ_medium/ρ_grain),   U = -F · r                                            A9
//! ```
//!
//! # Source
//! Archimedes, *On Floating Bodies*; uniform field.
//!
//! # Symbols
//! | symbol             | name in code    | unit | meaning                                  |
//! |--------------------|-----------------|------|------------------------------------------|
//! | g                  | `acceleration`  | m/s² | acceleration of free fall                |
//! | ρ_medium/ρ_grain   | `density_ratio` | -    | density of the medium over the grain's   |
//!
//! # Valid when
//! The medium is at rest far away and its density uniform. Without `buoyancy` the full weight acts.
//!
//! # Compared with others
//! Most DEM codes leave buoyancy to the user; here it is one word.
//!
//! # In a scenario
//! ```toml
//! [fields.gravity]
//! acceleration = ["0 m/s2", "0 m/s2", "-9.81 m/s2"]
//! buoyancy = true
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::fields::Gravity;
//! use agglo::units::Quantity;
//! let down = [Quantity(0.0), Quantity(0.0), Quantity(-9.81)];
//! let gravity = Gravity { acceleration: down, buoyancy: true };
//! assert!((gravity.acceleration_on(0.4).z + 9.81 * 0.6).abs() < 1e-14);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Channel, FieldLaw, Grain};
use crate::law::{Context, Faults, Law};
use crate::math::Vec3;
use crate::units::{Acceleration, Triple, vector};

/// Uniform gravity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Gravity {
    /// Acceleration of free fall.
    pub acceleration: Triple<Acceleration>,
    /// Whether the medium carries part of the weight.
    #[serde(default)]
    pub buoyancy: bool,
}

impl Law for Gravity {
    fn faults(&self, faults: &mut Faults, context: &Context<'_>) {
        if self.buoyancy && context.medium.density.si() == 0.0 {
            let message = "buoyancy is on, but medium.density is 0".to_owned();
            faults.fail_with("buoyancy", message, "give the medium a density or turn buoyancy off");
        }
    }
}

impl FieldLaw for Gravity {
    const CHANNEL: Channel = Channel::Gravity;

    #[inline]
    fn force(&self, grain: &Grain) -> Vec3 {
        self.acceleration_on(grain.density_ratio) * grain.mass
    }
}

impl Gravity {
    /// Weight less buoyancy, per mass [m/s²], from the density of the medium over that of the grain [-].
    #[inline]
    pub fn acceleration_on(&self, density_ratio: f64) -> Vec3 {
        let carried = if self.buoyancy { density_ratio } else { 0.0 };
        vector(self.acceleration) * (1.0 - carried)
    }

    /// Potential energy [J] of a mass [kg] at a point [m]; zero at the origin.
    #[inline]
    pub fn energy(&self, mass: f64, density_ratio: f64, position: Vec3) -> f64 {
        -mass * self.acceleration_on(density_ratio).dot(position)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Quantity;

    /// Weight 9.81 m in air; in water a grain of 2500 kg/m³ keeps 3/5 of it, and one of 1000 kg/m³ nothing.
    #[test]
    fn weight_and_buoyancy() {
        let down = [Quantity(0.0), Quantity(0.0), Quantity(-9.81)];
        let (dry, wet) =
            (Gravity { acceleration: down, buoyancy: false }, Gravity { acceleration: down, buoyancy: true });
        assert_eq!(dry.acceleration_on(0.4), Vec3::new(0.0, 0.0, -9.81));
        assert_near!(wet.acceleration_on(0.4).z, -5.886, 1e-14);
        assert_eq!(wet.acceleration_on(1.0).norm(), 0.0);
        assert_near!(wet.energy(2.0, 0.4, Vec3::new(1.0, 1.0, 3.0)), 2.0 * 5.886 * 3.0, 1e-13, "in J");
    }
}
