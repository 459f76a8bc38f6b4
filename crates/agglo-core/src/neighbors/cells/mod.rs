//! Spheres by the cells that they are in, one lattice per octave of size.
//!
//! Each octave of radius has its own cells, as wide as the reach of two of its largest spheres, so that spheres of
//! very different size do not crowd one another's cells.
//!
//! One index serves all who ask for spheres near a place. They differ in two things, which they choose:
//!
//! - Where the cells lie ([`Span`]). Among free spheres cells stay narrow however far a few have flown, and are hashed where
//!   they would outnumber the spheres; searches that reach farther than the cells were made for would then look into
//!   very many. A block is tiled by no more cells than its spheres pay for, and may repeat itself.
//! - How the spheres of a cell are kept. [`Sorted`] ones lie side by side, and are all sorted at once; a [`Chained`] one can be
//!   added at any time and is found by a chain. The first is faster to search, the second is what lets an index
//!   grow with each sphere that is placed: sorting anew for each would cost n² in all.
//!
//! It does not know where spheres have come since they were sorted: who asks then widens the reach by how far they may have.

mod chained;
mod index;
mod lattice;
mod sorted;

pub use chained::Chained;
pub use index::CellIndex;
pub use lattice::Span;
pub use sorted::{Places, Sorted};

#[cfg(test)]
mod tests;
