//! What a collision does to the spheres of a run. Both drivers use it; they find out who collides with whom, and when.

use crate::domain::Boundary;
use crate::engine::hard::record::EventKind;
use crate::engine::hard::search::{Contact, Surroundings};
use crate::impact::Outcome;
use crate::impact::sticking::merged;
use crate::math::Vec3;

use super::collision::{Change, Collision};
use super::fragments;
use super::system::HardSystem;

impl HardSystem {
    /// Lets two spheres collide at `time` [s]. Their motions are brought up to that time.
    ///
    /// The outcome does not depend on which is named first, but for the order in memory.
    pub fn collide(&mut self, contact: Contact, time: f64, surroundings: &dyn Surroundings) -> Change {
        for at in contact.spheres {
            self.bring_up(at as usize, time);
        }
        let collision = self.collision(contact, time);
        let outcome = self.outcome(&collision);
        self.count(&outcome, collision.overlaps);
        if outcome.fragments == [1, 1] {
            return self.carry_out(&collision, &outcome);
        }
        match fragments::find_room(self, &collision, &outcome, surroundings) {
            Some(found) => fragments::break_up(self, &collision, &outcome, found),
            None => self.stay_whole(collision),
        }
    }

    fn collision(&self, contact: Contact, time: f64) -> Collision {
        let [a, b] = contact.spheres.map(|at| &self.state.spheres.motion[at as usize]);
        // Written so that swapping the partners turns it round exactly.
        let distance = (b.position - a.position) + contact.shift;
        let length = distance.norm();
        let normal = if length > 0.0 { distance / length } else { Vec3::AXES[0] };
        Collision {
            contact,
            time,
            bodies: contact.spheres.map(|at| self.body(at as usize)),
            distance,
            normal,
            approach: (a.velocity - b.velocity).dot(normal),
            overlaps: length < (a.radius + b.radius) * (1.0 - 1e-9) - a.rounding(time) - b.rounding(time),
        }
    }

    /// The same collision where there is no room for fragments: both stay whole.
    fn stay_whole(&mut self, mut collision: Collision) -> Change {
        self.state.counts.no_room += 1;
        self.state.warnings.add("an agglomerate could not break: there was no room for its fragments");
        collision.bodies.iter_mut().for_each(|body| body.primaries = 1);
        let [a, b] = &collision.bodies;
        let outcome = self.laws.impact([a, b], collision.normal);
        self.carry_out(&collision, &outcome)
    }

    fn carry_out(&mut self, collision: &Collision, outcome: &Outcome) -> Change {
        self.book(collision, outcome);
        let classes = collision.contact.spheres.map(|at| self.state.spheres.bulk[at as usize].primaries);
        self.state.rates.collide(classes, outcome.sticks);
        for side in [0, 1] {
            self.settle(side, collision, outcome);
        }
        if outcome.sticks {
            self.merge(collision, outcome)
        } else {
            self.state.counts.bounces += 1;
            Change::Bounced
        }
    }

    fn outcome(&mut self, collision: &Collision) -> Outcome {
        let [a, b] = &collision.bodies;
        let outcome = self.laws.impact_drawn([a, b], collision.normal, &self.draws(collision));
        let loses = outcome.restitution < 1.0 || outcome.energy.tangential > 0.0;
        let bounces = !outcome.sticks && outcome.fragments == [1, 1];
        if bounces && loses && self.contact_duration > 0.0 && self.collapses(collision) {
            self.state.counts.tc_bounces += 1;
            self.state.ledger.flows.kept += outcome.energy.normal + outcome.energy.tangential;
            return self.laws.elastic([a, b], collision.normal);
        }
        outcome
    }

    /// Whether a bounce belongs to an inelastic collapse.
    fn collapses(&mut self, collision: &Collision) -> bool {
        let bulk = collision.contact.spheres.map(|at| self.state.spheres.bulk[at as usize]);
        let (time, duration) = (collision.time, self.contact_duration);
        bulk.iter().all(|one| time - one.bounced_at < duration)
            && self.state.collapse.has_come(bulk.map(|one| one.id), time, duration)
    }

    fn count(&mut self, outcome: &Outcome, overlap: bool) {
        let counts = &mut self.state.counts;
        counts.collisions += 1;
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

    fn merge(&mut self, collision: &Collision, outcome: &Outcome) -> Change {
        let ([a, b], distance) = (collision.contact.spheres, collision.distance);
        let (kept, gone, to_gone) = if self.is_first(a, b) { (a, b, distance) } else { (b, a, -distance) };
        let event = self.note(EventKind::Merge, collision, outcome);
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
        self.state.rates.merge([one.primaries, other.primaries], collision.time);
        let id = parents[0].id;
        self.descend(event, parents.map(|parent| (parent.id, id, parent.primaries, parent.mass)));
        Change::Merged { kept, gone }
    }
}
