//! A uniform grid over spheres that rays walk through (3-D DDA): exact nearest hits on spheres that move.
//!
//! Spheres are binned with a margin, and the exact test uses where they are now; so the grid stays valid until
//! one has moved by the margin. What a ray hits never depends on when the grid was built: the cells only say
//! which spheres are tested. Spheres that do not touch the box of the rays are not binned.
//!
//! The margin also tells how far a ray can fly unhindered while the grid stays valid ([`RayGrid::clear_until`]), so
//! that short steps need not look again.
//!
//! Source: J. Amanatides and A. Woo, *A fast voxel traversal algorithm for ray tracing*, Eurographics (1987).

mod span;
#[cfg(test)]
mod tests;
mod walk;

use std::sync::atomic::{AtomicU64, Ordering};

use crate::math::Vec3;
use span::Sphere;
use walk::{Cells, Walk};

pub use span::{NO_SPHERE, RaySpan, SphereHit};

/// Cells per sphere that a new grid aims at; twice as many are allowed for awkward boxes.
const CELLS_PER_SPHERE: f64 = 2.0;
/// How far a sphere may move before the grid is built anew, as a part of the mean radius.
const MARGIN: f64 = 0.1;
/// Spheres are binned with a little more than the margin, so that rounding in the walk cannot miss one.
const BINNED_MARGIN: f64 = 1.01 * MARGIN;
/// What a ray must stay clear of is between the two: safe against rounding on both sides.
const CLEAR_MARGIN: f64 = 1.005 * MARGIN;

/// Counts the builds of all grids, so that no two have the same [`Clear::build`].
static BUILDS: AtomicU64 = AtomicU64::new(0);

/// How far a ray can fly unhindered while one build of a grid is valid. A shortcut, no part of any state: without
/// it the same hits are found, only later; so all values are equal.
#[derive(Clone, Copy, Debug, Default)]
pub struct Clear {
    until: f64,
    build: u64,
}

impl PartialEq for Clear {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// The grid; see the module.
#[derive(Clone, Debug)]
pub struct RayGrid {
    rays_lower: Vec3,
    rays_upper: Vec3,
    upper: Vec3,
    cells: Cells,
    margin: f64,
    starts: Vec<u32>,
    entries: Vec<u32>,
    spheres: Vec<Sphere>,
    /// As they were when the grid was built; a negative radius marks those that are not binned.
    built: Vec<Sphere>,
    builds: u64,
    build: u64,
}

impl RayGrid {
    /// An empty grid for rays that stay between these corners [m].
    pub fn new(rays_lower: Vec3, rays_upper: Vec3) -> Self {
        Self {
            rays_lower,
            rays_upper,
            upper: rays_lower,
            cells: Cells { lower: rays_lower, size: 0.0, dims: [0; 3] },
            margin: 0.0,
            starts: Vec::new(),
            entries: Vec::new(),
            spheres: Vec::new(),
            built: Vec::new(),
            builds: 0,
            build: 0,
        }
    }

    /// Takes the spheres as they are now (`positions` [n, 3] [m], `radii` [n] [m]); builds anew only if it must.
    pub fn update(&mut self, positions: &[Vec3], radii: &[f64]) {
        self.spheres.clear();
        let now = positions.iter().zip(radii);
        self.spheres.extend(now.map(|(&center, &radius)| Sphere { center, radius }));
        if !self.is_valid() {
            self.build();
        }
    }

    /// How often the grid was built.
    pub fn builds(&self) -> u64 {
        self.builds
    }

    fn is_valid(&self) -> bool {
        self.builds > 0
            && self.spheres.len() == self.built.len()
            && self.spheres.iter().zip(&self.built).all(|(now, then)| {
                if then.radius < 0.0 {
                    !self.reaches_rays(*now)
                } else {
                    let room = self.margin - (now.radius - then.radius);
                    room >= 0.0 && (now.center - then.center).norm_squared() <= room * room
                }
            })
    }

    fn reaches_rays(&self, sphere: Sphere) -> bool {
        let nearest = sphere.center.max(self.rays_lower).min(self.rays_upper);
        let reach = sphere.radius + self.margin;
        (sphere.center - nearest).norm_squared() <= reach * reach
    }

