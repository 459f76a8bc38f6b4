//! Hard spheres step by step, with steps that are as long as gaps allow.
//!
//! # Equation
//! ```text
//! Δt = f min over i, j of g/c,   g = |r_j - r_i| - b_i - b_j,   c = -(v_j - v_i)·n > 0           [B] 6.14
//! ```
//! as printed (`distance = "centers"`): |r_j - r_i|/|c|, of pairs that part too; n from i to j; held between
//! `shortest_step` and `longest_step`; then r_i ← r_i + v_i Δt, then the faces, then collisions.
//!
//! # Source
//! T. I. Zohdi, Proc. R. Soc. Lond. A 460, 3421 (2004), equations 6.14 and 6.21 and the staggering scheme of section 6.
//!
//! # Symbols
//! | symbol | name in code                     | unit | meaning                                                    |
//! |--------|----------------------------------|------|------------------------------------------------------------|
//! | f      | `fraction`                       | 1    | part of the shortest time of approach that a step takes    |
//! | Δt     | `dt`, `Clock::last_step`         | s    | length of the step                                         |
//! | g      | `distance` (`gap`)               | m    | way to go: the gap, or with `centers` the center distance  |
//! | c      | `closing` over the distance      | m/s  | speed of approach along the line of centers, below 0 for pairs that part |
//! | b      | `radius`                         | m    | radius                                                     |
//!
//! What happens in a step, in this order:
//! 1. The length. All pairs count, images included. Pairs are searched up to a reach that grows until no pair beyond
//!    it could be the first to touch: at the reach over the greatest relative speed. The reach ends at 4 mean distances
//!    of spheres (and at the shortest edge of a periodic volume); then that time bounds the step in place of the pairs
//!    beyond. So no pair is passed by unseen. Where walls reflect, a step also ends when the first sphere gets there.
//!    Where `shortest_step` would take a pair into one another by more than a tenth of its reach, the step is that much
//!    shorter: small fast spheres would fly through one another.
//! 2. Free flight, and the faces. A sphere bounces when its surface is at the wall. One that has left an antipodal volume
//!    is mirrored in its middle, r -> -r: from e beyond a face to e before the opposite one ([B], section 7). With `cooling.integration =
//!    "published"` all temperatures go one explicit step on ([B] 6.21); else cooling is exact and takes no steps.
//! 3. Collisions: every pair that touches and approaches. The pair that has been touching for the longest time comes
//!    first, by going back along the straight lines they flew on; of equals the one that comes first in space. After
//!    each collision its spheres, or what became of them, are searched anew for whom they touch. A pair that bounced and
//!    comes together again in the same step, being pushed by others, waits for the next step, and is counted in the
//!    warnings; merging and breaking begin afresh. None is lost: it still touches and approaches in the next step.
//!
//! # Valid when
//! The distance of two spheres in free flight is convex in time. So with `gap` and f up to 1 no pair touches before the
//! step ends, and what overlap there is comes from `shortest_step`: at most c times that. Positions and times of collisions
//! err in proportion to it. Steps are short when spheres are many; [`event_driven`](crate::engine::hard::EventDriven) has no such
//! error and is faster. A sphere that enters an antipodal volume on the other side may find its position taken; that pair
//! then counts as touching.
//!
//! # Compared with others
//! [B] prints the distance of the centers (`distance = "centers"`), with which spheres run into one another up to the
//! depth that a step is long, or pass by unseen; and each sphere's nearest neighbor only (`pairs = "nearest"`), with
//! which a sphere may run into its second nearest, and what a merged sphere touches waits for the next step. Neither
//! converges as f becomes small, unless `longest_step` becomes small too. With `nearest` the length looks at nearest
//! neighbors only, as printed.
//!
//! # In a scenario
//! ```toml
//! [engine.time_stepped]
//! fraction = 0.5
//! shortest_step = "10 ns"
//! longest_step = "1 ms"
//! distance = "gap"
//! pairs = "all"
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::engine::hard::{Distance, Pairs, TimeStepped};
//! let consistent = TimeStepped::default();
//! assert_eq!((consistent.distance, consistent.pairs), (Distance::Gap, Pairs::All));
//! // Two grains 1 mm apart that approach at 100 m/s: half the way takes 5 us.
//! let half_way: f64 = consistent.fraction * 1e-3 / 100.0;
//! assert!((half_way - 5e-6).abs() < 1e-18);
//! ```

use crate::domain::{Boundary, resolution};
use crate::engine::SimError;
use crate::engine::hard::collide::HardSystem;
use crate::engine::hard::search::{Approach, Near, Nearest};
use crate::engine::hard::spheres::{Sphere, Spheres};
use crate::engine::hard::types::{Distance, Pairs, TimeStepped};
use crate::math::{Vec3, rounding_of_sum};

use super::cascade::Cascade;
use super::clock::Clock;
use super::walls;

/// Steps between two looks at positions that doubles do not resolve.
const LOOK_EVERY: u64 = 100;

