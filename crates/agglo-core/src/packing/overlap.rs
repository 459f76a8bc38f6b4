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
    let space = volume.map_or(Space::OPEN, Volume::space);
    let mut cells = CellIndex::<Sorted>::default();
    cells.fill(&(&grains.position[..], &grains.radius[..]), &Span::Free(space), 0.0);
    let search = |range: Range<usize>, ()| {
        range.fold(None, |found, sphere| {
            let own = with_itself(grains, sphere, space.shortest_period());
            first_of(first_of(found, own), first_partner(grains, &space, &cells, sphere))
        })
    };
    parallel::over(0..grains.len(), LEAF, (), &search, &first_of)
}

/// The first grain, by its place, that lies outside a volume whose faces hold grains in: with its center where faces
/// are periodic, antipodal or absorbing, with any part of it where they are walls, unless it may reach into them.
pub(super) fn first_outside(grains: &Particles, volume: &Volume, may_reach_in: bool) -> Option<usize> {
    let (lower, upper) = (volume.lower(), volume.upper());
    let walls = volume.boundaries().map(|boundary| match boundary {
        Boundary::Open => None,
        Boundary::Reflecting if !may_reach_in => Some(1.0 - TOLERANCE),
        Boundary::Periodic | Boundary::Antipodal | Boundary::Reflecting | Boundary::Absorbing => Some(0.0),
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
    match (a, b) {
        (Some(a), Some(b)) => Some(if a.ids <= b.ids { a } else { b }),
        (a, b) => a.or(b),
    }
}

/// The overlap of a sphere with its own image a period [m] away.
fn with_itself(grains: &Particles, sphere: usize, period: f64) -> Option<Overlap> {
    let (id, diameter) = (grains.id[sphere], 2.0 * grains.radius[sphere]);
    let overlap = diameter - period;
    (overlap > TOLERANCE * diameter).then_some(Overlap { ids: [id; 2], overlap })
}

/// The overlap with the smallest ids among the pairs that the cells give to a sphere, each where it is nearest.
fn first_partner(
    grains: &Particles,
    space: &Space,
    cells: &CellIndex<Sorted>,
    sphere: usize,
) -> Option<Overlap> {
    let mut first = None;
    let (at, radius) = (grains.position[sphere], grains.radius[sphere]);
    cells.visit_partners(sphere as u32, at, radius, &mut |other, _| {
        let reach = radius + grains.radius[other as usize];
        let between = space.shortest(grains.position[other as usize] - at).norm_squared();
        if between < reach * reach {
            let overlap = reach - between.sqrt();
            if overlap > TOLERANCE * reach {
                let (a, b) = (grains.id[sphere], grains.id[other as usize]);
                first = first_of(first, Some(Overlap { ids: [a.min(b), a.max(b)], overlap }));
            }
        }
    });
    first
}
