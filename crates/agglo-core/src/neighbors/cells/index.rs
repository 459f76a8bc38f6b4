//! What every index has, however it keeps the spheres of a cell.

use super::lattice::Lattice;

/// Spheres by cell, kept as `S` says.
#[derive(Clone, Debug, Default)]
pub struct CellIndex<S> {
    pub(super) levels: Vec<Level<S>>,
    /// The smallest radius [m], from which octaves are counted.
    pub(super) smallest: f64,
    /// The level of each sphere that was sorted.
    pub(super) level_of: Vec<u8>,
}

/// The cells of the spheres of one octave of radius.
#[derive(Clone, Debug, Default)]
pub(super) struct Level<S> {
    pub(super) largest_radius: f64,
    pub(super) lattice: Lattice,
    pub(super) spheres: S,
}

/// How many octaves a radius is above the smallest.
pub(super) fn octave(radius: f64, smallest: f64) -> u8 {
    (radius / smallest).log2().max(0.0) as u8
}