/// Speeds of all spheres.
#[derive(Clone, Copy, Debug)]
struct Speeds {
    /// The greatest [m/s].
    greatest: f64,
    /// No two differ by more [m/s].
    apart: f64,
    /// The smallest radius [m].
    smallest: f64,
}

/// Where the shortest step is too long for small spheres, they come into one another by this part of their reach.
const DEEPEST: f64 = 0.1;

/// Drives hard spheres step by step.
#[derive(Clone, Debug)]
pub struct Steps {
    options: TimeStepped,
    near: Near,
    nearest: Nearest,
    cascade: Cascade,
    /// Unless velocities changed.
    speeds: Option<Speeds>,
    /// Whether the nearest neighbors are those of the spheres as they are.
    nearest_is_known: bool,
}

impl Steps {
    /// Starts, or goes on: whatever it keeps from step to step only spares work.
    pub fn new(options: &TimeStepped) -> Self {
        Self {
            options: options.clone(),
            // Found by trial with a thousand spheres: nearest neighbors are farther away than the first to touch.
            near: Near::new(if options.pairs == Pairs::All { 0.2 } else { 0.6 }),
            nearest: Nearest::default(),
            cascade: Cascade::default(),
            speeds: None,
            nearest_is_known: false,
        }
    }

    /// Makes one step, which does not pass `end` [s].
    ///
    /// # Errors
    /// [`SimError`] where the motion is not finite or a sphere is wider than a periodic volume.
    pub fn step(&mut self, system: &mut HardSystem, clock: &mut Clock, end: f64) -> Result<(), SimError> {
        let speeds = match self.speeds {
            Some(speeds) => speeds,
            None => *self.speeds.insert(Speeds::of(system, clock.time)?),
        };
        if clock.step.is_multiple_of(LOOK_EVERY) {
            system.check_motions(clock.time)?;
        }
        let dt = self.length(system, speeds);
        // The clock goes on by a bit at least, and comes to the end exactly; what rounding has taken from it makes no step
        // of its own before the end.
        let reaches_end = clock.time + clock.lag + dt * (1.0 + 1e-9) >= end;
        let next = if reaches_end { end } else { (clock.time + dt).max(clock.time.next_up()) };
        let lag = clock.lag + if next == clock.time + dt { rounding_of_sum(clock.time, dt) } else { 0.0 };
        let dt = next - clock.time;
        self.fly(system, dt, next);
        if system.laws.cools_in_steps() {
            let slots = 0..system.state.spheres.slots();
            slots.for_each(|at| cool(system, at, next));
        }
        self.near.moved(speeds.greatest * dt, speeds.apart * dt);
        self.near.refresh(&system.state.spheres, &system.volume);
        self.collisions(system, next)?;
        if clock.step.is_multiple_of(LOOK_EVERY) {
            warn_of_positions(system, dt, end);
        }
        *clock = Clock { time: next, lag, step: clock.step + 1, last_step: dt };
        Ok(())
    }

    /// Length of the next step [s], [B] 6.14.
    fn length(&mut self, system: &HardSystem, speeds: Speeds) -> f64 {
        let (shortest, longest) = (self.options.shortest_step.si(), self.options.longest_step.si());
        let shortest_approach = match self.options.pairs {
            Pairs::All => self.shortest_of_all(system, speeds, longest / self.options.fraction),
            Pairs::Nearest => self.shortest_of_nearest(system),
        };
        let mut dt = self.options.fraction * shortest_approach;
        if system.volume.boundary == Boundary::Reflecting {
            dt = dt.min(walls::time_left(&system.state.spheres, &system.volume));
        }
        let consistent = self.options.pairs == Pairs::All && self.options.distance == Distance::Gap;
        let too_long = DEEPEST * 2.0 * speeds.smallest < speeds.apart * shortest;
        if dt < shortest && consistent && too_long {
            return self.length_for_small(system, speeds, dt).min(longest);
        }
        dt.max(shortest).min(longest)
    }

    /// Length [s] in place of `dt`, which is below the shortest step, where that would let small spheres through one another:
    /// as long as none comes deep into another, and none turns round at a wall on the way.
    fn length_for_small(&mut self, system: &HardSystem, speeds: Speeds, dt: f64) -> f64 {
        let (spheres, shortest) = (&system.state.spheres, self.options.shortest_step.si());
        while self.near.slack() < speeds.apart * shortest && self.near.widen(spheres, &system.volume) {}
        let times = self.near.contacts().map(|contact| Approach::of(spheres, &contact).time_to_sink(DEEPEST));
        let mut allowed = times.fold(self.near.slack() / speeds.apart, f64::min);
        if system.volume.boundary == Boundary::Reflecting {
            allowed = allowed.min(walls::time_left(spheres, &system.volume));
        }
        allowed.max(dt).min(shortest)
    }

    /// Shortest time of approach of all pairs [s], or of what may come from beyond the reach; `enough` is as good as
    /// anything longer.
    fn shortest_of_all(&mut self, system: &HardSystem, speeds: Speeds, enough: f64) -> f64 {
        let spheres = &system.state.spheres;
        self.near.refresh(spheres, &system.volume);
        loop {
            let times = self
                .near
                .contacts()
                .map(|contact| Approach::of(spheres, &contact).time_left(self.options.distance));
            let shortest = times.fold(f64::INFINITY, f64::min);
            let unseen = if speeds.apart > 0.0 { self.near.slack() / speeds.apart } else { f64::INFINITY };
            if shortest.min(enough) <= unseen || !self.near.widen(spheres, &system.volume) {
                return shortest.min(unseen);
            }
        }
    }

