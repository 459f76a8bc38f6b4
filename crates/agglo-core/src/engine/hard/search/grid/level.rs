//! Cells of one size, as the grid of hard spheres has several.

#![allow(clippy::inline_always, reason = "part of the innermost loop of the engine")]

use crate::engine::hard::spheres::NONE;
use crate::math::{Vec3, prefetch};

use super::spans::Span;

/// Cells of a block, which share a word of bits.
const BLOCK: usize = 64;

/// Cells are this much wider than the spheres that they are for, so that rounding cannot let a neighbor slip.
pub const SLACK: f64 = 1.0 + 1e-9;

/// Nobody's velocities: above the highest and below the lowest.
const NO_VELOCITIES: [Vec3; 2] = [
    Vec3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
    Vec3::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
];

/// Cells of one size.
#[derive(Clone, Debug)]
pub struct Level {
    pub counts: [i32; 3],
    /// How many times cells were doubled from the finest ones.
    pub doublings: u32,
    /// Least width of a cell [m].
    width: f64,
    /// First sphere of each cell.
    pub heads: Vec<u32>,
    /// Which cells hold any, a bit for each: small enough to stay near the processor.
    occupied: Vec<u64>,
    /// What one block further along an axis adds to the number of a block.
    pub strides: [u32; 3],
    /// Spheres in it.
    pub population: u32,
    /// Along each axis the velocities of its spheres lie between these two [m/s].
    pub velocities: [Vec3; 2],
}

impl Level {
    /// Cells that are 2^`doublings` of the finest ones wide, of which there are `finest` along each axis.
    pub fn new(finest: [i32; 3], doublings: u32, edges: Vec3) -> Self {
        let counts = finest.map(|count| (count >> doublings).max(1));
        let [bx, by, bz] = counts.map(|count| (count as u32).div_ceil(4));
        let blocks = bx as usize * by as usize * bz as usize;
        let width = |axis: usize| match counts[axis] {
            1 => edges[axis],
            _ => edges[axis] / f64::from(finest[axis]) * f64::from(1 << doublings),
        };
        Self {
            counts,
            doublings,
            width: width(0).min(width(1)).min(width(2)),
            heads: vec![NONE; blocks * BLOCK],
            occupied: vec![0; blocks],
            strides: [1, bx, bx * by],
            population: 0,
            velocities: NO_VELOCITIES,
        }
    }

    /// Diameter [m] of the largest sphere that it is for.
    pub fn widest(&self) -> f64 {
        self.width / SLACK
    }

    /// A coordinate in this level of one in a finer level, which may lie beyond the volume.
    #[inline]
    pub fn coarsened(&self, axis: usize, finer: &Self, along: i32) -> i32 {
        let (count, by) = (finer.counts[axis], self.doublings - finer.doublings);
        let (round, within) = (along.div_euclid(count), along.rem_euclid(count));
        round * self.counts[axis] + (within >> by).min(self.counts[axis] - 1)
    }

    /// Empties all cells.
    pub fn clear(&mut self) {
        self.heads.fill(NONE);
        self.occupied.fill(0);
        self.population = 0;
        self.velocities = NO_VELOCITIES;
    }

    /// Puts a sphere first into a cell and gives the one that was first.
    #[inline]
    pub fn put_first(&mut self, flat: u32, sphere: u32) -> u32 {
        self.population += 1;
        self.occupied[flat as usize / BLOCK] |= 1 << (flat as usize % BLOCK);
        std::mem::replace(&mut self.heads[flat as usize], sphere)
    }

    /// Takes the first sphere out of a cell; `next` is first then.
    #[inline]
    pub fn take_first(&mut self, flat: u32, next: u32) {
        self.population -= 1;
        self.heads[flat as usize] = next;
        if next == NONE {
            self.occupied[flat as usize / BLOCK] &= !(1 << (flat as usize % BLOCK));
        }
    }

    /// Fetches from memory which cells near one are occupied: those of its block and of the blocks beyond the faces,
    /// edges and corners that it is near.
    #[inline]
    pub fn fetch_words(&self, flat: u32) {
        let block = flat as usize / BLOCK;
        // The nearer neighbor along y and z; along x it shares the line.
        let beside = |axis: usize| {
            let stride = self.strides[axis] as usize;
            if (flat >> (2 * axis)) & 2 == 0 { block.wrapping_sub(stride) } else { block + stride }
        };
        let (y, z) = (beside(1), beside(2));
        let both = y.wrapping_add(z).wrapping_sub(block);
        for word in [block, y, z, both] {
            prefetch(&self.occupied, word);
        }
    }

    /// Words of bits that say which cells hold any.
    pub fn words(&self) -> usize {
        self.occupied.len()
    }

    /// Visits the first sphere of each cell that holds any.
    #[inline]
    pub fn each_first(&self, mut visit: impl FnMut(u32)) {
        for (&word, first) in self.occupied.iter().zip((0..).step_by(BLOCK)) {
            let mut left = word;
            while left != 0 {
                visit(self.heads[first + left.trailing_zeros() as usize]);
                left &= left - 1;
            }
        }
    }

    /// Visits the cells that hold any, in the blocks that spans along the three axes cross in: their numbers, and the edges
    /// of the volume to add to positions there.
    #[inline(always)]
    pub fn each_occupied<S>(&self, [x, y, z]: [S; 3], mut visit: impl FnMut(usize, [i8; 3]))
    where
        S: Iterator<Item = Span> + Clone,
    {
        for z in z {
            for y in y.clone() {
                let (row, bits) = (y.block + z.block, y.bits & z.bits);
                for x in x.clone() {
                    let block = (row + x.block) as usize;
                    let mut left = self.occupied[block] & bits & x.bits;
                    while left != 0 {
                        visit(block * BLOCK + left.trailing_zeros() as usize, [x.image, y.image, z.image]);
                        left &= left - 1;
                    }
                }
            }
        }
    }

    /// Whether a cell holds any sphere.
    #[inline(always)]
    pub fn is_occupied(&self, flat: u32) -> bool {
        self.occupied[flat as usize / BLOCK] >> (flat as usize % BLOCK) & 1 == 1
    }

    /// What a coordinate adds to the number of a cell. Cells are numbered in blocks of 4 x 4 x 4, so that neighbors
    /// are near one another in memory.
    #[inline(always)]
    pub fn part(&self, axis: usize, along: u32) -> u32 {
        (along >> 2) * self.strides[axis] * BLOCK as u32 + ((along & 3) << (2 * axis))
    }

    /// Number of a cell.
    #[inline(always)]
    pub fn flat(&self, [x, y, z]: [u32; 3]) -> u32 {
        self.part(0, x) + self.part(1, y) + self.part(2, z)
    }
}
