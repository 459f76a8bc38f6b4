//! Hard spheres from event to event, each at its exact time.
//!
//! # Equation
//! ```text
//! |r_j - r_i + (v_j - v_i) t| = b_i + b_j                                                     E1
//! ```
//! Between events spheres fly straight: r(t) = r(t₀) + v (t - t₀). Events are collisions, at the smaller root t of this;
//! moves into the next cell; bounces off walls.
//!
//! # Source
//! One event per sphere: B. D. Lubachevsky, J. Comput. Phys. 94, 255 (1991). Bins of events: G. Paul, J. Comput. Phys.
//! 221, 615 (2007). Inelastic collapse: S. Luding and S. McNamara, Granular Matter 1, 113 (1998).
//!
//! # Rules
//! - Each sphere knows its earliest collision and who with. Where a third sphere comes first, the one left over looks again
//!   at the time at which it would have collided: nothing can happen to it before.
//! - Spheres that overlap (after a merge, or at an antipodal face) and approach collide at once; those that part are let go.
//!   A merged sphere that overlaps others collides with them at the same instant, one after the other, in the order of
//!   memory, which is that of space; each may merge in turn.
//! - Simultaneous events are taken in the order of ids.
//! - Inelastic collapse: a bounce is elastic if its pair bounced with one another four times before, each time less than
//!   `contact_duration` after the last. First bounces of one moment, sticking and breaking are not concerned. The summary
//!   has their count and the energy that they kept.
//! - The clock must go on: spheres without room, whose gaps are rounding, end the run with an error.
//! - Cells fly with the mean velocity of the spheres where the volume has no wall and no antipodal face.
//!
//! # Symbols
//! | symbol | name in code       | unit | meaning                                                  |
//! |--------|--------------------|------|----------------------------------------------------------|
//! | t_c    | `contact_duration` | s    | default: 1e-6 of the time in which a mean radius is flown; between walls at the mean speed, else at the mean relative to all |
//!
//! # Valid when
//! Flight is straight (no forces) and collisions are instantaneous. The order of events is exact to rounding. Where positions are
//! rounded to more than 1e-5 of a radius (4.5e10 radii from the origin, or as far flown) the run ends with an error.
//!
//! # Compared with others
//! No step, so no error of stepping and no collision missed, unlike overlap searches such as REBOUND's `direct` and `tree`.
//!
//! # In a scenario
//! ```toml
//! [engine.event_driven]
//! contact_duration = "0 s"
//! ```

use std::borrow::Cow;

use crate::domain::Boundary;
use crate::engine::SimError;
use crate::engine::hard::collide::{Change, HardSystem};
use crate::engine::hard::search::{Around, Candidate, Contact, Grid, NextCollision, NextEvent, Seeker};
use crate::engine::hard::spheres::{NONE, Spheres};
use crate::engine::hard::types::EventDriven;
use crate::math::Vec3;
use crate::neighbors::morton_code;

use super::clock::Clock;
use super::fetch::fetch;
use super::filed::{EventsState, Filed};
use super::queue::Queue;

/// Events between two looks at the clock.
const BATCH: u32 = 10_000;
/// Spheres are sorted in memory after this many events for each.
const EVENTS_PER_SORT: u64 = 50;
/// Part of the time in which a mean radius is flown that the default contact duration is.
const CONTACT: f64 = 1e-6;
/// Relative motion that is less than this part of all motion, by squares, is rounding.
const ONE_WAY: f64 = 1e-24;

/// Drives hard spheres from event to event.
#[derive(Clone, Debug)]
pub struct Events {
    upcoming: Vec<NextEvent>,
    grid: Grid,
    queue: Queue,
    filed: Filed,
    scratch: Vec<Candidate>,
}