    fn shortest_of_nearest(&mut self, system: &HardSystem) -> f64 {
        let spheres = &system.state.spheres;
        // Without collisions since the last flight it is known already.
        if !self.nearest_is_known {
            self.near.refresh(spheres, &system.volume);
            self.nearest.find(spheres, &self.near, &system.volume);
        }
        let contacts = self.nearest.contacts().iter();
        let times = contacts.map(|contact| Approach::of(spheres, contact).time_left(self.options.distance));
        times.fold(f64::INFINITY, f64::min)
    }

    /// Moves all spheres on to `time`, `dt` later, and deals with the faces.
    fn fly(&mut self, system: &mut HardSystem, dt: f64, time: f64) {
        let (boundary, edges) = (system.volume.boundary, system.volume.edges());
        for at in 0..system.state.spheres.slots() {
            if !system.state.spheres.bulk[at].lives() {
                continue;
            }
            let motion = &mut system.state.spheres.motion[at];
            motion.position = motion.at(time);
            motion.time = time;
            let goes_on = match boundary {
                Boundary::Periodic => system.volume.wrap(motion.position),
                Boundary::Antipodal => system.volume.mirrored(motion.position, motion.velocity),
                Boundary::Reflecting | Boundary::Open | Boundary::Absorbing => motion.position,
            };
            if goes_on != motion.position {
                self.near.crossed(at as u32, crossings(motion.position - goes_on, edges));
                motion.position = goes_on;
            }
            if boundary == Boundary::Reflecting {
                walls::reflect(system, at, dt, time);
            }
        }
    }

    /// Lets all spheres collide that touch and approach.
    fn collisions(&mut self, system: &mut HardSystem, time: f64) -> Result<(), SimError> {
        self.cascade.open(system);
        let all = self.options.pairs == Pairs::All;
        if all {
            for contact in self.near.contacts() {
                self.cascade.offer(system, contact);
            }
        } else {
            self.nearest.find(&system.state.spheres, &self.near, &system.volume);
            for contact in self.nearest.contacts() {
                self.cascade.offer(system, *contact);
            }
        }
        let collisions = self.cascade.run(system, &mut self.near, time, all)?;
        self.nearest_is_known = collisions == 0;
        if collisions > 0 {
            self.speeds = None;
        }
        Ok(())
    }
}

/// Where spheres are too far out, or too slow for the steps, doubles do not move them.
fn warn_of_positions(system: &mut HardSystem, dt: f64, end: f64) {
    let spheres = &system.state.spheres;
    let motions = spheres.living().map(|at| {
        let Sphere { position, velocity, radius, .. } = spheres.motion[at as usize];
        (position, velocity, radius)
    });
    if let Some(warning) = resolution::warning(motions, dt, end) {
        system.state.warnings.add(warning);
    }
}

/// Takes a temperature one explicit step on, [B] 6.21. Where cooling is exact that is left to whoever asks for it.
fn cool(system: &mut HardSystem, at: usize, time: f64) {
    if system.state.spheres.bulk[at].lives() {
        system.bring_up(at, time);
    }
}

/// How often a sphere crossed faces, from the way that brought it back.
fn crossings(back: Vec3, edges: Vec3) -> [i32; 3] {
    [0, 1, 2].map(|axis| (back[axis] / edges[axis]).round() as i32)
}

impl Speeds {
    fn of(system: &HardSystem, time: f64) -> Result<Self, SimError> {
        let spheres: &Spheres = &system.state.spheres;
        let velocity = |at: u32| spheres.motion[at as usize].velocity;
        if let Some(at) = spheres.living().find(|at| !velocity(*at).norm_squared().is_finite()) {
            return Err(system.not_finite(at, time));
        }
        let first = spheres.living().next().map_or(Vec3::ZERO, velocity);
        let (low, high) = spheres
            .living()
            .map(velocity)
            .fold((first, first), |(low, high), velocity| (low.min(velocity), high.max(velocity)));
        // Walls turn velocities round within a step; there only their size counts.
        let middle =
            if system.volume.boundary == Boundary::Reflecting { Vec3::ZERO } else { (low + high) * 0.5 };
        let radius = |at: u32| spheres.motion[at as usize].radius;
        let smallest = spheres.living().map(radius).fold(f64::INFINITY, f64::min);
        let farthest = |from: Vec3| {
            let squares = spheres.living().map(|at| (velocity(at) - from).norm_squared());
            squares.fold(0.0, f64::max).sqrt() * (1.0 + 1e-12)
        };
        Ok(Self { greatest: farthest(Vec3::ZERO), apart: 2.0 * farthest(middle), smallest })
    }
}

#[cfg(test)]
#[path = "time_stepped_tests.rs"]
mod tests;
