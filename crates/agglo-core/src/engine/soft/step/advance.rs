//! The update that both schemes share: a trial motion from loads at both ends of the step.

use std::ops::Range;

use crate::contact::pass::Record;
use crate::math::Vec3;
use crate::math::parallel::BLOCK;

use super::change::Change;
use crate::engine::soft::forces::loads::LoadViews;
use crate::engine::soft::system::System;
use crate::ledger::Correction;

/// Which loads count at the end of the step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ahead {
    /// Those at its start: a first guess.
    AsAtStart,
    /// Those evaluated at the trial motion.
    AsAtTrial,
}

impl System {
    /// Factor from the loads of rays to forces; nothing where no ray acts.
    pub(super) fn ray_scale(&self, dt: f64) -> Option<f64> {
        self.has_ray_loads.then(|| self.ray_load_scale(dt))
    }

    /// Trial motion after `dt` [s] from `time` [s] with the part `phi` of the loads taken at the end of the step:
    /// v' = v + (dt/m)(phi F' + (1 - phi) F) and r' = r + dt (phi v' + (1 - phi) v) ([A] 31-33), for r with the
    /// same loads as for v. Loads that answer to velocity are solved for and brought along.
    pub(in crate::engine::soft) fn move_trial(
        &mut self,
        time: f64,
        dt: f64,
        phi: f64,
        ahead: Ahead,
    ) -> Change {
        let ray_scale = self.ray_scale(dt);
        let stretch = self.move_space(time, time + dt);
        let Self { grains, trial, records, loads, ray_loads, laws, domain, .. } = self;
        let from_start = ahead == Ahead::AsAtStart;
        let at_time = if from_start { time } else { time + dt };
        let has_response = laws.has_response();
        // Loads at the end are there where they are taken, or brought along.
        let is_ended = has_response || !from_start;
        if is_ended {
            trial.loads.fit(grains.len());
        }
        let views = (is_ended.then(|| trial.loads.views()), &mut records[..]);
        let leaf = |range: Range<usize>, (mut end, records): (Option<LoadViews<'_>>, &mut [Record])| {
            let (mut change, mut correction) = (Change::default(), Correction::default());
            for (slot, grain) in range.enumerate() {
                let start = (loads.force[grain], loads.torque[grain]);
                let mut ahead = match &end {
                    Some(end) if !from_start => (end.force[slot], end.torque[slot]),
                    _ => start,
                };
                let mut force = ahead.0 * phi + start.0 * (1.0 - phi);
                let mut torque = ahead.1 * phi + start.1 * (1.0 - phi);
                if let Some(scale) = ray_scale {
                    force += ray_loads.force[grain] * scale;
                    torque += ray_loads.torque[grain] * scale;
                }
                let record = &mut records[slot];
                if from_start {
                    let (place, velocity) = (grains.position[grain], grains.velocity[grain]);
                    record.begin(place, velocity, grains.angular_velocity[grain]);
                    record.end(place, Vec3::ZERO, Vec3::ZERO);
                }
                let [per_mass, per_inertia] = record.inverses().map(|inverse| dt * inverse);
                let (mut kick, mut twist) = (force * per_mass, torque * per_inertia);
                if has_response {
                    let (place, velocity, spin) = record.before();
                    // Where and how fast the loads at the end are taken.
                    let (position, velocity_now, spin_now) = record.now();
                    let response = laws.response(grains, grain, (position, velocity_now), at_time);
                    let parts = (phi * per_mass, phi * per_inertia);
                    let explicit = (velocity + kick, spin + twist);
                    let solved = response.solved(explicit, (velocity_now, spin_now), parts);
                    (kick, twist) = (solved.velocity - velocity, solved.angular_velocity - spin);
                    solved.correct(&mut ahead, position, &mut correction);
                    if let Some(end) = &mut end {
                        (end.force[slot], end.torque[slot]) = ahead;
                    }
                    let flow = laws.flow_change([(place, time), (position, at_time)]);
                    correction.bend += response.bend((kick, twist), flow);
                }
                change.note_move(grain, record, (dt, phi, stretch), (kick, twist));
            }
            (change, correction)
        };
        let join = |a: (Change, Correction), b: (Change, Correction)| (Change::join(a.0, b.0), a.1 + b.1);
        let (change, correction) = domain.over(0..grains.len(), BLOCK, views, &leaf, &join);
        domain.share_grains(records);
        if is_ended {
            domain.share_grains(&mut trial.loads.force);
            domain.share_grains(&mut trial.loads.torque);
        }
        trial.rates.correct(correction);
        self.note_way(change.wavering);
        change
    }

    /// Trial motion after `dt` [s] from `time` [s] in place of a longer `tried` [s], by the same loads. Only where [`System::flies_freely`].
    pub(in crate::engine::soft) fn shorten(&mut self, time: f64, tried: f64, dt: f64) -> Change {
        let stretch = self.move_space(time, time + dt);
        let part = dt / tried;
        let leaf = |range: Range<usize>, records: &mut [Record]| {
            let mut change = Change::default();
            for (record, grain) in records.iter_mut().zip(range) {
                let (kick, twist) = record.changes();
                change.note_move(grain, record, (dt, 0.5, stretch), (kick * part, twist * part));
            }
            change
        };
        let n = self.records.len();
        let change = self.domain.over(0..n, BLOCK, &mut self.records[..], &leaf, &Change::join);
        self.domain.share_grains(&mut self.records);
        self.note_way(change.wavering);
        change
    }
}

#[cfg(test)]
#[path = "advance_tests.rs"]
mod tests;
