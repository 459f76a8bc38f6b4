//! Where random grains may be put: wholly inside a region, or anywhere along the axes on which space repeats itself.

use crate::domain::{Block, Boundary, Region, Volume};
use crate::math::Vec3;
use crate::math::rng::Stream;

/// Where random grains may be put.
#[derive(Clone, Debug)]
pub(super) struct Room {
    region: Region,
    /// Along which axes space repeats itself: the region is a box then, and its faces across these are no walls.
    repeats: [bool; 3],
}

impl Room {
    /// A region that grains lie wholly inside of.
    pub fn inside(region: &Region) -> Self {
        Self { region: region.clone(), repeats: [false; 3] }
    }

    /// The control volume: centers anywhere where it repeats itself, else grains wholly inside.
    pub fn of_volume(volume: &Volume) -> Self {
        let block = Block { lower: volume.lower, upper: volume.upper };
        Self { region: Region::Box(block), repeats: volume.boundaries().map(Boundary::wraps) }
    }

    /// Along which axes space repeats itself.
    pub fn repeats(&self) -> [bool; 3] {
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
        if self.repeats == [false; 3] {
            return self.region.inner_radius();
        }
        let (lower, upper) = self.bounds();
        let along =
            |axis: usize| 0.5 * (upper[axis] - lower[axis] - if self.repeats[axis] { gap } else { 0.0 });
        along(0).min(along(1)).min(along(2))
    }

    /// A place uniform among those that a grain of `radius` [m] may have; nothing where there is none.
    pub fn sample(&self, radius: f64, stream: &mut Stream) -> Option<Vec3> {
        if self.repeats == [false; 3] {
            return self.region.sample(radius, stream);
        }
        let (lower, upper) = self.bounds();
        let half = (upper - lower) * 0.5;
        let mut along = |axis: usize| (2.0 * stream.uniform() - 1.0) * (half[axis] - self.wall(axis, radius));
        let from_middle = Vec3::new(along(0), along(1), along(2));
        let fits = (0..3).all(|axis| half[axis] >= self.wall(axis, radius));
        fits.then(|| (lower + upper) * 0.5 + from_middle)
    }

    /// Whether a grain of `radius` [m] may have its center here.
    pub fn admits(&self, center: Vec3, radius: f64) -> bool {
        self.may_admit_near(center, radius, 0.0)
    }

    /// Whether a grain of `radius` [m] may have its center somewhere within `reach` [m] of here; in doubt, yes.
    pub fn may_admit_near(&self, middle: Vec3, radius: f64, reach: f64) -> bool {
        if self.repeats == [false; 3] {
            return self.region.contains(middle, radius - reach);
        }
        let (lower, upper) = self.bounds();
        (0..3).all(|axis| {
            let wall = self.wall(axis, radius) - reach;
            lower[axis] + wall <= middle[axis] && middle[axis] <= upper[axis] - wall
        })
    }

    /// How far from the faces across an axis a center must keep.
    fn wall(&self, axis: usize, radius: f64) -> f64 {
        if self.repeats[axis] { 0.0 } else { radius }
    }
}