impl EventDriven {
    /// The contact duration [s], given or worked out from the spheres at the start.
    pub(in crate::engine::hard) fn duration(&self, spheres: &Spheres, boundary: Boundary) -> f64 {
        if let Some(given) = self.contact_duration {
            return given.si();
        }
        let order = spheres.by_id();
        let n = order.len().max(1) as f64;
        let velocity = |at: u32| spheres.motion[at as usize].velocity;
        let mean = order.iter().fold(Vec3::ZERO, |sum, &at| sum + velocity(at)) / n;
        let square =
            |from: Vec3| order.iter().map(|&at| (velocity(at) - from).norm_squared()).sum::<f64>() / n;
        let radius = order.iter().map(|&at| spheres.motion[at as usize].radius).sum::<f64>() / n;
        // Spheres that all fly one way collide with nobody, but walls turn them round. What is left of equal velocities
        // is rounding.
        let all = square(Vec3::ZERO);
        let against = if boundary == Boundary::Reflecting { all } else { square(mean) };
        if against > ONE_WAY * all { CONTACT * radius / against.sqrt() } else { 0.0 }
    }
}

/// How fast cells fly [m/s]: with the mean of the spheres, unless they must lie at the faces of the volume. It is summed
/// in the order of memory, which does not depend on ids once spheres are sorted.
fn drift(system: &HardSystem) -> Vec3 {
    if matches!(system.volume.boundary, Boundary::Reflecting | Boundary::Antipodal) {
        return Vec3::ZERO;
    }
    let motion = &system.state.spheres.motion;
    motion.iter().fold(Vec3::ZERO, |sum, one| sum + one.velocity) / motion.len().max(1) as f64
}

impl Events {
    /// Starts at time zero.
    ///
    /// # Errors
    /// [`SimError`] where a sphere is too far out.
    pub fn start(system: &mut HardSystem) -> Result<Self, SimError> {
        let filed = Filed::default().renewed(&system.state.spheres);
        let mut events = Self::with(system, Vec::new(), filed);
        events.file_all(system, 0.0)?;
        Ok(events)
    }

    fn with(system: &HardSystem, upcoming: Vec<NextEvent>, filed: Filed) -> Self {
        let (grid, queue) = (filed.grid(&system.volume), Queue::default());
        Self { upcoming, grid, queue, filed, scratch: Vec::new() }
    }

    /// Goes on from what was remembered.
    pub fn resume(system: &HardSystem, state: EventsState<'_>) -> Self {
        let filed = state.filed;
        let mut events = Self::with(system, state.next_events.into_owned(), filed);
        events.grid.frame = state.frame;
        events.link_all(system);
        for (level, velocities) in (0..).zip(state.velocities) {
            events.grid.note_velocities(level, velocities);
        }
        events.queue_all(filed.moment);
        events
    }

