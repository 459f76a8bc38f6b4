//! The one loop over pairs: which touch, or are within the reach of a law, and what the contact laws make of it.
//!
//! Each touching pair is computed once, in blocks of grains (`blocks`) and several pairs side by side (`batch`). Loads and rates
//! have the same bits for any number of threads and lanes, whatever the list has besides the pairs that touch. Memory of
//! contacts (tangential springs) is committed only when a step is accepted, so a step can be tried again.

mod batch;
mod blocks;
mod energy;
mod given;
mod memory;
mod record;
mod touch;
mod touching;
mod world;

pub use energy::{ContactEnergy, contact_energy, contact_pace, deepest_pair};
pub use memory::Remembered;
pub use record::{Centers, Record};
pub use world::{ContactRates, ContactWorld, Passage, Snapshot};

use std::ops::Range;

use super::ContactLaws;
use super::friction::TangentialSpring;
use crate::link::Domain;
use crate::math::lanes::{Work, widest};
use crate::math::parallel::BLOCK;
use crate::math::{Vec3, parallel, refill};
use crate::neighbors::PairList;
use batch::{BlockOfContacts, Written};
use blocks::{Blocks, Slot, grains_of};
use given::Given;
use memory::{Memory, SLIDES, TOUCHES};

/// Loads and memory of all candidate pairs.
#[derive(Debug, Default)]
pub struct Contacts {
    blocks: Blocks,
    slots: Vec<Slot>,
    committed: Memory,
    trial: Memory,
    /// Committed contacts of pairs that the list left out because a try, not yet accepted, has parted them.
    parted: Vec<Remembered>,
    /// Grains of the contacts that are set aside in `trial` while a list is built anew.
    aside: Vec<[u32; 2]>,
}

/// What a pass writes, cut between blocks.
struct Room<'a> {
    written: Written<'a>,
    starts: &'a [u32],
    blocks: &'a Blocks,
}

/// The pairs whose owners lie in some blocks; those of a grain begin at its place in `starts`.
fn pairs_of(blocks: Range<usize>, starts: &[u32]) -> Range<usize> {
    let first = |block: usize| starts[(block * BLOCK).min(starts.len() - 1)] as usize;
    first(blocks.start)..first(blocks.end)
}

impl parallel::Split for Room<'_> {
    fn split(self, range: &Range<usize>, at: usize) -> (Self, Self) {
        let Self { written, starts, blocks } = self;
        let pairs = pairs_of(range.start..at, starts).len();
        let (before, after) = written.split_at(blocks.slots_of(range.start..at).len(), pairs);
        (Self { written: before, starts, blocks }, Self { written: after, starts, blocks })
    }
}

impl Contacts {
    /// Sets the committed contacts aside, before the list is built anew; `place` says where a grain comes to. They take the room
    /// of those that are tried, whose loads must be worked out again.
    pub fn set_aside(&mut self, list: &PairList, place: impl Fn(u32) -> Option<u32>) {
        let Self { committed, trial, parted, aside, .. } = self;
        trial.clear();
        aside.clear();
        for (a, b, spring) in committed.touching(list).chain(parted.drain(..)) {
            if let (Some(a), Some(b)) = (place(a), place(b)) {
                aside.push([a, b]);
                trial.push(&spring);
            }
        }
    }

    /// Sets contacts aside in place of the committed ones.
    pub fn set_aside_these(&mut self, remembered: &[Remembered]) {
        self.parted.clear();
        self.trial.clear();
        self.aside = remembered.iter().map(|(a, b, _)| [*a, *b]).collect();
        for (.., spring) in remembered {
            self.trial.push(spring);
        }
    }

