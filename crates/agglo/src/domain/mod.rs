//! Where things are: regions of space, and the volume that a hard-sphere run is about with its faces.

mod disc;
mod region;
mod volume;

pub use disc::Disc;
pub use region::{Ball, Block, Cylinder, Region};
pub use volume::{Boundary, Volume};