    fn build(&mut self) {
        self.builds += 1;
        self.build = BUILDS.fetch_add(1, Ordering::Relaxed) + 1;
        let mean = self.spheres.iter().map(|sphere| sphere.radius).sum::<f64>() / self.spheres.len() as f64;
        self.margin = MARGIN * mean;
        let mut built = std::mem::take(&mut self.built);
        built.clear();
        built.extend(self.spheres.iter().map(|&sphere| {
            let radius = if self.reaches_rays(sphere) { sphere.radius } else { -1.0 };
            Sphere { radius, ..sphere }
        }));
        self.built = built;
        self.lay_out(mean * BINNED_MARGIN);
        self.sort_into_cells(mean * BINNED_MARGIN);
    }

    /// Puts the box about the binned spheres and cuts it into cubes.
    fn lay_out(&mut self, margin: f64) {
        let (mut lower, mut upper) = (self.rays_upper, self.rays_lower);
        let mut count = 0;
        for sphere in self.built.iter().filter(|sphere| sphere.radius >= 0.0) {
            let reach = sphere.radius + margin;
            let reach = Vec3::new(reach, reach, reach);
            lower = lower.min(sphere.center - reach);
            upper = upper.max(sphere.center + reach);
            count += 1;
        }
        if count == 0 {
            self.cells.dims = [0; 3];
            return;
        }
        let slack = Vec3::new(margin, margin, margin);
        self.cells.lower = lower.max(self.rays_lower - slack);
        self.upper = upper.min(self.rays_upper + slack);
        let extent = (self.upper - self.cells.lower).to_array();
        let wanted = CELLS_PER_SPHERE * f64::from(count);
        self.cells.size = (extent.iter().product::<f64>() / wanted).cbrt();
        if !(self.cells.size.is_finite() && self.cells.size > 0.0) {
            // A space that is no number, or has no volume, is one cell: it could be widened for ever.
            (self.cells.size, self.cells.dims) = (f64::MAX, [1; 3]);
            return;
        }
        loop {
            self.cells.dims = extent.map(|length| (length / self.cells.size).ceil().max(1.0) as usize);
            if self.cells.dims.iter().map(|&count| count as f64).product::<f64>() <= 2.0 * wanted + 64.0 {
                break;
            }
            self.cells.size *= 1.25;
        }
    }

    /// Counting sort: a sphere goes into every cell that it touches; numbers ascend within a cell.
    fn sort_into_cells(&mut self, margin: f64) {
        let cells = self.cells.dims.iter().product::<usize>();
        let mut starts = std::mem::take(&mut self.starts);
        let mut entries = std::mem::take(&mut self.entries);
        starts.clear();
        starts.resize(cells + 1, 0);
        for &sphere in &self.built {
            self.for_each_cell(sphere, margin, |cell| starts[cell] += 1);
        }
        let mut end = 0;
        for start in &mut starts {
            end += *start;
            *start = end;
        }
        entries.clear();
        entries.resize(end as usize, 0);
        for (number, &sphere) in self.built.iter().enumerate().rev() {
            self.for_each_cell(sphere, margin, |cell| {
                starts[cell] -= 1;
                entries[starts[cell] as usize] = number as u32;
            });
        }
        self.starts = starts;
        self.entries = entries;
    }

    fn for_each_cell(&self, sphere: Sphere, margin: f64, mut visit: impl FnMut(usize)) {
        if sphere.radius < 0.0 {
            return;
        }
        let reach = sphere.radius + margin;
        let [xs, ys, zs] = [0, 1, 2].map(|axis| self.cells_along(axis, sphere.center[axis], reach));
        for z in zs.0..=zs.1 {
            let z_squared = self.gap(2, z, sphere.center.z).powi(2);
            for y in ys.0..=ys.1 {
                let yz_squared = z_squared + self.gap(1, y, sphere.center.y).powi(2);
                let row = self.cells.dims[0] * (y + self.cells.dims[1] * z);
                for x in xs.0..=xs.1 {
                    if yz_squared + self.gap(0, x, sphere.center.x).powi(2) <= reach * reach {
                        visit(row + x);
                    }
                }
            }
        }
    }