    /// Makes room for the pairs of a new list over `n` grains and puts the contacts that were set aside in their new places.
    pub fn relist(&mut self, list: &PairList, n: usize, laws: Option<&ContactLaws>) {
        let with_springs = laws.is_some_and(ContactLaws::has_memory);
        self.blocks.relist(list, n);
        refill(&mut self.slots, self.blocks.len(), Slot::default());
        self.committed.resize(list.len(), with_springs);
        for (at, [a, b]) in std::mem::take(&mut self.aside).into_iter().enumerate() {
            let Some(spring) = self.trial.of(at) else { continue };
            let mirrored = TangentialSpring { force: -spring.force, ..spring };
            let place = list.find(a, b).map(|pair| (pair, spring));
            if let Some((pair, spring)) = place.or_else(|| list.find(b, a).map(|pair| (pair, mirrored))) {
                self.committed.put(pair, &spring);
            } else {
                self.parted.push((a, b, spring));
            }
        }
        self.trial.resize(list.len(), with_springs);
    }

    /// The committed contacts with their memory.
    pub fn remembered<'a>(&'a self, list: &'a PairList) -> impl Iterator<Item = Remembered> + 'a {
        self.committed.touching(list).chain(self.parted.iter().copied())
    }

    /// Keeps the memory of the last pass.
    pub fn commit(&mut self) {
        std::mem::swap(&mut self.committed, &mut self.trial);
        self.parted.clear();
    }

    /// Keeps the memory of a pass over which no time went by: contacts that slid before still slide, though nothing moved.
    pub fn commit_unmoved(&mut self) {
        for (state, before) in self.trial.states.iter_mut().zip(&self.committed.states) {
            if *state & *before & TOUCHES != 0 {
                *state |= before & SLIDES;
            }
        }
        self.commit();
    }

    /// Force [N] and torque [N m] of all contacts on a grain in the last pass.
    #[inline(always)]
    pub fn load_on(&self, grain: usize) -> (Vec3, Vec3) {
        self.blocks.load_on(grain, &self.slots)
    }

    /// Energy [J] of the committed tangential springs.
    pub fn spring_energy(&self, list: &PairList) -> f64 {
        if self.committed.springs.is_empty() {
            return 0.0;
        }
        parallel::sum(list.starts().len() - 1, |owner| {
            let springs = list.owned(owner).filter_map(|pair| self.committed.of(pair));
            springs.map(|spring| spring.energy()).fold(0.0, |a, b| a + b)
        })
    }

    /// Computes the loads of all touching pairs.
    pub fn compute(
        &mut self,
        domain: &Domain,
        world: &ContactWorld<'_>,
        passage: &Passage<'_>,
    ) -> ContactRates {
        // A formula has no lanes.
        let is_one_by_one = world.laws.is_some_and(|laws| laws.custom.is_some());
        self.compute_as(domain, world, passage, is_one_by_one)
    }

    fn compute_as(
        &mut self,
        domain: &Domain,
        world: &ContactWorld<'_>,
        passage: &Passage<'_>,
        is_one_by_one: bool,
    ) -> ContactRates {
        let Self { blocks, slots, committed, trial, .. } = self;
        let (blocks, committed, n) = (&*blocks, &*committed, passage.records.len());
        if n == 0 {
            return ContactRates::default();
        }
        let starts = world.list.starts();
        let (states, springs) = (&mut trial.states[..], &mut trial.springs[..]);
        let room = Room { written: Written { slots, states, springs }, starts, blocks };
        let leaf = |one: Range<usize>, room: Room<'_>| {
            let grains = grains_of(one.start, n);
            let pairs = pairs_of(one, starts);
            let (first, targets) = ([grains.start, pairs.start], &blocks.targets()[pairs.clone()]);
            let given = Given { world, passage, committed, targets, first };
            let mut written = room.written;
            written.slots.fill(Slot::default());
            let contacts = BlockOfContacts { given, pairs, written: &mut written };
            if is_one_by_one { contacts.with::<f64>() } else { widest(contacts) }
        };
        let rates = domain.over(0..blocks.count(), 1, room, &leaf, &ContactRates::join);
        let (count, has_springs) = (blocks.count(), !trial.springs.is_empty());
        domain.share(slots, count, |own| blocks.slots_of(own));
        domain.share(&mut trial.states, count, |own| pairs_of(own, starts));
        let springs_of = |own| if has_springs { pairs_of(own, starts) } else { 0..0 };
        domain.share(&mut trial.springs, count, springs_of);
        rates
    }
}

#[cfg(test)]
mod tests;
