//! Pairs of hard spheres that are near one another, kept for as many steps as they can be.
//!
//! The list holds every pair whose surfaces are closer than its slack. Each step uses up what two spheres can come
//! nearer to one another in it; the list is made anew when the slack is gone, or when spheres merged, broke or were
//! put elsewhere. Which pairs it holds beyond the slack depends on its age; so nothing may depend on those.

use crate::domain::{Boundary, Volume};
use crate::engine::hard::spheres::Spheres;
use crate::math::Vec3;
use crate::neighbors::{CellIndex, Sorted, Span};

use super::contact::{Contact, Surroundings};

/// The longest reach, in mean distances of spheres.
const LONGEST_REACH: f64 = 4.0;
/// Up to so many spheres without images are all near one another.
const FEW: usize = 64;
/// More newcomers than this are sorted into the cells.
const NEWCOMERS: usize = 32;
/// A slack shorter than this part of the reach counts as none, for the rounding of positions.
const ROUNDING: f64 = 1e-9;

/// Two spheres and the number of the second one's image, as they were when the list was made.
#[derive(Clone, Copy, Debug)]
struct Pair {
    spheres: [u32; 2],
    image: [i8; 3],
}

/// Who is near whom.
#[derive(Clone, Debug, Default)]
pub(in crate::engine::hard) struct Near {
    cells: CellIndex<Sorted>,
    pairs: Vec<Pair>,
    /// How often each sphere crossed faces since the cells were filled [slots].
    crossings: Vec<[i32; 3]>,
    /// Spheres that are not where the cells say, or not at all there.
    newcomers: Vec<u32>,
    is_newcomer: Vec<bool>,
    edges: Vec3,
    periodic: bool,
    /// The shortest reach, in mean distances.
    least_reach: f64,
    reach: f64,
    slack: f64,
    drift: f64,
    spacing: f64,
    valid: bool,
}

impl Near {
    /// Nothing is known yet; lists will reach `least_reach` mean distances of spheres at the least. That is a matter of
    /// speed alone.
    pub fn new(least_reach: f64) -> Self {
        Self { least_reach, ..Self::default() }
    }

    /// Makes the list anew with every pair whose surfaces are closer than `reach` [m], as far as that is allowed.
    pub fn list(&mut self, spheres: &Spheres, volume: &Volume, reach: f64) {
        self.spacing = (volume.volume() / spheres.len().max(1) as f64).cbrt();
        self.edges = volume.edges();
        self.periodic = volume.boundary == Boundary::Periodic;
        self.reach = if !self.periodic && spheres.len() <= FEW {
            f64::INFINITY
        } else {
            reach.max(self.least_reach * self.spacing).min(self.longest_reach())
        };
        self.fill(spheres, volume);
        self.pairs.clear();
        let (pairs, reach) = (&mut self.pairs, self.reach);
        for at in spheres.living() {
            let one = &spheres.motion[at as usize];
            self.cells.visit_partners(at, one.position, one.radius + reach, &mut |other, image| {
                let two = &spheres.motion[other as usize];
                let shift = shift_of(image.map(i32::from), self.edges);
                let within = one.radius + two.radius + reach;
                if ((two.position - one.position) + shift).norm_squared() <= within * within {
                    pairs.push(Pair { spheres: [at, other], image });
                }
            });
        }
        self.slack = self.reach;
        self.valid = true;
    }

    fn fill(&mut self, spheres: &Spheres, volume: &Volume) {
        self.cells.fill(spheres, &span(volume), self.reach);
        self.crossings.clear();
        self.crossings.resize(spheres.slots(), [0; 3]);
        self.newcomers.clear();
        self.is_newcomer.clear();
        self.is_newcomer.resize(spheres.slots(), false);
        self.drift = 0.0;
    }

    /// The longest reach [m] that a list may have: it depends on the spheres as they are, not on the list's past.
    fn longest_reach(&self) -> f64 {
        let reach = LONGEST_REACH * self.spacing;
        if self.periodic { self.edges.to_array().into_iter().fold(reach, f64::min) } else { reach }
    }

    /// Makes a list that has reached its end anew, with the reach it had.
    pub fn refresh(&mut self, spheres: &Spheres, volume: &Volume) {
        if !self.is_valid() {
            // It becomes shorter by and by, in case that it was long for once.
            self.list(spheres, volume, 0.95 * self.reach);
        }
    }

    fn is_valid(&self) -> bool {
        self.valid && self.slack >= ROUNDING * self.reach && self.drift <= 2.0 * self.spacing
    }

