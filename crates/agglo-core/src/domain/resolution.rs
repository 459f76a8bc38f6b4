//! Where doubles end: how finely they tell places apart.
//!
//! Neighboring doubles near 1 m are 2e-16 m apart, near 1e12 m a tenth of a millimeter. A grain whose place is known no
//! better than that does not touch, and moves, by chance. One limit holds for soft and hard spheres, at the start and on the
//! way.

use crate::math::Vec3;

/// Largest part of a grain's radius by which neighboring places may differ.
///
/// It is a hundredth of the gap within which grains count as touching (`contact::closeness`), and of the overlap of a
/// contact that is pressed by a thousandth of the radius: both are known to 1 %. Normals of impacts are then known to
/// 1e-5 rad. Doubles hold that up to 4.5e10 radii from the origin.
pub const COARSEST: f64 = 1e-5;
/// A grain that would move less far in a whole run, in parts of its radius, may stand still.
const WORTH_MOVING: f64 = 1e-3;

/// Distance [m] between neighboring doubles at the largest coordinate of a place.
#[inline]
pub fn spacing(position: Vec3) -> f64 {
    let largest = position.x.abs().max(position.y.abs()).max(position.z.abs());
    largest.next_up() - largest
}

/// Whether a place that is known to `rounding` [m] is known well enough for a grain of this radius [m]. What is not a number
/// is not.
#[inline]
pub fn is_fine(rounding: f64, radius: f64) -> bool {
    rounding <= COARSEST * radius
}

/// Whether a place is too far from the origin for a grain of this radius [m].
#[inline]
pub fn is_too_far(position: Vec3, radius: f64) -> bool {
    !is_fine(spacing(position), radius)
}

/// Whether a grain that moves stands still all the same: a step of `dt` [s] is lost to rounding along an axis along which
/// the grain would come somewhere within the `duration` [s] of the run.
#[inline]
pub fn is_stuck(position: Vec3, velocity: Vec3, radius: f64, dt: f64, duration: f64) -> bool {
    (0..3).any(|axis| {
        let (place, speed) = (position[axis], velocity[axis]);
        place + speed * dt == place && (speed * duration).abs() > WORTH_MOVING * radius
    })
}

/// A warning where grains, each a position [m], a velocity [m/s] and a radius [m], are too far from the origin or too slow
/// for steps of `dt` [s] in a run of `duration` [s].
pub fn warning(
    mut grains: impl Iterator<Item = (Vec3, Vec3, f64)>,
    dt: f64,
    duration: f64,
) -> Option<&'static str> {
    grains.find_map(|(position, velocity, radius)| {
        if is_too_far(position, radius) {
            Some(
                "a grain is so far from the origin that neighboring places differ by more than 1e-5 of its radius: \
                 contacts and motion are round-off there",
            )
        } else if is_stuck(position, velocity, radius, dt, duration) {
            Some(
                "a grain moves less in a step than neighboring places differ, so it stands still; move the grains \
                 toward the origin or take longer steps",
            )
        } else {
            None
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2^52 spacings make a binade: 2.2e-16 m from 1 m to 2 m, 1.2e-4 m at 1e12 m (2^39 to 2^40).
    #[test]
    fn spacing_is_that_of_the_largest_coordinate() {
        assert_eq!(spacing(Vec3::new(0.0, -1.5, 0.3)), f64::EPSILON);
        assert_eq!(spacing(Vec3::new(1e12, 0.0, 0.0)), 2.0_f64.powi(39 - 52));
    }

    /// Half a per cent within the limits and beyond: 1e-5 of a radius for a place, 1e-3 of it for a way worth going.
    #[test]
    fn limits_are_parts_of_the_radius() {
        assert_true!(is_fine(0.995e-8, 1e-3), "numbers this coarse, m, are fine enough for a grain of 1 mm");
        assert_false!(is_fine(1.005e-8, 1e-3), "numbers this coarse, m, are fine enough for a grain of 1 mm");
        assert_false!(is_fine(f64::NAN, 1e-3), "numbers this coarse, m, are fine enough for a grain of 1 mm");
        let stuck = |way: f64| is_stuck(Vec3::AXES[0], Vec3::AXES[0] * 1e-12, 1e-3, 1e-6, way / 1e-12);
        assert_false!(stuck(0.995e-6), "a way of so many m in the whole run is lost");
        assert_true!(stuck(1.005e-6), "a way of so many m in the whole run is lost");
    }

    #[test]
    fn far_grains_and_slow_steps_are_told() {
        let told = |x: f64, v: f64, dt: f64, duration: f64| {
            let grain = (Vec3::new(x, 0.0, 0.0), Vec3::new(v, 0.0, 0.0), 1e-3);
            warning(std::iter::once(grain), dt, duration)
        };
        assert_contains!(told(1e12, 1.0, 1e-6, 1.0).unwrap(), "so far from the origin");
        assert_eq!(told(1.0, 1.0, 1e-6, 1.0), None);
        // 1e-11 m/s for 1e-6 s: 1e-17 m, and the spacing is 2e-16 m; in 1e6 s it would be 1e-5 m, ten times 1e-3 R.
        assert_contains!(told(1.0, 1e-11, 1e-6, 1e6).unwrap(), "stands still");
        assert_eq!(told(1.0, 1e-11, 1e-6, 1e4), None);
        assert_eq!(told(1e-3, 1e-11, 1e-6, 1e6), None);
        assert_eq!(told(1.0, 0.0, 1e-6, 1e6), None);
    }
}
