//! Where grains are, and how large, when the clock starts.

mod cluster;
mod error;
mod group;
mod lattice;
mod occupied;
mod overlap;
mod place;
mod placement;
mod pockets;
mod random;
mod room;
mod size;
mod spread;
mod velocity;
mod watch;

pub use cluster::{PackedCluster, pack_cluster};
pub use error::{PackingError, SATURATION};
pub use group::{GrainGroup, Groups, SphereKind};
pub use overlap::{Overlap, first_overlap};
pub use place::{Placed, make_ready, place, place_all, place_groups};
pub use placement::{Fill, GrainList, Lattice, LatticeKind, Placement, RandomAddition, Table, TableGrain};
pub use random::fill_with;
pub use size::{ConstantSize, LengthRatio, LognormalSize, Size, SizeTable, UniformSize};
pub use spread::{least_spread, move_apart};
pub use velocity::{Maxwell, UniformSpread, VelocitySpread};
pub use watch::{PlaceWatch, ReadTable};

#[cfg(test)]
mod hard_tests;
#[cfg(test)]
mod tests;