    /// What has to be remembered.
    pub fn state(&self) -> EventsState<'_> {
        let velocities = self.grid.levels().iter().map(|level| level.velocities).collect();
        EventsState {
            next_events: Cow::Borrowed(&self.upcoming),
            filed: self.filed,
            frame: self.grid.frame,
            velocities,
        }
    }

    /// Deals with events until `until` [s], or with some thousand of them.
    ///
    /// # Errors
    /// [`SimError`] where the motion is not finite, the clock comes to a halt, or a sphere outgrows a periodic volume.
    pub fn advance(
        &mut self,
        system: &mut HardSystem,
        clock: &mut Clock,
        until: f64,
    ) -> Result<(), SimError> {
        for _ in 0..BATCH {
            let spheres = &system.state.spheres;
            let Some((time, sphere)) = self.queue.next(&mut self.upcoming, until, |soon, next_events, at| {
                fetch(soon, next_events, &self.grid, spheres, at);
            }) else {
                clock.time = until;
                break;
            };
            clock.time = time;
            clock.step += 1;
            self.deal_with(system, sphere, time)?;
            self.keep_order(system, time)?;
        }
        let collisions = system.state.counts.collisions.max(1);
        clock.last_step = clock.time / collisions as f64;
        Ok(())
    }

    /// Sorts spheres in memory, or makes a new grid, when it is due; and sees to it that time goes on.
    fn keep_order(&mut self, system: &mut HardSystem, time: f64) -> Result<(), SimError> {
        let living = system.state.spheres.len() as u64;
        self.filed.events += 1;
        self.filed.moment = time;
        self.filed.watch.look(system, self.grid.frame.drift, time)?;
        if 2 * living < self.filed.spheres || living > 2 * self.filed.spheres {
            self.file_anew(system, time)?;
        } else if self.filed.events > EVENTS_PER_SORT * living || self.grid.is_far(time) {
            let back = self.grid.take_back(&system.volume, time);
            if back != Vec3::ZERO {
                system.state.spheres.motion.iter_mut().for_each(|motion| motion.position += back);
            }
            self.sort(system);
            self.link_all(system);
            self.queue_all(time);
            self.check_positions(system, time)?;
        }
        Ok(())
    }

    /// Whether spheres are where they can be told from one another, and cells can be counted.
    fn check_positions(&self, system: &HardSystem, time: f64) -> Result<(), SimError> {
        system.check_motions(time)?;
        let spheres = &system.state.spheres;
        let position = |at: u32| spheres.motion[at as usize].at(time);
        let Some(at) = spheres.living().find(|&at| self.grid.is_beyond(position(at), time)) else {
            return Ok(());
        };
        let (grain, distance) = (spheres.bulk[at as usize].id, position(at).norm());
        Err(SimError::OutOfCells { time, grain, distance, cell: self.grid.narrowest_cell() })
    }

    fn deal_with(&mut self, system: &mut HardSystem, sphere: u32, time: f64) -> Result<(), SimError> {
        let next_event = self.upcoming[sphere as usize];
        if next_event.crossing < next_event.collision {
            if next_event.exit.is_wall {
                system.bounce_off_wall(sphere, next_event.exit.axis as usize, time);
                self.filed.watch.bounced(system, [sphere, NONE]);
                return self.look_again(system, sphere, time);
            }
            return self.cross(system, sphere, time);
        }
        if next_event.partner == NONE {
            return self.look_again(system, sphere, time);
        }
        self.collide(system, sphere, time)
    }

    /// A sphere moves into the next cell.
    fn cross(&mut self, system: &mut HardSystem, sphere: u32, time: f64) -> Result<(), SimError> {
        let spheres = &mut system.state.spheres;
        self.grid.unlink(&self.upcoming[sphere as usize], sphere);
        let next_event = &mut self.upcoming[sphere as usize];
        let exit = next_event.exit;
        let edges = self.grid.step_over(next_event);
        if edges != 0 {
            let mut position = spheres.motion[sphere as usize].position.to_array();
            position[exit.axis as usize] += f64::from(edges) * self.grid.edges[exit.axis as usize];
            spheres.motion[sphere as usize].position = position.into();
        }
        self.grid.link(&mut self.upcoming[sphere as usize], sphere);
        if edges != 0 {
            if system.volume.boundary == Boundary::Antipodal {
                // On the other side nobody is who was near before.
                return self.look_again(system, sphere, time);
            }
            self.shift_images(sphere, exit.axis as usize, edges);
        }
        let spheres = &system.state.spheres;
        let next_event = &mut self.upcoming[sphere as usize];
        (next_event.crossing, next_event.exit) =
            self.grid.exit(next_event, &spheres.motion[sphere as usize], time);
        let next = next_event.exit;
        // The search looks through the face that was just passed.
        next_event.exit = exit;
        let known = NextCollision::known(next_event);
        let found = Seeker::new(&spheres.motion, &self.upcoming, &self.grid, sphere, time, known)
            .look_ahead(&mut self.scratch);
        self.upcoming[sphere as usize].exit = next;
        let other = if found == known { None } else { self.arrange(sphere, found) };
        self.refile(sphere, other);
        Ok(())
    }

    /// A sphere was put an edge further: who is to collide with it sees it there.
    fn shift_images(&mut self, sphere: u32, axis: usize, edges: i8) {
        let partner = self.upcoming[sphere as usize].partner;
        if partner != NONE {
            self.upcoming[sphere as usize].shift(axis, edges);
            self.upcoming[partner as usize].shift(axis, edges.saturating_neg());
        }
    }

    /// Two spheres collide.
    fn collide(&mut self, system: &mut HardSystem, sphere: u32, time: f64) -> Result<(), SimError> {
        let next_event = &self.upcoming[sphere as usize];
        let mut pair = [sphere, next_event.partner];
        let mut shift = self.grid.shift(next_event.image);
        // An order that belongs to the spheres themselves, so that ids do not matter.
        if !system.is_first(pair[0], pair[1]) {
            pair.reverse();
            shift = Vec3::ZERO - shift;
        }
        self.filed.watch.bounced(system, pair);
        for at in pair {
            self.upcoming[at as usize].partner = NONE;
            self.upcoming[at as usize].collision = f64::INFINITY;
        }
        let around = Around { grid: &self.grid };
        match system.collide(Contact { spheres: pair, shift }, time, &around) {
            Change::Bounced => {
                self.look_again(system, pair[0], time)?;
                self.look_again(system, pair[1], time)
            }
            Change::Merged { kept, gone } => {
                self.drop_sphere(gone);
                self.grid.unlink(&self.upcoming[kept as usize], kept);
                self.place(system, kept, time)?;
                self.look_again(system, kept, time)
            }
            Change::Broke => {
                for at in pair {
                    self.drop_sphere(at);
                }
                let fragments = std::mem::take(&mut system.fragments);
                self.upcoming.resize(system.state.spheres.slots(), NextEvent::EMPTY);
                self.grid.hold(system.state.spheres.slots());
                fragments.iter().try_for_each(|&fragment| self.place(system, fragment, time))?;
                fragments.iter().try_for_each(|&fragment| self.look_again(system, fragment, time))?;
                system.fragments = fragments;
                Ok(())
            }
        }
    }

    fn drop_sphere(&mut self, sphere: u32) {
        self.grid.unlink(&self.upcoming[sphere as usize], sphere);
        self.upcoming[sphere as usize] = NextEvent::EMPTY;
    }

    /// Files a sphere, which is in no cell, under the cell where it is.
    fn place(&mut self, system: &mut HardSystem, sphere: u32, time: f64) -> Result<(), SimError> {
        let (motion, edge) = (&mut system.state.spheres.motion[sphere as usize], self.grid.shortest_edge());
        motion.position += self.grid.way_back(motion.at(time), time);
        if 2.0 * motion.radius > edge && system.volume.boundary != Boundary::Open {
            let grain = system.state.spheres.bulk[sphere as usize].id;
            return Err(SimError::Outgrown { time, grain, diameter: 2.0 * motion.radius, edge });
        }
        let next_event = &mut self.upcoming[sphere as usize];
        next_event.id = system.state.spheres.bulk[sphere as usize].id;
        self.grid.seat(next_event, motion, time);
        self.grid.link(next_event, sphere);
        Ok(())
    }

    /// A sphere whose motion has changed, or that was left over, looks for its next collision.
    fn look_again(&mut self, system: &HardSystem, sphere: u32, time: f64) -> Result<(), SimError> {
        let (spheres, at) = (&system.state.spheres, sphere as usize);
        let motion = &spheres.motion[at];
        system.check_motion(sphere, time)?;
        self.leave_partner(sphere);
        let next_event = &mut self.upcoming[at];
        self.grid.note_velocities(next_event.level, [motion.velocity; 2]);
        (next_event.crossing, next_event.exit) = self.grid.exit(next_event, motion, time);
        next_event.collision = f64::INFINITY;
        let found =
            Seeker::new(&spheres.motion, &self.upcoming, &self.grid, sphere, time, NextCollision::NEVER)
                .look_around(&mut self.scratch);
        let other = self.arrange(sphere, found);
        self.refile(sphere, other);
        Ok(())
    }

    /// Parts a sphere from its partner, who will look again when they would have collided.
    fn leave_partner(&mut self, sphere: u32) {
        let partner = std::mem::replace(&mut self.upcoming[sphere as usize].partner, NONE);
        if partner != NONE {
            self.upcoming[partner as usize].partner = NONE;
        }
    }

    /// Notes a collision as the next event of both; whom the partner would have collided with looks again. Gives the
    /// partner where it must be filed under another time.
    fn arrange(&mut self, sphere: u32, collision: NextCollision) -> Option<u32> {
        self.leave_partner(sphere);
        let next_event = &mut self.upcoming[sphere as usize];
        next_event.collision = collision.time;
        next_event.partner = collision.partner;
        next_event.image = collision.image;
        if collision.partner == NONE {
            return None;
        }
        self.leave_partner(collision.partner);
        let other = &mut self.upcoming[collision.partner as usize];
        let due = other.due();
        other.collision = collision.time;
        other.partner = sphere;
        other.image = collision.image.map(i8::saturating_neg);
        (other.due() != due).then_some(collision.partner)
    }

    /// Files a sphere, and another one if there is one, under their new times.
    fn refile(&mut self, sphere: u32, other: Option<u32>) {
        for at in other.into_iter().chain([sphere]) {
            self.queue.file(&mut self.upcoming, at);
        }
    }

    /// Makes a grid for the spheres as they are.
    fn file_anew(&mut self, system: &mut HardSystem, time: f64) -> Result<(), SimError> {
        self.filed = self.filed.renewed(&system.state.spheres);
        self.grid = self.filed.grid(&system.volume);
        self.file_all(system, time)
    }

    /// Sorts the spheres in memory and lets all look for their next collisions.
    fn file_all(&mut self, system: &mut HardSystem, time: f64) -> Result<(), SimError> {
        let spheres = &mut system.state.spheres;
        self.upcoming.clear();
        self.upcoming.resize(spheres.slots(), NextEvent::EMPTY);
        self.grid.set_off(&system.volume, time, Vec3::ZERO);
        for ((next_event, motion), bulk) in
            self.upcoming.iter_mut().zip(&mut spheres.motion).zip(&spheres.bulk)
        {
            if bulk.lives() {
                motion.position += self.grid.way_back(motion.at(time), time);
                next_event.id = bulk.id;
                self.grid.seat(next_event, motion, time);
            }
        }
        self.check_positions(system, time)?;
        self.sort(system);
        self.grid.set_off(&system.volume, time, drift(system));
        self.link_all(system);
        for sphere in 0..system.state.spheres.slots() as u32 {
            let motion = &system.state.spheres.motion;
            let next_event = &mut self.upcoming[sphere as usize];
            (next_event.crossing, next_event.exit) =
                self.grid.exit(next_event, &motion[sphere as usize], time);
            // Who was found by an earlier one may find someone sooner.
            let known = NextCollision::known(next_event);
            let found = Seeker::new(motion, &self.upcoming, &self.grid, sphere, time, known)
                .look_around(&mut self.scratch);
            if found != known {
                self.arrange(sphere, found);
            }
        }
        self.queue_all(time);
        Ok(())
    }

    /// Files all spheres under the cells that their next events name.
    fn link_all(&mut self, system: &HardSystem) {
        self.grid.clear();
        self.grid.hold(self.upcoming.len());
        for (next_event, sphere) in self.upcoming.iter_mut().zip(0..) {
            if next_event.level != NextEvent::NOWHERE {
                self.grid.link(next_event, sphere);
                let velocity = system.state.spheres.motion[sphere as usize].velocity;
                self.grid.note_velocities(next_event.level, [velocity; 2]);
            }
        }
    }

    /// Files all spheres under the times that their next events name.
    fn queue_all(&mut self, time: f64) {
        self.queue.rebuild(time, &mut self.upcoming);
    }

    /// Puts spheres that are near one another in space near one another in memory, and drops empty slots. The order
    /// belongs to the spheres themselves, so that their ids do not matter.
    fn sort(&mut self, system: &mut HardSystem) {
        let spheres = &mut system.state.spheres;
        let curve = |at: u32| {
            let next_event = &self.upcoming[at as usize];
            morton_code(self.grid.finest_cell(next_event).map(|along| along as u64))
        };
        let mut order: Vec<(u64, u32)> = spheres.living().map(|at| (curve(at), at)).collect();
        order.sort_unstable_by(|a, b| {
            let position = |at: u32| &spheres.motion[at as usize].position;
            a.0.cmp(&b.0).then_with(|| position(a.1).total_cmp(position(b.1)))
        });
        let order: Vec<u32> = order.into_iter().map(|(_, at)| at).collect();
        let mut index_of = vec![NONE; spheres.slots()];
        for (&at, index) in order.iter().zip(0..) {
            index_of[at as usize] = index;
        }
        spheres.reorder(&order);
        self.upcoming = order.iter().map(|&at| self.upcoming[at as usize]).collect();
        for next_event in &mut self.upcoming {
            if next_event.partner != NONE {
                next_event.partner = index_of[next_event.partner as usize];
            }
        }
        self.filed.events = 0;
    }
}
