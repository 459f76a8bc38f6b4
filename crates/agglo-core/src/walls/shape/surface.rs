//! What a shape of a wall can do.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::law::Faults;
use crate::math::Vec3;

/// Corners [m] of a triangle, counted against the clock where it is seen from the side of the grains.
pub type Triangle = [Vec3; 3];

/// The nearest point of a wall, as a grain sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// Unit vector toward the wall: from a grain on its side to the point, and away from it where the grain's center has passed
    /// the wall.
    pub normal: Vec3,
    /// Distance [m] to it along the normal; below 0 behind the wall.
    pub gap: f64,
}

/// Where grains are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// Grains are inside: it holds them.
    #[default]
    Inside,
    /// Grains are outside: it is a solid body among them.
    Outside,
}

/// A shape of a wall. It has faces, and a grain can touch each of them in one point.
pub trait Surface {
    /// What is wrong with it; keys are relative to its table.
    fn faults(&self, faults: &mut Faults);

    /// How many faces it has.
    fn faces(&self) -> u32;

    /// The point of a face that is nearest to a point [m].
    fn nearest(&self, face: u32, point: Vec3) -> Near;

    /// The point [m] that it turns about where none is given.
    fn middle(&self) -> Vec3;

    /// Its smallest radius of curvature [m].
    fn curvature_radius(&self) -> f64 {
        f64::INFINITY
    }

    /// Whether it is the same all along a direction.
    fn goes_on_along(&self, _direction: Vec3) -> bool {
        false
    }

    /// Triangles that show it, as far as it is within a ball about a point [m] of a radius [m].
    fn triangles(&self, about: Vec3, within: f64) -> Vec<Triangle>;
}

/// Sine of an angle that is none but for rounding.
pub(super) const ASKEW: f64 = 1e-12;

/// Toward a point at this offset [m] from where one stands; `fallback` where one stands on it.
#[inline]
pub(super) fn toward(offset: Vec3, fallback: Vec3) -> Near {
    let gap = offset.norm();
    Near { normal: if gap > 0.0 { offset / gap } else { fallback }, gap }
}

/// Unit vector of an offset [m] from an axis, and its length [m]; any direction at right angles to the axis where there is none.
#[inline]
pub(super) fn radial(offset: Vec3, axis: Vec3) -> (Vec3, f64) {
    let distance = offset.norm();
    (if distance > 0.0 { offset / distance } else { axis.frame().0 }, distance)
}

/// A direction that is one.
pub(super) fn direction(faults: &mut Faults, key: &str, direction: [f64; 3], example: &str) {
    if Vec3::from(direction).norm() == 0.0 {
        let message = "has no direction: all components are 0".to_owned();
        faults.fail_with(key, message, format!("for example {example}"));
    }
}

/// Pieces of a circle that show it.
pub(super) const PIECES: u32 = 48;

/// Points of a circle [m] about a center [m] in the plane of two unit vectors; the first comes again at the end.
pub(super) fn circle(center: Vec3, radius: f64, (first, second): (Vec3, Vec3)) -> Vec<Vec3> {
    let at = |piece: u32| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(piece % PIECES) / f64::from(PIECES)).sin_cos();
        center + (first * cos + second * sin) * radius
    };
    (0..=PIECES).map(at).collect()
}

/// Triangles between two rows of as many points.
pub(super) fn strip(one: &[Vec3], other: &[Vec3]) -> Vec<Triangle> {
    let quads = one.windows(2).zip(other.windows(2));
    quads.flat_map(|(a, b)| [[a[0], a[1], b[1]], [a[0], b[1], b[0]]]).collect()
}

/// Triangles from a point to a row of points.
pub(super) fn fan(center: Vec3, rim: &[Vec3]) -> Vec<Triangle> {
    rim.windows(2).map(|piece| [center, piece[0], piece[1]]).collect()
}

/// The same triangles seen from the other side.
pub(super) fn turned_over(mut triangles: Vec<Triangle>) -> Vec<Triangle> {
    for corners in &mut triangles {
        corners.swap(1, 2);
    }
    triangles
}
