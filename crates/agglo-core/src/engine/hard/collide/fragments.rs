//! Room for the fragments of agglomerates that break.
//!
//! Fragments of a ball need more room than the ball. They are put at random positions about its center, one after the
//! other, largest first, in a region that grows until there is room clear of all other spheres. They all have the
//! velocity of the parent after the collision, so momentum and kinetic energy are those of the parent; their center of
//! mass may lie a little off its center.

use crate::engine::hard::record::EventKind;
use crate::engine::hard::search::Surroundings;
use crate::engine::hard::spheres::{Bulk, Sphere};
use crate::impact::Outcome;
use crate::math::Vec3;
use crate::math::rng::{Purpose, Stream};

use super::collision::{Change, Collision};
use super::system::HardSystem;

/// The region grows by this factor.
const GROWTH: f64 = 1.05;
/// Draws for one fragment before the region grows.
const DRAWS: u32 = 40;
/// Fragments lie within this many radii of their parent, or it does not break.
const FARTHEST: f64 = 3.0;
/// Fragments keep this part of their radius from everything else.
const CLEARANCE: f64 = 1e-6;

/// A fragment and where it goes.
#[derive(Clone, Copy, Debug)]
pub struct Fragment {
    /// Which partner it comes from.
    parent: usize,
    primaries: u32,
    center: Vec3,
    radius: f64,
}

/// Finds room for all fragments; nothing is changed.
pub fn find_room(
    system: &HardSystem,
    collision: &Collision,
    outcome: &Outcome,
    surroundings: &dyn Surroundings,
) -> Option<Vec<Fragment>> {
    let contact = collision.contact;
    let event = system.state.counts.fragmentations + system.state.counts.no_room;
    let mut stream = Stream::new(system.seed, Purpose::Fragment, event as u32);
    // The draws belong to positions in space, not to the order in which the partners are named.
    let mut order = [0, 1];
    if !system.is_first(contact.spheres[0], contact.spheres[1]) {
        order.reverse();
    }
    let draws = system.draws(collision);
    let mut found: Vec<Fragment> = Vec::new();
    for k in order {
        let body = &collision.bodies[k];
        if outcome.fragments[k] < 2 {
            continue;
        }
        let shares = system.laws.share_primaries(body, outcome.fragments[k], draws.of(k));
        let center = system.state.spheres.motion[contact.spheres[k] as usize].position;
        let taken = taken_near(system, collision, k, outcome, surroundings);
        let mut reach = body.radius;
        for primaries in shares {
            let radius = body.radius * (f64::from(primaries) / f64::from(body.primaries)).cbrt();
            let position = loop {
                let position = (0..DRAWS).find_map(|_| {
                    let position = center + in_ball(&mut stream) * (reach - radius).max(0.0);
                    is_clear(system, position, radius, &taken, &found).then_some(position)
                });
                match position {
                    Some(position) => break position,
                    None if reach * GROWTH > FARTHEST * body.radius => return None,
                    None => reach *= GROWTH,
                }
            };
            found.push(Fragment { parent: k, primaries, center: position, radius });
        }
    }
    Some(found)
}

/// Spheres near partner `k` that fragments must keep clear of: (center, radius), as seen from its position.
fn taken_near(
    system: &HardSystem,
    collision: &Collision,
    k: usize,
    outcome: &Outcome,
    surroundings: &dyn Surroundings,
) -> Vec<(Vec3, f64)> {
    let (spheres, contact, time) = (&system.state.spheres, collision.contact, collision.time);
    let own = &spheres.motion[contact.spheres[k] as usize];
    let mut taken = Vec::new();
    surroundings.visit_near(spheres, own.position, FARTHEST * own.radius, time, &mut |at, center| {
        // Fragments of the partner are looked at one by one.
        let breaks = (0..2).any(|partner| contact.spheres[partner] == at && outcome.fragments[partner] > 1);
        if !breaks {
            taken.push((center, spheres.motion[at as usize].radius));
        }
    });
    taken
}

fn is_clear(
    system: &HardSystem,
    position: Vec3,
    radius: f64,
    taken: &[(Vec3, f64)],
    found: &[Fragment],
) -> bool {
    let clear = |center: Vec3, other: f64| {
        let least = radius + other + CLEARANCE * radius;
        (center - position).norm_squared() >= least * least
    };
    system.volume.holds(position, radius)
        && taken.iter().all(|&(center, other)| clear(center, other))
        && found
            .iter()
            .all(|fragment| clear(system.volume.nearest_image(fragment.center, position), fragment.radius))
}

fn in_ball(stream: &mut Stream) -> Vec3 {
    let radius = stream.uniform().cbrt();
    stream.direction() * radius
}

/// Puts the fragments where there is room for them; the partners' slots are given up, unless one stays whole.
pub fn break_up(
    system: &mut HardSystem,
    collision: &Collision,
    outcome: &Outcome,
    found: Vec<Fragment>,
) -> Change {
    let (contact, time, bodies) = (collision.contact, collision.time, &collision.bodies);
    system.book(collision, outcome);
    system.state.rates.collide_and_break(bodies.map(|body| body.primaries));
    let event = system.note(EventKind::Break, collision, outcome);
    let parents = contact.spheres.map(|at| system.state.spheres.bulk[at as usize]);
    system.fragments.clear();
    for (k, at) in contact.spheres.into_iter().enumerate() {
        if outcome.fragments[k] > 1 {
            system.state.spheres.remove(at);
            system.state.counts.fragmentations += 1;
            let primaries: Vec<u32> = found
                .iter()
                .filter(|fragment| fragment.parent == k)
                .map(|fragment| fragment.primaries)
                .collect();
            system.state.rates.shatter(bodies[k].primaries, &primaries, time);
        } else {
            system.settle(k, collision, outcome);
            system.fragments.push(at);
        }
    }
    for fragment in found {
        let parent = &parents[fragment.parent];
        let part = f64::from(fragment.primaries) / f64::from(parent.primaries);
        let id = system.state.spheres.new_id();
        let motion = Sphere {
            position: system.volume.wrap(fragment.center),
            velocity: outcome.velocities[fragment.parent],
            time,
            radius: fragment.radius,
        };
        let bulk = Bulk {
            mass: parent.mass * part,
            heat_capacity: parent.heat_capacity * part,
            temperature: outcome.temperatures[fragment.parent],
            bounced_at: time,
            id,
            primaries: fragment.primaries,
            ..*parent
        };
        let at = system.state.spheres.insert(motion, bulk);
        system.fragments.push(at);
        system.descend(event, [(parent.id, id, fragment.primaries, bulk.mass)]);
    }
    Change::Broke
}
