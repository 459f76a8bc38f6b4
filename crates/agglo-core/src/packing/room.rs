//! Where random grains may be put: wholly inside a region, or anywhere in a box beyond which space repeats itself.

use crate::domain::{Block, Region, Volume};
use crate::math::Vec3;
use crate::math::rng::Stream;

/// Where random grains may be put.
#[derive(Clone, Debug)]
pub(super) struct Room {
    region: Region,
    /// Space repeats itself: the region is a box, and its faces are no walls.
    repeats: bool,
}

impl Room {
    /// A region that grains lie wholly inside of.
    pub fn inside(region: &Region) -> Self {
        Self { region: region.clone(), repeats: false }
    }

    /// The control volume: centers anywhere where it repeats itself, else grains wholly inside.
    pub fn of_volume(volume: &Volume) -> Self {
        let block = Block { lower: volume.lower, upper: volume.upper };
        Self { region: Region::Box(block), repeats: volume.boundary.wraps() }
    }

    pub fn repeats(&self) -> bool {
        self.repeats
    }

    /// Volume [m³].
    pub fn volume(&self) -> f64 {
        self.region.volume()
    }

    /// Smallest box that holds it: lower and upper corner [m].
    pub fn bounds(&self) -> (Vec3, Vec3) {
        self.region.bounds()
    }

    /// Largest radius [m] that has room, with `gap` [m] between a grain and its own image.
    pub fn largest_radius(&self, gap: f64) -> f64 {
        self.region.inner_radius() - if self.repeats { 0.5 * gap } else { 0.0 }
    }

    /// A place uniform among those that a grain of `radius` [m] may have; nothing where there is none.
    pub fn sample(&self, radius: f64, stream: &mut Stream) -> Option<Vec3> {
        self.region.sample(self.wall(radius), stream)
    }

    /// Whether a grain of `radius` [m] may have its center here.
    pub fn admits(&self, center: Vec3, radius: f64) -> bool {
        self.region.contains(center, self.wall(radius))
    }

    /// Whether a grain of `radius` [m] may have its center somewhere within `reach` [m] of here; in doubt, yes.
    pub fn may_admit_near(&self, middle: Vec3, radius: f64, reach: f64) -> bool {
        self.region.contains(middle, self.wall(radius) - reach)
    }

    /// How far from the surface a center must keep.
    fn wall(&self, radius: f64) -> f64 {
        if self.repeats { 0.0 } else { radius }
    }
}
