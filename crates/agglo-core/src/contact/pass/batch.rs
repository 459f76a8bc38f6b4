//! What the laws make of the touching pairs of one block, several at a time.

use std::ops::Range;

use super::blocks::Slot;
use super::given::{Given, ends, rows, scalars, vectors};
use super::memory::{SLIDES, TOUCHES};
use super::record::Record;
use super::touch::Touch;
use super::touching::Touching;
use super::world::{ContactRates, ContactWorld, Passage};
use crate::contact::bond::StrainBond;
use crate::contact::friction::{Sliding, TangentialSpring};
use crate::contact::{Along, ContactGeometry, PairConstants, PairTable};
use crate::math::lanes::{Lanes, WIDEST, Work};
use crate::math::{Real, Vector};

/// What a block writes.
pub(super) struct Written<'a> {
    pub slots: &'a mut [Slot],
    pub states: &'a mut [u8],
    pub springs: &'a mut [[f64; 4]],
}

impl Written<'_> {
    /// Cuts it after so many slots and pairs.
    pub fn split_at(self, slots: usize, pairs: usize) -> (Self, Self) {
        let (slots, slots_after) = self.slots.split_at_mut(slots);
        let (states, states_after) = self.states.split_at_mut(pairs);
        // Laws without a memory have no springs.
        let (springs, springs_after) = self.springs.split_at_mut(pairs.min(self.springs.len()));
        let after = Self { slots: slots_after, states: states_after, springs: springs_after };
        (Self { slots, states, springs }, after)
    }
}

/// Sums over contacts, kept in as many parts as there are lanes at most, so that they do not depend on how many there are.
#[derive(Clone, Copy)]
struct Sums<F> {
    damping: [F; WIDEST],
    driven: [F; WIDEST],
    tangential: [F; WIDEST],
    strained: [F; WIDEST],
    worst_strain: [F; WIDEST],
}

impl<F: Lanes> Sums<F> {
    fn none() -> Self {
        let zeros = [F::of(0.0); WIDEST];
        Self { damping: zeros, driven: zeros, tangential: zeros, strained: zeros, worst_strain: zeros }
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
            strained: single(&self.strained),
            worst_strain: single(&self.worst_strain),
        }
    }
}

impl Sums<f64> {
    /// Joins the parts in their order.
    fn rates(&self) -> ContactRates {
        let sum = |parts: &[f64; WIDEST]| parts.iter().fold(0.0, |sum, part| sum + part);
        ContactRates {
            damping: sum(&self.damping),
            driven: sum(&self.driven),
            tangential: sum(&self.tangential),
            strained: sum(&self.strained),
            worst_strain: self.worst_strain.into_iter().fold(0.0, f64::max),
        }
    }
}

/// All contacts of a block of grains.
pub(super) struct BlockOfContacts<'a, 'b> {
    pub given: Given<'a>,
    pub pairs: Range<usize>,
    pub written: &'b mut Written<'a>,
}

impl Work for BlockOfContacts<'_, '_> {
    type Out = ContactRates;

    #[inline(always)]
    fn with<F: Lanes>(self) -> ContactRates {
        let Self { given, pairs, written } = self;
        let mut touching = Touching::among(pairs);
        let mut sums = Sums::<F>::none();
        let constants = given.world.pairs.only().map(PairConstants::of);
        loop {
            let is_last = touching.fill::<F>(&given, written.states);
            // As many as fill the widest lanes, so that a contact's part of the sums does not depend on their width.
            let whole = touching.count / WIDEST * WIDEST;
            for first in (0..whole).step_by(F::COUNT) {
                contacts(&given, written, &touching, first, constants.as_ref(), &mut sums);
            }
            touching.drop_first(whole);
            if is_last {
                break;
            }
        }
        let mut sums = sums.unfolded();
        for at in 0..touching.count {
            contacts(&given, written, &touching, at, None, &mut sums);
        }
        sums.rates()
    }
}

