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

mod across;
#[cfg(test)]
mod across_tests;
mod span;
#[cfg(test)]
mod tests;
mod walk;

use std::sync::atomic::{AtomicU64, Ordering};

use crate::domain::Space;
use crate::math::Vec3;
use across::{Around, Piece};
use span::Sphere;
use walk::{Cells, Walk};

pub use across::ImageHit;
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
    /// What there is besides where space repeats itself.
    around: Option<Around>,
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
            around: None,
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

    fn is_valid(&mut self) -> bool {
        if let Some(around) = &mut self.around {
            return self.builds > 0 && around.follow(&self.spheres, self.margin);
        }
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
        if let Some(mut around) = self.around.take() {
            around.images_of(&self.spheres, |image| self.reaches_rays(image), &mut built);
            self.around = Some(around);
        } else {
            built.extend(self.spheres.iter().map(|&sphere| {
                let radius = if self.reaches_rays(sphere) { sphere.radius } else { -1.0 };
                Sphere { radius, ..sphere }
            }));
        }
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
        if let Some(around) = &self.around {
            return self.image_around(around, point);
        }
        let direction = Vec3::AXES[0];
        let span = RaySpan { origin: point, direction, from: 0.0, to: 0.0, skip: NO_SPHERE };
        let holds = |number: usize| self.spheres[number].holds(point).then_some(0.0);
        self.first(&span, holds).map(|hit| hit.sphere)
    }

    /// How far the ray meets none of the spheres, wherever they move while this build of the grid is valid.
    pub fn clear_until(&self, span: &RaySpan) -> Clear {
        let margin = self.margin * (CLEAR_MARGIN / MARGIN);
        if let Some(around) = &self.around {
            return self.clear_across(around, span, margin);
        }
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

/// Where space repeats itself.
impl RayGrid {
    /// An empty grid for rays in space that repeats itself.
    pub fn across(space: Space) -> Self {
        let [lower, upper] = space.corners();
        let along = |axis: usize, face: f64, open: f64| if space.repeats_along(axis) { face } else { open };
        let corner = |of: Vec3, open: f64| Vec3::from([0, 1, 2].map(|axis| along(axis, of[axis], open)));
        let grid = Self::new(corner(lower, f64::NEG_INFINITY), corner(upper, f64::INFINITY));
        Self { around: Some(Around::new(space)), ..grid }
    }

    /// The nearest image of a sphere that the ray meets, in space that repeats itself; of several at the same distance that of the sphere
    /// with the lowest number. The span has an end.
    pub fn nearest_image(&self, span: &RaySpan) -> Option<ImageHit> {
        let around = self.around.as_ref()?;
        let left = around.left(span, &self.spheres);
        let mut best = ImageHit { hit: SphereHit { at: span.to, sphere: NO_SPHERE }, shift: Vec3::ZERO };
        around.pieces(span, |piece| {
            let local = self.within(span, piece);
            self.each_entry(&local, |entry| {
                let (sphere, image) = around.image_of(entry, piece.image);
                let shift = around.space().shift_to(image);
                let moved = RaySpan { origin: span.origin - shift, ..*span };
                if let Some(at) = moved.meets(self.spheres[sphere as usize])
                    && (at < best.hit.at || (at == best.hit.at && sphere < best.hit.sphere))
                    && !(sphere == span.skip && left == Some(image))
                {
                    best = ImageHit { hit: SphereHit { at, sphere }, shift };
                }
                best.hit.at
            });
            best.hit.at
        });
        (best.hit.sphere != NO_SPHERE).then_some(best)
    }

    /// As [`RayGrid::clear_until`], no farther than a period.
    fn clear_across(&self, around: &Around, span: &RaySpan, margin: f64) -> Clear {
        let to = span.to.min(span.from + around.space().shortest_period());
        let span = RaySpan { to, ..*span };
        let left = around.left(&span, &self.spheres);
        let mut until = to;
        around.pieces(&span, |piece| {
            let local = self.within(&span, piece);
            let here = RaySpan { from: span.from, to, ..local };
            self.each_entry(&local, |entry| {
                let (sphere, image) = around.image_of(entry, piece.image);
                let built = self.built[entry as usize];
                let ball = Sphere { radius: built.radius + margin, ..built };
                if !(sphere == span.skip && left == Some(image))
                    && let Some(at) = here.touches(ball)
                {
                    until = until.min(at);
                }
                until
            });
            until
        });
        Clear { until, build: self.build }
    }

    /// The sphere that a point lies inside in one of its images.
    fn image_around(&self, around: &Around, point: Vec3) -> Option<u32> {
        let span = RaySpan {
            origin: around.space().home(point).0,
            direction: Vec3::AXES[0],
            from: 0.0,
            to: 0.0,
            skip: NO_SPHERE,
        };
        let mut found = None;
        self.each_entry(&span, |entry| {
            let (sphere, image) = around.image_of(entry, [0; 3]);
            let shift = around.space().shift_to(image);
            if self.spheres[sphere as usize].holds(span.origin - shift) {
                found = Some(found.map_or(sphere, |found: u32| found.min(sphere)));
            }
            0.0
        });
        found
    }

    /// A piece of a ray as the grid has it.
    fn within(&self, span: &RaySpan, piece: &Piece) -> RaySpan {
        let shift = self.around.as_ref().map_or(Vec3::ZERO, |around| around.space().shift_to(piece.image));
        RaySpan { origin: span.origin - shift, from: piece.from, to: piece.to, ..*span }
    }

    /// Shows what the cells along a piece of a ray hold, as far as `visit` says that it matters [m].
    #[inline]
    fn each_entry(&self, span: &RaySpan, mut visit: impl FnMut(u32) -> f64) {
        let Some((enter, leave)) = self.clip(span) else { return };
        let mut walk = Walk::new(&self.cells, span, enter);
        let mut most = f64::INFINITY;
        loop {
            let (first, last) = (self.starts[walk.cell] as usize, self.starts[walk.cell + 1] as usize);
            for &entry in &self.entries[first..last] {
                most = visit(entry);
            }
            if walk.next_face() > most.min(leave) || !walk.step() {
                break;
            }
        }
    }
}
