//! Whether what the event-driven engine remembered is what the spheres of a cloud can have come to.

use crate::domain::Boundary;
use crate::engine::hard::collide::Cloud;
use crate::engine::hard::search::Agenda;
use crate::engine::hard::spheres::{Bulk, NONE};
use crate::engine::validate::{Fault, ensure, finite, length};
use crate::math::Vec3;

use super::event_driven::EventsState;

/// A grid is made anew when spheres have become so many times more or smaller.
const FAR_FROM: f64 = 1e6;

/// Edges of the volume that a sphere may be away from the corner of the cells.
const NEAR_CELLS: f64 = 4.0;

impl EventsState<'_> {
    /// Whether it is one that the spheres of a cloud can have come to by `time` [s].
    ///
    /// # Errors
    /// What is wrong with it.
    pub(in crate::engine::hard) fn validate(&self, cloud: &Cloud, time: f64) -> Result<(), Fault> {
        let spheres = &cloud.state.spheres;
        length("agendas", self.agendas.len(), spheres.places())?;
        finite("cells", &self.filed)?;
        finite("frame", &self.frame)?;
        let now = self.filed.renewed(spheres);
        let near = |found: f64, now: f64| found > now / FAR_FROM && found < now * FAR_FROM;
        let same = near(self.filed.smallest, now.smallest)
            && self.filed.spheres > 0
            && self.filed.spheres <= spheres.places() as u64 * 64;
        ensure(same && self.filed.moment <= time, || "cells: made for other spheres".to_owned())?;
        let grid = self.filed.grid(&cloud.volume);
        let levels = grid.levels();
        length("levels", self.velocities.len(), levels.len())?;
        let edges = cloud.volume.edges();
        let flown = self.frame.lower - cloud.volume.lower();
        let is_far = (0..3).any(|axis| flown[axis].abs() > FAR_FROM * edges[axis]);
        ensure(!is_far && (0.0..=time).contains(&self.frame.since), || "frame: it is far away".to_owned())?;
        let corner = self.frame.lower + self.frame.flown(time);
        let inside = |at: u32| {
            let way = spheres.motion[at as usize].at(time) - corner;
            (0..3).all(|axis| way[axis].abs() <= NEAR_CELLS * edges[axis])
        };
        let is_open = cloud.volume.boundary == Boundary::Open;
        ensure(is_open || spheres.living().all(inside), || "a grain is far from the cells".to_owned())?;
        let bounds = |bounds: &[Vec3; 2]| bounds.iter().all(|bound| !bound.sum_of_sizes().is_nan());
        ensure(self.velocities.iter().all(bounds), || "velocities are no numbers".to_owned())?;
        for (at, agenda) in self.agendas.iter().enumerate() {
            let bulk = &spheres.bulk[at];
            if !bulk.lives() {
                let same = Agenda { flat: NONE, bin: NONE, ..*agenda } == Agenda::EMPTY;
                ensure(same, || format!("place {at} is empty and has an agenda"))?;
                continue;
            }
            let cells = levels.get(agenda.level as usize).map(|level| level.counts);
            let inside = cells.is_some_and(|cells| {
                cloud.volume.boundary == Boundary::Open
                    || agenda.cell.iter().zip(cells).all(|(cell, count)| (0..count).contains(cell))
            });
            let partner =
                agenda.partner == NONE || spheres.bulk.get(agenda.partner as usize).is_some_and(Bulk::lives);
            let images = agenda.image.iter().all(|image| (-2..=2).contains(image));
            let exit = agenda.exit.axis < 3 && agenda.exit.side.abs() <= 1;
            let times = agenda.collision >= self.filed.moment && agenda.crossing >= self.filed.moment;
            ensure(inside && partner && images && exit && times && agenda.id == bulk.id, || {
                format!("the agenda of grain {} is none", bulk.id)
            })?;
        }
        Ok(())
    }
}