/// Works out contacts side by side, from a place among those that touch.
#[inline(always)]
fn contacts<F: Lanes>(
    given: &Given<'_>,
    written: &mut Written<'_>,
    touching: &Touching,
    first: usize,
    constants: Option<&PairConstants<F>>,
    sums: &mut Sums<F>,
) {
    let (ContactWorld { laws, pairs, .. }, Passage { records, elapsed, dt }) = (given.world, given.passage);
    let lanes = first..first + F::COUNT;
    let ends = ends(records, &touching.owners[lanes.clone()], &touching.partners[lanes]);
    let place = rows::<F>(&ends, |of| &of.place);
    let motion = rows::<F>(&ends, |of| &of.motion);
    let spin = rows::<F>(&ends, |of| &of.spin);
    let centers = vectors(&place);
    let apart = given.world.space.shortest(centers[1] - centers[0]);
    let touch = Touch::new(scalars(&place), scalars(&motion), scalars(&spin), apart);
    let Touch { geometry, normal, lever_arms, .. } = &touch;
    let constants = if let Some(constants) = constants { *constants } else { constants_of(pairs, &ends) };
    let (before, kick) = (vectors(&motion), vectors(&rows::<F>(&ends, |of| &of.kick)));
    let (spin_before, twist) = (vectors(&spin), vectors(&rows::<F>(&ends, |of| &of.twist)));
    let velocities = [before[0] + kick[0], before[1] + kick[1]];
    let spins = [spin_before[0] + twist[0], spin_before[1] + twist[1]];
    let mut velocity = touch.relative_velocity(velocities, spins);
    let space = given.world.space;
    let flow = space.flow(apart);
    if space.is_strained() {
        velocity += flow;
    }
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
            let mut remembered = TangentialSpring::default();
            let has_memory = law.has_memory();
            if has_memory {
                // Sums over both ends of the step.
                let way = [before[0] + velocities[0], before[1] + velocities[1]];
                let turn = [spin_before[0] + spins[0], spin_before[1] + spins[1]];
                let mut path = touch.relative_velocity(way, turn);
                if space.is_strained() {
                    path += flow * F::of(2.0);
                }
                let path = path.rejected_from(*normal);
                sliding.displacement = path * F::of(0.5 * elapsed);
                sliding.turn_about_normal = (turn[0] + turn[1]).dot(*normal) * F::of(0.25 * elapsed);
                remembered = spring_of(given, touching, first);
            }
            let (force, spring) = law.force(&constants, geometry, &sliding, &remembered);
            let touches = F::of(0.0).below(geometry.overlap);
            tangential = Vector::select(touches, force, tangential);
            if has_memory {
                remember(written, touching, first, touches, &spring);
            }
        }
    }
    if let Some(bond) = given.world.bond() {
        repulsion = repulsion - bond.attraction(geometry);
        tangential += grip(bond, geometry, slip, F::of(*dt));
    }
    sums.tangential[part] = sums.tangential[part] + tangential.dot(slip);
    sums.worst_strain[part] = touch.strain.max(sums.worst_strain[part]);

    let force = tangential - *normal * repulsion;
    if space.is_strained() {
        sums.strained[part] = sums.strained[part] + force.dot(flow);
    }
    let couple = normal.cross(tangential);
    put_down(given, written, touching, first, (force, couple, lever_arms));
}

/// What the materials of the pairs have in common.
#[inline(always)]
fn constants_of<F: Lanes>(pairs: &PairTable, ends: &[[&Record; WIDEST]; 2]) -> PairConstants<F> {
    let material = |end: usize, lane: usize| ends[end][lane].kick[3] as u32;
    PairConstants::from_lanes(|lane| pairs.of(material(0, lane), material(1, lane)))
}

/// How a bond that acts in contact resists slip.
#[inline(always)]
fn grip<F: Real>(bond: &StrainBond, geometry: &ContactGeometry<F>, slip: Vector<F>, dt: F) -> Vector<F> {
    let speed = slip.norm();
    let grip = slip * (bond.tangential(geometry, speed, dt) / speed);
    Vector::select(F::of(0.0).below(speed), grip, Vector::default())
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
fn spring_of<F: Lanes>(given: &Given<'_>, touching: &Touching, first: usize) -> TangentialSpring<F> {
    let springs = &given.committed.springs[given.first[1]..];
    let [x, y, z, stiffness] = F::from_rows(|lane| &springs[touching.pair(first + lane)]);
    let mut before = [0; WIDEST];
    for (lane, state) in before.iter_mut().enumerate().take(F::COUNT) {
        *state = touching.before(first + lane);
    }
    let touched = F::mask_from_flags(&before, TOUCHES);
    TangentialSpring {
        force: Vector::select(touched, Vector::new(x, y, z), Vector::default()),
        stiffness: F::select(touched, stiffness, F::of(0.0)),
        sliding: F::both(touched, F::mask_from_flags(&before, SLIDES)),
    }
}

/// Keeps springs; where grains do not touch there is none.
#[inline(always)]
fn remember<F: Lanes>(
    written: &mut Written<'_>,
    touching: &Touching,
    first: usize,
    touches: F::Mask,
    spring: &TangentialSpring<F>,
) {
    let force = Vector::select(touches, spring.force, Vector::default());
    let stiffness = F::select(touches, spring.stiffness, F::of(0.0));
    let slides = F::bits(F::both(touches, spring.sliding));
    F::to_rows([force.x, force.y, force.z, stiffness], |lane, row| {
        let pair = touching.pair(first + lane);
        written.springs[pair] = row;
        written.states[pair] = TOUCHES | (SLIDES * (slides >> lane & 1) as u8);
    });
}

/// Puts forces [N] and torques [N m] on both grains into their slots, contact by contact: moments per arm [N] times the two arms
/// [m]. Arms ride along with the vectors as their fourth numbers, which nobody asks for in a slot.
#[inline(always)]
fn put_down<F: Lanes>(
    given: &Given<'_>,
    written: &mut Written<'_>,
    touching: &Touching,
    first: usize,
    (force, couple, arms): (Vector<F>, Vector<F>, &[F; 2]),
) {
    let (mut forces, mut couples) = ([[0.0; 4]; WIDEST], [[0.0; 4]; WIDEST]);
    F::to_rows([force.x, force.y, force.z, arms[0]], |lane, row| forces[lane] = row);
    F::to_rows([couple.x, couple.y, couple.z, arms[1]], |lane, row| couples[lane] = row);
    for lane in 0..F::COUNT {
        let (force, couple) = (&forces[lane], &couples[lane]);
        let owner = &mut written.slots[touching.owners[first + lane] as usize - given.first[0]];
        for part in 0..4 {
            owner.force[part] += force[part];
            owner.torque[part] += couple[part] * force[3];
        }
        let partner = &mut written.slots[touching.targets[first + lane] as usize];
        for part in 0..4 {
            partner.force[part] -= force[part];
            partner.torque[part] += couple[part] * couple[3];
        }
    }
}
