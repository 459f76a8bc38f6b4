//! The spheres of a run with their laws and ledger.

use serde::{Deserialize, Serialize};

use crate::domain::{Volume, resolution};
use crate::engine::hard::record::{Counts, Descent, EventKind, GrainEvent};
use crate::engine::hard::spheres::Spheres;
use crate::engine::{SimError, Warnings};
use crate::impact::{Body, Draws, ImpactLaws, Outcome};
use crate::ledger::Ledger;
use crate::math::Vec3;
use crate::measure::SizeRates;

use super::collapse::Collapse;
use super::collision::Collision;

/// All that changes and is not a driver's own; a checkpoint holds it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct HardSystemState {
    /// The spheres.
    pub spheres: Spheres,
    /// The ledger.
    pub ledger: Ledger,
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
pub struct HardSystem {
    /// All that changes.
    pub state: HardSystemState,
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
    /// Indices of the spheres that came out of the last fragmentation.
    pub fragments: Vec<u32>,
}

impl HardSystem {
    /// Gives a partner that stays whole its new velocity and temperature.
    pub(super) fn settle(&mut self, side: usize, collision: &Collision, outcome: &Outcome) {
        let at = collision.contact.spheres[side] as usize;
        self.state.spheres.motion[at].velocity = outcome.velocities[side];
        let bulk = &mut self.state.spheres.bulk[at];
        bulk.temperature = outcome.temperatures[side];
        bulk.bounced_at = collision.time;
    }

    /// Random numbers for the sizes of each partner's fragments. They belong to positions in space, not to the order in which the
    /// partners are named.
    pub(super) fn draws(&self, collision: &Collision) -> Draws {
        let [a, b] = collision.contact.spheres;
        let counts = &self.state.counts;
        let event = 2 * (counts.fragmentations + counts.no_room) as u32;
        let draws = Draws::new(self.seed, event);
        if !self.laws.draws_fragments() || self.is_first(a, b) { draws } else { draws.swapped() }
    }

    pub(super) fn book(&mut self, collision: &Collision, outcome: &Outcome) {
        let (flows, bodies) = (&mut self.state.ledger.flows, &collision.bodies);
        flows.collisions.add(&outcome.energy);
        if bodies.iter().any(|body| body.heat_capacity == 0.0) {
            let kept = |k: usize| bodies[k].heat_capacity * (outcome.temperatures[k] - bodies[k].temperature);
            flows.unkept.add(outcome.energy.heat - (kept(0) + kept(1)));
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
            self.state.ledger.flows.cooled += given_off;
        }
    }

    /// Temperature [K] of the sphere of an index at `time` [s], and the heat [J] that it has given off since its last
    /// heating.
    pub fn cooled(&self, at: usize, time: f64) -> (f64, f64) {
        let bulk = &self.state.spheres.bulk[at];
        let body = self.body(at);
        let temperature = self.laws.cooled(&body, time - bulk.heated_at);
        (temperature, body.heat_capacity * (body.temperature - temperature))
    }

    pub(in crate::engine::hard) fn body(&self, at: usize) -> Body {
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

    /// Which of two spheres goes on when they merge: the heavier one; of equals the one whose position comes first in
    /// space, so that ids do not matter.
    pub(in crate::engine::hard) fn is_first(&self, a: u32, b: u32) -> bool {
        let spheres = &self.state.spheres;
        let mass = |at: u32| spheres.bulk[at as usize].mass;
        let position = |at: u32| self.volume.wrap(spheres.motion[at as usize].position);
        mass(b).total_cmp(&mass(a)).then_with(|| position(a).total_cmp(&position(b))).is_le()
    }

    /// Writes an event down and gives its number.
    pub(super) fn note(&mut self, kind: EventKind, collision: &Collision, outcome: &Outcome) -> u64 {
        self.state.counts.events += 1;
        let number = self.state.counts.events;
        if self.keeps_events {
            let mut partners = collision.contact.spheres.map(|at| {
                let bulk = &self.state.spheres.bulk[at as usize];
                (bulk.id, bulk.mass)
            });
            partners.sort_unstable_by_key(|partner| partner.0);
            self.events.push(GrainEvent {
                number,
                time: collision.time,
                kind,
                grains: partners.map(|partner| partner.0),
                masses: partners.map(|partner| partner.1),
                speed: collision.approach,
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

    /// Whether a sphere has a motion, and is where doubles can tell its position well enough for its radius.
    ///
    /// # Errors
    /// [`SimError`] where not.
    #[inline]
    pub(in crate::engine::hard) fn check_motion(&self, at: u32, time: f64) -> Result<(), SimError> {
        let motion = &self.state.spheres.motion[at as usize];
        if resolution::is_fine(motion.rounding(time), motion.radius) {
            return Ok(());
        }
        if !(motion.velocity.norm_squared().is_finite() && motion.position.is_finite()) {
            return Err(self.not_finite(at, time));
        }
        let grain = self.state.spheres.bulk[at as usize].id;
        let (distance, speed) = (motion.at(time).norm(), motion.velocity.norm());
        let (rounding, radius) = (motion.rounding(time), motion.radius);
        Err(SimError::OutOfDigits { time, grain, distance, speed, rounding, radius })
    }

    /// The same for all spheres.
    ///
    /// # Errors
    /// [`SimError`] for the first that is not.
    pub(in crate::engine::hard) fn check_motions(&self, time: f64) -> Result<(), SimError> {
        self.state.spheres.living().try_for_each(|at| self.check_motion(at, time))
    }

    /// The error of a sphere whose motion is not finite at `time` [s].
    pub(in crate::engine::hard) fn not_finite(&self, at: u32, time: f64) -> SimError {
        let grain = self.state.spheres.bulk[at as usize].id;
        SimError::CollisionNotFinite { time, grain, laws: self.laws.names().join(", ") }
    }

    /// Lets a sphere bounce off a smooth wall whose inward normal is along `axis`, and enters the momentum in the ledger.
    pub fn bounce_off_wall(&mut self, at: u32, axis: usize, time: f64) {
        self.bring_up(at as usize, time);
        let mass = self.state.spheres.bulk[at as usize].mass;
        let velocity = &mut self.state.spheres.motion[at as usize].velocity;
        let mut along = velocity.to_array();
        let mut impulse = [0.0; 3];
        impulse[axis] = -2.0 * mass * along[axis];
        along[axis] = -along[axis];
        *velocity = along.into();
        self.state.ledger.flows.walls += Vec3::from(impulse);
        self.state.counts.walls += 1;
    }
}
