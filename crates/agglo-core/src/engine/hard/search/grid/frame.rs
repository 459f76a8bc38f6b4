//! Cells that fly with the spheres.
//!
//! Spheres that all fly one way would pass through cells that lie still, one event for each, without a collision. So the
//! cells fly at the mean velocity of the spheres, where no face of the volume does anything but bring spheres back by an
//! edge. Positions are those of the images in the flying block; what is given out is folded into the volume.

use serde::{Deserialize, Serialize};

use crate::math::Vec3;

/// Where the cells are. Where there is no wall they fly with the spheres, so that a wind drives nobody through them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    /// Lower corner of the cells [m] at `since`.
    pub lower: Vec3,
    /// Their velocity [m/s].
    pub drift: Vec3,
    /// A moment [s].
    pub since: f64,
}

impl Frame {
    /// How far the cells have flown [m].
    #[inline]
    pub fn flown(&self, time: f64) -> Vec3 {
        self.drift * (time - self.since)
    }
}
