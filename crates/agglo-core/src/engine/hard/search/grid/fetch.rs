//! What the next event of a sphere will read of the cells, fetched from memory ahead of it.

#![allow(clippy::inline_always, reason = "together these are the innermost loop of the engine")]

use super::{Block, Grid, Level};
use crate::engine::hard::search::next_event::NextEvent;
use crate::engine::hard::spheres::Sphere;
use crate::math::prefetch;

impl Grid {
    /// Visits the occupied cells of its own level that a sphere will look into at its next event.
    #[inline(always)]
    fn each_cell_in_view(&self, next_event: &NextEvent, mut visit: impl FnMut(&Level, u32)) {
        let Some(level) = self.levels.get(next_event.level as usize) else { return };
        let block = if next_event.crossing < next_event.collision {
            let mut next = next_event.cell;
            next[next_event.exit.axis as usize] += i32::from(next_event.exit.side);
            Block::ahead(next, next_event.exit)
        } else {
            Block::around(next_event.cell)
        };
        self.each_cell(level, &block, |flat, _| {
            if level.is_occupied(flat) {
                visit(level, flat);
            }
        });
    }

    /// Fetches from memory which cells are occupied where a sphere will look at its next event.
    #[inline]
    pub fn fetch_words(&self, next_event: &NextEvent) {
        if let Some(level) = self.levels.get(next_event.level as usize) {
            level.fetch_words(next_event.flat);
        }
    }

    /// Fetches from memory the cells that a sphere will look into at its next event.
    #[inline]
    pub fn fetch_cells(&self, next_event: &NextEvent) {
        self.each_cell_in_view(next_event, |level, flat| prefetch(&level.heads, flat as usize));
        if next_event.crossing < next_event.collision && !next_event.exit.is_wall {
            // It will be taken out of one cell and filed in another.
            let level = &self.levels[next_event.level as usize];
            let mut next = *next_event;
            self.step_over(&mut next);
            prefetch(&level.heads, next_event.flat as usize);
            prefetch(&level.heads, self.flat(&next) as usize);
        }
    }

    /// Fetches from memory the first sphere of each of these cells.
    #[inline]
    pub fn fetch_spheres(&self, next_event: &NextEvent, motion: &[Sphere], next_events: &[NextEvent]) {
        self.each_cell_in_view(next_event, |level, flat| {
            let first = level.heads[flat as usize] as usize;
            prefetch(motion, first);
            prefetch(next_events, first);
            prefetch(&self.after, first);
        });
    }

    /// Fetches from memory where a sphere is filed.
    #[inline]
    pub fn fetch_link(&self, sphere: u32) {
        prefetch(&self.after, sphere as usize);
    }
}
