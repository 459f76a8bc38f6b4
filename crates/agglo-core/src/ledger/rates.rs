//! The rates at which forces feed or drain the ledger.

use std::ops::Add;

use serde::{Deserialize, Serialize};

use crate::contact::network::BondRates;
use crate::contact::pass::ContactRates;
use crate::link::row_of_fields;
use crate::math::Vec3;

/// What an outer agent does to all grains together, per second.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Supply {
    /// Power put in [W].
    pub power: f64,
    /// Force [N].
    pub force: Vec3,
    /// Torque about the origin [N m].
    pub torque: Vec3,
}

row_of_fields!(Supply { power: f64, force: Vec3, torque: Vec3 });

impl Supply {
    /// A force at a point of a grain with this position and velocity.
    #[inline]
    pub fn of(force: Vec3, position: Vec3, velocity: Vec3) -> Self {
        Self { power: force.dot(velocity), force, torque: position.cross(force) }
    }

    /// The weighted sum with another.
    #[must_use]
    pub fn plus(self, other: Self, weight: f64) -> Self {
        Self {
            power: self.power + weight * other.power,
            force: self.force + other.force * weight,
            torque: self.torque + other.torque * weight,
        }
    }
}

impl Add for Supply {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.plus(other, 1.0)
    }
}

/// Supplies of forces from outside, by channel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Supplies {
    /// Drag of the medium (its power is mostly negative).
    pub drag: Supply,
    /// Weight and buoyancy.
    pub gravity: Supply,
    /// Electric and magnetic forces, and fields given by formulas.
    pub field: Supply,
    /// A hook.
    pub hook: Supply,
    /// Walls: what moving ones put in, and the impulse of all.
    pub walls: Supply,
    /// Power that space puts in against forces at a distance as it is pressed together [W].
    pub strained: f64,
}

row_of_fields!(Supplies {
    drag: Supply,
    gravity: Supply,
    field: Supply,
    hook: Supply,
    walls: Supply,
    strained: f64,
});

impl Supplies {
    /// The same with what walls do.
    #[must_use]
    pub fn with_walls(self, walls: Supply) -> Self {
        Self { walls, ..self }
    }

    /// What is more in these than in others.
    #[must_use]
    pub fn less(self, other: Self) -> Self {
        let less = |own: Supply, other: Supply| own.plus(other, -1.0);
        Self {
            drag: less(self.drag, other.drag),
            gravity: less(self.gravity, other.gravity),
            field: less(self.field, other.field),
            hook: less(self.hook, other.hook),
            walls: less(self.walls, other.walls),
            strained: self.strained - other.strained,
        }
    }

    /// Forces [N] and a torque [N m] by which the loads on a grain at a point [m] changed when its velocity was solved
    /// for. What they supply is of second order in the step and left out.
    #[inline]
    pub fn note_correction(&mut self, position: Vec3, drag: Vec3, magnetic: Vec3, spun: Vec3) {
        self.drag.force += drag;
        self.drag.torque += position.cross(drag) + spun;
        self.field.force += magnetic;
        self.field.torque += position.cross(magnetic);
    }
}

impl Add for Supplies {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            drag: self.drag + other.drag,
            gravity: self.gravity + other.gravity,
            field: self.field + other.field,
            hook: self.hook + other.hook,
            walls: self.walls + other.walls,
            strained: self.strained + other.strained,
        }
    }
}

/// What solving for velocities changes in the ledger of a step.
#[derive(Clone, Copy, Debug, Default)]
pub struct Correction {
    /// Changes of the supplies at the end of the step.
    pub supplies: Supplies,
    /// Change of drag over that of velocity, both within the step [W]: -ΔF · Δv - ΔM · Δw.
    pub bend: f64,
}

row_of_fields!(Correction { supplies: Supplies, bend: f64 });

impl Add for Correction {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { supplies: self.supplies + other.supplies, bend: self.bend + other.bend }
    }
}

/// All rates at one time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rates {
    /// Power lost in contact dashpots [W].
    pub damping: f64,
    /// Power that a formula of contact puts in where it drives grains [W].
    pub driven: f64,
    /// Power that friction and tangential springs take from the motion [W].
    pub tangential: f64,
    /// Power lost in the dashpots of bonds [W].
    pub bond_damping: f64,
    /// Power that space puts in as it is pressed together [W].
    pub strained: f64,
    /// Forces from outside.
    pub supplies: Supplies,
    /// By how much drag changed within the step that led here, over how velocities did: -ΔF · Δv - ΔM · Δw [W].
    pub bend: f64,
}

impl Rates {
    /// Puts the parts together.
    pub fn new(contact: &ContactRates, bonds: BondRates, supplies: Supplies) -> Self {
        let ContactRates { damping, driven, tangential, strained, .. } = *contact;
        let (bond_damping, strained) = (bonds.damping, strained + bonds.strained + supplies.strained);
        Self { damping, driven, tangential, bond_damping, strained, supplies, bend: 0.0 }
    }

    /// Brings in what solving for velocities changed in the step that leads here.
    pub fn correct(&mut self, correction: Correction) {
        self.supplies = self.supplies + correction.supplies;
        self.bend = correction.bend;
    }
}
