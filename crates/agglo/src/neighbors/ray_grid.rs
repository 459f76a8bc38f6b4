//! A uniform grid over spheres that rays walk through (3-D DDA): exact nearest hits on spheres that move.
//!
//! Spheres are binned with a margin, and the exact test uses where they are now; so the grid stays valid until
//! one has moved by the margin. What a ray hits never depends on when the grid was built: the cells only say
//! which spheres are tested. Spheres that do not touch the box of the rays are not binned.
//!
//! Source: J. Amanatides and A. Woo, *A fast voxel traversal algorithm for ray tracing*, Eurographics (1987).

use crate::math::Vec3;

/// In place of a sphere's number: none.
pub const NO_SPHERE: u32 = u32::MAX;

/// Cells per sphere that a new grid aims at; twice as many are allowed for awkward boxes.
const CELLS_PER_SPHERE: f64 = 4.0;
/// How far a sphere may move before the grid is built anew, as a part of the mean radius.
const MARGIN: f64 = 0.1;
/// Spheres are binned with a little more than the margin, so that rounding in the walk cannot miss one.
const BINNED_MARGIN: f64 = 1.01 * MARGIN;

/// A straight piece of a ray: points `origin + t direction` with `from <= t <= to`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RaySpan {
    /// Where t is 0 [m].
    pub origin: Vec3,
    /// Unit vector.
    pub direction: Vec3,
    /// Smallest t [m], not below 0.
    pub from: f64,
    /// Largest t [m]; infinity allowed.
    pub to: f64,
    /// Sphere that is not to be hit; [`NO_SPHERE`] if all count.
    pub skip: u32,
}

/// The nearest hit of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereHit {
    /// Distance from the span's origin [m].
    pub at: f64,
    /// Number of the sphere.
    pub sphere: u32,
}

/// A sphere, packed for the exact test.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sphere {
    center: Vec3,
    radius: f64,
}

/// The grid; see the module.
#[derive(Clone, Debug)]
pub struct RayGrid {
    rays_lower: Vec3,
    rays_upper: Vec3,
    lower: Vec3,
    upper: Vec3,
    cell: f64,
    dims: [usize; 3],
    margin: f64,
    starts: Vec<u32>,
    entries: Vec<u32>,
    spheres: Vec<Sphere>,
    /// As they were when the grid was built; a negative radius marks those that are not binned.
    built: Vec<Sphere>,
    builds: u64,
}

impl RaySpan {
    /// Where the ray first meets a sphere: now, if its point lies inside and heads inward; never, if outward.
    #[inline]
    fn meets(&self, sphere: Sphere) -> Option<f64> {
        let from_center = self.origin - sphere.center;
        let nearest = -from_center.dot(self.direction);
        if nearest <= self.from {
            return None;
        }
        // Both roots without cancellation; the offset form keeps far and small spheres exact.
        let offset = from_center + self.direction * nearest;
        let half_chord_squared = sphere.radius * sphere.radius - offset.norm_squared();
        if half_chord_squared < 0.0 {
            return None;
        }
        let outside = from_center.norm_squared() - sphere.radius * sphere.radius;
        let entry = outside / (nearest + half_chord_squared.sqrt());
        Some(entry.max(self.from))
    }
}

impl RayGrid {
    /// An empty grid for rays that stay between these corners [m].
    pub fn new(rays_lower: Vec3, rays_upper: Vec3) -> Self {
        Self {
            rays_lower,
            rays_upper,
            lower: rays_lower,
            upper: rays_lower,
            cell: 0.0,
            dims: [0; 3],
            margin: 0.0,
            starts: Vec::new(),
            entries: Vec::new(),
            spheres: Vec::new(),
            built: Vec::new(),
            builds: 0,
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
            self.dims = [0; 3];
            return;
        }
        let slack = Vec3::new(margin, margin, margin);
        self.lower = lower.max(self.rays_lower - slack);
        self.upper = upper.min(self.rays_upper + slack);
        let extent = (self.upper - self.lower).to_array();
        let wanted = CELLS_PER_SPHERE * f64::from(count);
        self.cell = (extent.iter().product::<f64>() / wanted).cbrt();
        loop {
            self.dims = extent.map(|length| (length / self.cell).ceil().max(1.0) as usize);
            if self.dims.iter().product::<usize>() as f64 <= 2.0 * wanted + 64.0 {
                break;
            }
            self.cell *= 1.25;
        }
    }

