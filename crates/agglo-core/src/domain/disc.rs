//! A flat disc, and the way that it sweeps along its axis: how they lie to regions and balls.

use crate::domain::Region;
use crate::math::Vec3;
use crate::math::roots::root_between;

/// Most steps of alternating projection; two bodies that overlap are found to do so in a few, two that nearly touch
/// count as touching.
const PROJECTIONS: u32 = 2000;
/// Bodies closer than this part of their size count as touching.
const TOUCHING: f64 = 1e-6;

/// A disc; what leaves it flies along its axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// Its middle [m].
    pub center: Vec3,
    /// Unit vector across it.
    pub axis: Vec3,
    /// Its radius [m].
    pub radius: f64,
}

impl Disc {
    /// Distance [m] from a point to the point of the disc that is farthest away.
    pub fn farthest_distance(&self, from: Vec3) -> f64 {
        let offset = self.center - from;
        offset.dot(self.axis).hypot(offset.rejected_from(self.axis).norm() + self.radius)
    }

    /// Distance [m] from the disc to a point.
    pub fn distance(&self, from: Vec3) -> f64 {
        let offset = from - self.center;
        let aside = (offset.rejected_from(self.axis).norm() - self.radius).max(0.0);
        offset.dot(self.axis).hypot(aside)
    }

    /// Half the length of the disc's shadow on a line along a unit vector [m].
    pub fn reach(&self, along: Vec3) -> f64 {
        self.radius * (1.0 - self.axis.dot(along).powi(2)).max(0.0).sqrt()
    }

    /// Whether the whole disc lies in a region; exact, to round-off.
    pub fn lies_in(&self, region: &Region) -> bool {
        match region {
            Region::Sphere(ball) => {
                self.farthest_distance(crate::units::vector(ball.center)) <= ball.radius.si()
            }
            Region::Box(block) => (0..3).all(|k| {
                let half = self.reach(Vec3::AXES[k]);
                self.center[k] - half >= block.lower[k].si() && self.center[k] + half <= block.upper[k].si()
            }),
            Region::Cylinder(cylinder) => {
                let along = Vec3::from(cylinder.axis).normalized();
                let from = self.center - crate::units::vector(cylinder.center);
                from.dot(along).abs() + self.reach(along) <= 0.5 * cylinder.length.si()
                    && self.farthest_from_line(from, along) <= cylinder.radius.si()
            }
        }
    }

    /// Distance [m] from the line through the origin along a unit vector to the point of the disc that is farthest from it; `from`
    /// is the disc's middle seen from there.
    ///
    /// Seen along the line the disc is an ellipse with the half axes e = (r, r |cos|) and its middle at m. The farthest point
    /// m + e u, |u| = 1, has (λ - e²) u = e m with the one λ above r² for which u has length one.
    fn farthest_from_line(&self, from: Vec3, along: Vec3) -> f64 {
        let across = from.rejected_from(along);
        let tilt = self.axis.rejected_from(along);
        let short = tilt.norm();
        if short <= f64::EPSILON {
            return across.norm() + self.radius;
        }
        let minor = tilt / short;
        let major = along.cross(minor);
        let e = [self.radius, self.radius * self.axis.dot(along).abs()];
        let m = [across.dot(major).abs(), across.dot(minor).abs()];
        let longest = e[0] * e[0];
        let point = |lambda: f64| [0, 1].map(|k| e[k] * m[k] / (lambda - e[k] * e[k]));
        let excess = |lambda: f64| {
            let [u, v] = point(lambda);
            u.hypot(v) - 1.0
        };
        let most = longest + e[0] * m[0].hypot(m[1]) * (1.0 + 1e-12);
        let least = longest * (1.0 + 4.0 * f64::EPSILON);
        let [mut u, v] = if m[0] > 0.0 && most > least && excess(least) > 0.0 {
            point(root_between(excess, [least, most], [excess(least), excess(most)], 0.0).at)
        } else {
            // The middle lies on the minor axis, near enough: λ is r² itself, and u takes what v leaves.
            let v = if e[0] > e[1] { (e[1] * m[1] / (longest - e[1] * e[1])).min(1.0) } else { 0.0 };
            [0.0, v]
        };
        u = u.max((1.0 - v * v).max(0.0).sqrt());
        (m[0] + e[0] * u).hypot(m[1] + e[1] * v)
    }

