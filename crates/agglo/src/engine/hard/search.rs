//! When two spheres meet, and whom a sphere meets next.
//!
//! # Equation
//! With d the distance of the centres, u the relative velocity and s the sum of the radii, b = d·u and c = d² - s²,
//! $$ t = \frac{c}{-b + \sqrt{b^2 - u^2 c}} \quad (b < 0,\; b^2 > u^2 c) $$          (E1)
//! the smaller root of |d + u t| = s, written so that nothing cancels. Spheres that overlap and approach meet at once;
//! those that overlap and part, or approach by no more than rounding, are let go.

#![allow(clippy::inline_always, reason = "together these are the innermost loop of the engine")]

use crate::math::Vec3;

use super::agenda::{Agenda, NONE};
use super::grid::Grid;
use super::level::Level;
use super::spheres::Sphere;

/// An approach slower than this part of the speeds is rounding.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The next impact of a sphere, as far as known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// When [s]; infinite for none.
    pub time: f64,
    /// With whom.
    pub partner: u32,
    /// Edges of the volume that are added to the partner's position.
    pub image: [i8; 3],
}

impl Meeting {
    /// No impact.
    pub const NEVER: Self = Self { time: f64::INFINITY, partner: NONE, image: [0; 3] };

    /// The one that an agenda says.
    pub fn known(agenda: &Agenda) -> Self {
        Self { time: agenda.collision, partner: agenda.partner, image: agenda.image }
    }
}

/// Time [s] from now until two spheres meet (E1); infinite if they do not. `distance` goes from the first to the second
/// [m], `velocity` is that of the second relative to the first [m/s], `reach` the sum of the radii [m]. Times that are
/// certain to be after `limit` [s] need not be worked out and are given as infinite.
#[inline(always)]
pub fn time_to_meet(distance: Vec3, velocity: Vec3, reach: f64, limit: f64) -> f64 {
    let approach = distance.dot(velocity);
    if approach >= 0.0 {
        return f64::INFINITY;
    }
    let gap = distance.norm_squared() - reach * reach;
    if gap <= 0.0 {
        return 0.0;
    }
    // The root of the discriminant is not larger than the approach.
    if gap > -2.0 * approach * limit * (1.0 + 1e-12) {
        return f64::INFINITY;
    }
    let discriminant = approach * approach - velocity.norm_squared() * gap;
    if discriminant <= 0.0 {
        return f64::INFINITY;
    }
    gap / (discriminant.sqrt() - approach)
}

/// A sphere does not look into more cells than this for smaller ones, if it need not.
const MOST_CELLS: u64 = 200;

/// Whether two spheres that touch approach no faster than velocities are rounded: they stay together. Impacts could not
/// part them, and would follow one another without end.
fn is_rounding(distance: Vec3, relative: Vec3, velocities: [Vec3; 2]) -> bool {
    let speed = velocities[0].norm() + velocities[1].norm();
    -distance.dot(relative) <= ROUNDING * speed * distance.norm()
}

/// A sphere that may be met, and the edges that are added to its position.
pub type Candidate = (u32, [i8; 3]);

/// A sphere that looks for its next impact.
pub struct Seeker<'a> {
    /// Motions of all.
    motion: &'a [Sphere],
    /// Agendas of all.
    agendas: &'a [Agenda],
    /// The cells.
    grid: &'a Grid,
    /// Its number.
    sphere: u32,
    /// The time [s].
    now: f64,
    best: Meeting,
}

impl<'a> Seeker<'a> {
    /// A sphere at `now` [s] that knows of the meeting `best`.
    #[inline]
    pub fn new(
        motion: &'a [Sphere],
        agendas: &'a [Agenda],
        grid: &'a Grid,
        sphere: u32,
        now: f64,
        best: Meeting,
    ) -> Self {
        Self { motion, agendas, grid, sphere, now, best }
    }

