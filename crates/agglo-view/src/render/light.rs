//! Light: how much of the sky and of the sun reaches a place. Nothing here is random, so pictures have no noise.

use super::bvh::{Bounds, Bvh, Ray};
use super::solid::Sphere;
use agglo::math::Vec3;

/// Directions in which the sky is probed.
const PROBES: usize = 64;

/// Tangent of half the angle under which the sun is seen: it makes shadows soft.
const SUN: f64 = 0.09;

/// The nine functions of the sphere's surface of lowest order, as far as diffuse light needs them (R. Ramamoorthi and
/// P. Hanrahan, *An efficient representation for irradiance environment maps*, 2001).
fn harmonics(n: Vec3) -> [f64; 9] {
    let (x, y, z) = (n.x, n.y, n.z);
    [
        0.282_094_791_773_878_14,
        0.488_602_511_902_919_9 * y,
        0.488_602_511_902_919_9 * z,
        0.488_602_511_902_919_9 * x,
        1.092_548_430_592_079_2 * x * y,
        1.092_548_430_592_079_2 * y * z,
        0.315_391_565_252_520_05 * (3.0 * z * z - 1.0),
        1.092_548_430_592_079_2 * x * z,
        0.546_274_215_296_039_6 * (x * x - y * y),
    ]
}

/// How each order of the sky's light shows on a diffuse surface: the coefficients of a cosine, over pi.
const ORDERS: [f64; 9] = [1.0, 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 0.25, 0.25, 0.25, 0.25, 0.25];

/// A direction of a spiral that covers the sphere evenly.
fn probe(k: usize) -> Vec3 {
    let z = 1.0 - (2.0 * k as f64 + 1.0) / PROBES as f64;
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let ((sin, cos), level) = ((golden * k as f64).sin_cos(), (1.0 - z * z).sqrt());
    Vec3::new(cos * level, sin * level, z)
}

/// The directions with the functions there.
pub(super) struct Probes(Vec<(Vec3, [f64; 9])>);

impl Probes {
    pub fn new() -> Self {
        Self((0..PROBES).map(probe).map(|direction| (direction, harmonics(direction))).collect())
    }

    /// What a surface sees of the sky, which is open where `is_open` says so.
    pub fn sky(&self, is_open: impl Fn(Vec3) -> bool) -> Sky {
        let mut sums = [0.0; 9];
        for (direction, functions) in &self.0 {
            if is_open(*direction) {
                sums.iter_mut().zip(functions).for_each(|(sum, function)| *sum += function);
            }
        }
        let share = 4.0 * std::f64::consts::PI / PROBES as f64;
        sums.iter_mut().zip(ORDERS).for_each(|(sum, order)| *sum *= order * share);
        Sky(sums)
    }
}

/// What is seen of the sky from the surface of a grain, in the functions of lowest order.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sky([f64; 9]);

impl Sky {
    /// The part of the sky's light that reaches a surface with this normal: 1 in the open.
    pub fn light(&self, normal: Vec3) -> f64 {
        let sum: f64 = self.0.iter().zip(harmonics(normal)).map(|(weight, function)| weight * function).sum();
        sum.clamp(0.0, 1.0)
    }
}

/// The part of a distant round light in `direction` that spheres leave free, as seen from `place`; the sphere in
/// the slot `but` is not asked. `slope` is the tangent of half its angle.
pub(super) fn free_part(
    tree: &Bvh,
    spheres: &[Sphere],
    (place, but): (Vec3, Option<usize>),
    direction: Vec3,
    slope: f64,
) -> f64 {
    let ray = Ray::new(place, direction);
    let mut free = 1.0;
    tree.walk(
        |bounds| cone_meets(&ray, slope, bounds),
        |slot| {
            if Some(slot) != but {
                free *= 1.0 - covered(&spheres[slot], &ray, slope);
            }
            free > 0.004
        },
    );
    free
}

/// As [`free_part`], for the sun.
pub(super) fn sun(tree: &Bvh, spheres: &[Sphere], from: (Vec3, Option<usize>), direction: Vec3) -> f64 {
    free_part(tree, spheres, from, direction, SUN)
}

