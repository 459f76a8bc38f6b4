//! Where grains are, and how large, when the clock starts.

mod placement;
mod size;

pub use placement::{GrainList, Lattice, LatticeKind, Placement, RandomAddition, Table};
pub use size::{ConstantSize, LognormalSize, Size, SizeTable, UniformSize};
