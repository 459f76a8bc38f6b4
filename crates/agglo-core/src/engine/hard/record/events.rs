//! Merges and fragmentations as they are written down: the genealogy of the grains.

use serde::{Deserialize, Serialize};

use crate::impact::ImpactEnergy;

/// What a collision did to the number of grains.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum EventKind {
    /// Two grains became one.
    Merge,
    /// One grain or both broke.
    Break,
}

/// A collision that changed the number of grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GrainEvent {
    /// Number of the event, from 1.
    pub number: u64,
    /// When [s].
    pub time: f64,
    /// What happened.
    pub kind: EventKind,
    /// Ids of the partners, the smaller first.
    pub grains: [u32; 2],
    /// Their masses [kg].
    pub masses: [f64; 2],
    /// Approach speed along the normal [m/s].
    pub speed: f64,
    /// Restitution.
    pub restitution: f64,
    /// Where the energy went.
    pub energy: ImpactEnergy,
}

/// One line of descent: a parent, or part of it, goes on as a child.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Descent {
    /// Number of the event.
    pub event: u64,
    /// Name of the parent.
    pub parent: u32,
    /// Name of the child; for a merge it is that of the heavier parent.
    pub child: u32,
    /// Primary grains that go from parent to child.
    pub primaries: u32,
    /// Their mass [kg].
    pub mass: f64,
}
