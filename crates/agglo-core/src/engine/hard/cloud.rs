//! The spheres of a run with their laws and books, and what an impact does to them. Both drivers use it; they find out
//! who meets whom and when.

use serde::{Deserialize, Serialize};

use crate::domain::{Boundary, Volume, resolution};
use crate::engine::{SimError, Warnings};
use crate::impact::sticking::merged;
use crate::impact::{Body, Draws, ImpactLaws, Outcome};
use crate::math::Vec3;
use crate::measure::SizeRates;

use super::books::{Books, Counts};
use super::collapse::Collapse;
use super::events::{Descent, EventKind, GrainEvent};
use super::pieces;
use super::spheres::Spheres;

/// Two spheres that meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Their places.
    pub spheres: [u32; 2],
    /// What is added to the second one's position to get the image that meets the first [m].
    pub shift: Vec3,
}

/// Two spheres at the moment at which they meet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Encounter {
    pub contact: Contact,
    /// When [s].
    pub time: f64,
    /// The two as they were before.
    pub bodies: [Body; 2],
    /// From the first center to the second [m].
    pub distance: Vec3,
    /// Its direction.
    pub normal: Vec3,
    /// Speed of approach along it [m/s].
    pub approach: f64,
    /// Whether they are in one another already.
    pub overlaps: bool,
}

/// What became of two spheres that met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// Both go on, with new velocities.
    Bounced,
    /// The first went on as both; the second is no more.
    Merged {
        /// Place of the sphere that is both now, larger and elsewhere.
        kept: u32,
        /// Empty place.
        gone: u32,
    },
    /// One or both broke: [`Cloud::pieces`] has the places of all pieces and of a partner that stayed whole, and the
    /// places of both partners were given up or reused.
    Broke,
}

/// Finds spheres near a point.
pub trait Surroundings {
    /// Visits every sphere whose surface may be nearer to `center` than `reach` [m] at `time` [s], with the position of
    /// its image that is near; may visit more.
    fn visit_near(
        &self,
        spheres: &Spheres,
        center: Vec3,
        reach: f64,
        time: f64,
        visit: &mut dyn FnMut(u32, Vec3),
    );
}

/// All that changes and is not a driver's own; a checkpoint holds it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct CloudState {
    /// The spheres.
    pub spheres: Spheres,
    /// The ledger.
    pub books: Books,
    /// Counts.
    pub counts: Counts,
    /// Collision and aggregation by size.
    pub rates: SizeRates,
    /// Warnings.
    pub warnings: Warnings,
    /// Pairs that bounce again and again.
    pub collapse: Collapse,
}

/// The spheres of a run.
#[derive(Clone, Debug)]
pub struct Cloud {
    /// All that changes.
    pub state: CloudState,
    /// Laws of impact.
    pub laws: ImpactLaws,
    /// Control volume.
    pub volume: Volume,
    /// Merges and fragmentations since they were last taken.
    pub events: Vec<GrainEvent>,
    /// Who became whom in them.
    pub descents: Vec<Descent>,
    /// Whether events are written down.
    pub keeps_events: bool,
    /// Bounces of a pair that follow one another within this time [s] again and again are elastic.
    pub contact_duration: f64,
    /// Seed of random numbers.
    pub seed: u64,
    /// Places of the spheres that came out of the last fragmentation.
    pub pieces: Vec<u32>,
}

impl Cloud {
    /// Lets two spheres meet at `time` [s]. Their motions are brought up to that time.
    ///
    /// The outcome does not depend on which is named first, but for the order in memory.
    pub fn meet(&mut self, contact: Contact, time: f64, surroundings: &dyn Surroundings) -> Change {
        for at in contact.spheres {
            self.bring_up(at as usize, time);
        }
        let encounter = self.encounter(contact, time);
        let outcome = self.outcome(&encounter);
        self.count(&outcome, encounter.overlaps);
        if outcome.pieces == [1, 1] {
            return self.carry_out(&encounter, &outcome);
        }
        match pieces::find_room(self, &encounter, &outcome, surroundings) {
            Some(found) => pieces::break_up(self, &encounter, &outcome, found),
            None => self.stay_whole(encounter),
        }
    }

