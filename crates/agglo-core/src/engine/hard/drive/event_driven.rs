//! Hard spheres from event to event, each at its exact time.
//!
//! # Equation
//! Between events spheres fly straight: r(t) = r(t₀) + v (t - t₀). Events are impacts, at the root (E1) of
//! |r_j - r_i + (v_j - v_i) t| = b_i + b_j; moves into the next cell; bounces off walls.
//!
//! # Source
//! One event per sphere: B. D. Lubachevsky, J. Comput. Phys. 94, 255 (1991). Bins of events: G. Paul, J. Comput. Phys.
//! 221, 615 (2007). Inelastic collapse: S. Luding and S. McNamara, Granular Matter 1, 113 (1998).
//!
//! # Rules
//! - Each sphere knows its earliest impact and who with. Where a third sphere comes first, the one left over looks again
//!   at the time at which it would have met: nothing can happen to it before.
//! - Spheres that overlap (after a merge, or at an antipodal face) and approach meet at once; those that part are let go.
//!   A merged sphere that overlaps others meets them at the same instant, one after the other, in the order of
//!   memory, which is that of space; each may merge in turn.
//! - Simultaneous events are taken in the order of names.
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
//! Flight is straight (no forces) and impacts are instantaneous. The order of events is exact to rounding. Where places are
//! rounded to more than 1e-5 of a radius (4.5e10 radii from the origin, or as far flown) the run ends with an error.
//!
//! # Compared with others
//! No step, so no error of stepping and no impact missed, unlike overlap searches such as REBOUND's `direct` and `tree`.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::domain::{Boundary, Volume};
use crate::engine::SimError;
use crate::engine::hard::collide::{Change, Cloud};
use crate::engine::hard::search::{Agenda, Around, Candidate, Contact, Frame, Grid, Meeting, Seeker};
use crate::engine::hard::spheres::{NONE, Spheres};
use crate::engine::hard::types::EventDriven;
use crate::math::Vec3;
use crate::neighbors::morton_code;

use super::clock::Clock;
use super::fetch::fetch;
use super::queue::Queue;
use super::standstill::Watch;

/// Events between two looks at the clock.
const BATCH: u32 = 10_000;
/// Spheres are sorted in memory after this many events for each.
const EVENTS_PER_SORT: u64 = 50;
/// Part of the time in which a mean radius is flown that the default contact duration is.
const CONTACT: f64 = 1e-6;
/// Relative motion that is less than this part of all motion, by squares, is rounding.
const ONE_WAY: f64 = 1e-24;

/// What the driver has to remember.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct EventsState<'a> {
    pub(super) agendas: Cow<'a, [Agenda]>,
    pub(super) filed: Filed,
    pub(super) frame: Frame,
    /// Bounds of the velocities that each level has seen [m/s]: how far it is looked ahead hangs on them.
    pub(super) velocities: Vec<[Vec3; 2]>,
}

/// What the grid was made for, and what has happened since.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Filed {
    /// Smallest diameter when the grid was made [m].
    pub(super) smallest: f64,
    /// Spheres when the grid was made.
    pub(super) spheres: u64,
    /// Events since spheres were sorted.
    events: u64,
    /// The moment of the last one [s].
    pub(super) moment: f64,
    watch: Watch,
}

impl Filed {
    /// The same with a grid for the spheres as they are.
    pub(super) fn renewed(self, spheres: &Spheres) -> Self {
        let diameter = |at: u32| 2.0 * spheres.motion[at as usize].radius;
        let smallest = spheres.living().map(diameter).fold(f64::MAX, f64::min);
        Self { smallest, spheres: spheres.len() as u64, ..self }
    }

    pub(super) fn grid(&self, volume: &Volume) -> Grid {
        Grid::new(volume, self.smallest, self.spheres as usize)
    }
}

/// Drives hard spheres from event to event.
#[derive(Clone, Debug)]
pub struct Events {
    agendas: Vec<Agenda>,
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
        // Spheres that all fly one way meet nobody, but walls turn them round. What is left of equal velocities is rounding.
        let all = square(Vec3::ZERO);
        let against = if boundary == Boundary::Reflecting { all } else { square(mean) };
        if against > ONE_WAY * all { CONTACT * radius / against.sqrt() } else { 0.0 }
    }
}

