//! Regions of space: sphere, box, cylinder.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::math::Vec3;
use crate::math::rng::Stream;
use crate::units::{Length, Triple, vector};

/// A region of space.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Region {
    /// A ball.
    Sphere(Ball),
    /// A block with faces along the axes.
    Box(Block),
    /// A straight circular cylinder.
    Cylinder(Cylinder),
}

/// A ball.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ball {
    /// Its center; the origin if left out.
    #[serde(default)]
    pub center: Triple<Length>,
    /// Its radius.
    pub radius: Length,
}

/// A block with faces along the axes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Block {
    /// Corner with the smallest coordinates.
    pub lower: Triple<Length>,
    /// Corner with the largest coordinates.
    pub upper: Triple<Length>,
}

/// A straight circular cylinder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cylinder {
    /// Its center; the origin if left out.
    #[serde(default)]
    pub center: Triple<Length>,
    /// Direction of its axis.
    pub axis: [f64; 3],
    /// Its radius.
    pub radius: Length,
    /// Its length along the axis.
    pub length: Length,
}

impl Region {
    /// Middle of the region [m].
    pub fn center(&self) -> Vec3 {
        match self {
            Self::Sphere(ball) => vector(ball.center),
            Self::Box(block) => (vector(block.lower) + vector(block.upper)) * 0.5,
            Self::Cylinder(cylinder) => vector(cylinder.center),
        }
    }

    /// Radius [m] of the ball about [`Region::center`] that encloses the region.
    pub fn enclosing_radius(&self) -> f64 {
        match self {
            Self::Sphere(ball) => ball.radius.si(),
            Self::Box(block) => 0.5 * (vector(block.upper) - vector(block.lower)).norm(),
            Self::Cylinder(cylinder) => cylinder.radius.si().hypot(0.5 * cylinder.length.si()),
        }
    }

    /// Volume [m³].
    pub fn volume(&self) -> f64 {
        use std::f64::consts::PI;
        match self {
            Self::Sphere(ball) => 4.0 / 3.0 * PI * ball.radius.si().powi(3),
            Self::Box(block) => {
                let edges = vector(block.upper) - vector(block.lower);
                edges.x * edges.y * edges.z
            }
            Self::Cylinder(cylinder) => PI * cylinder.radius.si().powi(2) * cylinder.length.si(),
        }
    }

    /// Whether a sphere lies wholly inside; `radius` 0 asks for a point.
    pub fn contains(&self, center: Vec3, radius: f64) -> bool {
        match self {
            Self::Sphere(ball) => (center - vector(ball.center)).norm() + radius <= ball.radius.si(),
            Self::Box(block) => {
                let low = center - vector(block.lower);
                let high = vector(block.upper) - center;
                low.x.min(low.y).min(low.z).min(high.x).min(high.y).min(high.z) >= radius
            }
            Self::Cylinder(cylinder) => {
                let axis = Vec3::from(cylinder.axis).normalized();
                let from = center - vector(cylinder.center);
                from.rejected_from(axis).norm() + radius <= cylinder.radius.si()
                    && from.dot(axis).abs() + radius <= 0.5 * cylinder.length.si()
            }
        }
    }

    /// The point of the region [m] that is nearest to a point: itself, if it lies inside.
    pub fn nearest_point(&self, point: Vec3) -> Vec3 {
        match self {
            Self::Sphere(ball) => {
                let from = point - vector(ball.center);
                let distance = from.norm();
                let radius = ball.radius.si();
                if distance <= radius { point } else { vector(ball.center) + from * (radius / distance) }
            }
            Self::Box(block) => point.max(vector(block.lower)).min(vector(block.upper)),
            Self::Cylinder(cylinder) => {
                let axis = Vec3::from(cylinder.axis).normalized();
                let from = point - vector(cylinder.center);
                let half = 0.5 * cylinder.length.si();
                let (along, aside) = (from.dot(axis).clamp(-half, half), from.rejected_from(axis));
                let (distance, radius) = (aside.norm(), cylinder.radius.si());
                let part = if distance <= radius { 1.0 } else { radius / distance };
                vector(cylinder.center) + axis * along + aside * part
            }
        }
    }

