//! Spheres that lie side by side by cell, all sorted at once.

use super::index::{CellIndex, Level, octave};
use super::lattice::{Cell, Lattice, Span};
use crate::domain::extent_of_places;
use crate::math::Vec3;

/// Spheres that can be sorted, by index.
pub trait Places {
    /// No index is as large.
    fn slots(&self) -> usize;
    /// The spheres that are there, in rising order.
    fn indices(&self) -> impl Iterator<Item = u32> + '_;
    /// Where one is [m].
    fn position(&self, at: u32) -> Vec3;
    /// Radius of one [m].
    fn radius(&self, at: u32) -> f64;
}

/// Positions [n] and radii [n] in m.
impl Places for (&[Vec3], &[f64]) {
    fn slots(&self) -> usize {
        self.0.len()
    }

    fn indices(&self) -> impl Iterator<Item = u32> + '_ {
        0..self.0.len() as u32
    }

    #[inline]
    fn position(&self, at: u32) -> Vec3 {
        self.0[at as usize]
    }

    #[inline]
    fn radius(&self, at: u32) -> f64 {
        self.1[at as usize]
    }
}

/// Indices of spheres, sorted by bucket.
#[derive(Clone, Debug, Default)]
pub struct Sorted {
    /// In rising order, as they were given.
    indices: Vec<u32>,
    /// Those of bucket k: `members[starts[k]..starts[k + 1]]`, in rising order.
    starts: Vec<u32>,
    members: Vec<u32>,
    /// The cell of each member where cells share buckets, else empty.
    cells: Vec<Cell>,
}

impl Sorted {
    fn sort(&mut self, lattice: &Lattice, spheres: &impl Places) {
        let cell = |at: u32| lattice.cell(spheres.position(at));
        self.starts.clear();
        self.starts.resize(lattice.buckets() + 1, 0);
        for &at in &self.indices {
            self.starts[lattice.bucket(cell(at))] += 1;
        }
        let mut sum = 0;
        for start in &mut self.starts {
            sum += *start;
            *start = sum;
        }
        self.members.clear();
        self.members.resize(self.indices.len(), 0);
        self.cells.clear();
        if lattice.is_hashed() {
            self.cells.resize(self.indices.len(), [0; 3]);
        }
        // Filled from the back so that the starts come out right and members rise within a bucket.
        for &at in self.indices.iter().rev() {
            let cell = cell(at);
            let start = &mut self.starts[lattice.bucket(cell)];
            *start -= 1;
            self.members[*start as usize] = at;
            if let Some(of_member) = self.cells.get_mut(*start as usize) {
                *of_member = cell;
            }
        }
    }
}

impl Level<Sorted> {
    #[inline]
    fn visit(&self, center: Vec3, reach: f64, visit: &mut impl FnMut(u32, [i8; 3])) {
        let spheres = &self.spheres;
        self.lattice.all_within(center, reach + self.largest_radius, &mut |buckets, cell, image| {
            let range = spheres.starts[buckets.start] as usize..spheres.starts[buckets.end] as usize;
            if spheres.cells.is_empty() {
                spheres.members[range].iter().for_each(|&member| visit(member, image));
            } else {
                // Two cells may share a bucket: only the sphere's own cell counts.
                let own = spheres.cells[range.clone()].iter().zip(&spheres.members[range]);
                own.filter(|(of_member, _)| **of_member == cell)
                    .for_each(|(_, &member)| visit(member, image));
            }
            true
        });
    }
}

impl CellIndex<Sorted> {
    /// Sorts all spheres into cells for searches with surfaces up to `margin` [m] apart.
    pub fn fill(&mut self, spheres: &impl Places, span: &Span, margin: f64) {
        for level in &mut self.levels {
            level.spheres.indices.clear();
            level.largest_radius = 0.0;
        }
        self.smallest = spheres.indices().map(|at| spheres.radius(at)).fold(f64::INFINITY, f64::min);
        self.level_of.clear();
        self.level_of.resize(spheres.slots(), 0);
        for at in spheres.indices() {
            let radius = spheres.radius(at);
            let own = octave(radius, self.smallest);
            self.level_of[at as usize] = own;
            if self.levels.len() <= own as usize {
                self.levels.resize_with(own as usize + 1, Level::default);
            }
            let level = &mut self.levels[own as usize];
            level.spheres.indices.push(at);
            level.largest_radius = level.largest_radius.max(radius);
        }
        for level in self.levels.iter_mut().filter(|level| !level.spheres.indices.is_empty()) {
            let sorted = &mut level.spheres;
            let corners = match *span {
                Span::Free(_) | Span::Around => corners_around(spheres, &sorted.indices),
                Span::Block(corners, _) => corners,
            };
            let width = 2.0 * level.largest_radius + margin;
            level.lattice = Lattice::new(span, corners, width, sorted.indices.len());
            sorted.sort(&level.lattice, spheres);
        }
    }

    /// Visits every sphere, with the number of its image, whose surface was nearer to `center` than `reach` [m] when the
    /// spheres were sorted; visits more.
    #[inline]
    pub fn visit_all(&self, center: Vec3, reach: f64, visit: &mut impl FnMut(u32, [i8; 3])) {
        for level in self.levels.iter().filter(|level| !level.spheres.indices.is_empty()) {
            level.visit(center, reach, visit);
        }
    }

    /// The same for the partners of a sphere, so that each pair is visited from one side only: the spheres of its own octave
    /// with a higher index, and all of higher octaves.
    #[inline]
    pub fn visit_partners(&self, of: u32, center: Vec3, reach: f64, visit: &mut impl FnMut(u32, [i8; 3])) {
        let own = self.level_of[of as usize] as usize;
        for (number, level) in self.levels.iter().enumerate().skip(own) {
            if !level.spheres.indices.is_empty() {
                level.visit(center, reach, &mut |at, image| {
                    if number > own || at > of {
                        visit(at, image);
                    }
                });
            }
        }
    }
}

/// Corners of the block around the centers of spheres [m].
fn corners_around(spheres: &impl Places, indices: &[u32]) -> [Vec3; 2] {
    let (lower, upper) = extent_of_places(indices.iter().map(|&at| spheres.position(at))).unwrap_or_default();
    [lower, upper]
}
