//! Whether what the event-driven engine remembered is what the spheres of a system can have come to.

use crate::domain::Boundary;
use crate::engine::hard::collide::HardSystem;
use crate::engine::hard::search::NextEvent;
use crate::engine::hard::spheres::{Bulk, NONE};
use crate::engine::validate::{Fault, ensure, finite, length};
use crate::math::Vec3;

use super::filed::EventsState;

/// A grid is made anew when spheres have become so many times more or smaller.
const FAR_FROM: f64 = 1e6;

/// Edges of the volume that a sphere may be away from the corner of the cells.
const NEAR_CELLS: f64 = 4.0;

impl EventsState<'_> {
    /// Whether it is one that the spheres of a system can have come to by `time` [s].
    ///
    /// # Errors
    /// What is wrong with it.
    pub(in crate::engine::hard) fn validate(&self, system: &HardSystem, time: f64) -> Result<(), Fault> {
        let spheres = &system.state.spheres;
        length("next_events", self.next_events.len(), spheres.slots())?;
        finite("cells", &self.filed)?;
        finite("frame", &self.frame)?;
        let now = self.filed.renewed(spheres);
        let near = |found: f64, now: f64| found > now / FAR_FROM && found < now * FAR_FROM;
        let same = near(self.filed.smallest, now.smallest)
            && self.filed.spheres > 0
            && self.filed.spheres <= spheres.slots() as u64 * 64;
        ensure(same && self.filed.moment <= time, || "cells: made for other spheres".to_owned())?;
        let grid = self.filed.grid(&system.volume);
        let levels = grid.levels();
        length("levels", self.velocities.len(), levels.len())?;
        let edges = system.volume.edges();
        let flown = self.frame.lower - system.volume.lower();
        let is_far = (0..3).any(|axis| flown[axis].abs() > FAR_FROM * edges[axis]);
        ensure(!is_far && (0.0..=time).contains(&self.frame.since), || "frame: it is far away".to_owned())?;
        let corner = self.frame.lower + self.frame.flown(time);
        let inside = |at: u32| {
            let way = spheres.motion[at as usize].at(time) - corner;
            (0..3).all(|axis| way[axis].abs() <= NEAR_CELLS * edges[axis])
        };
        let is_open = system.volume.boundary == Boundary::Open;
        ensure(is_open || spheres.living().all(inside), || "a grain is far from the cells".to_owned())?;
        let bounds = |bounds: &[Vec3; 2]| bounds.iter().all(|bound| !bound.sum_of_sizes().is_nan());
        ensure(self.velocities.iter().all(bounds), || "velocities are no numbers".to_owned())?;
        for (at, next_event) in self.next_events.iter().enumerate() {
            let bulk = &spheres.bulk[at];
            if !bulk.lives() {
                let same = NextEvent { flat: NONE, bin: NONE, ..*next_event } == NextEvent::EMPTY;
                ensure(same, || format!("slot {at} is empty and has a next event"))?;
                continue;
            }
            let cells = levels.get(next_event.level as usize).map(|level| level.counts);
            let inside = cells.is_some_and(|cells| {
                system.volume.boundary == Boundary::Open
                    || next_event.cell.iter().zip(cells).all(|(cell, count)| (0..count).contains(cell))
            });
            let of_partner = self.next_events.get(next_event.partner as usize);
            let partner = next_event.partner == NONE
                || spheres.bulk.get(next_event.partner as usize).is_some_and(Bulk::lives)
                    && of_partner.is_some_and(|other| other.partner as usize == at);
            let images = next_event.image.iter().all(|image| (-2..=2).contains(image));
            let exit = next_event.exit.axis < 3 && (-1..=1).contains(&next_event.exit.side);
            let times = next_event.collision >= self.filed.moment && next_event.crossing >= self.filed.moment;
            ensure(inside && partner && images && exit && times && next_event.id == bulk.id, || {
                format!("the next event of grain {} is none", bulk.id)
            })?;
        }
        Ok(())
    }
}
