//! Where cells lie, and which of them are within reach of a place.

use std::ops::Range;

use crate::math::Vec3;

/// Where the cells lie.
#[derive(Clone, Copy, Debug)]
pub enum Span {
    /// About the spheres, wherever they are; for searches that reach about as far as the cells are made for.
    Free,
    /// In the block around the spheres; for searches that reach any distance.
    Around,
    /// In the block between two corners [m]; spheres outside belong to the cells at its border.
    Block([Vec3; 2]),
    /// In the block between two corners [m], which repeats itself.
    Periodic([Vec3; 2]),
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
    repeats: bool,
}

impl Lattice {
    /// Cells for so many spheres, at least `width` [m] wide, over a block that spans from `lower` to `upper`.
    ///
    /// Cells of a block are as many as its spheres pay for. Cells about free spheres stay as narrow as they are wanted,
    /// and are hashed where they are too many.
    pub fn new(span: &Span, [lower, upper]: [Vec3; 2], width: f64, spheres: usize) -> Self {
        let most = (CELLS_PER_SPHERE * spheres as u64).max(FEW_CELLS);
        let repeats = matches!(span, Span::Periodic(..));
        let lattice = Self { lower, repeats, ..Self::default() };
        if matches!(span, Span::Free) {
            lattice.about(upper, width, most)
        } else {
            lattice.tiled(upper, width, most)
        }
    }

    /// Cells of exactly this width.
    fn about(mut self, upper: Vec3, width: f64, most: u64) -> Self {
        self.per_metre = [1.0 / width; 3];
        // A motion that blew up may be anywhere; it is found after the search, which must get that far.
        // Counted with the rounding of the search: a quotient may fall just below a whole number where the product with
        // the inverse does not.
        self.counts = [0, 1, 2].map(|axis| self.coordinate(upper[axis], axis).saturating_add(1));
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

    /// The cell that a place belongs to: outside of the block the nearest one at its border.
    #[inline]
    pub fn cell(&self, place: Vec3) -> Cell {
        [0, 1, 2].map(|axis| self.coordinate(place[axis], axis).clamp(0, self.counts[axis] - 1))
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
        let within =
            |cell: i64, axis: usize| if self.repeats { cell } else { cell.clamp(0, self.counts[axis] - 1) };
        let low = [0, 1, 2].map(|axis| within(self.coordinate(center[axis] - reach, axis), axis));
        let high = [0, 1, 2].map(|axis| within(self.coordinate(center[axis] + reach, axis), axis));
        if self.repeats {
            return self.all_folded(low, high, holds);
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
    fn all_folded(
        &self,
        low: Cell,
        high: Cell,
        holds: &mut impl FnMut(Range<usize>, Cell, [i8; 3]) -> bool,
    ) -> bool {
        let fold = |cell: i64, axis: usize| {
            let count = self.counts[axis];
            (cell.rem_euclid(count), cell.div_euclid(count) as i8)
        };
        for z in low[2]..=high[2] {
            let (z, image_z) = fold(z, 2);
            for y in low[1]..=high[1] {
                let (y, image_y) = fold(y, 1);
                let mut x = low[0];
                while x <= high[0] {
                    let (at, image_x) = fold(x, 0);
                    let length = (self.counts[0] - at).min(high[0] - x + 1);
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
