//! Where things are: regions of space, the volume that a hard-sphere run is about with its faces, and where doubles end.

mod disc;
mod extent;
mod region;
pub mod resolution;
mod volume;

pub use disc::Disc;
pub use extent::extent;
pub use region::{Ball, Block, Cylinder, Region};
pub use volume::{Boundary, Volume};
