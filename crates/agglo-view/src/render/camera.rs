//! Where a picture is taken from.

use super::bvh::Ray;
use agglo::math::Vec3;

/// Vertical angle of view [rad]: that of a long lens, so that near grains do not look much larger than far ones.
const ANGLE: f64 = 0.45;

/// From which side a run is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    /// Angle about the z axis [rad]; from 0 one looks along +x, from a quarter turn along +y.
    pub azimuth: f64,
    /// Angle above the horizon [rad].
    pub elevation: f64,
}

impl Default for Side {
    /// From the front, a little to the left and above.
    fn default() -> Self {
        Self { azimuth: 60_f64.to_radians(), elevation: 20_f64.to_radians() }
    }
}

impl Side {
    /// Unit vectors to the right and up in the picture, and forward into it.
    pub fn axes(&self) -> [Vec3; 3] {
        let ((sin, cos), (up, level)) = (self.azimuth.sin_cos(), self.elevation.sin_cos());
        let forward = Vec3::new(cos * level, sin * level, -up);
        let right = Vec3::new(sin, -cos, 0.0);
        [right, right.cross(forward), forward]
    }
}

/// A camera with a perspective view.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    eye: Vec3,
    axes: [Vec3; 3],
    distance: f64,
    width: u32,
    height: u32,
}

impl Camera {
    /// Looks at `center` [m] from `distance` [m], for pictures of `size` (width and height) in pixels.
    pub fn new(center: Vec3, distance: f64, side: Side, size: [u32; 2]) -> Self {
        let axes = side.axes();
        Self { eye: center - axes[2] * distance, axes, distance, width: size[0], height: size[1] }
    }

    /// Sees a box of these half extents [m] (right, up, forward) about `center` [m] whole.
    pub fn framing(center: Vec3, half: [f64; 3], side: Side, size: [u32; 2]) -> Self {
        let slope = (0.5 * ANGLE).tan();
        let aspect = f64::from(size[0]) / f64::from(size[1]);
        let distance = half[2] + (half[1] / slope).max(half[0] / (slope * aspect));
        Self::new(center, distance, side, size)
    }

    /// The same nearer or farther away, so that the middle looks `factor` times as large.
    #[must_use]
    pub fn zoomed(&self, factor: f64) -> Self {
        let center = self.eye + self.axes[2] * self.distance;
        let distance = self.distance / factor;
        Self { eye: center - self.axes[2] * distance, distance, ..self.clone() }
    }

    /// Width and height of the picture in pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// Where it is [m].
    pub(super) fn eye(&self) -> Vec3 {
        self.eye
    }

    /// Unit vectors to the right and up in the picture, and forward into it.
    pub fn axes(&self) -> &[Vec3; 3] {
        &self.axes
    }

    /// Distance of what it looks at [m].
    pub fn distance(&self) -> f64 {
        self.distance
    }

    /// Length of a pixel's edge [m] at this depth [m] before the camera.
    pub fn pixel_at(&self, depth: f64) -> f64 {
        2.0 * depth * (0.5 * ANGLE).tan() / f64::from(self.height)
    }

    /// Length of a pixel's edge [m] in the middle of what it looks at.
    pub fn pixel(&self) -> f64 {
        self.pixel_at(self.distance)
    }

    /// The ray through a point of the picture in pixels from its upper left corner.
    pub(super) fn ray(&self, x: f64, y: f64) -> Ray {
        let pixel = self.pixel_at(1.0);
        let (right, down) = (x - 0.5 * f64::from(self.width), y - 0.5 * f64::from(self.height));
        let [to_right, up, forward] = self.axes;
        let direction = forward + to_right * (right * pixel) - up * (down * pixel);
        Ray::new(self.eye, direction.normalized())
    }

    /// Where a point [m] is seen, in pixels from the upper left corner, and its depth [m]; nothing behind the camera.
    pub fn project(&self, point: Vec3) -> Option<([f64; 2], f64)> {
        let [right, up, forward] = self.axes.map(|axis| axis.dot(point - self.eye));
        let pixel = self.pixel_at(forward);
        let (middle_x, middle_y) = (0.5 * f64::from(self.width), 0.5 * f64::from(self.height));
        (forward > 0.0).then(|| ([middle_x + right / pixel, middle_y - up / pixel], forward))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera(side: Side) -> Camera {
        Camera::new(Vec3::new(1.0, -2.0, 0.5), 10.0, side, [640, 360])
    }

    #[test]
    fn rays_go_where_points_are_seen() {
        for azimuth in [0.0, 1.0, 4.0] {
            let camera = camera(Side { azimuth, elevation: 0.3 });
            for point in [[1.0, -2.0, 0.5], [2.0, -1.0, 1.0], [0.3, -3.0, -0.4]].map(Vec3::from) {
                let ([x, y], _) = camera.project(point).unwrap();
                let ray = camera.ray(x, y);
                let aside = (point - ray.origin).rejected_from(ray.direction);
                assert!(aside.norm() < 1e-13, "{aside:?}");
            }
        }
    }

    #[test]
    fn the_axes_are_right_and_up() {
        // Along +y: x is to the right, z is up.
        let [right, up, forward] = Side { azimuth: 0.25 * std::f64::consts::TAU, elevation: 0.0 }.axes();
        for (axis, wanted) in [(right, Vec3::AXES[0]), (up, Vec3::AXES[2]), (forward, Vec3::AXES[1])] {
            assert!((axis - wanted).norm() < 1e-15, "{axis:?}");
        }
        // From above one looks down.
        let [_, _, forward] = Side { azimuth: 0.0, elevation: 1.0 }.axes();
        assert_below!(forward.z, 0.0);
    }

    /// The corners of the near face of the box touch the picture's edges, as its half extents say.
    #[test]
    fn a_box_is_framed() {
        let side = Side::default();
        let camera = Camera::framing(Vec3::ZERO, [2.0, 1.5, 0.7], side, [800, 600]);
        let [right, up, forward] = side.axes();
        let corner = right * 2.0 + up * 1.5 - forward * 0.7;
        let ([x, y], _) = camera.project(corner).unwrap();
        assert!((x - 800.0).abs() < 1e-9 && y.abs() < 1e-9, "{x} {y}");
        assert_eq!(camera.zoomed(2.0).pixel(), 0.5 * camera.pixel());
    }

    #[test]
    fn what_is_behind_is_not_seen() {
        let camera = camera(Side::default());
        assert_eq!(camera.project(Vec3::new(1.0, -2.0, 0.5) - camera.axes()[2] * 11.0), None);
    }
}
