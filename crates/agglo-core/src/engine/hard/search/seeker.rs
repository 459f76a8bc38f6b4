//! When two spheres collide, and whom a sphere collides with next.
//!
//! # Equation
//! With d the distance of the centers, u the relative velocity and s the sum of the radii, b = d·u and c = d² - s²,
//! $$ t = \frac{c}{-b + \sqrt{u^2 s^2 - (d \times u)^2}} \quad (b < 0,\; u s > |d \times u|) $$          (E1)
//! the smaller root of |d + u t| = s, written so that nothing cancels: the textbook's b² - u² c is the same number, but
//! loses s² where the way is 1e8 times the radii. Spheres that overlap and approach collide at once; those that overlap and
//! part, or approach by no more than rounding, are let go.

#![allow(clippy::inline_always, reason = "together these are the innermost loop of the engine")]

use crate::engine::hard::spheres::{NONE, Sphere};
use crate::math::Vec3;

use super::grid::{Grid, Level};
use super::next_event::NextEvent;

/// An approach slower than this part of the speeds is rounding.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The next collision of a sphere, as far as known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NextCollision {
    /// When [s]; infinite for none.
    pub time: f64,
    /// With whom.
    pub partner: u32,
    /// Edges of the volume that are added to the partner's position.
    pub image: [i8; 3],
}

impl NextCollision {
    /// No collision.
    pub const NEVER: Self = Self { time: f64::INFINITY, partner: NONE, image: [0; 3] };

    /// The one that a next event says.
    pub fn known(next_event: &NextEvent) -> Self {
        Self { time: next_event.collision, partner: next_event.partner, image: next_event.image }
    }
}

/// Time [s] from now until two spheres collide (E1); infinite if they do not. `distance` goes from the first to the second
/// [m], `velocity` is that of the second relative to the first [m/s], `reach` the sum of the radii [m]. Times that are
/// certain to be after `limit` [s] need not be worked out and are given as infinite.
#[inline(always)]
pub fn time_to_collision(distance: Vec3, velocity: Vec3, reach: f64, limit: f64) -> f64 {
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
    let discriminant = velocity.norm_squared() * (reach * reach) - distance.cross(velocity).norm_squared();
    if discriminant <= 0.0 {
        return f64::INFINITY;
    }
    gap / (discriminant.sqrt() - approach)
}

/// A sphere does not look into more cells than this for smaller ones, if it need not.
const MOST_WORK: u64 = 400;
/// Its own radii that whoever is fastest comes nearer in the first look: the most, and what is looked at in any case.
const FIRST_LOOK: [f64; 2] = [4.0, 0.5];
/// Edges of the volume that such a look may span at the most.
const FARTHEST: f64 = 2.0;

/// Whether two spheres that touch approach no faster than velocities are rounded: they stay together. Collisions could not
/// part them, and would follow one another without end.
fn is_rounding(distance: Vec3, relative: Vec3, velocities: [Vec3; 2]) -> bool {
    let speed = velocities[0].norm() + velocities[1].norm();
    -distance.dot(relative) <= ROUNDING * speed * distance.norm()
}

/// A sphere to collide with, perhaps, and the edges that are added to its position.
pub type Candidate = (u32, [i8; 3]);

/// A sphere that looks for its next collision.
pub struct Seeker<'a> {
    /// Motions of all.
    motion: &'a [Sphere],
    /// Next events of all.
    next_events: &'a [NextEvent],
    /// The cells.
    grid: &'a Grid,
    /// Its number.
    sphere: u32,
    /// The time [s].
    now: f64,
    best: NextCollision,
}

impl<'a> Seeker<'a> {
    /// A sphere at `now` [s] that knows of the collision `best`.
    #[inline]
    pub fn new(
        motion: &'a [Sphere],
        next_events: &'a [NextEvent],
        grid: &'a Grid,
        sphere: u32,
        now: f64,
        best: NextCollision,
    ) -> Self {
        Self { motion, next_events, grid, sphere, now, best }
    }

    /// Works out when there would be a collision with each candidate. One is passed over where it has a collision before
    /// that: it will look again after it.
    ///
    /// Candidates are gathered before any is looked at, so that they come from memory side by side.
    #[inline(always)]
    fn consider(&mut self, candidates: &mut Vec<Candidate>) {
        let own = &self.motion[self.sphere as usize];
        let (position, velocity) = (own.at(self.now), own.velocity);
        for (other, image) in candidates.drain(..) {
            let sphere = &self.motion[other as usize];
            let mut distance = sphere.at(self.now) - position;
            if image != [0; 3] {
                distance += self.grid.shift(image);
            }
            let relative = sphere.velocity - velocity;
            let limit = self.best.time - self.now;
            let wait = time_to_collision(distance, relative, own.radius + sphere.radius, limit);
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
            let next_event = &self.next_events[other as usize];
            if time < next_event.collision || (time == next_event.collision && next_event.partner == NONE) {
                self.best = NextCollision { time, partner: other, image };
            }
        }
    }

    /// The next collision, looking at everyone about. `scratch` is empty before and after.
    #[inline]
    pub fn look_around(mut self, scratch: &mut Vec<Candidate>) -> NextCollision {
        let next_event = &self.next_events[self.sphere as usize];
        self.grid.visit_around(next_event, |other, image| scratch.push((other, image)));
        self.consider(scratch);
        self.look_at_smaller(scratch);
        self.best
    }

