//! Space as grains live in it: open, or repeating itself along some of the axes.

use crate::math::{Real, Vec3, Vector};

/// Space that repeats itself along some of the axes, or along none.
///
/// A grain stands for all of its images, and is where it is inside. Two grains see each other where they are nearest, as long as
/// no reach is half a period or more.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Space {
    lower: Vec3,
    upper: Vec3,
    /// Periods [m], and their inverses; 0 along axes on which space does not repeat itself.
    periods: Vec3,
    per_period: Vec3,
    repeats: bool,
    /// How fast it is drawn out along each axis [1/s].
    strain_rate: Vec3,
    is_strained: bool,
}

/// How often a grain has gone out through each upper face, less how often through the lower one.
pub type Image = [i32; 3];

impl Space {
    /// Space without end.
    pub const OPEN: Self = Self {
        lower: Vec3::ZERO,
        upper: Vec3::ZERO,
        periods: Vec3::ZERO,
        per_period: Vec3::ZERO,
        repeats: false,
        strain_rate: Vec3::ZERO,
        is_strained: false,
    };

    /// Space that repeats the block between two corners [m] along some axes.
    pub fn repeating([lower, upper]: [Vec3; 2], axes: [bool; 3]) -> Self {
        let edges = upper - lower;
        let of = |axis: usize, value: f64| if axes[axis] { value } else { 0.0 };
        let along = |axis: usize| of(axis, edges[axis]);
        let inverse = |axis: usize| of(axis, 1.0 / edges[axis]);
        Self {
            lower,
            upper,
            periods: Vec3::new(along(0), along(1), along(2)),
            per_period: Vec3::new(inverse(0), inverse(1), inverse(2)),
            repeats: axes.contains(&true),
            strain_rate: Vec3::ZERO,
            is_strained: false,
        }
    }

    /// The same while it is drawn out along its axes at these rates [1/s].
    #[must_use]
    pub fn strained(self, strain_rate: Vec3) -> Self {
        Self { strain_rate, is_strained: strain_rate != Vec3::ZERO, ..self }
    }

    /// Whether it is being drawn out or pressed together.
    #[inline(always)]
    pub fn is_strained(&self) -> bool {
        self.is_strained
    }

    /// How fast two points part as they follow it [m/s], from the vector between them [m].
    #[inline(always)]
    #[must_use]
    pub fn flow<F: Real>(&self, between: Vector<F>) -> Vector<F> {
        let Vec3 { x, y, z } = self.strain_rate;
        Vector::new(between.x * F::of(x), between.y * F::of(y), between.z * F::of(z))
    }

    /// Whether it repeats itself along any axis.
    #[inline(always)]
    pub fn repeats(&self) -> bool {
        self.repeats
    }

    /// Whether it repeats itself along an axis.
    #[inline]
    pub fn repeats_along(&self, axis: usize) -> bool {
        self.periods[axis] > 0.0
    }

    /// Periods [m]; 0 along axes on which it does not repeat itself.
    pub fn periods(&self) -> Vec3 {
        self.periods
    }

    /// The shortest period [m]; infinite where there is none.
    pub fn shortest_period(&self) -> f64 {
        self.periods.to_array().into_iter().filter(|period| *period > 0.0).fold(f64::INFINITY, f64::min)
    }

    /// The corners [m] of the block that repeats itself.
    pub fn corners(&self) -> [Vec3; 2] {
        [self.lower, self.upper]
    }

    /// The shortest of the vectors [m] that lead from one point to the images of another, given one of them.
    #[inline(always)]
    #[must_use]
    pub fn shortest<F: Real>(&self, between: Vector<F>) -> Vector<F> {
        if !self.repeats {
            return between;
        }
        let along = |between: F, period: f64, per_period: f64| {
            between - F::of(period) * (between * F::of(per_period)).round()
        };
        Vector::new(
            along(between.x, self.periods.x, self.per_period.x),
            along(between.y, self.periods.y, self.per_period.y),
            along(between.z, self.periods.z, self.per_period.z),
        )
    }

    /// In which image of the block a place [m] is: how many periods it is away along each axis, a face belonging to what is above it.
    #[inline]
    #[must_use]
    pub fn image_at(&self, place: Vec3) -> Image {
        let along = |axis: usize| ((place[axis] - self.lower[axis]) * self.per_period[axis]).floor() as i32;
        [along(0), along(1), along(2)]
    }

    /// Way [m] from a point of the block to its image.
    #[inline(always)]
    #[must_use]
    pub fn shift_to(&self, [x, y, z]: Image) -> Vec3 {
        let Vec3 { x: a, y: b, z: c } = self.periods;
        Vec3::new(a * f64::from(x), b * f64::from(y), c * f64::from(z))
    }

