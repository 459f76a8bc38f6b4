//! The cells that spheres are filed in: levels of cells for spheres of different size, nested in one another.
//!
//! A sphere lies in the finest level whose cells are as wide as it is. Two spheres that touch lie in neighboring cells
//! of the coarser of their two levels, so each sphere knows whom it may collide with from the 27 cells about its own in its own
//! level and in every coarser one. A coarse cell is made of whole finer ones, two along each axis, or three where one would
//! be left over, up to a single cell that is the volume: a sphere that leaves a coarse cell leaves a fine one too.
//!
//! An open volume has no end: the grid is folded, cells that are a whole number of edges apart share a list.

#![allow(clippy::inline_always, reason = "together these are the innermost loop of the engine")]

mod fetch;
mod flight;
mod frame;
mod level;
mod spans;
#[cfg(test)]
mod tests;

use crate::domain::{Boundary, Volume};
use crate::engine::hard::spheres::{NONE, Sphere};
use crate::math::Vec3;

use super::next_event::{Exit, NextEvent};
use level::SLACK;
use spans::Spans;

pub use frame::Frame;
pub use level::Level;

/// Cells of the second coarsest level along the shortest edge, at least, if there are as many at all.
const COARSE: i32 = 2;
/// Cells are at least this wide, over the mean distance of spheres.
const CELL_OVER_SPACING: f64 = 0.6;

/// Levels of cells, from the single cell to the finest.
#[derive(Clone, Debug)]
pub struct Grid {
    /// Where the cells are.
    pub frame: Frame,
    /// Edges of the volume [m].
    pub edges: Vec3,
    /// Widths of the finest cells [m].
    widths: Vec3,
    boundary: Boundary,
    levels: Vec<Level>,
    /// The next sphere of the same cell.
    after: Vec<u32>,
}

/// Cells next to one another along an axis: what they add to a cell's number, and edges of the volume to add.
#[derive(Clone, Copy, Debug)]
struct Line {
    cells: [(u32, i8); 3],
    len: usize,
}

impl Line {
    fn as_slice(&self) -> &[(u32, i8)] {
        &self.cells[..self.len]
    }
}

/// Cells about a cell: from `cell + from` to `cell + to`, at most three along each axis.
#[derive(Clone, Copy, Debug)]
struct Block {
    cell: [i32; 3],
    from: [i32; 3],
    to: [i32; 3],
}

impl Block {
    /// A cell and the 26 about it.
    fn around(cell: [i32; 3]) -> Self {
        Self { cell, from: [-1; 3], to: [1; 3] }
    }

    /// The nine cells ahead of a cell that was entered the way that `exit` says.
    fn ahead(cell: [i32; 3], exit: Exit) -> Self {
        let mut block = Self::around(cell);
        let (axis, side) = (exit.axis as usize, i32::from(exit.side));
        (block.from[axis], block.to[axis]) = (side, side);
        block
    }
}

impl Grid {
    /// Cells for spheres of at least `smallest` diameter [m]; some cells for each sphere.
    pub fn new(volume: &Volume, smallest: f64, spheres: usize) -> Self {
        let edges = volume.edges();
        let spacing = (volume.volume() / spheres.max(1) as f64).cbrt();
        let width = (smallest * SLACK).max(CELL_OVER_SPACING * spacing);
        let finest = edges.to_array().map(|edge| ((edge / width) as i32).clamp(1, 1 << 10));
        let least = finest.into_iter().min().unwrap_or(1);
        let widths = Vec3::new(
            edges.x / f64::from(finest[0]),
            edges.y / f64::from(finest[1]),
            edges.z / f64::from(finest[2]),
        );
        // The coarsest level is one cell, whatever the shape of the volume.
        let mut levels = vec![Level::new(finest, 31 - 1, edges)];
        if finest != [1; 3] {
            let most = (least / COARSE).max(1).ilog2();
            levels.extend((0..=most).rev().map(|doublings| Level::new(finest, doublings, edges)));
        }
        let frame = Frame { lower: volume.lower(), drift: Vec3::ZERO, since: 0.0 };
        Self { frame, edges, widths, boundary: volume.boundary, levels, after: Vec::new() }
    }

    /// Shortest edge of the volume [m].
    pub fn shortest_edge(&self) -> f64 {
        self.edges.x.min(self.edges.y).min(self.edges.z)
    }

    /// The levels, coarsest first.
    pub fn levels(&self) -> &[Level] {
        &self.levels
    }

    /// The levels from a number on that hold any sphere, and their numbers.
    pub fn populated(&self, from: usize) -> impl Iterator<Item = (usize, &Level)> {
        self.levels.iter().enumerate().skip(from).filter(|(_, level)| level.population > 0)
    }