    /// Way [m] that what leaves the disc flies until the first of it meets a ball, 0 if the ball lies about the disc; none if all
    /// of it passes by.
    pub fn meets(&self, center: Vec3, radius: f64) -> Option<f64> {
        let offset = center - self.center;
        let along = offset.dot(self.axis);
        let aside = (offset.rejected_from(self.axis).norm() - self.radius).max(0.0);
        let half_squared = radius * radius - aside * aside;
        if half_squared <= 0.0 {
            return None;
        }
        let half = half_squared.sqrt();
        (along + half > 0.0).then(|| (along - half).max(0.0))
    }

    /// Distance [m] from the disc to a region; 0 where they touch.
    pub fn distance_to(&self, region: &Region) -> f64 {
        self.apart(region, |_| 0.0)
    }

    /// Distance [m] from the way that the disc sweeps to a region; 0 where they touch.
    pub fn distance_of_way_to(&self, region: &Region) -> f64 {
        self.apart(region, |along| along.max(0.0))
    }

    /// Distance of a region from the disc or its way, `onto` saying where along the axis the nearest point of that is: by
    /// projection onto the two in turn, which ends at the nearest points of two convex bodies.
    fn apart(&self, region: &Region, onto: impl Fn(f64) -> f64) -> f64 {
        let size = self.radius + region.enclosing_radius();
        let mut there = region.center();
        let mut gap = f64::INFINITY;
        for _ in 0..PROJECTIONS {
            let offset = there - self.center;
            let along = onto(offset.dot(self.axis));
            let aside = offset.rejected_from(self.axis);
            // Where the point lies on the axis the quotient is infinite, and the part 1.
            let part = (self.radius / aside.norm()).min(1.0);
            let here = self.center + self.axis * along + aside * part;
            there = region.nearest_point(here);
            let now = (there - here).norm();
            if now <= TOUCHING * size {
                return 0.0;
            }
            if gap - now <= 1e-12 * size {
                return now;
            }
            gap = now;
        }
        gap
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::{Ball, Block, Cylinder};
    use crate::math::rng::{Purpose, Stream};
    use crate::units::Quantity;

    fn disc(center: [f64; 3], axis: [f64; 3], radius: f64) -> Disc {
        Disc { center: Vec3::from(center), axis: Vec3::from(axis).normalized(), radius }
    }

    fn block(lower: [f64; 3], upper: [f64; 3]) -> Region {
        Region::Box(Block { lower: lower.map(Quantity), upper: upper.map(Quantity) })
    }

    fn cylinder(axis: [f64; 3], radius: f64, length: f64) -> Region {
        Region::Cylinder(Cylinder {
            center: [Quantity(0.0); 3],
            axis,
            radius: Quantity(radius),
            length: Quantity(length),
        })
    }

    /// A disc across (1, 1, 1) reaches √(2/3) = 0.81650 of its radius along each axis.
    #[test]
    fn a_tilted_disc_in_a_box() {
        let tilted = disc([0.0; 3], [1.0, 1.0, 1.0], 1.0);
        let low = |face: f64| block([face, -1.0, -1.0], [1.0, 1.0, 1.0]);
        let reach = (2.0_f64 / 3.0).sqrt();
        assert_true!(tilted.lies_in(&low(-reach - 1e-12)), "the whole disc lies in the region");
        assert_false!(tilted.lies_in(&low(-reach + 1e-12)), "the whole disc lies in the region");
        assert_false!(tilted.lies_in(&low(-0.8163)), "the whole disc lies in the region");
    }

    /// Against the farthest of 100,000 points of the rim, from tilts of nothing to a right angle: these fall short by
    /// (2 π/100,000)²/8 of the radius at most.
    #[test]
    fn a_tilted_disc_in_a_cylinder() {
        let mut stream = Stream::new(4, Purpose::Sampling, 0);
        for k in 0..60 {
            let axis = match k % 4 {
                0 => Vec3::AXES[2],
                1 => Vec3::AXES[0],
                _ => stream.direction(),
            };
            let (e1, e2) = axis.frame();
            let middle = match k % 3 {
                0 => Vec3::ZERO,
                1 => Vec3::AXES[0] * stream.uniform(),
                _ => stream.direction() * stream.uniform(),
            };
            let disc = Disc { center: middle, axis, radius: 0.7 };
            let rim = (0..100_000).map(|k| {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / 1e5).sin_cos();
                let point = middle + (e1 * cos + e2 * sin) * 0.7;
                point.x.hypot(point.y)
            });
            let farthest = rim.fold(0.0, f64::max);
            let holds = |radius: f64| disc.lies_in(&cylinder([0.0, 0.0, 2.0], radius, 9.0));
            assert!(holds(farthest + 1e-9) && !holds(farthest - 1e-12), "{k} {axis:?} {middle:?} {farthest}");
        }
        // Its middle off the axis of the cylinder along the short half axis of the ellipse, so far that the end of that is the
        // farthest point: 2 + 0.3 cos 60° = 2.15.
        let tilted = disc([2.0, 0.0, 0.0], [3.0_f64.sqrt(), 0.0, 1.0], 0.3);
        assert_near!(tilted.farthest_from_line(tilted.center, Vec3::AXES[2]), 2.15, 1e-14, "in m");
        let across = disc([0.0; 3], [0.0, 0.0, 1.0], 0.3);
        let flat = |length: f64| cylinder([0.0, 0.0, 1.0], 1.0, length);
        assert_true!(across.lies_in(&flat(1e-3)), "the whole disc lies in the region");
        assert_false!(
            disc([0.0, 0.0, 0.1], [1.0, 0.0, 0.0], 0.3).lies_in(&flat(0.79)),
            "the whole disc lies in the region"
        );
        assert_true!(
            disc([0.0, 0.0, 0.1], [1.0, 0.0, 0.0], 0.3).lies_in(&flat(0.81)),
            "the whole disc lies in the region"
        );
    }

