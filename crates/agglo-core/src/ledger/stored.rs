//! What grains hold.

use std::ops::{Add, Sub};

use serde::{Deserialize, Serialize};

use crate::math::Vec3;

/// Energy that the grains hold [J].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Stored {
    /// Kinetic energy of the centers' motion, added mass included.
    pub kinetic: f64,
    /// Kinetic energy of rotation.
    pub rotational: f64,
    /// Elastic energy of normal contact.
    pub elastic: f64,
    /// Energy of tangential springs in contacts.
    pub tangential_spring: f64,
    /// Elastic energy of bonds.
    pub bonds: f64,
    /// Potential energy of the near field.
    pub near_field: f64,
    /// Potential energy in fields whose energy is given.
    pub fields: f64,
    /// Thermal energy m C T of hard spheres.
    pub thermal: f64,
}

impl Stored {
    /// All but heat [J].
    pub fn mechanical(&self) -> f64 {
        self.kinetic
            + self.rotational
            + self.elastic
            + self.tangential_spring
            + self.bonds
            + self.near_field
            + self.fields
    }
}

/// Linear and angular momentum about the origin.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Momentum {
    /// Linear [kg m/s].
    pub linear: Vec3,
    /// Angular [kg m²/s].
    pub angular: Vec3,
}

impl Add for Momentum {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { linear: self.linear + other.linear, angular: self.angular + other.angular }
    }
}

impl Sub for Momentum {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { linear: self.linear - other.linear, angular: self.angular - other.angular }
    }
}
