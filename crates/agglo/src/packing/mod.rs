//! Where grains are, and how large, when the clock starts.

mod error;
mod lattice;
mod occupied;
mod place;
mod placement;
mod random;
mod size;
mod table;

pub use error::{PackingError, SATURATION};
pub use place::place;
pub use placement::{GrainList, Lattice, LatticeKind, Placement, RandomAddition, Table};
pub use size::{ConstantSize, LognormalSize, Size, SizeTable, UniformSize};

#[cfg(test)]
mod tests;
