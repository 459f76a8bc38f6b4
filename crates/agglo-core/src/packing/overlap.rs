//! Whether hard spheres can start: apart from one another, and within the faces of their volume.

use std::ops::Range;

use crate::domain::{Boundary, Space, Volume};
use crate::math::{Vec3, parallel};
use crate::neighbors::{CellIndex, Sorted, Span};
use crate::particles::Particles;

/// Part of the sum of two radii, or of a radius at a face, that counts as round-off.
const TOLERANCE: f64 = 1e-9;
/// Grains that one thread looks at in a go.
const LEAF: usize = 4096;

/// Two grains that overlap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overlap {
    /// Their ids, the smaller one first; twice the same where a grain overlaps its own image.
    pub ids: [u32; 2],
    /// How far they overlap [m].
    pub overlap: f64,
}

/// The overlapping pair with the smallest ids, if there is one; across the faces too where a volume is periodic.
///
/// Centers must then lie in the volume or on its faces. Less than 1e-9 of the sum of the radii is no overlap.
///
/// ```
/// # extern crate agglo_core as agglo;
/// use agglo::math::Vec3;
/// use agglo::packing::first_overlap;
/// use agglo::particles::{Particles, Row};
/// let mut grains = Particles::default();
/// for (id, x) in [(0, 0.0), (1, 2.0), (2, 3.5)] {
///     grains.push(Row { id, position: Vec3::new(x, 0.0, 0.0), radius: 1.0, ..Row::default() });
/// }
/// let found = first_overlap(&grains, None).unwrap();
/// assert_eq!((found.ids, found.overlap), ([1, 2], 0.5));
/// ```
pub fn first_overlap(grains: &Particles, volume: Option<&Volume>) -> Option<Overlap> {
    let mut crowd =
        Crowd { ids: grains.id.clone(), positions: grains.position.clone(), radii: grains.radius.clone() };
    if let Some(volume) = volume {
        crowd.add_images(volume);
    }
    let mut cells = CellIndex::<Sorted>::default();
    cells.fill(&(&crowd.positions[..], &crowd.radii[..]), &Span::Free(Space::OPEN), 0.0);
    let search = |range: Range<usize>, ()| {
        range.fold(None, |found, sphere| first_of(found, crowd.first_partner(&cells, sphere as u32)))
    };
    parallel::over(0..crowd.ids.len(), LEAF, (), &search, &first_of)
}

/// The first grain, by its place, that lies outside a volume whose faces hold grains in: with its center where faces
/// are periodic or antipodal, with any part of it where they are walls, unless it may reach into them.
pub(super) fn first_outside(grains: &Particles, volume: &Volume, may_reach_in: bool) -> Option<usize> {
    let (lower, upper) = (volume.lower(), volume.upper());
    let walls = volume.boundaries().map(|boundary| match boundary {
        Boundary::Open => None,
        Boundary::Reflecting if !may_reach_in => Some(1.0 - TOLERANCE),
        Boundary::Periodic | Boundary::Antipodal | Boundary::Reflecting => Some(0.0),
    });
    let is_inside = |center: Vec3, radius: f64| {
        (0..3).all(|axis| {
            walls[axis].is_none_or(|wall| {
                let margin = wall * radius;
                lower[axis] + margin <= center[axis] && center[axis] <= upper[axis] - margin
            })
        })
    };
    let mut spheres = grains.position.iter().zip(&grains.radius);
    spheres.position(|(&center, &radius)| !is_inside(center, radius))
}

fn first_of(a: Option<Overlap>, b: Option<Overlap>) -> Option<Overlap> {
    // The larger overlap where a pair has its images twice, so that order does not matter.
    let before = |a: &Overlap, b: &Overlap| a.ids < b.ids || (a.ids == b.ids && a.overlap >= b.overlap);
    match (a, b) {
        (Some(a), Some(b)) => Some(if before(&a, &b) { a } else { b }),
        (a, b) => a.or(b),
    }
}

/// Grains, and images of those that others may touch across a face.
struct Crowd {
    ids: Vec<u32>,
    positions: Vec<Vec3>,
    radii: Vec<f64>,
}

impl Crowd {
    fn add_images(&mut self, volume: &Volume) {
        let (lower, upper, edges) = (volume.lower(), volume.upper(), volume.edges());
        let largest = self.radii.iter().copied().fold(0.0, f64::max);
        let repeats = volume.repeats();
        // Images along one axis after the other: those of images make edges and corners.
        for axis in (0..3).filter(|axis| repeats[*axis]) {
            for at in 0..self.ids.len() {
                let (position, reach) = (self.positions[at], self.radii[at] + largest);
                if position[axis] - reach < lower[axis] {
                    self.add_image(at, Vec3::AXES[axis] * edges[axis]);
                }
                if position[axis] + reach > upper[axis] {
                    self.add_image(at, -Vec3::AXES[axis] * edges[axis]);
                }
            }
        }
    }

    fn add_image(&mut self, of: usize, shift: Vec3) {
        self.ids.push(self.ids[of]);
        self.positions.push(self.positions[of] + shift);
        self.radii.push(self.radii[of]);
    }

    /// The overlap with the smallest ids among the pairs that the cells give to this sphere.
    fn first_partner(&self, cells: &CellIndex<Sorted>, sphere: u32) -> Option<Overlap> {
        let mut first = None;
        let (at, radius) = (self.positions[sphere as usize], self.radii[sphere as usize]);
        cells.visit_partners(sphere, at, radius, &mut |other, _| {
            let reach = radius + self.radii[other as usize];
            let between = (self.positions[other as usize] - at).norm_squared();
            if between < reach * reach {
                let overlap = reach - between.sqrt();
                if overlap > TOLERANCE * reach {
                    let (a, b) = (self.ids[sphere as usize], self.ids[other as usize]);
                    first = first_of(first, Some(Overlap { ids: [a.min(b), a.max(b)], overlap }));
                }
            }
        });
        first
    }
}
