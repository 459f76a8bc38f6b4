//! Two spheres at the moment at which they collide, and what became of them.

use crate::engine::hard::search::Contact;
use crate::impact::Body;
use crate::math::Vec3;

/// Two spheres at the moment at which they collide.
#[derive(Clone, Copy, Debug)]
pub(super) struct Collision {
    pub contact: Contact,
    /// When [s].
    pub time: f64,
    /// The two as they were before.
    pub bodies: [Body; 2],
    /// From the first center to the second [m].
    pub distance: Vec3,
    /// Its direction.
    pub normal: Vec3,
    /// Speed of approach along it [m/s].
    pub approach: f64,
    /// Whether they are in one another already.
    pub overlaps: bool,
}

/// What became of two spheres that collided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// Both go on, with new velocities.
    Bounced,
    /// The first went on as both; the second is no more.
    Merged {
        /// Index of the sphere that is both now, larger and elsewhere.
        kept: u32,
        /// The empty slot.
        gone: u32,
    },
    /// One or both broke: [`HardSystem::fragments`](super::HardSystem::fragments) has the indices of all fragments and of a
    /// partner that stayed whole, and the slots of both partners were given up or reused.
    Broke,
}
