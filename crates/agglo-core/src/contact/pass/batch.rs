//! What the laws make of the touching pairs of one block, several at a time.

use std::ops::Range;

use super::blocks::Slot;
use super::memory::{Memory, SLIDES, TOUCHES};
use super::record::Record;
use super::touch::Touch;
use super::world::{ContactRates, ContactWorld};
use crate::contact::friction::{Sliding, TangentialSpring};
use crate::contact::{Along, PairConstants};
use crate::math::lanes::{Lanes, WIDEST, Work};
use crate::math::{Real, Vector, prefetch};

/// How many pairs ahead the memory of a grain is asked for.
const AHEAD: usize = 16;

/// What a block reads.
#[derive(Clone, Copy)]
pub(super) struct Given<'a> {
    pub world: &'a ContactWorld<'a>,
    pub records: &'a [Record],
    pub committed: &'a Memory,
    /// Slots of the partners of the block's pairs.
    pub targets: &'a [u32],
    /// The block's first grain and first pair.
    pub first: [usize; 2],
}

/// What a block writes.
pub(super) struct Written<'a> {
    pub slots: &'a mut [Slot],
    pub states: &'a mut [u8],
    pub springs: &'a mut [[f64; 4]],
    /// Room for the numbers of the pairs that touch, counted from the block's first.
    pub active: &'a mut [u32],
}

impl Written<'_> {
    /// Cuts it after so many slots and pairs.
    pub fn split_at(self, slots: usize, pairs: usize) -> (Self, Self) {
        let (slots, slots_after) = self.slots.split_at_mut(slots);
        let (states, states_after) = self.states.split_at_mut(pairs);
        // Laws without a memory have no springs.
        let (springs, springs_after) = self.springs.split_at_mut(pairs.min(self.springs.len()));
        let (active, active_after) = self.active.split_at_mut(pairs);
        let after =
            Self { slots: slots_after, states: states_after, springs: springs_after, active: active_after };
        (Self { slots, states, springs, active }, after)
    }
}

/// Sums over contacts, kept in as many parts as there are lanes at most, so that they do not depend on how many there are.
#[derive(Clone, Copy)]
struct Sums<F> {
    damping: [F; WIDEST],
    driven: [F; WIDEST],
    tangential: [F; WIDEST],
    /// Largest strains, and the places of their contacts.
    worst: [F; WIDEST],
    worst_at: [F; WIDEST],
}

impl<F: Lanes> Sums<F> {
    fn none() -> Self {
        let zeros = [F::of(0.0); WIDEST];
        Self { damping: zeros, driven: zeros, tangential: zeros, worst: zeros, worst_at: zeros }
    }

    /// The same as single numbers.
    #[inline(always)]
    fn unfolded(&self) -> Sums<f64> {
        let single =
            |parts: &[F; WIDEST]| std::array::from_fn(|part| parts[part / F::COUNT].lane(part % F::COUNT));
        Sums {
            damping: single(&self.damping),
            driven: single(&self.driven),
            tangential: single(&self.tangential),
            worst: single(&self.worst),
            worst_at: single(&self.worst_at),
        }
    }
}

/// Finds the pairs of a block that touch, without a branch on it, and puts their numbers first.
pub(super) fn find_touching(given: &Given<'_>, grains: Range<usize>, written: &mut Written<'_>) -> usize {
    let (list, beyond) = (given.world.list, given.world.beyond());
    let partners = list.partners();
    let mut count = 0;
    for owner in grains {
        let [x, y, z, radius] = given.records[owner].place;
        for pair in list.owned(owner) {
            if let Some(&ahead) = partners.get(pair + AHEAD) {
                prefetch(given.records, ahead as usize);
            }
            let [other_x, other_y, other_z, other_radius] = given.records[partners[pair] as usize].place;
            let apart = Vector::new(other_x - x, other_y - y, other_z - z);
            let reach = radius + other_radius + beyond;
            let touches = apart.norm_squared() < reach * reach;
            let local = pair - given.first[1];
            written.states[local] = u8::from(touches);
            written.active[count] = local as u32;
            count += usize::from(touches);
        }
    }
    count
}

/// The touching pairs of a block.
pub(super) struct Touching<'a, 'b> {
    pub given: Given<'a>,
    pub written: &'b mut Written<'a>,
    pub count: usize,
}

impl Work for Touching<'_, '_> {
    type Out = ContactRates;

    #[inline(always)]
    fn with<F: Lanes>(self) -> ContactRates {
        let Self { given, written, count } = self;
        let whole = count / F::COUNT * F::COUNT;
        let mut sums = Sums::<F>::none();
        let constants = given.world.pairs.only().map(PairConstants::of);
        for first in (0..whole).step_by(F::COUNT) {
            contacts(&given, written, first, constants.as_ref(), &mut sums);
        }
        let mut sums = sums.unfolded();
        for at in whole..count {
            contacts(&given, written, at, None, &mut sums);
        }
        rates(&given, written, &sums)
    }
}