    fn encounter(&self, contact: Contact, time: f64) -> Encounter {
        let [a, b] = contact.spheres.map(|at| &self.state.spheres.motion[at as usize]);
        // Written so that swapping the partners turns it round exactly.
        let distance = (b.position - a.position) + contact.shift;
        let length = distance.norm();
        let normal = if length > 0.0 { distance / length } else { Vec3::AXES[0] };
        Encounter {
            contact,
            time,
            bodies: contact.spheres.map(|at| self.body(at as usize)),
            distance,
            normal,
            approach: (a.velocity - b.velocity).dot(normal),
            overlaps: length < (a.radius + b.radius) * (1.0 - 1e-9) - a.rounding(time) - b.rounding(time),
        }
    }

    /// The same impact where there is no room for pieces: both stay whole.
    fn stay_whole(&mut self, mut encounter: Encounter) -> Change {
        self.state.counts.no_room += 1;
        self.state.warnings.add("an agglomerate could not break: there was no room for its pieces");
        encounter.bodies.iter_mut().for_each(|body| body.primaries = 1);
        let [a, b] = &encounter.bodies;
        let outcome = self.laws.impact([a, b], encounter.normal);
        self.carry_out(&encounter, &outcome)
    }

    fn carry_out(&mut self, encounter: &Encounter, outcome: &Outcome) -> Change {
        self.book(encounter, outcome);
        let classes = encounter.contact.spheres.map(|at| self.state.spheres.bulk[at as usize].primaries);
        self.state.rates.collide(classes, outcome.sticks);
        for side in [0, 1] {
            self.settle(side, encounter, outcome);
        }
        if outcome.sticks {
            self.merge(encounter, outcome)
        } else {
            self.state.counts.bounces += 1;
            Change::Bounced
        }
    }

    /// Gives a partner that stays whole its new velocity and temperature.
    pub(super) fn settle(&mut self, side: usize, encounter: &Encounter, outcome: &Outcome) {
        let at = encounter.contact.spheres[side] as usize;
        self.state.spheres.motion[at].velocity = outcome.velocities[side];
        let bulk = &mut self.state.spheres.bulk[at];
        bulk.temperature = outcome.temperatures[side];
        bulk.bounced_at = encounter.time;
    }

    fn outcome(&mut self, encounter: &Encounter) -> Outcome {
        let [a, b] = &encounter.bodies;
        let outcome = self.laws.impact_drawn([a, b], encounter.normal, &self.draws(encounter));
        let loses = outcome.restitution < 1.0 || outcome.energy.tangential > 0.0;
        let bounces = !outcome.sticks && outcome.pieces == [1, 1];
        if bounces && loses && self.contact_duration > 0.0 && self.collapses(encounter) {
            self.state.counts.guarded += 1;
            self.state.books.flows.kept += outcome.energy.normal + outcome.energy.tangential;
            return self.laws.elastic([a, b], encounter.normal);
        }
        outcome
    }

    /// Whether a bounce belongs to an inelastic collapse.
    fn collapses(&mut self, encounter: &Encounter) -> bool {
        let bulk = encounter.contact.spheres.map(|at| self.state.spheres.bulk[at as usize]);
        let (time, duration) = (encounter.time, self.contact_duration);
        bulk.iter().all(|one| time - one.bounced_at < duration)
            && self.state.collapse.has_come(bulk.map(|one| one.id), time, duration)
    }

    /// Random numbers for the sizes of each partner's pieces. They belong to places in space, not to the order in which the
    /// partners are named.
    pub(super) fn draws(&self, encounter: &Encounter) -> Draws {
        let [a, b] = encounter.contact.spheres;
        let counts = &self.state.counts;
        let event = 2 * (counts.fragmentations + counts.no_room) as u32;
        let draws = Draws::new(self.seed, event);
        if !self.laws.draws_pieces() || self.is_first(a, b) { draws } else { draws.swapped() }
    }

