//! Spheres sorted into cells, one grid per octave of size.
//!
//! Each octave of radius has its own cells, as wide as the reach of two of its largest spheres, so that spheres
//! of very different size do not crowd one another's cells. Spheres that are spread so far that their cells would
//! outnumber them are hashed: memory stays in proportion to the number of spheres.

use crate::math::Vec3;

/// Most cells per sphere before cells are hashed.
const CELLS_PER_SPHERE: u64 = 4;

/// Spheres by cell.
#[derive(Debug, Default)]
pub struct CellGrid {
    levels: Vec<Level>,
    level_of: Vec<u8>,
}

#[derive(Debug, Default)]
struct Level {
    largest_radius: f64,
    lower: Vec3,
    cells_per_metre: f64,
    counts: [i64; 3],
    /// Buckets are cells where they fit, else hashes of cells; then this is a power of two less one.
    mask: Option<u64>,
    starts: Vec<u32>,
    members: Vec<u32>,
}

impl Level {
    fn coordinate(&self, along: f64, axis: usize) -> i64 {
        ((along - self.lower[axis]) * self.cells_per_metre).floor() as i64
    }

    fn cell(&self, position: Vec3) -> [i64; 3] {
        [0, 1, 2].map(|axis| self.coordinate(position[axis], axis))
    }

    fn bucket(&self, [x, y, z]: [i64; 3]) -> usize {
        let row = y.wrapping_add(self.counts[1].wrapping_mul(z));
        let linear = x.wrapping_add(self.counts[0].wrapping_mul(row)) as u64;
        match self.mask {
            None => linear as usize,
            Some(mask) => ((linear.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 32) & mask) as usize,
        }
    }

    /// Sorts the spheres of this level into buckets; `spheres` gives their numbers in rising order.
    fn fill(&mut self, positions: &[Vec3], spheres: &[u32], cell: f64) {
        let (mut lower, mut upper) =
            (Vec3::new(f64::MAX, f64::MAX, f64::MAX), -Vec3::new(f64::MAX, f64::MAX, f64::MAX));
        for &sphere in spheres {
            lower = lower.min(positions[sphere as usize]);
            upper = upper.max(positions[sphere as usize]);
        }
        self.lower = lower;
        self.cells_per_metre = 1.0 / cell;
        // A motion that blew up may be anywhere; it is found after the search, which must get that far.
        // Counted with the rounding of the search: a quotient may fall just below a whole number where the product with
        // the inverse does not.
        let count = |axis: usize| self.coordinate(upper[axis], axis).saturating_add(1);
        self.counts = [0, 1, 2].map(count);
        let limit = CELLS_PER_SPHERE * spheres.len() as u64;
        let cells = self.counts.iter().try_fold(1_u64, |product, count| product.checked_mul(*count as u64));
        let fits = cells.filter(|cells| *cells <= limit.max(64));
        self.mask = if fits.is_some() { None } else { Some(limit.next_power_of_two() - 1) };
        let buckets = fits.unwrap_or(limit.next_power_of_two()) as usize;
        self.starts.clear();
        self.starts.resize(buckets + 1, 0);
        for &sphere in spheres {
            let bucket = self.bucket(self.cell(positions[sphere as usize]));
            self.starts[bucket + 1] += 1;
        }
        for bucket in 0..buckets {
            self.starts[bucket + 1] += self.starts[bucket];
        }
        self.members.clear();
        self.members.resize(spheres.len(), 0);
        // Filled from the back so that the starts come out right and members rise within a bucket.
        for &sphere in spheres.iter().rev() {
            let bucket = self.bucket(self.cell(positions[sphere as usize]));
            self.starts[bucket + 1] -= 1;
            self.members[self.starts[bucket + 1] as usize] = sphere;
        }
        self.starts.rotate_left(1);
        if let Some(last) = self.starts.last_mut() {
            *last = spheres.len() as u32;
        }
    }