/// Joins the parts of the sums in their order.
fn rates(given: &Given<'_>, written: &Written<'_>, sums: &Sums<f64>) -> ContactRates {
    let sum = |parts: &[f64; WIDEST]| parts.iter().fold(0.0, |sum, part| sum + part);
    let mut found = ContactRates {
        damping: sum(&sums.damping),
        driven: sum(&sums.driven),
        tangential: sum(&sums.tangential),
        ..ContactRates::default()
    };
    let mut worst_at = f64::INFINITY;
    for (strain, at) in sums.worst.iter().zip(&sums.worst_at) {
        if *strain > found.worst_strain || (*strain == found.worst_strain && *at < worst_at) {
            (found.worst_strain, worst_at) = (*strain, *at);
        }
    }
    if found.worst_strain > 0.0 {
        let pair = given.first[1] + written.active[worst_at as usize] as usize;
        let list = given.world.list;
        found.worst_pair = [list.owners()[pair], list.partners()[pair]];
    }
    found
}

/// Works out contacts side by side, from a place among those that touch.
#[inline(always)]
fn contacts<F: Lanes>(
    given: &Given<'_>,
    written: &mut Written<'_>,
    first: usize,
    constants: Option<&PairConstants<F>>,
    sums: &mut Sums<F>,
) {
    let ContactWorld { laws, list, pairs, elapsed, dt, .. } = given.world;
    let (mut local, mut grains) = ([0; WIDEST], [[0; WIDEST]; 2]);
    for lane in 0..F::COUNT {
        local[lane] = written.active[first + lane] as usize;
        let pair = given.first[1] + local[lane];
        grains[0][lane] = list.owners()[pair] as usize;
        grains[1][lane] = list.partners()[pair] as usize;
    }
    let records = given.records;
    let place = rows::<F>(records, &grains, |of| &of.place);
    let motion = rows::<F>(records, &grains, |of| &of.motion);
    let spin = rows::<F>(records, &grains, |of| &of.spin);
    let centers = vectors(&place);
    let touch = Touch::new(scalars(&place), scalars(&motion), scalars(&spin), centers[1] - centers[0]);
    let Touch { geometry, normal, lever_arms } = &touch;
    let constants = if let Some(constants) = constants {
        *constants
    } else {
        let material = |end: usize, lane: usize| records[grains[end][lane]].way[3] as u32;
        PairConstants::from_lanes(|lane| pairs.of(material(0, lane), material(1, lane)))
    };
    let velocity = touch.relative_velocity(vectors(&motion), vectors(&spin));
    let separation = velocity.dot(*normal);
    let slip = velocity - *normal * separation;

    let part = first / F::COUNT % (WIDEST / F::COUNT);
    let (mut repulsion, mut tangential) = (F::of(0.0), Vector::default());
    if let Some(laws) = laws {
        let along = laws.along(&constants, geometry, separation);
        repulsion = along.repulsion;
        sums.damping[part] = sums.damping[part] + along.dissipation;
        sums.driven[part] = sums.driven[part] + along.driven;
        if let Some(law) = &laws.friction {
            let mut sliding = sliding(&along, *normal, slip, F::of(*dt));
            let mut before = TangentialSpring::default();
            let has_memory = law.has_memory();
            if has_memory {
                let way = vectors(&rows::<F>(records, &grains, |of| &of.way));
                let turn = vectors(&rows::<F>(records, &grains, |of| &of.turn));
                let path = touch.relative_velocity(way, turn).rejected_from(*normal);
                sliding.displacement = path * F::of(0.5 * elapsed);
                sliding.turn_about_normal = (turn[0] + turn[1]).dot(*normal) * F::of(0.25 * elapsed);
                before = remembered(given, &local);
            }
            let (force, spring) = law.force(&constants, geometry, &sliding, &before);
            let touches = F::of(0.0).below(geometry.overlap);
            tangential = Vector::select(touches, force, tangential);
            if has_memory {
                remember(written, &local, touches, &spring);
            }
        }
    }
    if let Some(bond) = given.world.bond() {
        repulsion = repulsion - bond.attraction(geometry);
        let speed = slip.norm();
        let grip = slip * (bond.tangential(geometry, speed, F::of(*dt)) / speed);
        tangential += Vector::select(F::of(0.0).below(speed), grip, Vector::default());
    }
    sums.tangential[part] = sums.tangential[part] + tangential.dot(slip);
    let strain = geometry.strain();
    let higher = sums.worst[part].below(strain);
    sums.worst[part] = F::select(higher, strain, sums.worst[part]);
    let at = F::from_lanes(|lane| (first + lane) as f64);
    sums.worst_at[part] = F::select(higher, at, sums.worst_at[part]);

    let force = tangential - *normal * repulsion;
    let couple = normal.cross(tangential);
    let torques = [couple * lever_arms[0], couple * lever_arms[1]];
    put_down(given, written, (&local, &grains[0]), force, torques);
}