    /// Works out when each candidate would be met. One is passed over where it has an impact before the two would meet:
    /// it will look again after that.
    ///
    /// Candidates are gathered before any is looked at, so that they come from memory side by side.
    #[inline(always)]
    fn consider(&mut self, candidates: &mut Vec<Candidate>) {
        let own = &self.motion[self.sphere as usize];
        let (place, velocity) = (own.at(self.now), own.velocity);
        for (other, image) in candidates.drain(..) {
            let sphere = &self.motion[other as usize];
            let mut distance = sphere.at(self.now) - place;
            if image != [0; 3] {
                distance += self.grid.shift(image);
            }
            let relative = sphere.velocity - velocity;
            let limit = self.best.time - self.now;
            let wait = time_to_meet(distance, relative, own.radius + sphere.radius, limit);
            if wait == 0.0 && is_rounding(distance, relative, [velocity, sphere.velocity]) {
                continue;
            }
            let time = self.now + wait;
            if time > self.best.time || wait == f64::INFINITY || other == self.sphere {
                continue;
            }
            if time == self.best.time && other >= self.best.partner {
                continue;
            }
            let agenda = &self.agendas[other as usize];
            if time < agenda.collision || (time == agenda.collision && agenda.partner == NONE) {
                self.best = Meeting { time, partner: other, image };
            }
        }
    }

    /// The next impact, looking at everyone about. `scratch` is empty before and after.
    #[inline]
    pub fn look_around(mut self, scratch: &mut Vec<Candidate>) -> Meeting {
        let agenda = &self.agendas[self.sphere as usize];
        self.grid.visit_around(agenda, |other, image| scratch.push((other, image)));
        self.consider(scratch);
        self.look_at_smaller(scratch);
        self.best
    }

    /// The next impact, looking only at those who came into view through a cell's face.
    #[inline]
    pub fn look_ahead(mut self, scratch: &mut Vec<Candidate>) -> Meeting {
        let agenda = &self.agendas[self.sphere as usize];
        self.grid.visit_ahead(agenda, agenda.exit, |other, image| scratch.push((other, image)));
        self.consider(scratch);
        self.look_at_smaller(scratch);
        self.best
    }

    /// Looks at spheres of finer levels, near the surface first and further out only as long as an impact there could
    /// come before the one known, or before the sphere leaves its cell and looks again. Where that would be too far,
    /// the sphere looks no further than it must for a while, and again after that.
    #[inline]
    fn look_at_smaller(&mut self, scratch: &mut Vec<Candidate>) {
        let finer = self.agendas[self.sphere as usize].level as usize + 1;
        if self.grid.levels().iter().skip(finer).any(|level| level.population > 0) {
            self.look_at_finer_levels(finer, scratch);
        }
    }

    fn look_at_finer_levels(&mut self, finer: usize, scratch: &mut Vec<Candidate>) {
        let grid = self.grid;
        let (own, crossing) =
            (&self.motion[self.sphere as usize], self.agendas[self.sphere as usize].crossing);
        let levels =
            || grid.levels().iter().enumerate().skip(finer).filter(|(_, level)| level.population > 0);
        let fastest = levels().map(|(_, level)| level.fastest).fold(0.0, f64::max);
        let finest = levels().map(|(_, level)| level.widest()).fold(f64::INFINITY, f64::min);
        let speed = own.velocity.norm() + fastest;
        if speed == 0.0 {
            return;
        }
        let place = own.at(self.now);
        // A little more than can be travelled, for rounding.
        let reach =
            |level: &Level, ahead: f64| (own.radius + 0.5 * level.widest() + speed * ahead) * (1.0 + 1e-9);
        let mut horizon = finest / speed;
        loop {
            let ahead = horizon.min((self.best.time.min(crossing) - self.now).max(0.0));
            for (number, level) in levels() {
                let reach = reach(level, ahead);
                grid.visit_within(number, place, reach, |other, image| scratch.push((other, image)));
                self.consider(scratch);
            }
            if self.best.time.min(crossing) - self.now <= horizon {
                return;
            }
            let next = 2.0 * horizon;
            let cells: u64 =
                levels().map(|(number, level)| grid.cells_within(number, place, reach(level, next))).sum();
            if cells > MOST_CELLS {
                self.best = Meeting { time: self.now + horizon, ..Meeting::NEVER };
                return;
            }
            horizon = next;
        }
    }
}

#[cfg(test)]
#[path = "search_tests.rs"]
mod tests;
