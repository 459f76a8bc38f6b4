//! Where things are: regions of space. Periodic and reflecting faces and walls have their place here.

mod region;

pub use region::{Ball, Block, Cylinder, Region};
