//! Where rays end when no region is given: behind the ball about the grains, out of reach of all of them.
//!
//! # Equation
//! ```text
//! s_x = s_0 + √(R² - b²) where b <= R √(1 - β²),   else s_0 + (R - b √(1 - β²))/β,   β = 0.1 + w/c    A14
//! ```
//! A ray that comes to the way s_x along its straight segment has left for good. The distance of a point of its line from
//! the ball's middle is √(b² + (s-s_0)²). A grain that starts anywhere in the ball when the ray is at s is at most
//! R + β (s' - s) from the middle when it is at s'. The first s from which the one stays above the other for all s' > s, and
//! the ray is outside, is s_x: where it comes out of the ball, if it then leaves faster than β c, else where the tangent of
//! slope β touches.
//!
//! Where space repeats itself the images of the grains go on for ever along some axes. Then what lies along the open axes counts alone: R, b and
//! s_0 are those of the places there, the ray is slower by the length d of what is left of its direction, and β/d stands for β and s d for s; from
//! β = d on a ray never ends this way. So it does not where a wall is ahead, off which it comes back.
//!
//! # Source
//! Worked out for this program; the derivation stands above.
//!
//! # Symbols
//! | symbol | name in code       | unit | meaning                                                        |
//! |--------|--------------------|------|----------------------------------------------------------------|
//! | R      | `radius`           | m    | of the ball about all grains, as they are now                  |
//! | b, s_0 | `offset`, `nearest` | m   | distance of the ray's line from the ball's middle; way to there |
//! | s_x    | [`Followed::exit_distance`] | m | way to where the ray ends                                |
//! | w/c    | `mach`             | 1    | speed of the fastest grain now over that of sound              |
//! | β      | `slope`            | 1    | how fast a grain may come after the ray, over the speed of sound |
//!
//! # Valid when
//! Grains get no more than 0.1 c faster than the fastest is now while the ray is near. A run warns of grains faster than
//! that. From w = 0.9 c on a ray never ends this way. The ball is taken anew in each step, from the grains alone, so it
//! has no memory; among grains at rest the end of a ray does not depend on the step, to the last bit.
//!
//! # Compared with others
//! A region that stays while grains spread drops rays in the middle of the cloud: in the paper's sample problem pulses 3 and 4
//! then count 833 and 14 reflections instead of thousands. A ray that passes the grains by ends at once.
//!
//! # In a scenario
//! ```toml
//! # No key chooses it: it acts where `region` is left out.
//! [acoustics]
//! bounces = 10000000
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::acoustics::Followed;
//! use agglo::math::Vec3;
//! let ball = Followed::of(&[Vec3::ZERO], &[2.0], 0.0);
//! // Through the middle it leaves at the surface; to rounding and the ball's own allowance of 1e-9.
//! assert!((ball.exit_distance(Vec3::new(-3.0, 0.0, 0.0), Vec3::AXES[0]) - 5.0).abs() < 1e-8);
//! ```

use crate::domain::{Space, extent};
use crate::math::Vec3;

/// By how much of the speed of sound the fastest grain may become faster while a ray is near.
pub const ALLOWANCE: f64 = 0.1;
/// The ball is a little wider than the grains, so that rounding leaves none outside.
const WIDER: f64 = 1.0 + 1e-9;

/// A ball about all grains as they are now, and how fast they may come after a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Followed {
    center: Vec3,
    radius: f64,
    slope: f64,
    /// 1 along open axes and 0 along others, where space repeats itself along some.
    open: Option<Vec3>,
}

impl Followed {
    /// The ball about grains at `positions` [n, 3] [m] with `radii` [n] [m]; `mach` is the speed of the fastest over that of
    /// sound.
    pub fn of(positions: &[Vec3], radii: &[f64], mach: f64) -> Self {
        Self::across(&Space::OPEN, positions, radii, mach)
    }

