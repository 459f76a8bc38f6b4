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

/// A straight line along which sound flies, from a distance on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Where the distance is 0 [m].
    pub origin: Vec3,
    /// Unit vector.
    pub direction: Vec3,
    /// Distance [m] from which on it counts.
    pub from: f64,
}

/// Where a line comes upon a face from the side where grains are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Struck {
    /// Distance [m] along the line.
    pub at: f64,
    /// Unit vector away from the wall.
    pub normal: Vec3,
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

    /// Where a line first comes upon a face: at once where it is behind the face already and goes on into the wall, and never where
    /// it comes out of it.
    fn struck(&self, face: u32, line: &Line) -> Option<Struck>;

    /// Whether a line that leaves a face can come upon the same face next.
    fn curves_around(&self, _face: u32) -> bool {
        false
    }

    /// On which side of it a point [m] is, where it is thin: a distance [m] with a sign. Nothing where there is a solid behind.
    fn side(&self, _point: Vec3) -> Option<f64> {
        None
    }

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

    /// How far an offset [m] reaches in the directions in which it has no end [m]; nothing where it has an end in all.
    fn endless_part(&self, _offset: Vec3) -> Option<f64> {
        None
    }

    /// Triangles that show it; where it has no end as far as it reaches this length [m] from a point [m].
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

impl Line {
    /// A point [m] of it.
    #[inline]
    pub fn at(&self, distance: f64) -> Vec3 {
        self.origin + self.direction * distance
    }
}

/// A plane with a solid behind it; `height` [m] is that of the line's origin above it.
#[inline]
pub(super) fn upon_plane(line: &Line, height: f64, normal: Vec3) -> Option<Struck> {
    let toward = -line.direction.dot(normal);
    (toward > 0.0).then(|| Struck { at: (height / toward).max(line.from), normal })
}

/// The piece of a line within something convex: where it begins and ends [m], and the normal where it begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Within {
    pub enter: f64,
    pub leave: f64,
    pub normal: Vec3,
}

impl Within {
    /// All of it.
    pub const ALL: Self = Self { enter: f64::NEG_INFINITY, leave: f64::INFINITY, normal: Vec3::ZERO };

    /// What of it is in something else as well.
    pub fn and(self, other: Self) -> Self {
        let first = if other.enter > self.enter { other } else { self };
        Self { leave: self.leave.min(other.leave), ..first }
    }

    /// The piece between two planes across a unit vector, whose places along it and that of the line's origin are given [m].
    pub fn slab(line: &Line, along: Vec3, [low, high]: [f64; 2], origin: f64) -> Option<Self> {
        let speed = line.direction.dot(along);
        if speed == 0.0 {
            return (low <= origin && origin <= high).then_some(Self::ALL);
        }
        let (near, far) = if speed > 0.0 { (low, high) } else { (high, low) };
        let normal = along * -speed.signum();
        Some(Self { enter: (near - origin) / speed, leave: (far - origin) / speed, normal })
    }

    /// The piece within a ball, or within a cylinder where the vectors are those across its axis: `origin` [m] seen from the middle.
    pub fn round(origin: Vec3, direction: Vec3, radius: f64) -> Option<Self> {
        let square = direction.norm_squared();
        let beyond = origin.norm_squared() - radius * radius;
        if square == 0.0 {
            return (beyond <= 0.0).then_some(Self::ALL);
        }
        // Roots without cancellation; the offset form keeps what is far and small exact.
        let nearest = -origin.dot(direction) / square;
        let offset = origin + direction * nearest;
        let half_squared = (radius * radius - offset.norm_squared()) / square;
        if half_squared < 0.0 {
            return None;
        }
        let half = half_squared.sqrt();
        let (mut enter, mut leave) = (nearest - half, nearest + half);
        if nearest > 0.0 {
            enter = beyond / (square * leave);
        } else if enter < 0.0 {
            leave = beyond / (square * enter);
        }
        Some(Self { enter, leave, normal: (origin + direction * enter) / radius })
    }

    /// Where a line comes upon the solid; `outward` is its normal where the line is now, if that is inside.
    pub fn struck(self, line: &Line, outward: impl FnOnce(Vec3) -> Vec3) -> Option<Struck> {
        if self.enter > self.leave || self.leave <= line.from {
            return None;
        }
        if self.enter >= line.from {
            return Some(Struck { at: self.enter, normal: self.normal });
        }
        let normal = outward(line.at(line.from));
        (line.direction.dot(normal) < 0.0).then_some(Struck { at: line.from, normal })
    }
}

/// Where a line comes upon a round face from inside; vectors as for [`Within::round`].
pub(super) fn upon_hollow(line: &Line, origin: Vec3, direction: Vec3, radius: f64) -> Option<Struck> {
    let square = direction.norm_squared();
    if square == 0.0 {
        return None;
    }
    // Behind the face a line may miss the hollow: it is where it comes nearest then.
    let nearest = -origin.dot(direction) / square;
    let far = Within::round(origin, direction, radius).map_or(nearest, |within| within.leave);
    let at = far.max(line.from);
    let outward = (origin + direction * at).normalized();
    (outward.dot(direction) > 0.0).then_some(Struck { at, normal: -outward })
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
