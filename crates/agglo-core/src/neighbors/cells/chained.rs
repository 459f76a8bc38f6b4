//! Spheres that are added one by one.

use super::index::{CellIndex, Level, octave};
use super::lattice::{Lattice, Span};
use crate::math::Vec3;

/// End of a chain.
const NONE: u32 = u32::MAX;

/// Spheres in chains, one per cell.
#[derive(Clone, Debug, Default)]
pub struct Chained {
    /// The last sphere that was added to each cell.
    first: Vec<u32>,
    spheres: Vec<Link>,
}

#[derive(Clone, Debug)]
struct Link {
    center: Vec3,
    radius: f64,
    next: u32,
}

impl Level<Chained> {
    fn insert(&mut self, center: Vec3, radius: f64) {
        let links = &mut self.spheres;
        let first = &mut links.first[self.lattice.bucket(self.lattice.cell(center))];
        links.spheres.push(Link { center, radius, next: *first });
        *first = (links.spheres.len() - 1) as u32;
    }

    #[inline]
    fn all_near<P: Copy>(
        &self,
        center: Vec3,
        reach: f64,
        seen_from: &impl Fn([i8; 3]) -> P,
        holds: &mut impl FnMut(P, Vec3, f64) -> bool,
    ) -> bool {
        self.lattice.all_within(center, reach, &mut |buckets, _, image| {
            let seen = seen_from(image);
            self.spheres.first[buckets].iter().all(|&first| {
                let mut at = first;
                while at != NONE {
                    let link = &self.spheres.spheres[at as usize];
                    if !holds(seen, link.center, link.radius) {
                        return false;
                    }
                    at = link.next;
                }
                true
            })
        })
    }
}

impl CellIndex<Chained> {
    /// Empty cells in the block between two corners [m], which may repeat itself along some axes, for spheres of the given radii [m] and
    /// searches with surfaces up to `margin` [m] apart.
    pub fn empty(
        corners: [Vec3; 2],
        repeats: [bool; 3],
        margin: f64,
        radii: impl Iterator<Item = f64> + Clone,
    ) -> Self {
        let smallest = radii.clone().fold(f64::INFINITY, f64::min);
        let mut octaves: Vec<(usize, f64)> = Vec::new();
        for radius in radii {
            let own = octave(radius, smallest) as usize;
            octaves.resize(octaves.len().max(own + 1), (0, 0.0));
            let (count, largest) = &mut octaves[own];
            (*count, *largest) = (*count + 1, largest.max(radius));
        }
        let span = Span::Block(corners, repeats);
        let level = |(count, largest_radius): (usize, f64)| {
            let width = 2.0 * largest_radius + margin;
            let lattice = match count {
                0 => Lattice::default(),
                _ => Lattice::new(&span, corners, width, count),
            };
            let (first, spheres) = (vec![NONE; lattice.buckets()], Vec::with_capacity(count));
            Level { largest_radius, lattice, spheres: Chained { first, spheres } }
        };
        Self { smallest, levels: octaves.into_iter().map(level).collect(), level_of: Vec::new() }
    }

    /// Adds a sphere; its radius [m] must be one of those that were given.
    pub fn insert(&mut self, center: Vec3, radius: f64) {
        let own = octave(radius, self.smallest) as usize;
        self.levels[own].insert(center, radius);
    }

    /// Whether `holds` says so of all spheres near a place. It is asked with what `seen_from` makes of the number of the image,
    /// and center [m] and radius [m] of every sphere whose center is nearer than `reach` gives for the largest radius around, and
    /// of more.
    #[inline]
    pub fn all_near<P: Copy>(
        &self,
        center: Vec3,
        reach: impl Fn(f64) -> f64,
        seen_from: impl Fn([i8; 3]) -> P,
        mut holds: impl FnMut(P, Vec3, f64) -> bool,
    ) -> bool {
        // From the largest down: what is in the way is mostly one of them.
        let mut levels = self.levels.iter().rev().filter(|level| !level.spheres.spheres.is_empty());
        levels.all(|level| level.all_near(center, reach(level.largest_radius), &seen_from, &mut holds))
    }
}
