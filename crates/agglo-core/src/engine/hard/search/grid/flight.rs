//! How a grid flies with the spheres, and comes back.

use super::{Frame, Grid};
use crate::domain::{Boundary, Volume};
use crate::math::Vec3;

/// Edges of the volume that cells may fly before they are taken back.
const FAR: f64 = 64.0;

/// Spheres may be so many cells away from an open volume.
const FARTHEST_CELL: f64 = 1e9;

impl Grid {
    /// Lets the cells, which are empty, fly on from where the volume is at a time [s].
    pub fn set_off(&mut self, volume: &Volume, time: f64, drift: Vec3) {
        self.frame = Frame { lower: volume.lower(), drift, since: time };
    }

    /// Edges [m] to add to the position of a sphere so that it is in the cells at a time [s].
    pub fn way_back(&self, position: Vec3, time: f64) -> Vec3 {
        self.whole_edges(position - self.frame.flown(time) - self.frame.lower)
    }

    /// Edges [m] that take a vector into the block of one volume at the origin.
    fn whole_edges(&self, way: Vec3) -> Vec3 {
        if self.boundary != Boundary::Periodic {
            return Vec3::ZERO;
        }
        let along = |axis: usize| -(way[axis] / self.edges[axis]).floor() * self.edges[axis];
        Vec3::new(along(0), along(1), along(2))
    }

    /// Whether the cells have flown so far that positions are about to lose digits.
    #[inline]
    pub fn is_far(&self, time: f64) -> bool {
        let flown = self.frame.flown(time).to_array();
        self.boundary == Boundary::Periodic
            && flown.into_iter().zip(self.edges.to_array()).any(|(way, edge)| way.abs() > FAR * edge)
    }

    /// Shortest width of the finest cells [m].
    pub fn narrowest_cell(&self) -> f64 {
        self.widths.x.min(self.widths.y).min(self.widths.z)
    }

    /// Whether a position at a time [s] is so far from an open volume that the numbers of cells there are about to end.
    pub fn is_beyond(&self, position: Vec3, time: f64) -> bool {
        let way = position - self.frame.flown(time) - self.frame.lower;
        self.boundary == Boundary::Open && way.sum_of_sizes() > FARTHEST_CELL * self.narrowest_cell()
    }

    /// Takes the cells back by whole edges to where the volume is; gives what must be added to all positions [m].
    pub fn take_back(&mut self, volume: &Volume, time: f64) -> Vec3 {
        let lower = self.frame.lower + self.frame.flown(time);
        let back = self.whole_edges(lower - volume.lower());
        self.frame = Frame { lower: lower + back, since: time, ..self.frame };
        back
    }

    /// The images of a position along an axis that lie between two coordinates [m]: the first and the last number of edges
    /// to add.
    #[inline]
    pub fn images(&self, axis: usize, position: f64, [from, to]: [f64; 2]) -> (i8, i8) {
        if self.boundary == Boundary::Periodic {
            let edge = self.edges[axis];
            (((from - position) / edge).ceil() as i8, ((to - position) / edge).floor() as i8)
        } else {
            (0, if from <= position && position <= to { 0 } else { -1 })
        }
    }
}