/// Rows of both ends of each contact.
#[inline(always)]
fn rows<F: Lanes>(
    records: &[Record],
    grains: &[[usize; WIDEST]; 2],
    row: impl Fn(&Record) -> &[f64; 4],
) -> [[F; 4]; 2] {
    [F::from_rows(|lane| row(&records[grains[0][lane]])), F::from_rows(|lane| row(&records[grains[1][lane]]))]
}

#[inline(always)]
fn vectors<F: Lanes>([a, b]: &[[F; 4]; 2]) -> [Vector<F>; 2] {
    [Vector::new(a[0], a[1], a[2]), Vector::new(b[0], b[1], b[2])]
}

#[inline(always)]
fn scalars<F: Lanes>([a, b]: &[[F; 4]; 2]) -> [F; 2] {
    [a[3], b[3]]
}

/// What friction needs to know that does not go back to the start of the step.
#[inline(always)]
fn sliding<F: Real>(along: &Along<F>, normal: Vector<F>, slip: Vector<F>, dt: F) -> Sliding<F> {
    Sliding {
        normal,
        velocity: slip,
        elastic: along.elastic,
        normal_dashpot: along.dashpot,
        normal_force: along.repulsion,
        dt,
        ..Sliding::default()
    }
}

/// The springs that the pairs had when the step began.
#[inline(always)]
fn remembered<F: Lanes>(given: &Given<'_>, local: &[usize; WIDEST]) -> TangentialSpring<F> {
    let pair = |lane: usize| given.first[1] + local[lane];
    let has = |lane: usize, flag: u8| given.committed.states[pair(lane)] & flag != 0;
    let [x, y, z, stiffness] = F::from_rows(|lane| &given.committed.springs[pair(lane)]);
    let touched = F::mask_from_lanes(|lane| has(lane, TOUCHES));
    TangentialSpring {
        force: Vector::select(touched, Vector::new(x, y, z), Vector::default()),
        stiffness: F::select(touched, stiffness, F::of(0.0)),
        sliding: F::both(touched, F::mask_from_lanes(|lane| has(lane, SLIDES))),
    }
}

/// Keeps springs; where grains do not touch there is none.
#[inline(always)]
fn remember<F: Lanes>(
    written: &mut Written<'_>,
    local: &[usize; WIDEST],
    touches: F::Mask,
    spring: &TangentialSpring<F>,
) {
    let force = Vector::select(touches, spring.force, Vector::default());
    let stiffness = F::select(touches, spring.stiffness, F::of(0.0));
    let slides = F::both(touches, spring.sliding);
    F::to_rows([force.x, force.y, force.z, stiffness], |lane, row| {
        written.springs[local[lane]] = row;
    });
    for (lane, pair) in local.iter().enumerate().take(F::COUNT) {
        written.states[*pair] |= if F::lane_of_mask(slides, lane) { SLIDES } else { 0 };
    }
}

/// Puts forces [N] and the torques [N m] on both grains into their slots, contact by contact.
#[inline(always)]
fn put_down<F: Lanes>(
    given: &Given<'_>,
    written: &mut Written<'_>,
    (local, owners): (&[usize; WIDEST], &[usize; WIDEST]),
    force: Vector<F>,
    torques: [Vector<F>; 2],
) {
    let (mut forces, mut ends) = ([[0.0; 4]; WIDEST], [[[0.0; 4]; WIDEST]; 2]);
    let zero = F::of(0.0);
    let [on_owner, on_partner] = torques;
    F::to_rows([force.x, force.y, force.z, zero], |lane, row| forces[lane] = row);
    F::to_rows([on_owner.x, on_owner.y, on_owner.z, zero], |lane, row| ends[0][lane] = row);
    F::to_rows([on_partner.x, on_partner.y, on_partner.z, zero], |lane, row| ends[1][lane] = row);
    for lane in 0..F::COUNT {
        let owner = &mut written.slots[owners[lane] - given.first[0]];
        for part in 0..4 {
            owner.force[part] += forces[lane][part];
            owner.torque[part] += ends[0][lane][part];
        }
        let partner = &mut written.slots[given.targets[local[lane]] as usize];
        for part in 0..4 {
            partner.force[part] -= forces[lane][part];
            partner.torque[part] += ends[1][lane][part];
        }
    }
}