/// Whether the cone about a ray may meet a box: the box is widened by the cone's radius at its far end.
#[inline]
fn cone_meets(ray: &Ray, slope: f64, bounds: &Bounds) -> bool {
    let (center, half) = ((bounds.lower + bounds.upper) * 0.5, (bounds.upper - bounds.lower) * 0.5);
    let d = ray.direction;
    let far = (center - ray.origin).dot(d) + half.x * d.x.abs() + half.y * d.y.abs() + half.z * d.z.abs();
    if far <= 0.0 {
        return false;
    }
    let wider = half + Vec3::new(1.0, 1.0, 1.0) * (slope * far);
    // Half the separating axes suffice: those across the ray.
    let to = center - ray.origin;
    let (x, y, z) = (d.x.abs(), d.y.abs(), d.z.abs());
    (to.y * d.z - to.z * d.y).abs() <= wider.y * z + wider.z * y
        && (to.z * d.x - to.x * d.z).abs() <= wider.z * x + wider.x * z
        && (to.x * d.y - to.y * d.x).abs() <= wider.x * y + wider.y * x
}

/// The part of the light that a sphere covers: from all to nothing as its edge crosses the light's disc.
#[inline]
fn covered(sphere: &Sphere, ray: &Ray, slope: f64) -> f64 {
    let to_center = sphere.center - ray.origin;
    let along = to_center.dot(ray.direction);
    if along <= 0.0 {
        return 0.0;
    }
    let aside = (to_center - ray.direction * along).norm();
    // From -1, where the disc is covered, to 1, where it is free.
    let place = ((aside - sphere.radius) / (slope * along)).clamp(-1.0, 1.0);
    let part = 0.5 - 0.5 * place;
    // A small sphere far away covers no more than its own disc.
    let size = (sphere.radius / (slope * along)).min(1.0);
    part * part * (3.0 - 2.0 * part) * size * size
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Under half a sky a surface gets all light from above, half of it upright and none from below: exact in these
    /// functions. 64 probes share half a sky to a few hundredths.
    #[test]
    fn half_a_sky() {
        let probes = Probes::new();
        let (open, half) = (probes.sky(|_| true), probes.sky(|direction| direction.z > 0.0));
        for (normal, wanted) in [(Vec3::AXES[2], 1.0), (Vec3::AXES[0], 0.5), (-Vec3::AXES[2], 0.0)] {
            assert!((open.light(normal) - 1.0).abs() < 0.01, "{}", open.light(normal));
            assert!((half.light(normal) - wanted).abs() < 0.03, "{} {wanted}", half.light(normal));
        }
    }

    fn shadow(spheres: &[Sphere], place: Vec3) -> f64 {
        let bounds: Vec<Bounds> = spheres.iter().map(Sphere::bounds).collect();
        sun(&Bvh::new(&bounds), spheres, (place, None), Vec3::AXES[2])
    }

    #[test]
    fn shadows_have_a_core_and_a_soft_edge() {
        let ball = Sphere { center: Vec3::new(0.0, 0.0, 10.0), radius: 1.0, color: [1.0; 3] };
        let at = |x: f64| shadow(&[ball], Vec3::new(x, 0.0, 0.0));
        assert_below!(at(0.0), 0.01);
        assert_below!(at(1.0 - 10.0 * SUN), 0.01);
        // Where the sphere's edge goes through the sun's middle half of it is left.
        assert_near!(at(1.0), 0.5, 1e-12);
        assert_eq!((at(1.0 + 10.001 * SUN), at(5.0)), (1.0, 1.0));
        // What is behind the place throws no shadow on it.
        assert_eq!(shadow(&[ball], Vec3::new(0.0, 0.0, 12.0)), 1.0);
    }

    /// Boxes that the cone misses are left out without loss: the same as asking every sphere.
    #[test]
    fn no_shadow_is_lost() {
        use agglo::math::rng::{Purpose, Stream};
        let mut stream = Stream::new(11, Purpose::Sampling, 0);
        let sphere =
            |_| Sphere { center: stream.direction() * stream.uniform(), radius: 0.03, color: [1.0; 3] };
        let spheres: Vec<Sphere> = (0..300).map(sphere).collect();
        let bounds: Vec<Bounds> = spheres.iter().map(Sphere::bounds).collect();
        let tree = Bvh::new(&bounds);
        let sorted: Vec<Sphere> = tree.order().iter().map(|&solid| spheres[solid as usize]).collect();
        let mut dark = 0;
        for _ in 0..2000 {
            let (place, direction) = (stream.direction() * stream.uniform(), stream.direction());
            let ray = Ray::new(place, direction);
            let wanted: f64 = spheres.iter().map(|sphere| 1.0 - covered(sphere, &ray, SUN)).product();
            let found = sun(&tree, &sorted, (place, None), direction);
            // The walk ends once less than 0.004 is left.
            assert!((found - wanted).abs() < 0.004, "{found} instead of {wanted}");
            dark += usize::from(wanted < 0.5);
        }
        assert_above!(dark, 100);
    }
}
