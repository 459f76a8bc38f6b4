//! Which space is taken: spheres by cell.

use crate::math::Vec3;
use crate::neighbors::{CellIndex, Chained};

/// Spheres that must not be overlapped, with a least distance `gap` [m] between surfaces.
pub(super) struct Occupied {
    cells: CellIndex<Chained>,
    edges: Vec3,
    gap: f64,
}

impl Occupied {
    /// Empty space in the box `bounds` [m] that will take spheres of the given radii [m].
    ///
    /// Along axes on which it `repeats` itself, the images of all spheres are kept clear of too; centers must then lie in the box,
    /// and no diameter may be above an edge.
    pub fn new(
        (lower, upper): (Vec3, Vec3),
        repeats: [bool; 3],
        gap: f64,
        radii: impl Iterator<Item = f64> + Clone,
    ) -> Self {
        let cells = CellIndex::empty([lower, upper], repeats, gap, radii);
        Self { cells, edges: upper - lower, gap }
    }

    /// Takes the space of a sphere.
    pub fn insert(&mut self, center: Vec3, radius: f64) {
        self.cells.insert(center, radius);
    }

    /// Whether a sphere here would keep its distance from all others.
    pub fn is_free(&self, center: Vec3, radius: f64) -> bool {
        let reach = |largest: f64| radius + largest + self.gap;
        let seen_from = |image| self.seen_from(image, center);
        self.cells.all_near(center, reach, seen_from, |seen, other, other_radius| {
            let least = radius + other_radius + self.gap;
            (seen - other).norm_squared() >= least * least
        })
    }

    /// Whether no sphere of `radius` has room with its center anywhere in the cube about `middle` [m].
    pub fn covers(&self, middle: Vec3, half_edge: f64, radius: f64) -> bool {
        // A sphere that covers the cube reaches at least half an edge past its middle.
        let reach = |largest: f64| (radius + largest + self.gap - half_edge).max(0.0);
        let seen_from = |image| self.seen_from(image, middle);
        let leaves_some = |seen: Vec3, other: Vec3, other_radius: f64| {
            let least = radius + other_radius + self.gap;
            let [x, y, z] = (seen - other).to_array().map(|along| along.abs() + half_edge);
            x * x + y * y + z * z >= least * least
        };
        !self.cells.all_near(middle, reach, seen_from, leaves_some)
    }

    /// A place [m] as an image sees it.
    #[inline]
    fn seen_from(&self, image: [i8; 3], place: Vec3) -> Vec3 {
        if image == [0; 3] {
            return place;
        }
        let along = |axis: usize| place[axis] - f64::from(image[axis]) * self.edges[axis];
        Vec3::new(along(0), along(1), along(2))
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
        let mut occupied = Occupied::new(bounds, [false; 3], 0.002, spheres.iter().map(|sphere| sphere.1));
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
            let mut occupied = Occupied::new((lower, lower + edges), [true; 3], 0.002, radii);
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