/// How fast cells fly [m/s]: with the mean of the spheres, unless they must lie at the faces of the volume. It is summed
/// in the order of memory, which does not depend on names once spheres are sorted.
fn drift(cloud: &Cloud) -> Vec3 {
    if matches!(cloud.volume.boundary, Boundary::Reflecting | Boundary::Antipodal) {
        return Vec3::ZERO;
    }
    let motion = &cloud.state.spheres.motion;
    motion.iter().fold(Vec3::ZERO, |sum, one| sum + one.velocity) / motion.len().max(1) as f64
}

impl Events {
    /// Starts at time zero.
    ///
    /// # Errors
    /// [`SimError`] where a sphere is too far out.
    pub fn start(cloud: &mut Cloud) -> Result<Self, SimError> {
        let filed = Filed::default().renewed(&cloud.state.spheres);
        let mut events = Self::with(cloud, Vec::new(), filed);
        events.file_all(cloud, 0.0)?;
        Ok(events)
    }

    fn with(cloud: &Cloud, agendas: Vec<Agenda>, filed: Filed) -> Self {
        let (grid, queue) = (filed.grid(&cloud.volume), Queue::default());
        Self { agendas, grid, queue, filed, scratch: Vec::new() }
    }

    /// Goes on from what was remembered.
    pub fn resume(cloud: &Cloud, state: EventsState<'_>) -> Self {
        let filed = state.filed;
        let mut events = Self::with(cloud, state.agendas.into_owned(), filed);
        events.grid.frame = state.frame;
        events.link_all(cloud);
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
            agendas: Cow::Borrowed(&self.agendas),
            filed: self.filed,
            frame: self.grid.frame,
            velocities,
        }
    }

    /// Deals with events until `until` [s], or with some thousand of them.
    ///
    /// # Errors
    /// [`SimError`] where the motion is not finite, the clock comes to a halt, or a sphere outgrows a periodic volume.
    pub fn advance(&mut self, cloud: &mut Cloud, clock: &mut Clock, until: f64) -> Result<(), SimError> {
        for _ in 0..BATCH {
            let spheres = &cloud.state.spheres;
            let Some((time, sphere)) = self.queue.next(&mut self.agendas, until, |soon, agendas, at| {
                fetch(soon, agendas, &self.grid, spheres, at);
            }) else {
                clock.time = until;
                break;
            };
            clock.time = time;
            clock.step += 1;
            self.deal_with(cloud, sphere, time)?;
            self.keep_order(cloud, time)?;
        }
        let impacts = cloud.state.counts.impacts.max(1);
        clock.last_step = clock.time / impacts as f64;
        Ok(())
    }

    /// Sorts spheres in memory, or makes a new grid, when it is due; and sees to it that time goes on.
    fn keep_order(&mut self, cloud: &mut Cloud, time: f64) -> Result<(), SimError> {
        let living = cloud.state.spheres.len() as u64;
        self.filed.events += 1;
        self.filed.moment = time;
        self.filed.watch.look(cloud, self.grid.frame.drift, time)?;
        if 2 * living < self.filed.spheres || living > 2 * self.filed.spheres {
            self.file_anew(cloud, time)?;
        } else if self.filed.events > EVENTS_PER_SORT * living || self.grid.is_far(time) {
            let back = self.grid.take_back(&cloud.volume, time);
            if back != Vec3::ZERO {
                cloud.state.spheres.motion.iter_mut().for_each(|motion| motion.position += back);
            }
            self.sort(cloud);
            self.link_all(cloud);
            self.queue_all(time);
            self.check_places(cloud, time)?;
        }
        Ok(())
    }

    /// Whether spheres are where they can be told from one another, and cells can be counted.
    fn check_places(&self, cloud: &Cloud, time: f64) -> Result<(), SimError> {
        cloud.check_motions(time)?;
        let spheres = &cloud.state.spheres;
        let place = |at: u32| spheres.motion[at as usize].at(time);
        let Some(at) = spheres.living().find(|&at| self.grid.is_beyond(place(at), time)) else {
            return Ok(());
        };
        let (grain, place) = (spheres.bulk[at as usize].id, place(at).norm());
        Err(SimError::OutOfCells { time, grain, place, cell: self.grid.narrowest_cell() })
    }

    fn deal_with(&mut self, cloud: &mut Cloud, sphere: u32, time: f64) -> Result<(), SimError> {
        let agenda = self.agendas[sphere as usize];
        if agenda.crossing < agenda.collision {
            if agenda.exit.is_wall {
                cloud.bounce_off_wall(sphere, agenda.exit.axis as usize, time);
                self.filed.watch.bounced(cloud, [sphere, NONE]);
                return self.look_again(cloud, sphere, time);
            }
            return self.cross(cloud, sphere, time);
        }
        if agenda.partner == NONE {
            return self.look_again(cloud, sphere, time);
        }
        self.impact(cloud, sphere, time)
    }

    /// A sphere moves into the next cell.
    fn cross(&mut self, cloud: &mut Cloud, sphere: u32, time: f64) -> Result<(), SimError> {
        let spheres = &mut cloud.state.spheres;
        self.grid.unlink(&self.agendas[sphere as usize], sphere);
        let agenda = &mut self.agendas[sphere as usize];
        let exit = agenda.exit;
        let edges = self.grid.step_over(agenda);
        if edges != 0 {
            let mut place = spheres.motion[sphere as usize].position.to_array();
            place[exit.axis as usize] += f64::from(edges) * self.grid.edges[exit.axis as usize];
            spheres.motion[sphere as usize].position = place.into();
        }
        self.grid.link(&mut self.agendas[sphere as usize], sphere);
        if edges != 0 {
            if cloud.volume.boundary == Boundary::Antipodal {
                // On the other side nobody is who was near before.
                return self.look_again(cloud, sphere, time);
            }
            self.shift_images(sphere, exit.axis as usize, edges);
        }
        let spheres = &cloud.state.spheres;
        let agenda = &mut self.agendas[sphere as usize];
        (agenda.crossing, agenda.exit) = self.grid.exit(agenda, &spheres.motion[sphere as usize], time);
        let next = agenda.exit;
        // The search looks through the face that was just passed.
        agenda.exit = exit;
        let known = Meeting::known(agenda);
        let found = Seeker::new(&spheres.motion, &self.agendas, &self.grid, sphere, time, known)
            .look_ahead(&mut self.scratch);
        self.agendas[sphere as usize].exit = next;
        let other = if found == known { None } else { self.arrange(sphere, found) };
        self.refile(sphere, other);
        Ok(())
    }

    /// A sphere was put an edge further: who meets it sees it there.
    fn shift_images(&mut self, sphere: u32, axis: usize, edges: i8) {
        let partner = self.agendas[sphere as usize].partner;
        if partner != NONE {
            self.agendas[sphere as usize].shift(axis, edges);
            self.agendas[partner as usize].shift(axis, edges.saturating_neg());
        }
    }

    /// Two spheres meet.
    fn impact(&mut self, cloud: &mut Cloud, sphere: u32, time: f64) -> Result<(), SimError> {
        let agenda = &self.agendas[sphere as usize];
        let mut pair = [sphere, agenda.partner];
        let mut shift = self.grid.shift(agenda.image);
        // An order that belongs to the spheres themselves, so that names do not matter.
        if !cloud.is_first(pair[0], pair[1]) {
            pair.reverse();
            shift = Vec3::ZERO - shift;
        }
        self.filed.watch.bounced(cloud, pair);
        for at in pair {
            self.agendas[at as usize].partner = NONE;
            self.agendas[at as usize].collision = f64::INFINITY;
        }
        let around = Around { grid: &self.grid };
        match cloud.meet(Contact { spheres: pair, shift }, time, &around) {
            Change::Bounced => {
                self.look_again(cloud, pair[0], time)?;
                self.look_again(cloud, pair[1], time)
            }
            Change::Merged { kept, gone } => {
                self.drop_sphere(gone);
                self.grid.unlink(&self.agendas[kept as usize], kept);
                self.place(cloud, kept, time)?;
                self.look_again(cloud, kept, time)
            }
            Change::Broke => {
                for at in pair {
                    self.drop_sphere(at);
                }
                let pieces = std::mem::take(&mut cloud.pieces);
                self.agendas.resize(cloud.state.spheres.places(), Agenda::EMPTY);
                self.grid.hold(cloud.state.spheres.places());
                pieces.iter().try_for_each(|&piece| self.place(cloud, piece, time))?;
                pieces.iter().try_for_each(|&piece| self.look_again(cloud, piece, time))?;
                cloud.pieces = pieces;
                Ok(())
            }
        }
    }

    fn drop_sphere(&mut self, sphere: u32) {
        self.grid.unlink(&self.agendas[sphere as usize], sphere);
        self.agendas[sphere as usize] = Agenda::EMPTY;
    }

    /// Files a sphere, which is in no cell, under the cell where it is.
    fn place(&mut self, cloud: &mut Cloud, sphere: u32, time: f64) -> Result<(), SimError> {
        let (motion, edge) = (&mut cloud.state.spheres.motion[sphere as usize], self.grid.shortest_edge());
        motion.position += self.grid.way_back(motion.at(time), time);
        if 2.0 * motion.radius > edge && cloud.volume.boundary != Boundary::Open {
            let grain = cloud.state.spheres.bulk[sphere as usize].id;
            return Err(SimError::Outgrown { time, grain, diameter: 2.0 * motion.radius, edge });
        }
        let agenda = &mut self.agendas[sphere as usize];
        agenda.id = cloud.state.spheres.bulk[sphere as usize].id;
        self.grid.seat(agenda, motion, time);
        self.grid.link(agenda, sphere);
        Ok(())
    }

    /// A sphere whose motion has changed, or that was left over, looks for its next impact.
    fn look_again(&mut self, cloud: &Cloud, sphere: u32, time: f64) -> Result<(), SimError> {
        let (spheres, at) = (&cloud.state.spheres, sphere as usize);
        let motion = &spheres.motion[at];
        cloud.check_motion(sphere, time)?;
        self.leave_partner(sphere);
        let agenda = &mut self.agendas[at];
        self.grid.note_velocities(agenda.level, [motion.velocity; 2]);
        (agenda.crossing, agenda.exit) = self.grid.exit(agenda, motion, time);
        agenda.collision = f64::INFINITY;
        let found = Seeker::new(&spheres.motion, &self.agendas, &self.grid, sphere, time, Meeting::NEVER)
            .look_around(&mut self.scratch);
        let other = self.arrange(sphere, found);
        self.refile(sphere, other);
        Ok(())
    }

    /// Parts a sphere from its partner, who will look again when they would have met.
    fn leave_partner(&mut self, sphere: u32) {
        let partner = std::mem::replace(&mut self.agendas[sphere as usize].partner, NONE);
        if partner != NONE {
            self.agendas[partner as usize].partner = NONE;
        }
    }

    /// Notes a meeting in the agendas of both; whom the partner would have met looks again. Gives the partner where it
    /// must be filed under another time.
    fn arrange(&mut self, sphere: u32, meeting: Meeting) -> Option<u32> {
        self.leave_partner(sphere);
        let agenda = &mut self.agendas[sphere as usize];
        agenda.collision = meeting.time;
        agenda.partner = meeting.partner;
        agenda.image = meeting.image;
        if meeting.partner == NONE {
            return None;
        }
        self.leave_partner(meeting.partner);
        let other = &mut self.agendas[meeting.partner as usize];
        let due = other.due();
        other.collision = meeting.time;
        other.partner = sphere;
        other.image = meeting.image.map(i8::saturating_neg);
        (other.due() != due).then_some(meeting.partner)
    }

    /// Files a sphere, and another one if there is one, under their new times.
    fn refile(&mut self, sphere: u32, other: Option<u32>) {
        for at in other.into_iter().chain([sphere]) {
            self.queue.file(&mut self.agendas, at);
        }
    }

    /// Makes a grid for the spheres as they are.
    fn file_anew(&mut self, cloud: &mut Cloud, time: f64) -> Result<(), SimError> {
        self.filed = self.filed.renewed(&cloud.state.spheres);
        self.grid = self.filed.grid(&cloud.volume);
        self.file_all(cloud, time)
    }

    /// Sorts the spheres in memory and lets all look for their next impacts.
    fn file_all(&mut self, cloud: &mut Cloud, time: f64) -> Result<(), SimError> {
        let spheres = &mut cloud.state.spheres;
        self.agendas.clear();
        self.agendas.resize(spheres.places(), Agenda::EMPTY);
        self.grid.set_off(&cloud.volume, time, Vec3::ZERO);
        for ((agenda, motion), bulk) in self.agendas.iter_mut().zip(&mut spheres.motion).zip(&spheres.bulk) {
            if bulk.lives() {
                motion.position += self.grid.way_back(motion.at(time), time);
                agenda.id = bulk.id;
                self.grid.seat(agenda, motion, time);
            }
        }
        self.check_places(cloud, time)?;
        self.sort(cloud);
        self.grid.set_off(&cloud.volume, time, drift(cloud));
        self.link_all(cloud);
        for sphere in 0..cloud.state.spheres.places() as u32 {
            let motion = &cloud.state.spheres.motion;
            let agenda = &mut self.agendas[sphere as usize];
            (agenda.crossing, agenda.exit) = self.grid.exit(agenda, &motion[sphere as usize], time);
            // Who was found by an earlier one may find someone sooner.
            let known = Meeting::known(agenda);
            let found = Seeker::new(motion, &self.agendas, &self.grid, sphere, time, known)
                .look_around(&mut self.scratch);
            if found != known {
                self.arrange(sphere, found);
            }
        }
        self.queue_all(time);
        Ok(())
    }

    /// Files all spheres under the cells that their agendas name.
    fn link_all(&mut self, cloud: &Cloud) {
        self.grid.clear();
        self.grid.hold(self.agendas.len());
        for (agenda, sphere) in self.agendas.iter_mut().zip(0..) {
            if agenda.level != Agenda::NOWHERE {
                self.grid.link(agenda, sphere);
                let velocity = cloud.state.spheres.motion[sphere as usize].velocity;
                self.grid.note_velocities(agenda.level, [velocity; 2]);
            }
        }
    }

    /// Files all spheres under the times that their agendas name.
    fn queue_all(&mut self, time: f64) {
        self.queue.rebuild(time, &mut self.agendas);
    }

    /// Puts spheres that are near one another in space near one another in memory, and drops empty places. The order
    /// belongs to the spheres themselves, so that their names do not matter.
    fn sort(&mut self, cloud: &mut Cloud) {
        let spheres = &mut cloud.state.spheres;
        let curve = |at: u32| {
            let agenda = &self.agendas[at as usize];
            morton_code(self.grid.finest_cell(agenda).map(|along| along as u64))
        };
        let mut order: Vec<(u64, u32)> = spheres.living().map(|at| (curve(at), at)).collect();
        order.sort_unstable_by(|a, b| {
            let place = |at: u32| &spheres.motion[at as usize].position;
            a.0.cmp(&b.0).then_with(|| place(a.1).total_cmp(place(b.1)))
        });
        let order: Vec<u32> = order.into_iter().map(|(_, at)| at).collect();
        let mut place_of = vec![NONE; spheres.places()];
        for (&at, place) in order.iter().zip(0..) {
            place_of[at as usize] = place;
        }
        spheres.reorder(&order);
        self.agendas = order.iter().map(|&at| self.agendas[at as usize]).collect();
        for agenda in &mut self.agendas {
            if agenda.partner != NONE {
                agenda.partner = place_of[agenda.partner as usize];
            }
        }
        self.filed.events = 0;
    }
}