    fn visit(&self, positions: &[Vec3], at: Vec3, reach: f64, visit: &mut impl FnMut(u32)) {
        let low = [0, 1, 2].map(|axis| self.coordinate(at[axis] - reach, axis).max(0));
        let high = [0, 1, 2].map(|axis| self.coordinate(at[axis] + reach, axis).min(self.counts[axis] - 1));
        for z in low[2]..=high[2] {
            for y in low[1]..=high[1] {
                for x in low[0]..=high[0] {
                    let bucket = self.bucket([x, y, z]);
                    for &member in
                        &self.members[self.starts[bucket] as usize..self.starts[bucket + 1] as usize]
                    {
                        // Two cells may share a hashed bucket: only the sphere's own cell counts.
                        if self.mask.is_none() || self.cell(positions[member as usize]) == [x, y, z] {
                            visit(member);
                        }
                    }
                }
            }
        }
    }
}

impl CellGrid {
    /// Sorts spheres into cells for searches with surfaces up to `margin` apart.
    pub fn build(&mut self, positions: &[Vec3], radii: &[f64], margin: f64) {
        let smallest = radii.iter().copied().fold(f64::MAX, f64::min);
        self.level_of.clear();
        self.level_of.extend(radii.iter().map(|radius| (radius / smallest).log2().max(0.0) as u8));
        let count = self.level_of.iter().max().map_or(0, |top| *top as usize + 1);
        self.levels.resize_with(count, Level::default);
        let mut spheres = Vec::new();
        for (number, level) in self.levels.iter_mut().enumerate() {
            spheres.clear();
            spheres.extend((0..radii.len() as u32).filter(|k| self.level_of[*k as usize] as usize == number));
            level.largest_radius = spheres.iter().map(|k| radii[*k as usize]).fold(0.0, f64::max);
            level.members.clear();
            if !spheres.is_empty() {
                level.fill(positions, &spheres, 2.0 * level.largest_radius + margin);
            }
        }
    }

    /// Visits the spheres that `sphere` owns a pair with, in no particular order: those of its own octave with a
    /// higher number and all of higher octaves, near enough that surfaces may be closer than `margin`.
    #[inline]
    pub fn visit_partners(
        &self,
        positions: &[Vec3],
        radii: &[f64],
        sphere: u32,
        margin: f64,
        mut visit: impl FnMut(u32),
    ) {
        let (at, radius) = (positions[sphere as usize], radii[sphere as usize]);
        let own = self.level_of[sphere as usize] as usize;
        for (number, level) in self.levels.iter().enumerate().skip(own) {
            if level.members.is_empty() {
                continue;
            }
            let reach = radius + level.largest_radius + margin;
            level.visit(positions, at, reach, &mut |other| {
                if number > own || other > sphere {
                    visit(other);
                }
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 0.6/0.2 is just below 3, 0.6 times 5 is not: the outermost of spheres in a row at whole numbers of cells must
    /// still have a cell, and meet its neighbor, along every axis.
    #[test]
    fn the_outermost_sphere_has_a_cell() {
        let mut grid = CellGrid::default();
        for axis in Vec3::AXES {
            for count in 2..200 {
                let row = |k: u32| axis * (f64::from(k) * 0.6 / f64::from(count - 1) + f64::from(count / 50));
                let mut positions: Vec<Vec3> = (0..count).map(row).collect();
                // Not a row of one cell across.
                positions.push(positions[0] + Vec3::new(0.45, 0.45, 0.45));
                let radii = vec![0.1; positions.len()];
                grid.build(&positions, &radii, 0.0);
                for sphere in 0..positions.len() {
                    let near =
                        |other: usize| other > sphere && (positions[other] - positions[sphere]).norm() < 0.2;
                    let mut found = Vec::new();
                    grid.visit_partners(&positions, &radii, sphere as u32, 0.0, |other| {
                        found.push(other as usize);
                    });
                    assert_all!((0..positions.len()).filter(|&other| near(other)), |other| found
                        .contains(&other));
                }
            }
        }
    }
}