    /// Empties all cells.
    pub fn clear(&mut self) {
        self.levels.iter_mut().for_each(Level::clear);
    }

    /// Seats a sphere in the level and the cell where it is at a time [s]; it is not filed there yet.
    pub fn seat(&self, next_event: &mut NextEvent, sphere: &Sphere, time: f64) {
        next_event.level = self.level_of(sphere.radius);
        next_event.cell = self.cell_of(next_event.level, sphere.at(time) - self.frame.flown(time));
    }

    /// Level for spheres of a radius [m].
    fn level_of(&self, radius: f64) -> u8 {
        let fits = |level: &Level| 2.0 * radius <= level.widest();
        (self.levels.iter().rposition(fits).unwrap_or(0)) as u8
    }

    /// Cell of a position in a level; what the cells have flown is taken off already, as in all that follows.
    pub fn cell_of(&self, level: u8, position: Vec3) -> [i32; 3] {
        let (finest, level) = (self.finest(), &self.levels[level as usize]);
        [0, 1, 2].map(|axis| {
            let along = self.finest_along(axis, position[axis]);
            let along = match self.boundary {
                Boundary::Open => along,
                _ => along.clamp(0, finest.counts[axis] - 1),
            };
            level.coarsened(axis, finest, along)
        })
    }

    fn finest(&self) -> &Level {
        &self.levels[self.levels.len() - 1]
    }

    /// Coordinate of the finest cell at a position along an axis [m], which may lie beyond the volume.
    fn finest_along(&self, axis: usize, position: f64) -> i32 {
        let along = ((position - self.frame.lower[axis]) / self.widths[axis]).floor() as i32;
        // A single cell is its own finest one.
        if self.finest().doublings > 0 {
            ((position - self.frame.lower[axis]) / self.edges[axis]).floor() as i32
        } else {
            along
        }
    }

    /// Where the lower face of a cell is, from the lower corner of the volume [m].
    #[inline]
    fn face(&self, level: &Level, axis: usize, along: i32) -> f64 {
        let count = level.counts[axis];
        if (0..count).contains(&along) {
            return f64::from(along << level.doublings) * self.widths[axis];
        }
        let (round, within) = (along.div_euclid(count), along.rem_euclid(count));
        f64::from(round) * self.edges[axis] + f64::from(within << level.doublings) * self.widths[axis]
    }

    /// Makes room for the links of this many slots.
    pub fn hold(&mut self, slots: usize) {
        self.after.resize(slots, NONE);
    }

    /// Files a sphere under the cell that its next event names.
    #[inline]
    pub fn link(&mut self, next_event: &mut NextEvent, sphere: u32) {
        next_event.flat = self.flat(next_event);
        self.after[sphere as usize] =
            self.levels[next_event.level as usize].put_first(next_event.flat, sphere);
    }

    /// Number of the cell that a next event names.
    #[inline]
    fn flat(&self, next_event: &NextEvent) -> u32 {
        let level = &self.levels[next_event.level as usize];
        level.flat(match self.boundary {
            Boundary::Open => {
                [0, 1, 2].map(|axis| next_event.cell[axis].rem_euclid(level.counts[axis]) as u32)
            }
            _ => next_event.cell.map(|along| along as u32),
        })
    }

    /// Takes a sphere out of its cell.
    #[inline]
    pub fn unlink(&mut self, next_event: &NextEvent, sphere: u32) {
        let level = &mut self.levels[next_event.level as usize];
        let (flat, after) = (next_event.flat, self.after[sphere as usize]);
        let mut at = level.heads[flat as usize];
        if at == sphere {
            level.take_first(flat, after);
            return;
        }
        level.population -= 1;
        while self.after[at as usize] != sphere {
            at = self.after[at as usize];
        }
        self.after[at as usize] = after;
    }

    /// The first cell of the finest level in a sphere's cell.
    pub fn finest_cell(&self, next_event: &NextEvent) -> [i32; 3] {
        let level = &self.levels[next_event.level as usize];
        next_event.cell.map(|along| along << level.doublings)
    }

    /// Keeps in mind how fast spheres of a level are along each axis [m/s].
    #[inline]
    pub fn note_velocities(&mut self, level: u8, [lowest, highest]: [Vec3; 2]) {
        let [low, high] = &mut self.levels[level as usize].velocities;
        (*low, *high) = (low.min(lowest), high.max(highest));
    }