    /// Makes the list anew with more slack, unless it has all that is allowed.
    pub fn widen(&mut self, spheres: &Spheres, volume: &Volume) -> bool {
        let can = self.slack < self.longest_reach();
        if can {
            // An old list gets its slack back first.
            self.list(
                spheres,
                volume,
                if self.slack < 0.5 * self.reach { self.reach } else { 2.0 * self.reach },
            );
        }
        can
    }

    /// Every pair whose surfaces are closer than this [m] is in the list.
    pub fn slack(&self) -> f64 {
        self.slack
    }

    /// Mean distance of spheres [m].
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Takes note that spheres moved up to `drift` [m], two of them up to `closer` [m] toward one another.
    pub fn moved(&mut self, drift: f64, closer: f64) {
        self.drift += drift;
        self.slack -= closer;
    }

    /// Takes note that a sphere crossed faces.
    pub fn crossed(&mut self, at: u32, crossings: [i32; 3]) {
        if self.periodic {
            for (sum, more) in self.crossings[at as usize].iter_mut().zip(crossings) {
                *sum = sum.saturating_add(more);
            }
        } else {
            // Spheres of an antipodal volume come out among others than they left.
            self.valid = false;
        }
    }

    /// Takes note that a sphere is new, or elsewhere, or gone.
    pub fn changed(&mut self, at: u32, spheres: &Spheres, volume: &Volume) {
        self.valid = false;
        self.is_newcomer.resize(spheres.slots(), false);
        self.crossings.resize(spheres.slots(), [0; 3]);
        if !self.is_newcomer[at as usize] {
            self.is_newcomer[at as usize] = true;
            self.newcomers.push(at);
        }
        if self.newcomers.len() > NEWCOMERS {
            self.fill(spheres, volume);
        }
    }

    /// Pairs of the list as they are now.
    pub fn contacts(&self) -> impl Iterator<Item = Contact> + '_ {
        self.pairs.iter().map(|pair| Contact { spheres: pair.spheres, shift: self.shift(pair) })
    }

    #[inline]
    fn shift(&self, pair: &Pair) -> Vec3 {
        if !self.periodic {
            return Vec3::ZERO;
        }
        let [a, b] = pair.spheres.map(|at| self.crossings[at as usize]);
        shift_of([0, 1, 2].map(|k| i32::from(pair.image[k]) + b[k] - a[k]), self.edges)
    }

    /// Visits every sphere whose surface may be nearer to `center` than `reach` [m], with the shift of its image that
    /// is near; visits more.
    pub fn visit(&self, spheres: &Spheres, center: Vec3, reach: f64, visit: &mut dyn FnMut(u32, Vec3)) {
        self.cells.visit_all(center, reach + self.drift, &mut |at, image| {
            if spheres.bulk[at as usize].lives() && !self.is_newcomer[at as usize] {
                let crossings = self.crossings[at as usize];
                visit(at, shift_of([0, 1, 2].map(|k| i32::from(image[k]) + crossings[k]), self.edges));
            }
        });
        let images = if self.periodic { -2..=2 } else { 0..=0 };
        for &at in self.newcomers.iter().filter(|at| spheres.bulk[**at as usize].lives()) {
            let sphere = &spheres.motion[at as usize];
            let is_near = |axis: usize, k: i32| {
                let along = sphere.position[axis] + f64::from(k) * self.edges[axis] - center[axis];
                along.abs() <= (reach + sphere.radius) * (1.0 + ROUNDING)
            };
            for x in images.clone().filter(|k| is_near(0, *k)) {
                for y in images.clone().filter(|k| is_near(1, *k)) {
                    for z in images.clone().filter(|k| is_near(2, *k)) {
                        visit(at, shift_of([x, y, z], self.edges));
                    }
                }
            }
        }
    }
}

impl Surroundings for Near {
    fn visit_near(
        &self,
        spheres: &Spheres,
        center: Vec3,
        reach: f64,
        time: f64,
        visit: &mut dyn FnMut(u32, Vec3),
    ) {
        self.visit(spheres, center, reach, &mut |at, shift| {
            visit(at, spheres.motion[at as usize].at(time) + shift);
        });
    }
}

/// Where cells are laid. Searches for the nearest sphere reach any distance, so that narrow cells would not do.
fn span(volume: &Volume) -> Span {
    let corners = [volume.lower(), volume.upper()];
    if volume.boundary.wraps() { Span::Block(corners, volume.repeats()) } else { Span::Around }
}

/// What has to be added to a position to come to an image [m].
#[inline]
fn shift_of(image: [i32; 3], edges: Vec3) -> Vec3 {
    Vec3::new(f64::from(image[0]) * edges.x, f64::from(image[1]) * edges.y, f64::from(image[2]) * edges.z)
}

#[cfg(test)]
#[path = "near_tests.rs"]
mod tests;
