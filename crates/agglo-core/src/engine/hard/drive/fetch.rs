//! What the next events will need, fetched from memory ahead of them.

use crate::engine::hard::search::{Agenda, Grid};
use crate::engine::hard::spheres::Spheres;
use crate::math::prefetch;

use super::queue::Soon;

/// From this many spheres on, they are fetched from memory ahead of their events: fewer stay near the processor anyway.
const MANY: usize = 40_000;

/// Fetches from memory what the next event of a sphere will need: first its own, then what says which of the cells about it
/// hold any, then those cells, then the spheres there.
#[inline]
pub fn fetch(soon: Soon, agendas: &[Agenda], grid: &Grid, spheres: &Spheres, sphere: u32) {
    if agendas.len() < MANY {
        return;
    }
    let at = sphere as usize;
    match soon {
        Soon::Someday => {
            prefetch(agendas, at);
            prefetch(&spheres.motion, at);
            grid.fetch_link(sphere);
        }
        Soon::Later => {
            let agenda = &agendas[at];
            if agenda.collision < agenda.crossing {
                let partner = agenda.partner as usize;
                prefetch(agendas, partner);
                prefetch(&spheres.motion, partner);
                prefetch(&spheres.bulk, partner);
                prefetch(&spheres.bulk, at);
            }
            grid.fetch_words(&agendas[at]);
        }
        Soon::Next => grid.fetch_cells(&agendas[at]),
        Soon::Now => grid.fetch_spheres(&agendas[at], &spheres.motion, agendas),
    }
}