    /// When and how a sphere leaves its cell or comes to a wall, at `now` [s] or later.
    #[inline]
    pub fn exit(&self, next_event: &NextEvent, sphere: &Sphere, now: f64) -> (f64, Exit) {
        let level = &self.levels[next_event.level as usize];
        let position = sphere.at(now) - self.frame.flown(now);
        let velocity = sphere.velocity - self.frame.drift;
        let mut first = (f64::INFINITY, Exit::default());
        for axis in 0..3 {
            let speed = velocity[axis];
            if speed == 0.0 {
                continue;
            }
            let side = if speed > 0.0 { 1 } else { -1 };
            let cell = next_event.cell[axis];
            let face = self.face(level, axis, if side > 0 { cell + 1 } else { cell });
            let mut time = (self.frame.lower[axis] + face - position[axis]) / speed;
            let mut is_wall = false;
            if self.boundary == Boundary::Reflecting
                && cell + side == if side > 0 { level.counts[axis] } else { -1 }
            {
                let wall = if side > 0 { self.edges[axis] - sphere.radius } else { sphere.radius };
                time = (self.frame.lower[axis] + wall - position[axis]) / speed;
                is_wall = true;
            }
            if time < first.0 {
                first = (time, Exit { axis: axis as u8, side: side as i8, is_wall });
            }
        }
        (now + first.0.max(0.0), first.1)
    }

    /// Moves a sphere's cell through the face that it leaves by. Gives the edges of the volume that must be added to its
    /// position along that axis: 0 unless it left the volume.
    #[inline]
    pub fn step_over(&self, next_event: &mut NextEvent) -> i8 {
        let axis = next_event.exit.axis as usize;
        let count = self.levels[next_event.level as usize].counts[axis];
        let cell = next_event.cell[axis] + i32::from(next_event.exit.side);
        if self.boundary == Boundary::Open || (0..count).contains(&cell) {
            next_event.cell[axis] = cell;
            return 0;
        }
        next_event.cell[axis] = cell.rem_euclid(count);
        -next_event.exit.side
    }

    /// Cells from `cell + from` to `cell + to` along an axis, at most three.
    #[inline(always)]
    fn line(&self, level: &Level, axis: usize, cell: i32, from: i32, to: i32) -> Line {
        let count = level.counts[axis];
        let mut line = Line { cells: [(0, 0); 3], len: 0 };
        if cell > 0 && cell < count - 1 {
            for along in cell + from..=cell + to {
                line.cells[line.len] = (level.part(axis, along as u32), 0);
                line.len += 1;
            }
            return line;
        }
        self.line_at_a_face(level, axis, cell, from, to)
    }

    /// The same where the line may leave the volume.
    #[inline(never)]
    fn line_at_a_face(&self, level: &Level, axis: usize, cell: i32, from: i32, to: i32) -> Line {
        let count = level.counts[axis];
        let mut line = Line { cells: [(0, 0); 3], len: 0 };
        for along in cell + from..=cell + to {
            let (folded, image) = match self.boundary {
                _ if (0..count).contains(&along) => (along, 0),
                Boundary::Periodic => (along.rem_euclid(count), along.div_euclid(count) as i8),
                Boundary::Open => (along.rem_euclid(count), 0),
                Boundary::Antipodal | Boundary::Reflecting | Boundary::Absorbing => continue,
            };
            let found = (level.part(axis, folded as u32), image);
            // A folded grid of one or two cells would show the same cell twice.
            if self.boundary == Boundary::Open && line.as_slice().contains(&found) {
                continue;
            }
            line.cells[line.len] = found;
            line.len += 1;
        }
        line
    }

    /// Visits the spheres of one cell.
    #[inline(always)]
    fn visit_cell(&self, level: &Level, flat: u32, image: [i8; 3], visit: &mut impl FnMut(u32, [i8; 3])) {
        if !level.is_occupied(flat) {
            return;
        }
        self.visit_first(level.heads[flat as usize], image, visit);
    }

    /// Visits the spheres of a list, from its first on.
    #[inline(always)]
    fn visit_first(&self, first: u32, image: [i8; 3], visit: &mut impl FnMut(u32, [i8; 3])) {
        let mut sphere = first;
        while sphere != NONE {
            visit(sphere, image);
            sphere = self.after[sphere as usize];
        }
    }

    /// The cells of a block: their numbers, and the edges to add to positions there.
    #[inline(always)]
    fn each_cell(&self, level: &Level, block: &Block, mut visit: impl FnMut(u32, [i8; 3])) {
        let line = |axis: usize| self.line(level, axis, block.cell[axis], block.from[axis], block.to[axis]);
        let lines = [line(0), line(1), line(2)];
        for &(z, image_z) in lines[2].as_slice() {
            for &(y, image_y) in lines[1].as_slice() {
                for &(x, image_x) in lines[0].as_slice() {
                    visit(x + y + z, [image_x, image_y, image_z]);
                }
            }
        }
    }