    /// A place [m] at home and its images about the block, 27 where space repeats itself along all axes.
    pub fn images_about(&self, place: Vec3) -> impl Iterator<Item = Vec3> {
        let steps = |axis: usize| if self.repeats_along(axis) { -1..=1 } else { 0..=0 };
        let [xs, ys, zs] = [0, 1, 2].map(steps);
        let (space, home) = (*self, self.home(place).0);
        let images = xs.flat_map(move |x| {
            let zs = zs.clone();
            ys.clone().flat_map(move |y| zs.clone().map(move |z| [x, y, z]))
        });
        images.map(move |image| home + space.shift_to(image))
    }

    /// By how many periods two vectors [m] between the same points differ, if they do not differ otherwise.
    #[inline]
    #[must_use]
    pub fn periods_between(&self, from: Vec3, to: Vec3) -> Image {
        let along = |axis: usize| ((to[axis] - from[axis]) * self.per_period[axis]).round() as i32;
        [along(0), along(1), along(2)]
    }

    /// The image of a point [m] that lies inside, and through which faces it left. Coordinates that are inside keep their bits; the
    /// lower faces belong to the inside, the upper ones do not. What is not a number stays that: it must be noticed.
    #[inline]
    #[must_use]
    pub fn home(&self, place: Vec3) -> (Vec3, Image) {
        let (mut home, mut image) = (place, [0; 3]);
        if self.repeats {
            (home.x, image[0]) = self.home_along(0, place.x);
            (home.y, image[1]) = self.home_along(1, place.y);
            (home.z, image[2]) = self.home_along(2, place.z);
        }
        (home, image)
    }

    #[inline]
    fn home_along(&self, axis: usize, along: f64) -> (f64, i32) {
        let (lower, upper, period) = (self.lower[axis], self.upper[axis], self.periods[axis]);
        if period == 0.0 || (lower <= along && along < upper) {
            return (along, 0);
        }
        let from_lower = along - lower;
        let inside = lower + from_lower.rem_euclid(period);
        // A hair below the lower face is rounded to the upper one.
        let inside = if inside >= upper { lower } else { inside };
        (inside, ((along - inside) / period).round() as i32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::{Purpose, Stream};

    fn space() -> Space {
        Space::repeating([Vec3::new(-0.3, 1.0, -7.0), Vec3::new(0.7, 1.1, -2.5)], [true, false, true])
    }

    /// Whole periods away from a point inside it comes back, with their numbers, to the rounding of the largest coordinate on
    /// the way (a few hundred meters: 1e-13 m); along an open axis nothing changes.
    #[test]
    fn grains_come_home_with_the_number_of_their_image() {
        let space = space();
        let mut stream = Stream::new(4, Purpose::Sampling, 0);
        for k in 0..2000 {
            let mut along = |from: f64, edge: f64| from + edge * (0.01 + 0.98 * stream.uniform());
            let point = Vec3::new(along(-0.3, 1.0), along(-9.0, 20.0), along(-7.0, 4.5));
            assert_eq!(space.home(point), (point, [0; 3]));
            let image = [k % 7 - 3, 0, k % 101 - 50];
            let [x, y, z] = image.map(f64::from);
            let (home, found) = space.home(point + Vec3::new(x, 4.0 * y, 4.5 * z));
            assert_eq!(found, image);
            assert_near_vector!(home, point, 2e-13, "m");
            assert_eq!(home.y, point.y);
        }
        assert_eq!(space.home(Vec3::new(0.7, 0.0, -2.5)), (Vec3::new(-0.3, 0.0, -7.0), [1, 0, 1]));
        let below = Vec3::new((-0.3_f64).next_down(), 0.0, -7.0);
        // It is less than a rounding away from the lower face, and a whole period from the upper one.
        assert_eq!(space.home(below), (Vec3::new(-0.3, 0.0, -7.0), [0; 3]));
        assert_nan!(space.home(Vec3::new(f64::NAN, 0.0, -3.0)).0.x);
    }

    /// Against the shortest of all images within four periods, to the rounding of some meters.
    #[test]
    fn shortest_of_many_images() {
        let space = space();
        let mut stream = Stream::new(5, Purpose::Sampling, 0);
        for _ in 0..2000 {
            let between = stream.direction() * 8.0 * stream.uniform();
            let mut least = f64::INFINITY;
            for k in 0..19 * 9 {
                let [x, z] = [k % 19 - 9, k / 19 - 4].map(f64::from);
                least = least.min((between + Vec3::new(x, 0.0, 4.5 * z)).norm());
            }
            assert_near!(space.shortest(between).norm(), least, 1e-14, "m");
            assert_eq!(space.shortest(-between), -space.shortest(between));
        }
        let any = Vec3::new(3.0, -4.0, 5.0);
        assert_eq!(Space::OPEN.shortest(any), any);
        assert_eq!(Space::OPEN.home(any), (any, [0; 3]));
    }
}
