//! Pockets of a heap of spheres: places where one more sphere would touch three that are there.

use crate::math::Vec3;
use crate::neighbors::{CellIndex, Chained};

/// Part of the distance of two centers by which spheres may overlap: touching ones do, or do not, by round-off.
const ROUND_OFF: f64 = 1e-9;

/// A sphere that is there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ball {
    /// Center [m].
    pub center: Vec3,
    /// Radius [m].
    pub radius: f64,
}

impl Ball {
    /// Whether a sphere overlaps it.
    fn overlaps(&self, center: Vec3, radius: f64) -> bool {
        let least = (radius + self.radius) * (1.0 - ROUND_OFF);
        (center - self.center).norm_squared() < least * least
    }
}

/// One side of three spheres, with the places of the smallest and the largest sphere that are still to come.
#[derive(Clone, Copy, Debug)]
struct Pocket {
    balls: [Ball; 3],
    side: f64,
    places: [Option<Vec3>; 2],
}

/// Where the center of a sphere of `radius` [m] is that touches three, on one of the two sides of their plane; none where
/// they are too far apart, or in one line.
fn touching_three(balls: &[Ball; 3], side: f64, radius: f64) -> Option<Vec3> {
    let [a, b, c] = balls;
    let (to_b, to_c) = (b.center - a.center, c.center - a.center);
    let apart = to_b.norm();
    let along = to_b / apart;
    let forward = to_c.dot(along);
    let aside = to_c - along * forward;
    let sideways = aside.norm();
    if sideways < 1e-6 * apart {
        return None;
    }
    let across = aside / sideways;
    let [from_a, from_b, from_c] = balls.map(|ball| (ball.radius + radius).powi(2));
    let x = (from_a - from_b + apart * apart) / (2.0 * apart);
    let y =
        (from_a - from_c + forward * forward + sideways * sideways - 2.0 * forward * x) / (2.0 * sideways);
    let height_squared = from_a - x * x - y * y;
    (height_squared >= 0.0)
        .then(|| a.center + along * x + across * y + along.cross(across) * (side * height_squared.sqrt()))
}

/// A heap of spheres with all its pockets.
pub(super) struct Heap {
    balls: Vec<Ball>,
    cells: CellIndex<Chained>,
    pockets: Vec<Pocket>,
    /// Smallest and largest radius [m] of all spheres, those to come included.
    sizes: [f64; 2],
}

impl Heap {
    /// Room for spheres of these radii [n] [m], most of them within `reach` [m] of the origin.
    pub fn new(radii: &[f64], reach: f64) -> Self {
        let smallest = radii.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = radii.iter().copied().fold(0.0, f64::max);
        let corner = Vec3::new(reach, reach, reach);
        let cells = CellIndex::empty([-corner, corner], [false; 3], 2.0 * largest, radii.iter().copied());
        Self { balls: Vec::new(), cells, pockets: Vec::new(), sizes: [smallest, largest] }
    }

    /// The spheres, in the order in which they came.
    pub fn balls(&self) -> &[Ball] {
        &self.balls
    }

    /// Puts a sphere there, fills pockets with it and opens new ones.
    pub fn add(&mut self, ball: Ball) {
        let sizes = self.sizes;
        self.pockets.retain_mut(|pocket| {
            for (place, size) in pocket.places.iter_mut().zip(sizes) {
                *place = place.filter(|&center| !ball.overlaps(center, size));
            }
            pocket.places.iter().any(Option::is_some)
        });
        let bridged = |a: &Ball, b: &Ball| a.radius + b.radius + 2.0 * sizes[1];
        let mut near: Vec<Ball> = Vec::new();
        self.cells.all_near(
            ball.center,
            |largest| ball.radius + largest + 2.0 * sizes[1],
            |_| (),
            |(), center, radius| {
                let other = Ball { center, radius };
                if (center - ball.center).norm() < bridged(&ball, &other) {
                    near.push(other);
                }
                true
            },
        );
        self.cells.insert(ball.center, ball.radius);
        self.balls.push(ball);
        for (at, one) in near.iter().enumerate() {
            let others = near[..at].iter();
            for other in others.filter(|other| (one.center - other.center).norm() < bridged(one, other)) {
                self.open([ball, *one, *other]);
            }
        }
    }

