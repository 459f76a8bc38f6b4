//! What is drawn: spheres and thin lines.

use super::bvh::{Bounds, Ray};
use agglo::math::Vec3;

/// Red, green and blue as light: proportional to power, 1 is white.
pub type Light = [f32; 3];

/// A grain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Center [m].
    pub center: Vec3,
    /// Radius [m].
    pub radius: f64,
    /// Color of its surface.
    pub color: Light,
}

impl Sphere {
    pub(super) fn bounds(&self) -> Bounds {
        Bounds::of_sphere(self.center, self.radius)
    }

    /// Distance at which a ray enters; nothing where it misses or begins inside or beyond.
    #[inline]
    pub(super) fn hit(&self, ray: &Ray) -> Option<f64> {
        entry(ray, self.center, self.radius)
    }
}

/// Distance at which a ray enters a sphere.
///
/// The square of the distance between center and line is taken from the vector between them: from squares of lengths
/// it would lose its digits where the sphere is small and far away.
#[inline]
fn entry(ray: &Ray, center: Vec3, radius: f64) -> Option<f64> {
    let to_center = center - ray.origin;
    let along = to_center.dot(ray.direction);
    let aside = to_center - ray.direction * along;
    let half_chord_squared = radius * radius - aside.norm_squared();
    if half_chord_squared < 0.0 {
        return None;
    }
    let distance = along - half_chord_squared.sqrt();
    (distance > 0.0).then_some(distance)
}

/// A thin line with round ends: a bond, a ray, an edge of the control volume. It is not shaded and throws no shadow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Its ends [m].
    pub ends: [Vec3; 2],
    /// Half its thickness [m].
    pub radius: f64,
    /// Its color.
    pub color: Light,
}

impl Line {
    pub(super) fn bounds(&self) -> Bounds {
        let [a, b] = self.ends.map(|end| Bounds::of_sphere(end, self.radius));
        a.and(b)
    }

    /// Distance at which a ray enters: through the mantle between the ends, or through the ball about the end that
    /// the mantle's hit lies beyond.
    #[inline]
    pub(super) fn hit(&self, ray: &Ray) -> Option<f64> {
        let [start, end] = self.ends;
        let axis = (end - start).normalized();
        let length = (end - start).norm();
        let from_start = ray.origin - start;
        // Seen along the axis the line is a disc, and the ray a ray in a plane.
        let (across, place) = (ray.direction.rejected_from(axis), from_start.rejected_from(axis));
        let speed_squared = across.norm_squared();
        let nearest = -place.dot(across) / speed_squared;
        let aside = place + across * nearest;
        let left = self.radius * self.radius - aside.norm_squared();
        let mantle = if speed_squared > 0.0 && left >= 0.0 {
            nearest - (left / speed_squared).sqrt()
        } else if speed_squared > 0.0 {
            return None;
        } else {
            0.0
        };
        let height = (from_start + ray.direction * mantle).dot(axis);
        if speed_squared > 0.0 && (0.0..=length).contains(&height) {
            return (mantle > 0.0).then_some(mantle);
        }
        let first =
            if height < 0.0 || (speed_squared == 0.0 && ray.direction.dot(axis) > 0.0) { start } else { end };
        entry(ray, first, self.radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spheres_are_entered_at_their_near_side() {
        let sphere = Sphere { center: Vec3::new(0.0, 0.0, 5.0), radius: 2.0, color: [1.0; 3] };
        let along_z = |x: f64, z: f64| sphere.hit(&Ray::new(Vec3::new(x, 0.0, z), Vec3::AXES[2]));
        assert_eq!(along_z(0.0, 0.0), Some(3.0));
        // At a distance of 1.2 from the middle half the chord is 1.6.
        assert_near!(along_z(1.2, 0.0).unwrap(), 3.4, 1e-15);
        assert_eq!((along_z(2.1, 0.0), along_z(0.0, 4.0), along_z(0.0, 9.0)), (None, None, None));
    }

    #[test]
    fn lines_have_a_mantle_and_round_ends() {
        let line = Line { ends: [Vec3::ZERO, Vec3::new(0.0, 0.0, 4.0)], radius: 0.5, color: [1.0; 3] };
        let hit = |origin: [f64; 3], toward: [f64; 3]| {
            line.hit(&Ray::new(origin.into(), Vec3::from(toward).normalized()))
        };
        assert_eq!(hit([-3.0, 0.0, 1.0], [1.0, 0.0, 0.0]), Some(2.5));
        assert_near!(hit([-3.0, 0.3, 1.0], [1.0, 0.0, 0.0]).unwrap(), 2.6, 1e-15);
        // Beyond its end, through the ball about it: 0.3² + 0.4² = 0.5².
        assert_near!(hit([-3.0, 0.0, 4.3], [1.0, 0.0, 0.0]).unwrap(), 2.6, 1e-15);
        assert_eq!(hit([-3.0, 0.0, 4.6], [1.0, 0.0, 0.0]), None);
        // Along its axis, from either side.
        assert_eq!(hit([0.0, 0.0, -2.0], [0.0, 0.0, 1.0]), Some(1.5));
        assert_eq!(hit([0.0, 0.0, 6.0], [0.0, 0.0, -1.0]), Some(1.5));
        // Slanted at 45 degrees, in the axis' plane: the mantle at x = -0.5, √2 times 2.5 away.
        let slanted = hit([-3.0, 0.0, 0.0], [1.0, 0.0, 1.0]).unwrap();
        assert_near!(slanted, 2.5 * 2.0_f64.sqrt(), 1e-14);
    }
}
