//! Where cells lie, and which of them are within reach of a place.

use std::ops::Range;

use crate::domain::Space;
use crate::math::Vec3;

/// Where the cells lie.
#[derive(Clone, Copy, Debug)]
pub enum Span {
    /// About the spheres, wherever they are in a space that may repeat itself; for searches that reach about as far as the cells
    /// are made for, and look for each sphere once, where it is nearest.
    Free(Space),
    /// In the block around the spheres; for searches that reach any distance.
    Around,
    /// In the block between two corners [m]; spheres outside belong to the cells at its border. Along some axes it may repeat itself:
    /// each image of a sphere counts.
    Block([Vec3; 2], [bool; 3]),
}

/// Most cells per sphere.
const CELLS_PER_SPHERE: u64 = 4;
/// Few spheres may have this many cells all the same.
const FEW_CELLS: u64 = 64;
/// Coordinates may be rounded by this part of a reach.
const ROUNDING: f64 = 1e-9;

/// A cell by its numbers along the axes.
pub(super) type Cell = [i64; 3];

/// Cells laid over space. Each has a bucket of its own, or shares one where cells are hashed.
#[derive(Clone, Debug, Default)]
pub(super) struct Lattice {
    lower: Vec3,
    per_metre: [f64; 3],
    counts: Cell,
    /// A power of two less one where cells are hashed.
    mask: Option<u64>,
    /// Along which axes cells repeat themselves.
    repeats: [bool; 3],
    /// Whether each sphere is looked for once, wherever its images are, and may be filed while it is out of the block.
    is_folded: bool,
}

impl Lattice {
    /// Cells for so many spheres, at least `width` [m] wide, over a block that spans from `lower` to `upper`.
    ///
    /// Cells of a block are as many as its spheres pay for. Cells about free spheres stay as narrow as they are wanted,
    /// and are hashed where they are too many.
    pub fn new(span: &Span, [lower, upper]: [Vec3; 2], width: f64, spheres: usize) -> Self {
        let most = (CELLS_PER_SPHERE * spheres as u64).max(FEW_CELLS);
        let lattice = Self { lower, ..Self::default() };
        match span {
            Span::Free(space) => lattice.about(upper, width, most, space),
            Span::Block(_, repeats) => Self { repeats: *repeats, ..lattice }.tiled(upper, width, most),
            Span::Around => lattice.tiled(upper, width, most),
        }
    }

    /// Cells of exactly this width; along axes on which space repeats itself a whole number of at least this.
    fn about(mut self, upper: Vec3, width: f64, most: u64, space: &Space) -> Self {
        self.is_folded = space.repeats();
        self.repeats = [0, 1, 2].map(|axis| space.repeats_along(axis));
        let [corner, _] = space.corners();
        self.lower =
            [0, 1, 2].map(|axis| if self.repeats[axis] { corner[axis] } else { self.lower[axis] }).into();
        for axis in 0..3 {
            if self.repeats[axis] {
                let period = space.periods()[axis];
                self.counts[axis] = (period / width).floor().max(1.0) as i64;
                self.per_metre[axis] = self.counts[axis] as f64 / period;
                continue;
            }
            self.per_metre[axis] = 1.0 / width;
            // A motion that blew up may be anywhere; it is found after the search, which must get that far.
            // Counted with the rounding of the search: a quotient may fall just below a whole number where the product with
            // the inverse does not.
            self.counts[axis] = self.coordinate(upper[axis], axis).saturating_add(1);
        }
        let cells = self.counts.iter().try_fold(1_u64, |product, count| product.checked_mul(*count as u64));
        self.mask =
            if cells.is_some_and(|cells| cells <= most) { None } else { Some(most.next_power_of_two() - 1) };
        self
    }

    /// A whole number of cells along each edge.
    fn tiled(mut self, upper: Vec3, mut width: f64, most: u64) -> Self {
        let edges = upper - self.lower;
        let count = |axis: usize, width: f64| {
            let cells = (edges[axis] / width).floor();
            if cells.is_finite() { cells.max(1.0) } else { 1.0 }
        };
        while (0..3).map(|axis| count(axis, width)).product::<f64>() > most as f64 {
            width *= 1.1;
        }
        for axis in 0..3 {
            let cells = count(axis, width);
            self.counts[axis] = cells as i64;
            self.per_metre[axis] = if edges[axis] > 0.0 { cells / edges[axis] } else { 0.0 };
        }
        self
    }