    /// A ball of radius 1 a way of 5 off: hit by the axis after 4; by the rim of a disc of 0.8 that passes at 0.6 of its middle
    /// after 5 - 0.8; missed; behind; about the disc.
    #[test]
    fn the_way_to_a_ball_by_hand() {
        let disc = disc([0.0; 3], [1.0, 0.0, 0.0], 0.8);
        let meets = |x: f64, y: f64| disc.meets(Vec3::new(x, y, 0.0), 1.0);
        assert_eq!(meets(5.0, 0.3), Some(4.0));
        assert_near!(meets(5.0, 1.4).unwrap(), 4.2, 1e-15);
        assert_eq!(meets(5.0, 1.81), None);
        assert_eq!(meets(-1.1, 0.0), None);
        assert_eq!(meets(0.5, 0.0), Some(0.0));
    }

    /// Discs and ways beside balls, boxes and cylinders, by hand; 1e-6 of their sizes is what counts as touching.
    #[test]
    fn distances_by_hand() {
        let disc = disc([0.0; 3], [1.0, 0.0, 0.0], 0.5);
        let ball = |x: f64, y: f64| {
            Region::Sphere(Ball { center: [x, y, 0.0].map(Quantity), radius: Quantity(1.0) })
        };
        let close = |found: f64, known: f64| assert!((found - known).abs() < 1e-5, "{found} {known}");
        close(disc.distance_to(&ball(3.0, 0.0)), 2.0);
        close(disc.distance_of_way_to(&ball(3.0, 0.0)), 0.0);
        close(disc.distance_of_way_to(&ball(3.0, 2.0)), 0.5);
        close(disc.distance_of_way_to(&ball(-3.0, 0.0)), 2.0);
        close(disc.distance_to(&ball(0.9, 0.0)), 0.0);
        close(disc.distance_to(&ball(4.0, 4.5)), 32.0_f64.sqrt() - 1.0);
        // A box whose corner's ball would reach the way, which passes its face at 0.1.
        close(disc.distance_of_way_to(&block([1.0, 0.6, -1.0], [2.0, 2.6, 1.0])), 0.1);
        close(disc.distance_of_way_to(&block([1.0, 0.4, -1.0], [2.0, 2.4, 1.0])), 0.0);
        close(disc.distance_to(&block([1.0, 0.4, -1.0], [2.0, 2.4, 1.0])), 1.0);
        let rod = cylinder([0.0, 0.0, 1.0], 0.2, 3.0);
        close(disc.distance_to(&rod), 0.0);
        let aside = Disc { center: Vec3::new(-1.0, 0.9, 0.0), ..disc };
        close(aside.distance_of_way_to(&rod), 0.2);
        // From (-1, 0.4, 0) to the rod's axis.
        close(aside.distance_to(&rod), 1.0_f64.hypot(0.4) - 0.2);
    }
}
