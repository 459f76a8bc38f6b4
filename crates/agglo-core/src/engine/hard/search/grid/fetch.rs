//! What the next event of a sphere will read of the cells, fetched from memory ahead of it.

#![allow(clippy::inline_always, reason = "together these are the innermost loop of the engine")]

use super::{Block, Grid, Level};
use crate::engine::hard::search::next_event::Agenda;
use crate::engine::hard::spheres::Sphere;
use crate::math::prefetch;

impl Grid {
    /// Visits the occupied cells of its own level that a sphere will look into at its next event.
    #[inline(always)]
    fn each_cell_in_view(&self, agenda: &Agenda, mut visit: impl FnMut(&Level, u32)) {
        let Some(level) = self.levels.get(agenda.level as usize) else { return };
        let block = if agenda.crossing < agenda.collision {
            let mut next = agenda.cell;
            next[agenda.exit.axis as usize] += i32::from(agenda.exit.side);
            Block::ahead(next, agenda.exit)
        } else {
            Block::around(agenda.cell)
        };
        self.each_cell(level, &block, |flat, _| {
            if level.is_occupied(flat) {
                visit(level, flat);
            }
        });
    }

    /// Fetches from memory which cells are occupied where a sphere will look at its next event.
    #[inline]
    pub fn fetch_words(&self, agenda: &Agenda) {
        if let Some(level) = self.levels.get(agenda.level as usize) {
            level.fetch_words(agenda.flat);
        }
    }

    /// Fetches from memory the cells that a sphere will look into at its next event.
    #[inline]
    pub fn fetch_cells(&self, agenda: &Agenda) {
        self.each_cell_in_view(agenda, |level, flat| prefetch(&level.heads, flat as usize));
        if agenda.crossing < agenda.collision && !agenda.exit.is_wall {
            // It will be taken out of one cell and filed in another.
            let level = &self.levels[agenda.level as usize];
            let mut next = *agenda;
            self.step_over(&mut next);
            prefetch(&level.heads, agenda.flat as usize);
            prefetch(&level.heads, self.flat(&next) as usize);
        }
    }

    /// Fetches from memory the first sphere of each of these cells.
    #[inline]
    pub fn fetch_spheres(&self, agenda: &Agenda, motion: &[Sphere], agendas: &[Agenda]) {
        self.each_cell_in_view(agenda, |level, flat| {
            let first = level.heads[flat as usize] as usize;
            prefetch(motion, first);
            prefetch(agendas, first);
            prefetch(&self.after, first);
        });
    }

    /// Fetches from memory where a sphere is filed.
    #[inline]
    pub fn fetch_link(&self, sphere: u32) {
        prefetch(&self.after, sphere as usize);
    }
}
