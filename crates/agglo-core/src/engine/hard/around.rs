//! What is near: for pieces that need room, and for memory that will be needed soon.

use crate::math::{Vec3, prefetch};

use super::agenda::Agenda;
use super::cloud::Surroundings;
use super::grid::Grid;
use super::queue::Soon;
use super::spheres::Spheres;

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

/// What is near a point, by the cells.
pub struct Around<'a> {
    /// The cells.
    pub grid: &'a Grid,
}

impl Surroundings for Around<'_> {
    fn visit_near(
        &self,
        spheres: &Spheres,
        center: Vec3,
        reach: f64,
        time: f64,
        visit: &mut dyn FnMut(u32, Vec3),
    ) {
        for (number, level) in self.grid.levels().iter().enumerate() {
            if level.population > 0 {
                // Cells are about where spheres were when they last moved into one: rounding apart, where they are.
                let farthest = (reach + 0.5 * level.widest()) * (1.0 + 1e-9);
                let corner = Vec3::new(farthest, farthest, farthest);
                let middle = center - self.grid.frame.flown(time);
                self.grid.visit_within(number, [middle - corner, middle + corner], |at, image| {
                    let sphere = &spheres.motion[at as usize];
                    let place = sphere.at(time) + self.grid.shift(image);
                    if (place - center).norm() <= reach + sphere.radius {
                        visit(at, place);
                    }
                });
            }
        }
    }
}