    /// The same in space that may repeat itself: of places and ways only what lies along the open axes counts.
    pub fn across(space: &Space, positions: &[Vec3], radii: &[f64], mach: f64) -> Self {
        let axes = || Vec3::from([0, 1, 2].map(|axis| f64::from(u8::from(!space.repeats_along(axis)))));
        let open = space.repeats().then(axes);
        let seen = |place: Vec3| open.map_or(place, |open| along(place, open));
        let (lower, upper) = extent(positions, radii).unwrap_or_default();
        let center = seen((lower + upper) * 0.5);
        let reach = |(&position, &radius): (&Vec3, &f64)| (seen(position) - center).norm() + radius;
        let radius = positions.iter().zip(radii).map(reach).fold(0.0, f64::max);
        Self { center, radius: radius * WIDER, slope: ALLOWANCE + mach, open }
    }

    /// Way [m] from `origin` along the unit vector `direction` from which on no grain can reach the ray; below 0 where that
    /// was so before, infinity where grains are as fast as sound.
    #[inline]
    pub fn exit_distance(&self, origin: Vec3, direction: Vec3) -> f64 {
        if let Some(open) = self.open {
            return self.exit_across(along(origin, open), along(direction, open));
        }
        if self.slope >= 1.0 {
            return f64::INFINITY;
        }
        let from = origin - self.center;
        let nearest = -from.dot(direction);
        let offset_squared = (from + direction * nearest).norm_squared();
        let shrunk_squared = 1.0 - self.slope * self.slope;
        let (radius_squared, lagging) = (self.radius * self.radius, offset_squared * shrunk_squared);
        if offset_squared <= radius_squared * shrunk_squared {
            nearest + (radius_squared - offset_squared).sqrt()
        } else {
            nearest + (self.radius - lagging.sqrt()) / self.slope
        }
    }

    /// The same of what lies along the open axes: there a ray is slower, and a grain seems to come after it faster.
    fn exit_across(&self, origin: Vec3, direction: Vec3) -> f64 {
        let speed = direction.norm();
        if self.slope >= speed {
            return f64::INFINITY;
        }
        let slower = Self { slope: self.slope / speed, open: None, ..*self };
        slower.exit_distance(origin, direction / speed) / speed
    }
}

