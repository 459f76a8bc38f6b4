//! A straight piece of a ray, and where it meets a sphere.

use crate::math::Vec3;

/// In place of a sphere's number: none.
pub const NO_SPHERE: u32 = u32::MAX;

/// A straight piece of a ray: points `origin + t direction` with `from <= t <= to`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RaySpan {
    /// Where t is 0 [m].
    pub origin: Vec3,
    /// Unit vector.
    pub direction: Vec3,
    /// Smallest t [m], not below 0.
    pub from: f64,
    /// Largest t [m]; infinity allowed.
    pub to: f64,
    /// Sphere that is not to be hit; [`NO_SPHERE`] if all count.
    pub skip: u32,
}

/// The nearest hit of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereHit {
    /// Distance from the span's origin [m].
    pub at: f64,
    /// Number of the sphere.
    pub sphere: u32,
}

/// A sphere, packed for the exact test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sphere {
    pub(super) center: Vec3,
    pub(super) radius: f64,
}

impl Sphere {
    /// Whether a point lies inside; one on the surface, to nine digits, is outside.
    #[inline]
    pub(super) fn holds(&self, point: Vec3) -> bool {
        let radius = self.radius * (1.0 - 1e-9);
        (point - self.center).norm_squared() < radius * radius
    }
}

impl RaySpan {
    /// Where the ray first meets a sphere: now, if its point lies inside and heads inward; never, if outward.
    #[inline]
    pub(super) fn meets(&self, sphere: Sphere) -> Option<f64> {
        let from_center = self.origin - sphere.center;
        let nearest = -from_center.dot(self.direction);
        if nearest <= self.from {
            return None;
        }
        // Both roots without cancellation; the offset form keeps far and small spheres exact.
        let offset = from_center + self.direction * nearest;
        let half_chord_squared = sphere.radius * sphere.radius - offset.norm_squared();
        if half_chord_squared < 0.0 {
            return None;
        }
        let outside = from_center.norm_squared() - sphere.radius * sphere.radius;
        let entry = outside / (nearest + half_chord_squared.sqrt());
        Some(entry.max(self.from))
    }

    /// Where the ray first touches a ball that a moving sphere may be anywhere in: unlike [`RaySpan::meets`] also on
    /// its way out, since the sphere's own center may lie ahead.
    #[inline]
    pub(super) fn touches(&self, ball: Sphere) -> Option<f64> {
        let now = self.origin + self.direction * self.from - ball.center;
        if now.norm_squared() <= ball.radius * ball.radius { Some(self.from) } else { self.meets(ball) }
    }
}