    fn count(&mut self, outcome: &Outcome, overlap: bool) {
        let counts = &mut self.state.counts;
        counts.impacts += 1;
        counts.overlapping += u64::from(overlap);
        counts.iterations += u64::from(outcome.iterations);
        counts.most_iterations = counts.most_iterations.max(outcome.iterations);
        if !outcome.converged {
            counts.not_converged += 1;
            self.state
                .warnings
                .add("the coupled equations of an impact were not solved within the tolerance");
        }
    }

    pub(super) fn book(&mut self, encounter: &Encounter, outcome: &Outcome) {
        let (books, bodies) = (&mut self.state.books, &encounter.bodies);
        books.add(&outcome.energy);
        if bodies.iter().any(|body| body.heat_capacity == 0.0) {
            let kept = |k: usize| bodies[k].heat_capacity * (outcome.temperatures[k] - bodies[k].temperature);
            books.add_unkept(outcome.energy.heat - (kept(0) + kept(1)));
        }
    }

    /// Brings a sphere's position and temperature up to `time` [s].
    pub fn bring_up(&mut self, at: usize, time: f64) {
        let motion = &mut self.state.spheres.motion[at];
        motion.position = motion.at(time);
        motion.time = time;
        if self.laws.cools() {
            let (body, duration) = (self.body(at), time - self.state.spheres.bulk[at].heated_at);
            let (temperature, given_off) = self.cooled(at, time);
            if self.laws.cooling_overshoots(&body, duration) {
                self.state.warnings.add("a published cooling step would fall to zero or below; it was held");
            }
            let bulk = &mut self.state.spheres.bulk[at];
            bulk.temperature = temperature;
            bulk.heated_at = time;
            self.state.books.flows.cooled += given_off;
        }
    }

    /// Temperature [K] of the sphere at a place at `time` [s], and the heat [J] that it has given off since its last
    /// heating.
    pub fn cooled(&self, at: usize, time: f64) -> (f64, f64) {
        let bulk = &self.state.spheres.bulk[at];
        let body = self.body(at);
        let temperature = self.laws.cooled(&body, time - bulk.heated_at);
        (temperature, body.heat_capacity * (body.temperature - temperature))
    }

    pub(super) fn body(&self, at: usize) -> Body {
        let (motion, bulk) = (&self.state.spheres.motion[at], &self.state.spheres.bulk[at]);
        Body {
            velocity: motion.velocity,
            mass: bulk.mass,
            radius: motion.radius,
            temperature: bulk.temperature,
            heat_capacity: bulk.heat_capacity,
            material: bulk.material,
            primaries: bulk.primaries,
        }
    }

    fn merge(&mut self, encounter: &Encounter, outcome: &Outcome) -> Change {
        let ([a, b], distance) = (encounter.contact.spheres, encounter.distance);
        let (kept, gone, to_gone) = if self.is_first(a, b) { (a, b, distance) } else { (b, a, -distance) };
        let event = self.note(EventKind::Merge, encounter, outcome);
        let [one, other] = [kept, gone].map(|at| self.body(at as usize));
        // From the center of the one that stays, so that a large volume costs no digits.
        let (both, center) = merged([&one, &other], [Vec3::ZERO, to_gone]);
        let spheres = &mut self.state.spheres;
        let parents = [kept, gone].map(|at| spheres.bulk[at as usize]);
        let motion = &mut spheres.motion[kept as usize];
        motion.position += center;
        if self.volume.boundary == Boundary::Periodic {
            motion.position = self.volume.wrap(motion.position);
        }
        motion.radius = both.radius;
        let bulk = &mut spheres.bulk[kept as usize];
        bulk.mass = both.mass;
        bulk.heat_capacity = both.heat_capacity;
        bulk.temperature = both.temperature;
        bulk.material = both.material;
        bulk.primaries = both.primaries;
        bulk.bounced_at = f64::NEG_INFINITY;
        spheres.remove(gone);
        self.state.counts.merges += 1;
        self.state.rates.merge([one.primaries, other.primaries], encounter.time);
        let id = parents[0].id;
        self.descend(event, parents.map(|parent| (parent.id, id, parent.primaries, parent.mass)));
        Change::Merged { kept, gone }
    }

