//! What a simulation starts from.

use super::hard::Grown;
use crate::contact::friction::TangentialSpring;
use crate::contact::network::Bond;
use crate::contact::pass::Remembered;
use crate::particles::Particles;

/// Grains at time zero, with what they bring along where they come out of another simulation.
///
/// Grains as they were placed bring nothing: `Start::from(grains)`.
#[derive(Clone, Debug, Default)]
pub struct Start {
    /// The grains.
    pub grains: Particles,
    /// Soft spheres: springs of contacts, by the grains' indices.
    pub contacts: Vec<Remembered>,
    /// Soft spheres: springs of contacts with walls.
    pub walls: Vec<SpringAtWall>,
    /// Soft spheres: the bonds that hold, however few. Without them the scenario's law bonds neighbors.
    pub bonds: Option<Vec<Bond>>,
    /// Hard spheres: what grown grains keep of their parts, in the order of the grains; those that it leaves out are primary
    /// grains.
    pub grown: Vec<Grown>,
    /// What the simulation warns of from the start.
    pub warnings: Vec<String>,
}

/// What a contact of a grain with a wall remembers.
#[derive(Clone, Debug, PartialEq)]
pub struct SpringAtWall {
    /// The grain's index.
    pub grain: u32,
    /// Name of the wall.
    pub wall: String,
    /// Number of the wall's face.
    pub face: u32,
    /// The spring.
    pub spring: TangentialSpring,
}

impl From<&Particles> for Start {
    fn from(grains: &Particles) -> Self {
        Self::from(grains.clone())
    }
}

impl From<Particles> for Start {
    fn from(grains: Particles) -> Self {
        Self { grains, ..Self::default() }
    }
}