    /// Cell in a coarser level of a cell in a finer one.
    #[inline]
    fn coarser_cell(&self, cell: [i32; 3], from: u8, to: usize) -> [i32; 3] {
        let (finer, coarser) = (&self.levels[from as usize], &self.levels[to]);
        [0, 1, 2].map(|axis| coarser.coarsened(axis, finer, cell[axis]))
    }

    /// Visits the spheres of its own and of coarser levels that a sphere may collide with before it leaves its cell: their
    /// numbers, and the edges to add to their positions. It may visit the sphere itself.
    #[inline]
    pub fn visit_around(&self, next_event: &NextEvent, mut visit: impl FnMut(u32, [i8; 3])) {
        for number in (0..=next_event.level as usize).rev() {
            let level = &self.levels[number];
            if level.population == 0 {
                continue;
            }
            let is_own = number == next_event.level as usize;
            let cell = if is_own {
                next_event.cell
            } else {
                self.coarser_cell(next_event.cell, next_event.level, number)
            };
            self.each_cell(level, &Block::around(cell), |flat, image| {
                self.visit_cell(level, flat, image, &mut visit);
            });
        }
    }

    /// Visits those that come into view when a sphere has just moved into its cell the way that `exit` says: the nine
    /// cells ahead, in each level whose face it went through.
    #[inline]
    pub fn visit_ahead(&self, next_event: &NextEvent, exit: Exit, mut visit: impl FnMut(u32, [i8; 3])) {
        let (axis, side) = (exit.axis as usize, i32::from(exit.side));
        for number in (0..=next_event.level as usize).rev() {
            let level = &self.levels[number];
            if level.population == 0 {
                continue;
            }
            let mut cell = next_event.cell;
            if number < next_event.level as usize {
                let mut behind = next_event.cell;
                behind[axis] -= side;
                cell = self.coarser_cell(next_event.cell, next_event.level, number);
                if self.coarser_cell(behind, next_event.level, number) == cell {
                    return;
                }
            }
            self.each_cell(level, &Block::ahead(cell, exit), |flat, image| {
                self.visit_cell(level, flat, image, &mut visit);
            });
        }
    }

    /// Cells of a level along an axis from one coordinate to another [m], the first and the last.
    fn range(&self, level: &Level, axis: usize, [from, to]: [Vec3; 2]) -> (i32, i32) {
        let count = level.counts[axis];
        let along = |x: f64| level.coarsened(axis, self.finest(), self.finest_along(axis, x));
        let (from, to) = (along(from[axis]), along(to[axis]));
        match self.boundary {
            // Nobody looks further than `FARTHEST` edges and half a volume.
            Boundary::Periodic => (from.max(-4 * count), to.min(5 * count - 1)),
            Boundary::Open => (from, to.min(from.saturating_add(count - 1))),
            Boundary::Antipodal | Boundary::Reflecting | Boundary::Absorbing => {
                (from.max(0), to.min(count - 1))
            }
        }
    }

    /// How many cells of a level lie in a block between two corners [m].
    pub fn cells_within(&self, number: usize, block: [Vec3; 2]) -> u64 {
        let level = &self.levels[number];
        let cells = |axis: usize| {
            let (from, to) = self.range(level, axis, block);
            i64::from(to).saturating_sub(i64::from(from)).max(0) as u64 + 1
        };
        cells(0) * cells(1) * cells(2)
    }

    /// Visits the spheres of a level whose centers may lie in a block between two corners [m].
    pub fn visit_within(&self, number: usize, block: [Vec3; 2], mut visit: impl FnMut(u32, [i8; 3])) {
        let level = &self.levels[number];
        let range = |axis: usize| self.range(level, axis, block);
        let has_images = self.boundary == Boundary::Periodic;
        let spans =
            |axis: usize| Spans::new(axis, level.strides[axis], level.counts[axis], range(axis), has_images);
        level.each_occupied([spans(0), spans(1), spans(2)], |cell, image| {
            self.visit_first(level.heads[cell], image, &mut visit);
        });
    }

    /// Visits all spheres of a level.
    pub fn visit_level(&self, number: usize, mut visit: impl FnMut(u32)) {
        self.levels[number].each_first(|first| {
            self.visit_first(first, [0; 3], &mut |sphere, _| visit(sphere));
        });
    }

    /// What an image adds to a position [m].
    #[inline]
    pub fn shift(&self, image: [i8; 3]) -> Vec3 {
        let [x, y, z] = image.map(f64::from);
        Vec3::new(x * self.edges.x, y * self.edges.y, z * self.edges.z)
    }
}