    /// Opens the pockets on both sides of three spheres, where there is room in them.
    fn open(&mut self, balls: [Ball; 3]) {
        for side in [-1.0, 1.0] {
            let places = self
                .sizes
                .map(|size| touching_three(&balls, side, size).filter(|&center| self.is_free(center, size)));
            if places.iter().any(Option::is_some) {
                self.pockets.push(Pocket { balls, side, places });
            }
        }
    }

    /// Whether a sphere there would overlap none.
    fn is_free(&self, center: Vec3, radius: f64) -> bool {
        self.cells.all_near(
            center,
            |largest| radius + largest,
            |_| (),
            |(), other, other_radius| !Ball { center: other, radius: other_radius }.overlaps(center, radius),
        )
    }

    /// The free place [m] for a sphere of `radius` [m] that is nearest to `target` [m], of those at which the sphere lies wholly
    /// within `limit` [m] of the origin.
    pub fn nearest_place(&self, radius: f64, target: Vec3, limit: f64) -> Option<Vec3> {
        let mut best: Option<(f64, Vec3)> = None;
        for pocket in &self.pockets {
            let known = self.sizes.iter().position(|&size| size == radius);
            let place = match known {
                Some(at) => pocket.places[at],
                None => touching_three(&pocket.balls, pocket.side, radius),
            };
            let Some(place) = place else { continue };
            let away = (place - target).norm_squared();
            let is_better = best.is_none_or(|(least, _)| away < least) && place.norm() + radius <= limit;
            if is_better && (known.is_some() || self.is_free(place, radius)) {
                best = Some((away, place));
            }
        }
        best.map(|(_, place)| place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The fourth of four touching unit spheres: centers are the corners of a regular tetrahedron of edge 2, of height
    /// 2 √(2/3).
    #[test]
    fn the_pocket_of_three_equal_spheres_is_the_tip_of_a_tetrahedron() {
        let corner = |x: f64, y: f64| Ball { center: Vec3::new(x, y, 0.0), radius: 1.0 };
        let balls = [corner(0.0, 0.0), corner(2.0, 0.0), corner(1.0, 3.0_f64.sqrt())];
        for side in [-1.0, 1.0] {
            let found = touching_three(&balls, side, 1.0).unwrap();
            let wanted = Vec3::new(1.0, 1.0 / 3.0_f64.sqrt(), side * (8.0_f64 / 3.0).sqrt());
            assert_close_vector!(found, wanted, 1e-14);
        }
        assert_eq!(touching_three(&balls, 1.0, 0.15), None, "a sphere that falls through the hole of 0.1547");
    }

    /// Three unlike spheres: distances to all are the sums of the radii.
    #[test]
    fn the_pocket_of_unlike_spheres_touches_all() {
        let ball = |x, y, z, radius| Ball { center: Vec3::new(x, y, z), radius };
        let balls = [ball(0.1, -0.2, 0.0, 1.0), ball(2.4, 0.3, 0.5, 0.7), ball(0.9, 1.9, -0.4, 1.3)];
        let place = touching_three(&balls, 1.0, 0.8).unwrap();
        for ball in balls {
            assert_close!((place - ball.center).norm(), ball.radius + 0.8, 1e-13);
        }
    }

    /// Three in one line have no pocket, rather than one at a place that is no number.
    #[test]
    fn three_in_a_line_have_no_pocket() {
        let balls = [0.0, 2.0, 4.0].map(|x| Ball { center: Vec3::new(x, 0.0, 0.0), radius: 1.0 });
        assert_eq!(touching_three(&balls, 1.0, 5.0), None);
    }
}