    /// Smallest box that holds the region: lower and upper corner [m].
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let center = self.center();
        let half = match self {
            Self::Sphere(ball) => Vec3::new(1.0, 1.0, 1.0) * ball.radius.si(),
            Self::Box(block) => return (vector(block.lower), vector(block.upper)),
            Self::Cylinder(cylinder) => {
                let axis = Vec3::from(cylinder.axis).normalized();
                let reach = |along: f64| {
                    let across = (1.0 - along * along).max(0.0).sqrt();
                    cylinder.radius.si() * across + 0.5 * cylinder.length.si() * along.abs()
                };
                axis.to_array().map(reach).into()
            }
        };
        (center - half, center + half)
    }

    /// Radius [m] of the largest sphere that fits in.
    pub fn inner_radius(&self) -> f64 {
        match self {
            Self::Sphere(ball) => ball.radius.si(),
            Self::Box(block) => {
                let edges = vector(block.upper) - vector(block.lower);
                0.5 * edges.x.min(edges.y).min(edges.z)
            }
            Self::Cylinder(cylinder) => cylinder.radius.si().min(0.5 * cylinder.length.si()),
        }
    }

    /// A point uniform among the centers [m] of spheres of `radius` [m] that lie wholly inside.
    ///
    /// Nothing where no such sphere fits. Made by rejection alone, without sines and roots, so that the
    /// point is the same to the last bit on every machine (save for cylinders askew to the axes, whose
    /// frame takes a root, which is exact everywhere too).
    pub fn sample(&self, radius: f64, stream: &mut Stream) -> Option<Vec3> {
        if self.inner_radius() < radius {
            return None;
        }
        let mut signed = || 2.0 * stream.uniform() - 1.0;
        match self {
            Self::Sphere(ball) => loop {
                let point = Vec3::new(signed(), signed(), signed());
                if point.norm_squared() <= 1.0 {
                    return Some(vector(ball.center) + point * (ball.radius.si() - radius));
                }
            },
            Self::Box(block) => {
                let (lower, upper) = (vector(block.lower), vector(block.upper));
                let half = (upper - lower) * 0.5;
                let [x, y, z] = half.to_array().map(|half| signed() * (half - radius));
                Some((lower + upper) * 0.5 + Vec3::new(x, y, z))
            }
            Self::Cylinder(cylinder) => {
                let axis = Vec3::from(cylinder.axis).normalized();
                let (first, second) = axis.frame();
                let (u, v) = loop {
                    let (u, v) = (signed(), signed());
                    if u * u + v * v <= 1.0 {
                        break (u, v);
                    }
                };
                let along = signed() * (0.5 * cylinder.length.si() - radius);
                let across = (first * u + second * v) * (cylinder.radius.si() - radius);
                Some(vector(cylinder.center) + axis * along + across)
            }
        }
    }

    /// Distance [m] from a point inside, along a unit vector, to the surface; 0 where the ray does not get back in.
    pub fn exit_distance(&self, origin: Vec3, direction: Vec3) -> f64 {
        match self {
            Self::Sphere(ball) => {
                farther_root(origin - vector(ball.center), direction, ball.radius.si()).max(0.0)
            }
            Self::Box(block) => {
                let (low, high) = (vector(block.lower) - origin, vector(block.upper) - origin);
                let leave = |axis: usize| leaving_slab(low[axis], high[axis], direction[axis]);
                leave(0).min(leave(1)).min(leave(2)).max(0.0)
            }
            Self::Cylinder(cylinder) => {
                let axis = Vec3::from(cylinder.axis).normalized();
                let from = origin - vector(cylinder.center);
                let half = 0.5 * cylinder.length.si();
                let (along, speed) = (from.dot(axis), direction.dot(axis));
                let caps = leaving_slab(-half - along, half - along, speed);
                let across = direction.rejected_from(axis);
                let turn = across.norm();
                if turn == 0.0 {
                    return caps.max(0.0);
                }
                let mantle =
                    farther_root(from.rejected_from(axis), across / turn, cylinder.radius.si()) / turn;
                caps.min(mantle).max(0.0)
            }
        }
    }
}