/// What of a vector lies along axes that have a 1.
fn along(vector: Vec3, axes: Vec3) -> Vec3 {
    Vec3::new(vector.x * axes.x, vector.y * axes.y, vector.z * axes.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::{Purpose, Stream};

    fn ball(mach: f64) -> Followed {
        Followed { center: Vec3::new(1.0, -2.0, 0.5), radius: 1.5, slope: ALLOWANCE + mach, open: None }
    }

    /// A ray that grazes the ball ends (1 - √(1 - β²))/β radii behind it, β = 0.1 and that of the fastest grain more.
    #[test]
    fn a_grazing_ray_waits_for_what_may_come_after_it() {
        for (mach, beta) in [(0.0, 0.1_f64), (0.5, 0.6)] {
            let ball = ball(mach);
            let origin = ball.center + Vec3::new(-3.0, ball.radius, 0.0);
            let behind = (1.0 - (1.0 - beta * beta).sqrt()) / beta * ball.radius;
            assert_near!(ball.exit_distance(origin, Vec3::AXES[0]) - 3.0, behind, 1e-12);
        }
    }

    /// Nothing that starts in the ball when a ray is at its exit and flies at up to β c ever comes near it, and a little earlier
    /// something could: the distance of the ray against the reach of the ball, at 4000 later moments.
    #[test]
    fn a_ray_ends_where_no_grain_can_reach_it_and_not_before() {
        let mut stream = Stream::new(8, Purpose::Sampling, 0);
        let mut grazing = 0;
        for k in 0..600 {
            let ball = ball([0.0, 0.2, 0.7][k % 3]);
            let direction = stream.direction();
            let offset = direction.frame().0 * (1.4 * ball.radius * stream.uniform());
            let origin = ball.center + offset - direction * (4.0 * stream.uniform());
            let exit = ball.exit_distance(origin, direction);
            let clearance = |start: f64| {
                let after = |step: i32| start + 20.0 * (f64::from(step) / 4000.0).powi(2);
                let gap = |at: f64| {
                    (origin + direction * at - ball.center).norm() - ball.radius - ball.slope * (at - start)
                };
                (0..4000).map(|step| gap(after(step))).fold(f64::INFINITY, f64::min)
            };
            // Round-off at the exit; a millimeter before it the clearance is below zero by up to the slope times that.
            assert!(clearance(exit) > -1e-12, "{k}: {}", clearance(exit));
            assert!(clearance(exit - 1e-3) < 0.0, "{k}: {}", clearance(exit - 1e-3));
            grazing += usize::from(offset.norm() > 0.99 * ball.radius);
        }
        assert_above!(grazing, 100);
    }

    #[test]
    fn the_ball_holds_all_grains() {
        let (positions, radii) = ([Vec3::new(4.0, 0.0, 0.0), Vec3::new(5.0, 1.0, 0.0)], [0.5, 0.1]);
        let ball = Followed::of(&positions, &radii, 0.0);
        for (position, radius) in positions.iter().zip(radii) {
            assert_at_most!((*position - ball.center).norm() + radius, ball.radius);
        }
        // From 3.5 to 5.1 and from -0.5 to 1.1: the second grain's far side is 0.1 + |(0.7, 0.7)| from the middle.
        assert_near!(ball.radius - 0.1, 0.7 * 2.0_f64.sqrt(), 1e-8);
        assert_eq!(Followed::of(&[], &[], 0.0).radius, 0.0);
    }

    #[test]
    fn grains_as_fast_as_sound_keep_every_ray() {
        assert_eq!(ball(0.9).exit_distance(Vec3::ZERO, Vec3::AXES[0]), f64::INFINITY);
        assert_finite!(ball(0.89).exit_distance(Vec3::ZERO, Vec3::AXES[0]));
    }

    /// A layer of grains from z = -1 to 1 that goes on along x and y: a ray upward leaves where it comes out of it, 1/d_z on, unless it rises
    /// more slowly than grains could come after it. Along two open axes it is the disc that it has to leave, at a way 1/d longer than in
    /// the plane.
    #[test]
    fn across_faces_only_open_axes_count() {
        let corner = Vec3::new(5.0, 5.0, 5.0);
        let space = |axes| Space::repeating([-corner, corner], axes);
        let (positions, radii) = ([Vec3::new(4.0, -3.0, 0.5), Vec3::new(-1.0, 2.0, -0.5)], [0.5, 0.5]);
        let layer = Followed::across(&space([true, true, false]), &positions, &radii, 0.0);
        let origin = Vec3::new(70.0, -3.0, 0.25);
        for rise in [0.9, 0.3, 0.11] {
            let direction = Vec3::new((1.0_f64 - rise * rise).sqrt(), 0.0, rise);
            assert_near!(layer.exit_distance(origin, direction), 0.75 / rise, 1e-7);
        }
        assert_eq!(layer.exit_distance(origin, Vec3::new(0.995, 0.0, 0.0999).normalized()), f64::INFINITY);
        let row = Followed::across(&space([false, false, true]), &positions, &radii, 0.0);
        let flat = Followed { slope: ALLOWANCE / 0.6, open: None, ..row };
        let from = Vec3::new(-9.0, 1.0, 33.0);
        let wanted = flat.exit_distance(Vec3::new(-9.0, 1.0, 0.0), Vec3::AXES[0]) / 0.6;
        assert_near!(row.exit_distance(from, Vec3::new(0.6, 0.0, 0.8)), wanted, 1e-12);
        let closed = Followed::across(&space([true; 3]), &positions, &radii, 0.0);
        assert_eq!(closed.exit_distance(origin, Vec3::AXES[2]), f64::INFINITY);
        let open = Followed::across(&Space::OPEN, &positions, &radii, 0.2);
        assert_eq!(open, Followed::of(&positions, &radii, 0.2));
    }
}