    /// Counting sort: a sphere goes into every cell that it touches; numbers ascend within a cell.
    fn sort_into_cells(&mut self, margin: f64) {
        let cells = self.dims.iter().product::<usize>();
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
                let row = self.dims[0] * (y + self.dims[1] * z);
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
            let place = ((coordinate - self.lower[axis]) / self.cell).max(0.0) as usize;
            place.min(self.dims[axis] - 1)
        };
        (cell(center - reach), cell(center + reach))
    }

    /// Distance along an axis from a coordinate to a layer of cells; 0 inside.
    fn gap(&self, axis: usize, layer: usize, center: f64) -> f64 {
        let low = self.lower[axis] + layer as f64 * self.cell;
        (low - center).max(center - (low + self.cell)).max(0.0)
    }

    /// The nearest sphere that the ray meets; of several at the same distance the one with the lowest number.
    #[inline]
    pub fn nearest(&self, span: &RaySpan) -> Option<SphereHit> {
        let (enter, leave) = self.clip(span)?;
        let mut walk = Walk::new(self, span, enter);
        let mut best = SphereHit { at: span.to, sphere: NO_SPHERE };
        loop {
            let first = self.starts[walk.cell] as usize;
            let last = self.starts[walk.cell + 1] as usize;
            for &sphere in &self.entries[first..last] {
                if let Some(at) = span.meets(self.spheres[sphere as usize])
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
        if self.dims[0] == 0 {
            return None;
        }
        let (mut enter, mut leave) = (span.from, span.to);
        for axis in 0..3 {
            let (o, d) = (span.origin[axis], span.direction[axis]);
            if d == 0.0 {
                if o < self.lower[axis] || o > self.upper[axis] {
                    return None;
                }
                continue;
            }
            let (a, b) = ((self.lower[axis] - o) / d, (self.upper[axis] - o) / d);
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        (enter <= leave).then_some((enter, leave))
    }
}

/// A ray's walk from cell to cell.
struct Walk {
    cell: usize,
    /// Distance at which the ray crosses the next face across each axis.
    next: [f64; 3],
    /// From face to face.
    between: [f64; 3],
    stride: [isize; 3],
    /// Cells left before the box ends.
    left: [usize; 3],
}

impl Walk {
    #[inline]
    fn new(grid: &RayGrid, span: &RaySpan, enter: f64) -> Self {
        let start = span.origin + span.direction * enter;
        let mut walk =
            Self { cell: 0, next: [f64::INFINITY; 3], between: [0.0; 3], stride: [0; 3], left: [0; 3] };
        let mut row = 1;
        for axis in 0..3 {
            let dims = grid.dims[axis];
            let place = (((start[axis] - grid.lower[axis]) / grid.cell).max(0.0) as usize).min(dims - 1);
            walk.cell += row * place;
            let d = span.direction[axis];
            if d != 0.0 {
                let ahead = d > 0.0;
                let face = grid.lower[axis] + (place + usize::from(ahead)) as f64 * grid.cell;
                walk.next[axis] = (face - span.origin[axis]) / d;
                walk.between[axis] = grid.cell / d.abs();
                walk.stride[axis] = if ahead { row.cast_signed() } else { -row.cast_signed() };
                walk.left[axis] = if ahead { dims - 1 - place } else { place };
            }
            row *= dims;
        }
        walk
    }

    #[inline]
    fn axis(&self) -> usize {
        let [x, y, z] = self.next;
        if x <= y && x <= z {
            0
        } else if y <= z {
            1
        } else {
            2
        }
    }

    #[inline]
    fn next_face(&self) -> f64 {
        self.next[self.axis()]
    }

    /// Goes into the next cell; false if the box ends here.
    #[inline]
    fn step(&mut self) -> bool {
        let axis = self.axis();
        if self.left[axis] == 0 {
            return false;
        }
        self.left[axis] -= 1;
        self.next[axis] += self.between[axis];
        self.cell = self.cell.wrapping_add_signed(self.stride[axis]);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::{Purpose, Stream};

    fn point(stream: &mut Stream, scale: f64) -> Vec3 {
        Vec3::new(stream.uniform() - 0.5, stream.uniform() - 0.5, stream.uniform() - 0.5) * (2.0 * scale)
    }

    fn brute_force(span: &RaySpan, positions: &[Vec3], radii: &[f64]) -> Option<SphereHit> {
        let mut best: Option<SphereHit> = None;
        for (number, (&center, &radius)) in positions.iter().zip(radii).enumerate() {
            let number = number as u32;
            if let Some(at) = span.meets(Sphere { center, radius })
                && number != span.skip
                && at <= span.to
                && best.is_none_or(|hit| at < hit.at)
            {
                best = Some(SphereHit { at, sphere: number });
            }
        }
        best
    }

    /// Spheres of size ratio 10 that overlap, move and partly lie outside; results are equal to the last bit.
    #[test]
    fn grid_finds_what_brute_force_finds_while_spheres_move() {
        let mut stream = Stream::new(3, Purpose::Sampling, 0);
        for count in [1, 2, 40, 700] {
            let corner = Vec3::new(1.0, 1.0, 1.0);
            let mut grid = RayGrid::new(-corner, corner);
            let mut positions: Vec<Vec3> = (0..count).map(|_| point(&mut stream, 1.3)).collect();
            let radii: Vec<f64> = (0..count).map(|_| 0.02 * 10.0_f64.powf(stream.uniform())).collect();
            let mut hits = 0;
            for _ in 0..25 {
                grid.update(&positions, &radii);
                for _ in 0..400 {
                    let mut direction = stream.direction();
                    if stream.uniform() < 0.2 {
                        direction = Vec3::AXES[(stream.uniform() * 3.0) as usize];
                    }
                    let from = if stream.uniform() < 0.5 { 0.0 } else { 0.3 * stream.uniform() };
                    let origin = point(&mut stream, 1.0) - direction * from;
                    let inside = crate::domain::Region::Box(crate::domain::Block {
                        lower: (-corner).to_array().map(crate::units::Quantity),
                        upper: corner.to_array().map(crate::units::Quantity),
                    });
                    let to = inside.exit_distance(origin, direction).min(from + 3.0 * stream.uniform());
                    let skip = (stream.uniform() * count as f64) as u32;
                    let span = RaySpan { origin, direction, from, to, skip };
                    let found = grid.nearest(&span);
                    assert_eq!(found, brute_force(&span, &positions, &radii), "{span:?}");
                    hits += usize::from(found.is_some());
                }
                for position in &mut positions {
                    *position += stream.direction() * (0.002 * stream.uniform());
                }
            }
            assert!(grid.builds() < 25 && (count < 700 || hits > 5000), "{} {hits}", grid.builds());
        }
    }

    #[test]
    fn distance_and_limits_by_hand() {
        let mut grid = RayGrid::new(Vec3::new(-9.0, -9.0, -9.0), Vec3::new(9.0, 9.0, 9.0));
        grid.update(&[Vec3::new(3.0, 0.6, 0.0), Vec3::new(3.0, 0.6, 0.0)], &[1.0, 1.0]);
        let span =
            RaySpan { origin: Vec3::ZERO, direction: Vec3::AXES[0], from: 0.0, to: 9.0, skip: NO_SPHERE };
        // 3 - sqrt(1 - 0.36) = 2.2; of two equal spheres the first is hit.
        let hit = grid.nearest(&span).unwrap();
        assert!((hit.at - 2.2).abs() < 1e-15 && hit.sphere == 0);
        assert_eq!(grid.nearest(&RaySpan { skip: 0, ..span }).unwrap().sphere, 1);
        assert_eq!(grid.nearest(&RaySpan { to: 2.19, ..span }), None);
        assert_eq!(grid.nearest(&RaySpan { to: hit.at, ..span }), Some(hit));
    }

    #[test]
    fn a_sphere_that_swept_over_the_ray_is_hit_at_once_or_never() {
        let mut grid = RayGrid::new(Vec3::new(-9.0, -9.0, -9.0), Vec3::new(9.0, 9.0, 9.0));
        grid.update(&[Vec3::new(3.0, 0.0, 0.0)], &[1.0]);
        let span =
            RaySpan { origin: Vec3::ZERO, direction: Vec3::AXES[0], from: 2.5, to: 9.0, skip: NO_SPHERE };
        assert_eq!(grid.nearest(&span).unwrap().at, 2.5);
        assert_eq!(grid.nearest(&RaySpan { from: 3.5, ..span }), None);
    }

    #[test]
    fn far_spheres_cost_no_rebuild_until_they_come_near() {
        let mut grid = RayGrid::new(Vec3::new(-1.0, -1.0, -1.0), Vec3::new(1.0, 1.0, 1.0));
        let mut positions = [Vec3::ZERO, Vec3::new(50.0, 0.0, 0.0)];
        for _ in 0..48 {
            grid.update(&positions, &[0.1, 0.1]);
            assert_eq!(grid.builds(), 1);
            positions[1].x -= 1.0;
        }
        positions[1].x = 1.0;
        grid.update(&positions, &[0.1, 0.1]);
        assert_eq!(grid.builds(), 2);
    }
}
