//! What the next events will need, fetched from memory ahead of them.

use crate::engine::hard::search::{Grid, NextEvent};
use crate::engine::hard::spheres::Spheres;
use crate::math::prefetch;

use super::queue::Soon;

/// From this many spheres on, they are fetched from memory ahead of their events: fewer stay near the processor anyway.
const MANY: usize = 40_000;

/// Fetches from memory what the next event of a sphere will need: first its own, then what says which of the cells about it
/// hold any, then those cells, then the spheres there.
#[inline]
pub fn fetch(soon: Soon, next_events: &[NextEvent], grid: &Grid, spheres: &Spheres, sphere: u32) {
    if next_events.len() < MANY {
        return;
    }
    let at = sphere as usize;
    match soon {
        Soon::Someday => {
            prefetch(next_events, at);
            prefetch(&spheres.motion, at);
            grid.fetch_link(sphere);
        }
        Soon::Later => {
            let next_event = &next_events[at];
            if next_event.collision < next_event.crossing {
                let partner = next_event.partner as usize;
                prefetch(next_events, partner);
                prefetch(&spheres.motion, partner);
                prefetch(&spheres.bulk, partner);
                prefetch(&spheres.bulk, at);
            }
            grid.fetch_words(&next_events[at]);
        }
        Soon::Next => grid.fetch_cells(&next_events[at]),
        Soon::Now => grid.fetch_spheres(&next_events[at], &spheres.motion, next_events),
    }
}
