//! Grains on a lattice, with one lattice point in the middle of the region.
//!
//! | kind  | distance of nearest neighbors = spacing a | grains per volume |
//! |-------|--------------------------------------------|-------------------|
//! | cubic | cube edge a                                | 1/a³              |
//! | bcc   | cube edge 2a/√3                            | 3√3/(4a³)         |
//! | fcc   | cube edge √2 a                             | √2/a³             |
//! | hcp   | layers √(2/3) a apart along z              | √2/a³             |
//!
//! A point is taken where the largest grain that can come up would lie wholly inside. A spacing below the grains'
//! diameter is allowed: bonded grains may overlap. With `count`, points are taken by their distance from the middle,
//! and at equal distance (to a millionth of a² in its square) by z, then y, then x.

use super::error::PackingError;
use super::{Lattice, LatticeKind};
use crate::math::Vec3;

/// More points than this are refused: they would not fit into memory.
const MOST_POINTS: f64 = 2e8;

/// More points than this in the block around a slanting region are not tried: it would take minutes.
const MOST_TRIED: f64 = 4e9;

impl LatticeKind {
    /// Three edge vectors of the unit cell and the points in it, all in units of the nearest distance.
    fn cell(self) -> ([f64; 3], Vec<Vec3>) {
        let (edges, points): ([f64; 3], &[[f64; 3]]) = match self {
            Self::Cubic => ([1.0; 3], &[[0.0; 3]]),
            Self::Bcc => ([2.0 / 3.0_f64.sqrt(); 3], &[[0.0; 3], [0.5; 3]]),
            Self::Fcc => {
                ([2.0_f64.sqrt(); 3], &[[0.0; 3], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5], [0.5, 0.5, 0.0]])
            }
            // The rectangular cell of four points: two in layer A, two in layer B above the hollows of A.
            Self::Hcp => (
                [1.0, 3.0_f64.sqrt(), (8.0_f64 / 3.0).sqrt()],
                &[[0.0; 3], [0.5, 0.5, 0.0], [0.5, 1.0 / 6.0, 0.5], [0.0, 2.0 / 3.0, 0.5]],
            ),
        };
        let [a, b, c] = edges;
        (edges, points.iter().map(|[x, y, z]| Vec3::new(x * a, y * b, z * c)).collect())
    }

    /// Lattice points per volume, in units of the nearest distance.
    fn density(self) -> f64 {
        let ([x, y, z], points) = self.cell();
        points.len() as f64 / (x * y * z)
    }
}

/// The centers [m] for grains up to the radius `largest` [m].
///
/// # Errors
/// [`PackingError::TooLarge`], or [`PackingError::Value`] for a spacing that is not above zero, makes too many points
/// or leaves fewer than `count`.
pub(super) fn points(lattice: &Lattice, largest: f64, group: usize) -> Result<Vec<Vec3>, PackingError> {
    let fault = |key, reason| Err(PackingError::Value { group, key, reason });
    let spacing = lattice.spacing.si();
    if !spacing.is_finite() || spacing <= 0.0 {
        return fault("placement.lattice.spacing", "must be above zero".to_owned());
    }
    let room = lattice.region.inner_radius();
    if room.is_nan() || room < largest {
        return Err(PackingError::TooLarge { group, radius: largest, room });
    }
    let expected = lattice.region.volume() / spacing.powi(3) * lattice.kind.density();
    if expected > MOST_POINTS {
        let reason = format!("makes about {expected:.1e} grains, above the limit of {MOST_POINTS:.0e}");
        return fault("placement.lattice.spacing", reason);
    }
    let tried = box_points(lattice, spacing);
    if tried > MOST_TRIED {
        let reason = format!(
            "makes {tried:.1e} lattice points in the block around the region, above the limit of {MOST_TRIED:.0e}; a region \
             along the axes has a smaller block"
        );
        return fault("placement.lattice.spacing", reason);
    }
    let mut found = inside(lattice, spacing, largest);
    let Some(count) = lattice.count.map(|count| count as usize) else { return Ok(found) };
    if count == 0 || count > found.len() {
        let reason = format!("must lie between 1 and the {} points in the region, not {count}", found.len());
        return fault("placement.lattice.count", reason);
    }
    let middle = lattice.region.center();
    // The points come ordered by z, y, x within equal keys: the sort is stable.
    found.sort_by_key(|&point| ((point - middle).norm_squared() / (spacing * spacing) * 1e6).round() as u64);
    found.truncate(count);
    Ok(found)
}

/// Lattice points in the block around the region, all of which are tried.
fn box_points(lattice: &Lattice, spacing: f64) -> f64 {
    let (edges, cell) = lattice.kind.cell();
    let (lower, upper) = lattice.region.bounds();
    let along = |axis: usize| (upper[axis] - lower[axis]) / (edges[axis] * spacing) + 3.0;
    along(0) * along(1) * along(2) * cell.len() as f64
}

/// All points where the grain lies inside, ordered by z, then y, then x.
fn inside(lattice: &Lattice, spacing: f64, largest: f64) -> Vec<Vec3> {
    let (edges, cell) = lattice.kind.cell();
    let (lower, upper) = lattice.region.bounds();
    let middle = lattice.region.center();
    let range = |axis: usize| {
        let edge = edges[axis] * spacing;
        let first = ((lower[axis] - middle[axis]) / edge).floor() as i64 - 1;
        let last = ((upper[axis] - middle[axis]) / edge).ceil() as i64 + 1;
        first..=last
    };
    // A grain that just touches the region's surface counts as inside in spite of rounding.
    let radius = largest * (1.0 - 1e-12) - 1e-12 * lattice.region.enclosing_radius();
    let mut found = Vec::new();
    for k in range(2) {
        for j in range(1) {
            for i in range(0) {
                let corner = Vec3::new(i as f64 * edges[0], j as f64 * edges[1], k as f64 * edges[2]);
                let points = cell.iter().map(|&point| middle + (corner + point) * spacing);
                found.extend(points.filter(|&point| lattice.region.contains(point, radius)));
            }
        }
    }
    found.sort_by(|a, b| a.z.total_cmp(&b.z).then(a.y.total_cmp(&b.y)).then(a.x.total_cmp(&b.x)));
    found
}