    /// The next collision, looking only at those who came into view through a cell's face.
    #[inline]
    pub fn look_ahead(mut self, scratch: &mut Vec<Candidate>) -> NextCollision {
        let next_event = &self.next_events[self.sphere as usize];
        self.grid.visit_ahead(next_event, next_event.exit, |other, image| scratch.push((other, image)));
        self.consider(scratch);
        self.look_at_smaller(scratch);
        self.best
    }

    /// Looks at spheres of finer levels, near the surface first and further out only as long as a collision there could
    /// come before the one known, or before the sphere leaves its cell and looks again. Where that would be too far,
    /// the sphere looks no further than it must for a while, and again after that.
    #[inline]
    fn look_at_smaller(&mut self, scratch: &mut Vec<Candidate>) {
        let finer = self.next_events[self.sphere as usize].level as usize + 1;
        if self.grid.populated(finer).next().is_some() {
            self.look_at_finer_levels(finer, scratch);
        }
    }

    fn look_at_finer_levels(&mut self, finer: usize, scratch: &mut Vec<Candidate>) {
        let grid = self.grid;
        let (own, crossing) =
            (&self.motion[self.sphere as usize], self.next_events[self.sphere as usize].crossing);
        let levels = || grid.populated(finer);
        let speed_of = |(_, level): (usize, &Level)| View::new(own, self.now, level).speed();
        let speed = levels().map(speed_of).fold(0.0, f64::max);
        if speed == 0.0 {
            return;
        }
        let farthest = FARTHEST * grid.shortest_edge() / speed;
        let [most, least] = FIRST_LOOK.map(|radii| (radii * own.radius / speed).min(farthest));
        let mut horizon = most;
        while horizon > least && self.work(finer, horizon) > MOST_WORK {
            horizon = (0.5 * horizon).max(least);
        }
        loop {
            let ahead = horizon.min((self.best.time.min(crossing) - self.now).max(0.0));
            for (number, level) in levels() {
                let block = View::new(own, self.now, level).block(ahead);
                self.gather(number, level, block, scratch);
                self.consider(scratch);
            }
            if self.best.time.min(crossing) - self.now <= horizon {
                return;
            }
            let next = 2.0 * horizon;
            if self.work(finer, next) > MOST_WORK || next > farthest {
                self.best = NextCollision { time: self.now + horizon, ..NextCollision::NEVER };
                return;
            }
            horizon = next;
        }
    }

    /// What looking ahead for a time [s] costs in all levels from the number `finer` on, in cells.
    fn work(&self, finer: usize, ahead: f64) -> u64 {
        let own = &self.motion[self.sphere as usize];
        let of = |(number, level): (usize, &Level)| {
            let block = View::new(own, self.now, level).block(ahead);
            self.grid.cells_within(number, self.in_cells(block)).min(work_of_all(level))
        };
        self.grid.populated(finer).map(of).sum()
    }

    /// A block [m] less what the cells have flown.
    fn in_cells(&self, block: [Vec3; 2]) -> [Vec3; 2] {
        let flown = self.grid.frame.flown(self.now);
        block.map(|corner| corner - flown)
    }

    /// Gathers the spheres of a level in a block between two corners [m]: from the cells there, or from all the spheres
    /// where they are fewer.
    fn gather(&self, number: usize, level: &Level, block: [Vec3; 2], scratch: &mut Vec<Candidate>) {
        let grid = self.grid;
        let in_cells = self.in_cells(block);
        if grid.cells_within(number, in_cells) <= work_of_all(level) {
            grid.visit_within(number, in_cells, |other, image| scratch.push((other, image)));
            return;
        }
        grid.visit_level(number, |other| {
            let position = self.motion[other as usize].at(self.now);
            let images = |axis: usize| grid.images(axis, position[axis], block.map(|corner| corner[axis]));
            let (x0, x1) = images(0);
            let (y0, y1) = images(1);
            let (z0, z1) = images(2);
            for z in z0..=z1 {
                for y in y0..=y1 {
                    (x0..=x1).for_each(|x| scratch.push((other, [x, y, z])));
                }
            }
        });
    }
}

/// What looking at all spheres of a level costs, in cells.
fn work_of_all(level: &Level) -> u64 {
    4 * u64::from(level.population) + level.words() as u64
}

/// Where spheres of a level are now if there can be a collision soon.
struct View {
    position: Vec3,
    /// Sum of the radii at the most [m].
    reach: f64,
    /// How fast they can come from below and from above along each axis [m/s].
    closing: [Vec3; 2],
}

impl View {
    #[inline]
    fn new(own: &Sphere, now: f64, level: &Level) -> Self {
        let [low, high] = level.velocities;
        let closing = [(high - own.velocity).max(Vec3::ZERO), (own.velocity - low).max(Vec3::ZERO)];
        Self { position: own.at(now), reach: own.radius + 0.5 * level.widest(), closing }
    }

    /// The fastest along any axis [m/s].
    #[inline]
    fn speed(&self) -> f64 {
        self.closing.iter().flat_map(|closing| closing.to_array()).fold(0.0, f64::max)
    }

    /// The block in which are all that can be collided with within a time [s], between two corners [m].
    #[inline]
    fn block(&self, ahead: f64) -> [Vec3; 2] {
        // A little more than can be traveled, for rounding.
        let side =
            |closing: Vec3| (Vec3::new(self.reach, self.reach, self.reach) + closing * ahead) * (1.0 + 1e-9);
        [self.position - side(self.closing[0]), self.position + side(self.closing[1])]
    }
}

#[cfg(test)]
#[path = "seeker_tests.rs"]
mod tests;
