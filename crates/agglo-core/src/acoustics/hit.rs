//! What rays fly among, what they hit, and how they end.

use crate::domain::Region;
use crate::math::Vec3;
use crate::neighbors::ray_grid::NO_SPHERE;

/// In place of the number of a grain or of a wall: none.
pub const NONE: u32 = NO_SPHERE;

/// A ray hits a grain or a wall.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Hit {
    /// Index of the grain; [`NONE`] where a wall is hit.
    pub grain: u32,
    /// Number of the wall; [`NONE`] where a grain is hit.
    pub wall: u32,
    /// Place of the ray's pulse in [`Flight::pulses`].
    pub pulse: u32,
    /// Where [m]: on the grain where it is at home, though it was hit in another of its images.
    pub point: Vec3,
    /// Outward normal of the grain or the wall, a unit vector.
    pub normal: Vec3,
    /// Direction of the ray that comes, a unit vector.
    pub direction_in: Vec3,
    /// Direction of the ray that goes, a unit vector.
    pub direction_out: Vec3,
    /// Direction of the sound that enters what is hit, a unit vector; zero beyond its critical angle.
    pub refracted: Vec3,
    /// Direction of the shear wave that enters what is hit, a unit vector; zero where there is none.
    pub refracted_shear: Vec3,
    /// Power of the ray that comes [W].
    pub power_in: f64,
    /// Part of it that is reflected [1].
    pub reflectance: f64,
    /// Part of it that enters as a shear wave [1].
    pub sheared: f64,
    /// Area of the ray in its beam [m²].
    pub ray_area: f64,
}

impl Hit {
    /// Power that what is hit takes [W].
    #[inline]
    pub fn power_taken(&self) -> f64 {
        self.power_in * (1.0 - self.reflectance)
    }
}

/// How rays end.
#[derive(Clone, Debug, PartialEq)]
pub struct Ends {
    /// Rays that leave it are lost; if there is none, rays end where they can hit no grain any more.
    pub region: Option<Region>,
    /// Part of its first power at which a ray is dropped (0: only when nothing is left).
    pub truncation: f64,
    /// Bounces after which a ray is dropped.
    pub bounces: u32,
    /// Way [m] after which a ray is dropped; infinite if it has none.
    pub way: f64,
}

impl Default for Ends {
    fn default() -> Self {
        Self { region: None, truncation: 0.0, bounces: 10_000_000, way: f64::INFINITY }
    }
}

/// The grains that rays fly among, as they are now.
#[derive(Clone, Copy, Debug)]
pub struct Targets<'a> {
    /// Centers [n, 3] [m].
    pub positions: &'a [Vec3],
    /// Radii [n] [m].
    pub radii: &'a [f64],
    /// Numbers of the materials [n].
    pub material: &'a [u32],
    /// Speed of the fastest grain over that of sound in the medium.
    pub mach: f64,
}