    /// First and last cell along an axis within `reach` of a coordinate.
    fn cells_along(&self, axis: usize, center: f64, reach: f64) -> (usize, usize) {
        let cell = |coordinate: f64| {
            let place = ((coordinate - self.cells.lower[axis]) / self.cells.size).max(0.0) as usize;
            place.min(self.cells.dims[axis] - 1)
        };
        (cell(center - reach), cell(center + reach))
    }

    /// Distance along an axis from a coordinate to a layer of cells; 0 inside.
    fn gap(&self, axis: usize, layer: usize, center: f64) -> f64 {
        let low = self.cells.lower[axis] + layer as f64 * self.cells.size;
        (low - center).max(center - (low + self.cells.size)).max(0.0)
    }

    /// The nearest sphere that the ray meets; of several at the same distance the one with the lowest number.
    #[inline]
    pub fn nearest(&self, span: &RaySpan) -> Option<SphereHit> {
        self.first(span, |sphere| span.meets(self.spheres[sphere]))
    }

    /// The sphere that a point lies inside, that with the lowest number if there are several; a point on a surface, to nine
    /// digits, is outside.
    pub fn sphere_around(&self, point: Vec3) -> Option<u32> {
        let direction = Vec3::AXES[0];
        let span = RaySpan { origin: point, direction, from: 0.0, to: 0.0, skip: NO_SPHERE };
        let holds = |number: usize| {
            let sphere = self.spheres[number];
            let radius = sphere.radius * (1.0 - 1e-9);
            ((point - sphere.center).norm_squared() < radius * radius).then_some(0.0)
        };
        self.first(&span, holds).map(|hit| hit.sphere)
    }

    /// How far the ray meets none of the spheres, wherever they move while this build of the grid is valid.
    pub fn clear_until(&self, span: &RaySpan) -> Clear {
        let margin = self.margin * (CLEAR_MARGIN / MARGIN);
        let ball = |sphere: Sphere| Sphere { radius: sphere.radius + margin, ..sphere };
        let first = self.first(span, |sphere| span.touches(ball(self.built[sphere])));
        let until = first.map_or(span.to, |hit| hit.at);
        Clear { until, build: self.build }
    }

    /// Whether the ray is known to meet nothing up to `end` [m].
    #[inline]
    pub fn is_clear(&self, clear: &Clear, end: f64) -> bool {
        clear.build == self.build && end < clear.until
    }

    /// The first of the spheres along the ray's way by the distance that `test` finds for a number.
    #[inline]
    fn first(&self, span: &RaySpan, test: impl Fn(usize) -> Option<f64>) -> Option<SphereHit> {
        let (enter, leave) = self.clip(span)?;
        let mut walk = Walk::new(&self.cells, span, enter);
        let mut best = SphereHit { at: span.to, sphere: NO_SPHERE };
        loop {
            let first = self.starts[walk.cell] as usize;
            let last = self.starts[walk.cell + 1] as usize;
            for &sphere in &self.entries[first..last] {
                if let Some(at) = test(sphere as usize)
                    && (at < best.at || (at == best.at && sphere < best.sphere))
                    && sphere != span.skip
                {
                    best = SphereHit { at, sphere };
                }
            }
            // At equal distance the next cell is looked at too: it may hold a lower number.
            if walk.next_face() > best.at.min(leave) || !walk.step() {
                break;
            }
        }
        (best.sphere != NO_SPHERE).then_some(best)
    }

    /// The part of the span inside the grid's box.
    #[inline]
    fn clip(&self, span: &RaySpan) -> Option<(f64, f64)> {
        if self.cells.dims[0] == 0 {
            return None;
        }
        let (mut enter, mut leave) = (span.from, span.to);
        for axis in 0..3 {
            let (o, d) = (span.origin[axis], span.direction[axis]);
            if d == 0.0 {
                if o < self.cells.lower[axis] || o > self.upper[axis] {
                    return None;
                }
                continue;
            }
            let (a, b) = ((self.cells.lower[axis] - o) / d, (self.upper[axis] - o) / d);
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        (enter <= leave).then_some((enter, leave))
    }
}