    /// How many buckets there are.
    pub fn buckets(&self) -> usize {
        self.mask.map_or_else(|| self.counts.iter().product::<i64>() as usize, |mask| mask as usize + 1)
    }

    /// Whether cells share buckets.
    pub fn is_hashed(&self) -> bool {
        self.mask.is_some()
    }

    #[inline]
    fn coordinate(&self, along: f64, axis: usize) -> i64 {
        ((along - self.lower[axis]) * self.per_metre[axis]).floor() as i64
    }

    /// The cell that a place belongs to: outside of the block that of its image, or the nearest one at the border.
    #[inline]
    pub fn cell(&self, place: Vec3) -> Cell {
        [0, 1, 2].map(|axis| {
            let (cell, count) = (self.coordinate(place[axis], axis), self.counts[axis]);
            if self.is_folded && self.repeats[axis] {
                cell.rem_euclid(count)
            } else {
                cell.clamp(0, count - 1)
            }
        })
    }

    /// The bucket of a cell.
    #[inline]
    pub fn bucket(&self, [x, y, z]: Cell) -> usize {
        let row = y.wrapping_add(self.counts[1].wrapping_mul(z));
        let linear = x.wrapping_add(self.counts[0].wrapping_mul(row)) as u64;
        match self.mask {
            None => linear as usize,
            Some(mask) => ((linear.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 32) & mask) as usize,
        }
    }

    /// Whether `holds` says so of all cells within `reach` [m] of a place. It is asked, by z, y, x and no further once it does
    /// not, of buckets that follow one another, with their first cell and the number of their image.
    #[inline]
    pub fn all_within(
        &self,
        center: Vec3,
        reach: f64,
        holds: &mut impl FnMut(Range<usize>, Cell, [i8; 3]) -> bool,
    ) -> bool {
        let reach = reach * (1.0 + ROUNDING);
        let within = |cell: i64, axis: usize| {
            if self.repeats[axis] { cell } else { cell.clamp(0, self.counts[axis] - 1) }
        };
        let low = [0, 1, 2].map(|axis| within(self.coordinate(center[axis] - reach, axis), axis));
        let high = [0, 1, 2].map(|axis| within(self.coordinate(center[axis] + reach, axis), axis));
        if self.repeats != [false; 3] {
            return self.all_across(low, high, holds);
        }
        for z in low[2]..=high[2] {
            for y in low[1]..=high[1] {
                let first = self.bucket([low[0], y, z]);
                let holds = match self.mask {
                    None => holds(first..first + (high[0] - low[0]) as usize + 1, [low[0], y, z], [0; 3]),
                    Some(_) => (low[0]..=high[0]).all(|x| {
                        let bucket = self.bucket([x, y, z]);
                        holds(bucket..bucket + 1, [x, y, z], [0; 3])
                    }),
                };
                if !holds {
                    return false;
                }
            }
        }
        true
    }

    /// The same where the block repeats itself.
    fn all_across(
        &self,
        low: Cell,
        high: Cell,
        holds: &mut impl FnMut(Range<usize>, Cell, [i8; 3]) -> bool,
    ) -> bool {
        let fold = |cell: i64, axis: usize| {
            let count = self.counts[axis];
            if self.repeats[axis] {
                (cell.rem_euclid(count), cell.div_euclid(count) as i8)
            } else {
                (cell, 0)
            }
        };
        // Where each sphere is looked for once, so is each cell.
        let last = |axis: usize| {
            let once = low[axis].saturating_add(self.counts[axis] - 1);
            if self.is_folded { high[axis].min(once) } else { high[axis] }
        };
        for z in low[2]..=last(2) {
            let (z, image_z) = fold(z, 2);
            for y in low[1]..=last(1) {
                let (y, image_y) = fold(y, 1);
                let mut x = low[0];
                while x <= last(0) {
                    let (at, image_x) = fold(x, 0);
                    // Cells that share buckets do not follow one another.
                    let row = if self.mask.is_some() { 1 } else { self.counts[0] - at };
                    let length = row.min(last(0) - x + 1);
                    let first = self.bucket([at, y, z]);
                    if !holds(first..first + length as usize, [at, y, z], [image_x, image_y, image_z]) {
                        return false;
                    }
                    x += length;
                }
            }
        }
        true
    }
}
