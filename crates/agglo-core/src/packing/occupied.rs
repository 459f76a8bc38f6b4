//! Which space is taken: spheres in cell grids, one grid per size class.
//!
//! Size classes differ by a factor of two, so that a search costs about the same for any spread of sizes. Where space
//! repeats itself, a place near a face is looked up once more on the opposite side.

use crate::math::Vec3;

/// End of a chain of spheres in a cell.
const NONE: u32 = u32::MAX;
/// Sizes below 2^-15 of the largest share the last class.
const CLASSES: usize = 16;

/// Spheres that must not be overlapped, with a least distance `gap` [m] between surfaces.
pub(super) struct Occupied {
    bounds: (Vec3, Vec3),
    /// Whether space repeats itself beyond the bounds.
    repeats: bool,
    gap: f64,
    largest: f64,
    classes: Vec<Class>,
}

/// Spheres of nearly one size in a grid of cells.
struct Class {
    lower: Vec3,
    per_length: f64,
    cells: [usize; 3],
    largest: f64,
    first: Vec<u32>,
    spheres: Vec<Sphere>,
}

struct Sphere {
    center: Vec3,
    radius: f64,
    next: u32,
}

impl Occupied {
    /// Empty space in the box `bounds` [m] that will take spheres of the given radii [m].
    ///
    /// If it `repeats` itself, the images of all spheres are kept clear of too; centers must then lie in the box, and
    /// no diameter may be above an edge.
    pub fn new(
        bounds: (Vec3, Vec3),
        repeats: bool,
        gap: f64,
        radii: impl Iterator<Item = f64> + Clone,
    ) -> Self {
        let largest = radii.clone().fold(0.0, f64::max);
        let mut found = Self { bounds, repeats, gap, largest, classes: Vec::new() };
        let mut counts = [0_usize; CLASSES];
        for radius in radii {
            counts[found.class_of(radius)] += 1;
        }
        let mut bound = largest;
        for count in counts {
            found.classes.push(Class::new(bounds, gap, bound, count));
            bound *= 0.5;
        }
        found
    }

    fn class_of(&self, radius: f64) -> usize {
        let (mut class, mut bound) = (0, 0.5 * self.largest);
        while class + 1 < CLASSES && radius < bound {
            class += 1;
            bound *= 0.5;
        }
        class
    }

    /// Takes the space of a sphere.
    pub fn insert(&mut self, center: Vec3, radius: f64) {
        let class = self.class_of(radius);
        self.classes[class].insert(center, radius);
    }

    /// Whether a sphere here would keep its distance from all others.
    pub fn is_free(&self, center: Vec3, radius: f64) -> bool {
        let keeps_away = |between: Vec3, other: f64| {
            let least = radius + other + self.gap;
            between.norm_squared() >= least * least
        };
        self.classes.iter().all(|class| {
            class.spheres.is_empty()
                || self.all_near(class, center, radius + class.largest + self.gap, keeps_away)
        })
    }

    /// Whether no sphere of `radius` has room with its center anywhere in the cube about `middle` [m].
    pub fn covers(&self, middle: Vec3, half_edge: f64, radius: f64) -> bool {
        let leaves_some = |between: Vec3, other: f64| {
            let least = radius + other + self.gap;
            let [x, y, z] = between.to_array().map(|along| along.abs() + half_edge);
            x * x + y * y + z * z >= least * least
        };
        self.classes.iter().any(|class| {
            // A sphere that covers the cube reaches at least half an edge past its middle.
            let reach = (radius + class.largest + self.gap - half_edge).max(0.0);
            !class.spheres.is_empty() && !self.all_near(class, middle, reach, leaves_some)
        })
    }

    /// Whether the predicate holds for every sphere of a class within `reach` of `center`, images included; it is
    /// asked with the vector from the sphere and its radius.
    fn all_near(
        &self,
        class: &Class,
        center: Vec3,
        reach: f64,
        holds: impl Fn(Vec3, f64) -> bool + Copy,
    ) -> bool {
        if !self.repeats {
            return class.all_near(center, reach, holds);
        }
        let (lower, upper) = self.bounds;
        // Seen from the opposite side, the center is a period farther on.
        let images = |axis: usize| {
            let (at, period) = (center[axis], upper[axis] - lower[axis]);
            let below = (at - reach < lower[axis]).then_some(at + period);
            let above = (at + reach > upper[axis]).then_some(at - period);
            [Some(at), below, above].into_iter().flatten()
        };
        images(2)
            .all(|z| images(1).all(|y| images(0).all(|x| class.all_near(Vec3::new(x, y, z), reach, holds))))
    }
}

impl Class {
    /// Cells as wide as the reach of two spheres, or wider where that would make far more cells than spheres.
    fn new((lower, upper): (Vec3, Vec3), gap: f64, largest: f64, count: usize) -> Self {
        let extent = upper - lower;
        let most = 4 * count + 64;
        let mut edge = 2.0 * largest + gap;
        let cells_at = |edge: f64| extent.to_array().map(|along| (along / edge).floor().max(1.0));
        while cells_at(edge).iter().product::<f64>() > most as f64 {
            edge *= 1.1;
        }
        let cells = cells_at(edge).map(|cells| cells as usize);
        let total = if count == 0 { 0 } else { cells.iter().product() };
        let per_length = 1.0 / edge;
        Self {
            lower,
            per_length,
            cells,
            largest,
            first: vec![NONE; total],
            spheres: Vec::with_capacity(count),
        }
    }

