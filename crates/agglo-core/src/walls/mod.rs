//! Walls: bodies that grains touch and that move as they are told.

mod contacts;
mod course;
mod listed;
mod meeting;
mod mirrors;
mod motion;
mod passed;
mod shape;
mod snapshot;
mod wall;

pub use contacts::{RememberedAtWall, WallContacts, WallRates, WallStep};
pub use course::Pose;
pub use mirrors::{AtWall, Mirrors, RayAtWalls};
pub use motion::{Constant, Motion, OfTime, Oscillating, TimeFormula, Traveling};
pub use passed::Passed;
pub use shape::{Cuboid, Cylinder, Line, Near, Opening, Plane, Shape, Side, Sphere, Triangle};
pub use snapshot::{WallEnergy, WallSnapshot};
pub use wall::{Wall, Walls};
