//! Where things are: regions of space, the volume that a run is about with its faces, space that repeats itself, and where
//! doubles end.

mod deformation;
mod disc;
mod extent;
mod region;
pub mod resolution;
mod space;
mod space_in_time;
mod volume;

pub use deformation::{Deformation, volume_of_spheres};
pub use disc::Disc;
pub use extent::{extent, extent_of_places};
pub use region::{Ball, Block, Cylinder, Region};
pub use space::{Image, Space};
pub use space_in_time::{SpaceInTime, Stretch};
pub use volume::{Boundary, Faces, Volume};
