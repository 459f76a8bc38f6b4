//! Room for the pieces of agglomerates that break.
//!
//! Pieces of a ball need more room than the ball. They are put at random places about its center, one after the
//! other, largest first, in a region that grows until there is room clear of all other spheres. They all have the
//! velocity of the parent after the impact, so momentum and kinetic energy are those of the parent; their center of
//! mass may lie a little off its center.

use crate::engine::hard::record::EventKind;
use crate::engine::hard::search::Surroundings;
use crate::engine::hard::spheres::{Bulk, Sphere};
use crate::impact::Outcome;
use crate::math::Vec3;
use crate::math::rng::{Purpose, Stream};

use super::collision::{Change, Encounter};
use super::system::Cloud;

/// The region grows by this factor.
const GROWTH: f64 = 1.05;
/// Draws for one piece before the region grows.
const DRAWS: u32 = 40;
/// Pieces lie within this many radii of their parent, or it does not break.
const FARTHEST: f64 = 3.0;
/// Pieces keep this part of their radius from everything else.
const CLEARANCE: f64 = 1e-6;

/// A piece and where it goes.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    /// Which partner it comes from.
    parent: usize,
    primaries: u32,
    center: Vec3,
    radius: f64,
}

/// Finds room for all pieces; nothing is changed.
pub fn find_room(
    cloud: &Cloud,
    encounter: &Encounter,
    outcome: &Outcome,
    surroundings: &dyn Surroundings,
) -> Option<Vec<Piece>> {
    let contact = encounter.contact;
    let event = cloud.state.counts.fragmentations + cloud.state.counts.no_room;
    let mut stream = Stream::new(cloud.seed, Purpose::Fragment, event as u32);
    // The draws belong to places in space, not to the order in which the partners are named.
    let mut order = [0, 1];
    if !cloud.is_first(contact.spheres[0], contact.spheres[1]) {
        order.reverse();
    }
    let draws = cloud.draws(encounter);
    let mut found: Vec<Piece> = Vec::new();
    for k in order {
        let body = &encounter.bodies[k];
        if outcome.pieces[k] < 2 {
            continue;
        }
        let shares = cloud.laws.share_primaries(body, outcome.pieces[k], draws.of(k));
        let center = cloud.state.spheres.motion[contact.spheres[k] as usize].position;
        let taken = taken_near(cloud, encounter, k, outcome, surroundings);
        let mut reach = body.radius;
        for primaries in shares {
            let radius = body.radius * (f64::from(primaries) / f64::from(body.primaries)).cbrt();
            let place = loop {
                let place = (0..DRAWS).find_map(|_| {
                    let place = center + in_ball(&mut stream) * (reach - radius).max(0.0);
                    is_clear(cloud, place, radius, &taken, &found).then_some(place)
                });
                match place {
                    Some(place) => break place,
                    None if reach * GROWTH > FARTHEST * body.radius => return None,
                    None => reach *= GROWTH,
                }
            };
            found.push(Piece { parent: k, primaries, center: place, radius });
        }
    }
    Some(found)
}

/// Spheres near partner `k` that pieces must keep clear of: (center, radius), as seen from its place.
fn taken_near(
    cloud: &Cloud,
    encounter: &Encounter,
    k: usize,
    outcome: &Outcome,
    surroundings: &dyn Surroundings,
) -> Vec<(Vec3, f64)> {
    let (spheres, contact, time) = (&cloud.state.spheres, encounter.contact, encounter.time);
    let own = &spheres.motion[contact.spheres[k] as usize];
    let mut taken = Vec::new();
    surroundings.visit_near(spheres, own.position, FARTHEST * own.radius, time, &mut |at, center| {
        // Pieces of the partner are looked at one by one.
        let breaks = (0..2).any(|partner| contact.spheres[partner] == at && outcome.pieces[partner] > 1);
        if !breaks {
            taken.push((center, spheres.motion[at as usize].radius));
        }
    });
    taken
}

fn is_clear(cloud: &Cloud, place: Vec3, radius: f64, taken: &[(Vec3, f64)], found: &[Piece]) -> bool {
    let clear = |center: Vec3, other: f64| {
        let least = radius + other + CLEARANCE * radius;
        (center - place).norm_squared() >= least * least
    };
    cloud.volume.holds(place, radius)
        && taken.iter().all(|&(center, other)| clear(center, other))
        && found.iter().all(|piece| clear(cloud.volume.nearest_image(piece.center, place), piece.radius))
}

fn in_ball(stream: &mut Stream) -> Vec3 {
    let radius = stream.uniform().cbrt();
    stream.direction() * radius
}

/// Puts the pieces where there is room for them; the partners' places are given up, unless one stays whole.
pub fn break_up(cloud: &mut Cloud, encounter: &Encounter, outcome: &Outcome, found: Vec<Piece>) -> Change {
    let (contact, time, bodies) = (encounter.contact, encounter.time, &encounter.bodies);
    cloud.book(encounter, outcome);
    cloud.state.rates.collide_and_break(bodies.map(|body| body.primaries));
    let event = cloud.note(EventKind::Break, encounter, outcome);
    let parents = contact.spheres.map(|at| cloud.state.spheres.bulk[at as usize]);
    cloud.pieces.clear();
    for (k, at) in contact.spheres.into_iter().enumerate() {
        if outcome.pieces[k] > 1 {
            cloud.state.spheres.remove(at);
            cloud.state.counts.fragmentations += 1;
            let primaries: Vec<u32> =
                found.iter().filter(|piece| piece.parent == k).map(|piece| piece.primaries).collect();
            cloud.state.rates.shatter(bodies[k].primaries, &primaries, time);
        } else {
            cloud.settle(k, encounter, outcome);
            cloud.pieces.push(at);
        }
    }
    for piece in found {
        let parent = &parents[piece.parent];
        let part = f64::from(piece.primaries) / f64::from(parent.primaries);
        let id = cloud.state.spheres.new_id();
        let motion = Sphere {
            position: cloud.volume.wrap(piece.center),
            velocity: outcome.velocities[piece.parent],
            time,
            radius: piece.radius,
        };
        let bulk = Bulk {
            mass: parent.mass * part,
            heat_capacity: parent.heat_capacity * part,
            temperature: outcome.temperatures[piece.parent],
            bounced_at: time,
            id,
            primaries: piece.primaries,
            ..*parent
        };
        let at = cloud.state.spheres.insert(motion, bulk);
        cloud.pieces.push(at);
        cloud.descend(event, [(parent.id, id, piece.primaries, bulk.mass)]);
    }
    Change::Broke
}
