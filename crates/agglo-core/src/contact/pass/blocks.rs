//! Where the loads of contacts are put down.
//!
//! Grains are taken in blocks of [`BLOCK`], fixed by their places in memory and never by threads. A block has the pairs whose
//! owner lies in it, and a slot for each of its grains, then one for each partner of another block (a ghost), in rising
//! order. It puts the loads of its contacts into its own slots, free of races and branches. A grain's load is then that in
//! its own slot and those in its ghosts by rising block: a sum whose order depends on what touches alone, since a ghost
//! without a contact adds zero.

use std::ops::Range;

use rayon::prelude::*;

use crate::link::row_of_fields;
use crate::math::parallel::BLOCK;
use crate::math::{Groups, Vec3, refill};
use crate::neighbors::PairList;

/// Force [N] and torque about the center [N m], each with a number unused.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(64))]
pub(super) struct Slot {
    pub force: [f64; 4],
    pub torque: [f64; 4],
}

row_of_fields!(Slot { force: [f64; 4], torque: [f64; 4] });

/// The slots of all blocks.
#[derive(Debug, Default)]
pub(super) struct Blocks {
    /// Where the slots of each block begin: [blocks + 1].
    first: Vec<u32>,
    /// Slot of each pair's partner, counted from the first of its block.
    targets: Vec<u32>,
    /// Slots in other blocks that each grain hears, by rising block.
    heard: Groups,
    /// Partners from other blocks, in rising order, of each block.
    ghosts: Vec<Vec<u32>>,
}

impl Blocks {
    /// Gives slots to the grains and pairs of a new list over `n` grains.
    pub fn relist(&mut self, list: &PairList, n: usize) {
        self.ghosts.resize_with(n.div_ceil(BLOCK), Vec::new);
        refill(&mut self.targets, list.len(), 0);
        let (starts, partners) = (list.starts(), list.partners());
        let mut rest = self.targets.as_mut_slice();
        let mut tasks = Vec::with_capacity(self.ghosts.len());
        for (block, ghosts) in self.ghosts.iter_mut().enumerate() {
            let grains = grains_of(block, n);
            let pairs = starts[grains.start] as usize..starts[grains.end] as usize;
            let (targets, after) = rest.split_at_mut(pairs.len());
            rest = after;
            tasks.push((grains, &partners[pairs], ghosts, targets));
        }
        tasks.into_par_iter().for_each(|(grains, partners, ghosts, targets)| {
            ghosts.clear();
            ghosts.extend(partners.iter().filter(|partner| !grains.contains(&(**partner as usize))));
            ghosts.sort_unstable();
            ghosts.dedup();
            for (target, partner) in targets.iter_mut().zip(partners) {
                let own = (*partner as usize).wrapping_sub(grains.start);
                let ghost = || grains.len() + ghosts.partition_point(|ghost| ghost < partner);
                *target = if own < grains.len() { own } else { ghost() } as u32;
            }
        });
        self.count_slots(n);
    }

    fn count_slots(&mut self, n: usize) {
        self.first.clear();
        self.first.push(0);
        for (block, ghosts) in self.ghosts.iter().enumerate() {
            self.first.push(self.first[block] + (grains_of(block, n).len() + ghosts.len()) as u32);
        }
        let heard = self.ghosts.iter().zip(&self.first[1..]).flat_map(|(ghosts, &end)| {
            let slots = end - ghosts.len() as u32..end;
            ghosts.iter().copied().zip(slots)
        });
        self.heard.fill(n, heard);
    }

    /// How many slots there are.
    pub fn len(&self) -> usize {
        self.first.last().map_or(0, |last| *last as usize)
    }

    /// How many blocks there are.
    pub fn count(&self) -> usize {
        self.ghosts.len()
    }

    /// The slots of some blocks.
    pub fn slots_of(&self, blocks: Range<usize>) -> Range<usize> {
        self.first[blocks.start] as usize..self.first[blocks.end] as usize
    }

    /// Slot of each pair's partner, counted from the first of its block.
    pub fn targets(&self) -> &[u32] {
        &self.targets
    }

    /// Force [N] and torque [N m] on a grain.
    #[inline(always)]
    pub fn load_on(&self, grain: usize, slots: &[Slot]) -> (Vec3, Vec3) {
        let own = slots[self.first[grain / BLOCK] as usize + grain % BLOCK];
        let (mut force, mut torque) = (own.force, own.torque);
        for &slot in self.heard.of(grain) {
            let ghost = &slots[slot as usize];
            force.iter_mut().zip(ghost.force).for_each(|(sum, part)| *sum += part);
            torque.iter_mut().zip(ghost.torque).for_each(|(sum, part)| *sum += part);
        }
        (Vec3::new(force[0], force[1], force[2]), Vec3::new(torque[0], torque[1], torque[2]))
    }
}

/// The grains of a block among `n`.
pub(super) fn grains_of(block: usize, n: usize) -> Range<usize> {
    block * BLOCK..((block + 1) * BLOCK).min(n)
}
