//! What a force on single grains can do.

use crate::law::Law;
use crate::math::{Pace, Vec3};

/// A grain as a force on single grains sees it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Grain {
    /// Place of the center [m].
    pub position: Vec3,
    /// Velocity [m/s].
    pub velocity: Vec3,
    /// Its own mass [kg].
    pub mass: f64,
    /// Radius [m].
    pub radius: f64,
    /// Charge [C].
    pub charge: f64,
    /// Density of the medium over its own.
    pub density_ratio: f64,
    /// Time [s].
    pub time: f64,
}

/// Where the ledger books the work of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// Weight and buoyancy.
    Gravity,
    /// Electric and magnetic fields, and whatever acts from outside.
    Field,
    /// What depends on the velocity: lost to the medium, or put in by it.
    Drag,
}

/// A part of the force of a field, as the ledger books it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// Where it is booked.
    pub channel: Channel,
    /// Force [N].
    pub force: Vec3,
    /// Power that it puts in from outside [W]: none of the work on a potential that is stored.
    pub power: f64,
}

/// What a force on single grains can do.
pub trait FieldLaw: Law {
    /// Where the ledger books its work.
    const CHANNEL: Channel;

    /// Force [N].
    fn force(&self, grain: &Grain) -> Vec3;

    /// Its parts as the ledger books them, two at most: all in one channel if it says nothing else.
    #[inline]
    fn parts(&self, grain: &Grain) -> [Option<Part>; 2] {
        let force = self.force(grain);
        [Some(Part { channel: Self::CHANNEL, force, power: force.dot(grain.velocity) }), None]
    }

    /// Energy stored [J] by a grain in the field, where it is known.
    fn energy(&self, _: &Grain) -> f64 {
        0.0
    }

    /// Whether it stores energy.
    fn stores(&self) -> bool {
        false
    }

    /// How fast it is by the change of the force along the way, and by rotation, where this mass [kg] resists it: the
    /// grain's own, and that of the fluid that it moves.
    fn pace(&self, _: &Grain, _mass: f64) -> Pace {
        Pace::NONE
    }

    /// What the force turns the velocity by [kg/s]: its part v x turning.
    fn turning(&self, _: &Grain) -> Vec3 {
        Vec3::ZERO
    }

    /// Whether it turns velocities at all.
    fn turns(&self) -> bool {
        false
    }

    /// Whether it acts on charges alone.
    fn is_by_charge(&self) -> bool {
        false
    }
}