    /// Number of the cell along one axis; places outside count to the outermost cells.
    fn along(&self, axis: usize, coordinate: f64) -> usize {
        // A cast from a number below zero gives zero.
        (((coordinate - self.lower[axis]) * self.per_length) as usize).min(self.cells[axis] - 1)
    }

    fn insert(&mut self, center: Vec3, radius: f64) {
        let [i, j, k] = [0, 1, 2].map(|axis| self.along(axis, center[axis]));
        let cell = &mut self.first[i + self.cells[0] * (j + self.cells[1] * k)];
        self.spheres.push(Sphere { center, radius, next: *cell });
        *cell = (self.spheres.len() - 1) as u32;
    }

    /// Whether the predicate holds for every sphere in the cells within `reach` of `center`; it is asked with the
    /// vector from the sphere and its radius.
    fn all_near(&self, center: Vec3, reach: f64, holds: impl Fn(Vec3, f64) -> bool) -> bool {
        let low = [0, 1, 2].map(|axis| self.along(axis, center[axis] - reach));
        let high = [0, 1, 2].map(|axis| self.along(axis, center[axis] + reach));
        for k in low[2]..=high[2] {
            for j in low[1]..=high[1] {
                let row = self.cells[0] * (j + self.cells[1] * k);
                for &first in &self.first[row + low[0]..=row + high[0]] {
                    let mut at = first;
                    while at != NONE {
                        let sphere = &self.spheres[at as usize];
                        if !holds(center - sphere.center, sphere.radius) {
                            return false;
                        }
                        at = sphere.next;
                    }
                }
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::{Purpose, Stream};

    /// Against a comparison with every sphere, for radii over two decades and places outside the bounds too.
    #[test]
    fn agrees_with_brute_force() {
        let mut stream = Stream::new(9, Purpose::Sampling, 0);
        let bounds = (Vec3::new(-1.0, -1.0, -1.0), Vec3::new(1.0, 1.0, 1.0));
        let mut any = |scale: f64| {
            Vec3::new(stream.uniform() - 0.5, stream.uniform() - 0.5, stream.uniform() - 0.5) * scale
        };
        let spheres: Vec<(Vec3, f64)> =
            (0..400).map(|k| (any(2.4), 0.15 * 0.01_f64.powf(f64::from(k) / 400.0))).collect();
        let mut occupied = Occupied::new(bounds, false, 0.002, spheres.iter().map(|sphere| sphere.1));
        for &(center, radius) in &spheres {
            occupied.insert(center, radius);
        }
        let (mut free, mut covered) = (0, 0);
        for k in 0..20_000 {
            let (point, radius) = (any(2.2), 0.05 * f64::from(k % 7));
            let brute =
                spheres.iter().all(|&(center, other)| (center - point).norm() >= radius + other + 0.002);
            assert_eq!(occupied.is_free(point, radius), brute);
            free += usize::from(brute);
            if occupied.covers(point, 0.02, radius) {
                covered += 1;
                for corner in 0..8 {
                    let side = |bit: u32| if corner >> bit & 1 == 0 { -0.02 } else { 0.02 };
                    assert_false!(
                        occupied.is_free(point + Vec3::new(side(0), side(1), side(2)), radius),
                        "a corner about {point:?} of what is held to be covered"
                    );
                }
            }
        }
        assert!(free > 1000 && covered > 1000, "{free} {covered}");
    }

    /// Against a comparison with 27 images of every sphere, in boxes from one diameter to many diameters wide.
    #[test]
    fn images_agree_with_brute_force() {
        let mut stream = Stream::new(10, Purpose::Sampling, 0);
        for edges in [Vec3::new(1.0, 1.0, 1.0), Vec3::new(0.2, 0.31, 0.9), Vec3::new(4.0, 0.2, 0.5)] {
            let lower = Vec3::new(-0.7, 3.0, -0.1);
            let mut any = || {
                let [x, y, z] = edges.to_array().map(|edge| edge * stream.uniform());
                lower + Vec3::new(x, y, z)
            };
            let spheres: Vec<(Vec3, f64)> =
                (0..40).map(|k| (any(), 0.1 * 0.05_f64.powf(f64::from(k) / 40.0))).collect();
            let radii = spheres.iter().map(|sphere| sphere.1);
            let mut occupied = Occupied::new((lower, lower + edges), true, 0.002, radii);
            for &(center, radius) in &spheres {
                occupied.insert(center, radius);
            }
            let (mut free, mut covered) = (0, 0);
            for k in 0..5_000 {
                let (point, radius) = (any(), 0.05 * f64::from(k % 3));
                let brute = spheres.iter().all(|&(center, other)| {
                    (0..27).all(|image: i32| {
                        let [i, j, k] = [image % 3 - 1, image / 3 % 3 - 1, image / 9 - 1].map(f64::from);
                        let shift = Vec3::new(i * edges.x, j * edges.y, k * edges.z);
                        (center + shift - point).norm() >= radius + other + 0.002
                    })
                });
                assert_eq!(occupied.is_free(point, radius), brute);
                free += usize::from(brute);
                if occupied.covers(point, 0.01, radius) {
                    covered += 1;
                    for corner in 0..8 {
                        let side = |bit: u32| if corner >> bit & 1 == 0 { -0.01 } else { 0.01 };
                        assert_false!(
                            occupied.is_free(point + Vec3::new(side(0), side(1), side(2)), radius),
                            "a corner about {point:?} of what is held to be covered"
                        );
                    }
                }
            }
            assert!(free > 50 && covered > 50, "{free} {covered}");
        }
    }
}