    /// Which of two spheres goes on when they merge: the heavier one; of equals the one whose place comes first in
    /// space, so that names do not matter.
    pub(super) fn is_first(&self, a: u32, b: u32) -> bool {
        let spheres = &self.state.spheres;
        let mass = |at: u32| spheres.bulk[at as usize].mass;
        let place = |at: u32| self.volume.wrap(spheres.motion[at as usize].position);
        mass(b).total_cmp(&mass(a)).then_with(|| place(a).total_cmp(&place(b))).is_le()
    }

    /// Writes an event down and gives its number.
    pub(super) fn note(&mut self, kind: EventKind, encounter: &Encounter, outcome: &Outcome) -> u64 {
        self.state.counts.events += 1;
        let number = self.state.counts.events;
        if self.keeps_events {
            let mut partners = encounter.contact.spheres.map(|at| {
                let bulk = &self.state.spheres.bulk[at as usize];
                (bulk.id, bulk.mass)
            });
            partners.sort_unstable_by_key(|partner| partner.0);
            self.events.push(GrainEvent {
                number,
                time: encounter.time,
                kind,
                grains: partners.map(|partner| partner.0),
                masses: partners.map(|partner| partner.1),
                speed: encounter.approach,
                restitution: outcome.restitution,
                energy: outcome.energy,
            });
        }
        number
    }

    /// Writes lines of descent down: (parent, child, primaries, mass).
    pub(super) fn descend(&mut self, event: u64, lines: impl IntoIterator<Item = (u32, u32, u32, f64)>) {
        if self.keeps_events {
            let lines = lines.into_iter();
            self.descents.extend(lines.map(|(parent, child, primaries, mass)| Descent {
                event,
                parent,
                child,
                primaries,
                mass,
            }));
        }
    }

    /// Whether a sphere has a motion, and is where doubles can tell its place well enough for its radius.
    ///
    /// # Errors
    /// [`SimError`] where not.
    #[inline]
    pub(super) fn check_motion(&self, at: u32, time: f64) -> Result<(), SimError> {
        let motion = &self.state.spheres.motion[at as usize];
        if resolution::is_fine(motion.rounding(time), motion.radius) {
            return Ok(());
        }
        if !(motion.velocity.norm_squared().is_finite() && motion.position.is_finite()) {
            return Err(self.not_finite(at, time));
        }
        let grain = self.state.spheres.bulk[at as usize].id;
        let (place, speed) = (motion.at(time).norm(), motion.velocity.norm());
        let (rounding, radius) = (motion.rounding(time), motion.radius);
        Err(SimError::OutOfDigits { time, grain, place, speed, rounding, radius })
    }

    /// The same for all spheres.
    ///
    /// # Errors
    /// [`SimError`] for the first that is not.
    pub(super) fn check_motions(&self, time: f64) -> Result<(), SimError> {
        self.state.spheres.living().try_for_each(|at| self.check_motion(at, time))
    }

    /// The error of a sphere whose motion is not finite at `time` [s].
    pub(super) fn not_finite(&self, at: u32, time: f64) -> SimError {
        let grain = self.state.spheres.bulk[at as usize].id;
        SimError::ImpactNotFinite { time, grain, laws: self.laws.names().join(", ") }
    }

    /// Lets a sphere bounce off a smooth wall whose inward normal is along `axis`, and books the momentum.
    pub fn bounce_off_wall(&mut self, at: u32, axis: usize, time: f64) {
        self.bring_up(at as usize, time);
        let mass = self.state.spheres.bulk[at as usize].mass;
        let velocity = &mut self.state.spheres.motion[at as usize].velocity;
        let mut along = velocity.to_array();
        let mut impulse = [0.0; 3];
        impulse[axis] = -2.0 * mass * along[axis];
        along[axis] = -along[axis];
        *velocity = along.into();
        self.state.books.flows.walls += Vec3::from(impulse);
        self.state.counts.walls += 1;
    }
}
