//! Each hard sphere's nearest neighbor, by the distance of the centers.

use crate::domain::{Boundary, Volume, extent_of_places};
use crate::engine::hard::spheres::Spheres;
use crate::math::Vec3;

use super::contact::Contact;
use super::near::Near;

/// A neighbor.
#[derive(Clone, Copy, Debug)]
struct Neighbor {
    /// Square of the distance of the centers [m²].
    distance_squared: f64,
    index: u32,
    shift: Vec3,
}

const NOBODY: Neighbor = Neighbor { distance_squared: f64::INFINITY, index: u32::MAX, shift: Vec3::ZERO };

/// The nearest neighbors of all.
#[derive(Clone, Debug, Default)]
pub(in crate::engine::hard) struct Nearest {
    of: Vec<Neighbor>,
    contacts: Vec<Contact>,
}

impl Nearest {
    /// Finds everybody's nearest neighbor; of several at the same distance the one that comes first in space.
    pub fn find(&mut self, spheres: &Spheres, near: &Near, volume: &Volume) {
        self.of.clear();
        self.of.resize(spheres.slots(), NOBODY);
        for contact in near.contacts() {
            let [a, b] = contact.spheres;
            self.offer(spheres, a, b, contact.shift);
            self.offer(spheres, b, a, Vec3::ZERO - contact.shift);
        }
        let radius = |at: u32| spheres.motion[at as usize].radius;
        let smallest = spheres.living().map(radius).fold(f64::INFINITY, f64::min);
        let farthest = farthest(spheres, volume);
        for at in spheres.living() {
            // Whoever is not in the list is at least this far away.
            let mut seen = near.slack() + radius(at) + smallest;
            loop {
                let best = self.of[at as usize].distance_squared.sqrt();
                if best <= seen || seen > farthest {
                    break;
                }
                // Somebody may be nearer than the best of the list; or nobody was in it.
                let is_last = best.is_finite();
                seen = if is_last { best } else { (2.0 * seen).max(near.spacing()) };
                near.visit(spheres, spheres.motion[at as usize].position, seen, &mut |other, shift| {
                    if other != at {
                        self.offer(spheres, at, other, shift);
                    }
                });
                if is_last {
                    break;
                }
            }
        }
        self.gather();
    }

    fn offer(&mut self, spheres: &Spheres, at: u32, index: u32, shift: Vec3) {
        let position = |at: u32| spheres.motion[at as usize].position;
        let distance_squared = ((position(index) - position(at)) + shift).norm_squared();
        let best = &mut self.of[at as usize];
        let is_nearer = distance_squared < best.distance_squared
            || (distance_squared == best.distance_squared
                && distance_squared.is_finite()
                && position(index).total_cmp(&position(best.index)).is_lt());
        if is_nearer {
            *best = Neighbor { distance_squared, index, shift };
        }
    }

    /// Writes each pair down once, though both may be nearest to one another.
    fn gather(&mut self) {
        self.contacts.clear();
        for (neighbor, at) in self.of.iter().zip(0..) {
            if neighbor.index == u32::MAX {
                continue;
            }
            let back = &self.of[neighbor.index as usize];
            let is_mutual = back.index == at && back.distance_squared == neighbor.distance_squared;
            if !is_mutual || at < neighbor.index {
                self.contacts.push(Contact { spheres: [at, neighbor.index], shift: neighbor.shift });
            }
        }
    }

    /// All pairs of a sphere and its nearest neighbor.
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }
}

/// No two spheres, or images where there are such, are farther apart than this [m].
fn farthest(spheres: &Spheres, volume: &Volume) -> f64 {
    let edges = volume.edges();
    if volume.boundary == Boundary::Periodic {
        return edges.norm();
    }
    let positions = spheres.living().map(|at| spheres.motion[at as usize].position);
    extent_of_places(positions).map_or(0.0, |(lower, upper)| (upper - lower).norm())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::hard::test_systems::{Grain, particles};
    use crate::math::rng::{Purpose, Stream};
    use crate::units::Quantity;

    /// More spheres than are all near one another, and one far away from all others, whichever stands where in memory.
    #[test]
    fn the_nearest_of_a_loner_is_found() {
        for (loner, way) in [(0, 900.0), (37, -900.0), (99, 900.0)] {
            let mut stream = Stream::new(7, Purpose::Sampling, 0);
            let mut grain = |id: usize| -> Grain {
                let mut position = stream.direction() * (20.0 * stream.uniform());
                position.y += if id == loner { way } else { 0.0 };
                (position.to_array(), [0.0; 3], 0.1)
            };
            let grains: Vec<Grain> = (0..100).map(&mut grain).collect();
            let spheres = Spheres::new(&particles(&grains), |_| 1.0);
            let volume = Volume {
                lower: [Quantity(-20.0); 3],
                upper: [Quantity(20.0); 3],
                boundary: Boundary::Open,
                faces: None,
                deformation: None,
            };
            let (mut near, mut nearest) = (Near::new(0.1), Nearest::default());
            near.list(&spheres, &volume, 0.0);
            nearest.find(&spheres, &near, &volume);
            let position = |at: u32| spheres.motion[at as usize].position;
            let by_hand = |at: u32| {
                let others = (0..100).filter(|other| *other != at);
                others.map(|other| (position(other) - position(at)).norm()).fold(f64::INFINITY, f64::min)
            };
            for at in 0..100 {
                let of_it = nearest.contacts().iter().filter(|contact| contact.spheres.contains(&at));
                let distance = |contact: &Contact| {
                    let [a, b] = contact.spheres;
                    (position(b) - position(a)).norm()
                };
                let found = of_it.map(distance).fold(f64::INFINITY, f64::min);
                assert_close!(found, by_hand(at), 1e-14, "in m, from sphere {at}, {loner} far away");
            }
        }
    }
}