/// Where a ray leaves a slab whose faces lie at `low` and `high` from its start along an axis.
fn leaving_slab(low: f64, high: f64, speed: f64) -> f64 {
    if speed == 0.0 { f64::INFINITY } else { (low / speed).max(high / speed) }
}

/// Where a ray that starts at `from` seen from the center leaves a ball (or, in two dimensions, a circle).
fn farther_root(from: Vec3, direction: Vec3, radius: f64) -> f64 {
    let nearest = -from.dot(direction);
    let offset = from + direction * nearest;
    let half_chord_squared = radius * radius - offset.norm_squared();
    if half_chord_squared < 0.0 { 0.0 } else { nearest + half_chord_squared.sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::Purpose;
    use crate::units::Quantity;

    fn regions() -> [Region; 4] {
        let center = [1.0, -2.0, 0.5].map(Quantity);
        [
            Region::Sphere(Ball { center, radius: Quantity(1.5) }),
            Region::Box(Block {
                lower: [-1.0, 0.0, 2.0].map(Quantity),
                upper: [1.0, 1.5, 5.0].map(Quantity),
            }),
            Region::Cylinder(Cylinder {
                center,
                axis: [1.0, 2.0, -0.5],
                radius: Quantity(0.8),
                length: Quantity(3.0),
            }),
            Region::Cylinder(Cylinder {
                center,
                axis: [0.0, -0.3, 1.0],
                radius: Quantity(2.1),
                length: Quantity(0.4),
            }),
        ]
    }

    /// The mean of |r - center|² over a solid body is a textbook moment of inertia per mass: 3/5 R² for a
    /// ball, the sum of edge²/12 for a block, R²/2 + L²/12 for a cylinder. Five standard errors of the mean.
    #[test]
    fn samples_have_the_second_moment_of_the_shrunk_body() {
        let radius = 0.1;
        let expected = [
            0.6 * 1.4_f64.powi(2),
            (1.8_f64.powi(2) + 1.3_f64.powi(2) + 2.8_f64.powi(2)) / 12.0,
            0.5 * 0.7_f64.powi(2) + 2.8_f64.powi(2) / 12.0,
            0.5 * 2.0_f64.powi(2) + 0.2_f64.powi(2) / 12.0,
        ];
        for (region, expected) in regions().into_iter().zip(expected) {
            let mut stream = Stream::new(3, Purpose::Sampling, 1);
            let (mut sum, mut squares, mut middle) = (0.0, 0.0, Vec3::ZERO);
            let n = 400_000;
            for _ in 0..n {
                let point = region.sample(radius, &mut stream).unwrap();
                assert_true!(
                    region.contains(point, radius * (1.0 - 1e-12)),
                    "a grain of {radius:e} m at {point:?}"
                );
                let value = (point - region.center()).norm_squared();
                sum += value;
                squares += value * value;
                middle += point - region.center();
            }
            let mean = sum / f64::from(n);
            let error = ((squares / f64::from(n) - mean * mean) / f64::from(n)).sqrt();
            assert!((mean - expected).abs() < 5.0 * error, "{mean} {expected}");
            assert_below!((middle / f64::from(n)).norm(), 5.0 * (mean / f64::from(n)).sqrt());
            assert_below!(5.0 * error, 0.01 * expected);
        }
    }

    #[test]
    fn bounds_are_reached_and_not_passed() {
        for region in regions() {
            let (lower, upper) = region.bounds();
            let mut stream = Stream::new(5, Purpose::Sampling, 2);
            let (mut low, mut high) = (upper, lower);
            for _ in 0..300_000 {
                let point = region.sample(0.0, &mut stream).unwrap();
                low = low.min(point);
                high = high.max(point);
            }
            for axis in 0..3 {
                // Corners of a body are seldom met: three parts in a hundred of the extent are left out at most.
                let slack = 0.03 * (upper[axis] - lower[axis]);
                assert_at_least!(low[axis], lower[axis]);
                assert_below!(low[axis], lower[axis] + slack);
                assert_at_most!(high[axis], upper[axis]);
                assert_above!(high[axis], upper[axis] - slack);
            }
        }
    }

    #[test]
    fn a_grain_as_large_as_the_region_sits_in_its_middle() {
        let mut stream = Stream::new(1, Purpose::Sampling, 0);
        let ball = &regions()[0];
        assert_eq!(ball.sample(1.5, &mut stream), Some(ball.center()));
        assert_eq!(ball.sample(1.6, &mut stream), None);
        assert_eq!(regions().map(|region| region.inner_radius()), [1.5, 0.75, 0.8, 0.2]);
    }

    /// Just before the exit a point is inside, just behind it outside, and inside the bounds: by a nanometer on
    /// meters, since a grazing ray crosses the surface slowly.
    #[test]
    fn exit_lies_on_the_surface() {
        let mut stream = Stream::new(1, Purpose::Sampling, 0);
        for region in regions() {
            let (lower, upper) = region.bounds();
            for k in 0..2000 {
                let origin =
                    region.center() + stream.direction() * (0.9 * region.inner_radius() * stream.uniform());
                let direction = if k % 7 == 0 { Vec3::AXES[k % 3] } else { stream.direction() };
                let distance = region.exit_distance(origin, direction);
                assert_true!(
                    region.contains(origin + direction * (distance - 1e-9), 0.0),
                    "{origin:?} along {direction:?} to the border at {distance:e} m"
                );
                assert_false!(
                    region.contains(origin + direction * (distance + 1e-9), 0.0),
                    "{origin:?} along {direction:?} to the border at {distance:e} m"
                );
                let exit = origin + direction * distance;
                let slack = Vec3::new(1e-9, 1e-9, 1e-9);
                assert_eq!(exit.max(lower - slack).min(upper + slack), exit);
            }
        }
    }

    /// The nearest point lies in the region, and no sampled point of it is nearer.
    #[test]
    fn no_point_of_a_region_is_nearer_than_the_nearest() {
        let mut stream = Stream::new(2, Purpose::Sampling, 0);
        for region in regions() {
            for _ in 0..200 {
                let point = region.center() + stream.direction() * (4.0 * stream.uniform());
                let nearest = region.nearest_point(point);
                let inward = nearest + (region.center() - nearest) * 1e-12;
                assert_true!(region.contains(inward, 0.0), "{inward:?} in {region:?}");
                let least = (point - nearest).norm() * (1.0 - 1e-12);
                assert_all!(0..200, |_| {
                    let other = region.sample(0.0, &mut stream).unwrap();
                    (other - point).norm() >= least
                });
                assert!(
                    !region.contains(point, 0.0) || (nearest - point).norm() < 1e-12,
                    "nearest to {point:?} inside is {nearest:?}"
                );
            }
        }
    }

    #[test]
    fn exit_distances_by_hand() {
        let ball = Region::Sphere(Ball { center: [Quantity(0.0); 3], radius: Quantity(1.0) });
        assert_eq!(ball.exit_distance(Vec3::new(-1.0, 0.0, 0.0), Vec3::AXES[0]), 2.0);
        assert_near!(ball.exit_distance(Vec3::new(0.0, 0.6, 0.0), Vec3::AXES[0]), 0.8, 1e-15, "in m");
        assert_eq!(ball.exit_distance(Vec3::new(0.0, 2.0, 0.0), Vec3::AXES[0]), 0.0);
    }
}
