//! Hard spheres sorted into cells, one grid per octave of size, with the images that a periodic volume repeats.
//!
//! A sphere is found in the cell where it was when the cells were filled; who asks has to widen its reach by how far
//! spheres may have come since.

use crate::domain::{Boundary, Volume};
use crate::engine::hard::spheres::Spheres;
use crate::math::Vec3;

/// Most cells per sphere of a level.
const CELLS_PER_SPHERE: f64 = 4.0;
/// A level with few spheres may have this many cells all the same.
const FEW_CELLS: f64 = 64.0;
/// Coordinates may be rounded by this part of a reach.
const ROUNDING: f64 = 1e-9;

/// Spheres by cell.
#[derive(Clone, Debug, Default)]
pub(super) struct Cells {
    levels: Vec<Level>,
    level_of: Vec<u8>,
    periodic: bool,
}

/// The cells of spheres of one octave of radius.
#[derive(Clone, Debug, Default)]
struct Level {
    largest_radius: f64,
    lower: Vec3,
    per_metre: [f64; 3],
    counts: [i64; 3],
    indices: Vec<u32>,
    starts: Vec<u32>,
    members: Vec<u32>,
}

impl Level {
    #[inline]
    fn coordinate(&self, along: f64, axis: usize) -> i64 {
        ((along - self.lower[axis]) * self.per_metre[axis]).floor() as i64
    }

    #[inline]
    fn bucket(&self, [x, y, z]: [i64; 3]) -> usize {
        (x + self.counts[0] * (y + self.counts[1] * z)) as usize
    }

    /// The cell that a sphere belongs to. One that lies outside belongs to the nearest cell at the border.
    #[inline]
    fn home(&self, position: Vec3) -> usize {
        self.bucket(
            [0, 1, 2].map(|axis| self.coordinate(position[axis], axis).clamp(0, self.counts[axis] - 1)),
        )
    }

    /// Lays cells that are at least `width` wide over a block.
    fn lay(&mut self, lower: Vec3, edges: Vec3, mut width: f64) {
        self.lower = lower;
        let most = (CELLS_PER_SPHERE * self.indices.len() as f64).max(FEW_CELLS);
        let count = |axis: usize, width: f64| {
            let cells = (edges[axis] / width).floor();
            if cells.is_finite() { cells.max(1.0) } else { 1.0 }
        };
        while (0..3).map(|axis| count(axis, width)).product::<f64>() > most {
            width *= 1.25;
        }
        for axis in 0..3 {
            let cells = count(axis, width);
            self.counts[axis] = cells as i64;
            self.per_metre[axis] = if edges[axis] > 0.0 { cells / edges[axis] } else { 0.0 };
        }
    }

    fn sort(&mut self, spheres: &Spheres) {
        let buckets = self.counts.iter().product::<i64>() as usize;
        self.starts.clear();
        self.starts.resize(buckets + 1, 0);
        for &at in &self.indices {
            let bucket = self.home(spheres.motion[at as usize].position);
            self.starts[bucket] += 1;
        }
        let mut sum = 0;
        for start in &mut self.starts {
            sum += *start;
            *start = sum;
        }
        self.members.clear();
        self.members.resize(self.indices.len(), 0);
        for &at in self.indices.iter().rev() {
            let bucket = self.home(spheres.motion[at as usize].position);
            self.starts[bucket] -= 1;
            self.members[self.starts[bucket] as usize] = at;
        }
    }

    #[inline]
    fn visit(&self, periodic: bool, center: Vec3, reach: f64, visit: &mut impl FnMut(u32, [i8; 3])) {
        let reach = reach * (1.0 + ROUNDING);
        let within =
            |cell: i64, axis: usize| if periodic { cell } else { cell.clamp(0, self.counts[axis] - 1) };
        let low = [0, 1, 2].map(|axis| within(self.coordinate(center[axis] - reach, axis), axis));
        let high = [0, 1, 2].map(|axis| within(self.coordinate(center[axis] + reach, axis), axis));
        let fold = |cell: i64, axis: usize| {
            let count = self.counts[axis];
            if (0..count).contains(&cell) {
                (cell, 0)
            } else {
                (cell.rem_euclid(count), cell.div_euclid(count) as i8)
            }
        };
        for z in low[2]..=high[2] {
            let (z, image_z) = fold(z, 2);
            for y in low[1]..=high[1] {
                let (y, image_y) = fold(y, 1);
                for x in low[0]..=high[0] {
                    let (x, image_x) = fold(x, 0);
                    let bucket = self.bucket([x, y, z]);
                    let range = self.starts[bucket] as usize..self.starts[bucket + 1] as usize;
                    for &member in &self.members[range] {
                        visit(member, [image_x, image_y, image_z]);
                    }
                }
            }
        }
    }
}

impl Cells {
    /// Sorts all spheres into cells that suit searches with surfaces up to `margin` [m] apart.
    pub fn fill(&mut self, spheres: &Spheres, volume: &Volume, margin: f64) {
        self.periodic = volume.boundary == Boundary::Periodic;
        for level in &mut self.levels {
            level.indices.clear();
            level.largest_radius = 0.0;
        }
        let radius = |at: u32| spheres.motion[at as usize].radius;
        let smallest = spheres.living().map(radius).fold(f64::INFINITY, f64::min);
        self.level_of.clear();
        self.level_of.resize(spheres.slots(), 0);
        for at in spheres.living() {
            let octave = (radius(at) / smallest).log2().max(0.0) as u8;
            self.level_of[at as usize] = octave;
            if self.levels.len() <= octave as usize {
                self.levels.resize_with(octave as usize + 1, Level::default);
            }
            let level = &mut self.levels[octave as usize];
            level.indices.push(at);
            level.largest_radius = level.largest_radius.max(radius(at));
        }
        for level in &mut self.levels {
            let (lower, edges) = if volume.boundary.wraps() {
                (volume.lower(), volume.edges())
            } else {
                extent(spheres, &level.indices)
            };
            level.lay(lower, edges, 2.0 * level.largest_radius + margin);
            level.sort(spheres);
        }
    }

    /// Visits every sphere, with the number of the image, whose surface was nearer to `center` than `reach` [m] when
    /// the cells were filled; visits more.
    pub fn visit_all(&self, center: Vec3, reach: f64, visit: &mut impl FnMut(u32, [i8; 3])) {
        for level in self.levels.iter().filter(|level| !level.indices.is_empty()) {
            level.visit(self.periodic, center, reach + level.largest_radius, visit);
        }
    }

    /// The same for the partners of a sphere, so that each pair is visited from one side only.
    pub fn visit_partners(&self, of: u32, center: Vec3, reach: f64, visit: &mut impl FnMut(u32, [i8; 3])) {
        let own = self.level_of[of as usize] as usize;
        for (number, level) in self.levels.iter().enumerate().skip(own) {
            if !level.indices.is_empty() {
                level.visit(self.periodic, center, reach + level.largest_radius, &mut |at, image| {
                    if number > own || at > of {
                        visit(at, image);
                    }
                });
            }
        }
    }
}

/// Lower corner and edges of the block around spheres.
fn extent(spheres: &Spheres, indices: &[u32]) -> (Vec3, Vec3) {
    let position = |at: &u32| spheres.motion[*at as usize].position;
    let first = indices.first().map_or(Vec3::ZERO, position);
    let (lower, upper) =
        indices.iter().map(position).fold((first, first), |(low, high), at| (low.min(at), high.max(at)));
    (lower, upper - lower)
}
