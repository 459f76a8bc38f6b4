//! The update that both schemes share: a trial motion from loads at both ends of the step.

use std::ops::Range;

use crate::math::{Vec3, parallel};

use crate::engine::soft::forces::loads::LoadViews;
use crate::engine::soft::system::{LEAF, System};
use crate::ledger::Correction;

/// What one update of the trial motion amounts to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Change {
    /// Sum of |r^K - r^(K-1)| [m].
    pub since_last: f64,
    /// Sum of |r^K - r^L| [m].
    pub since_start: f64,
    /// Largest motion over the step, in radii of the grain, and the grain's place.
    pub farthest: f64,
    /// The place of that grain.
    pub farthest_grain: u32,
    /// Longest |r^K - r^(K-1)| of a grain [m].
    pub wavering: f64,
    /// The place of that grain.
    pub wavering_grain: u32,
    /// Place of the first grain whose motion is not finite.
    pub not_finite: Option<u32>,
}

impl Change {
    fn join(a: Self, b: Self) -> Self {
        let (farthest, farthest_grain) = if b.farthest > a.farthest {
            (b.farthest, b.farthest_grain)
        } else {
            (a.farthest, a.farthest_grain)
        };
        let (wavering, wavering_grain) = if b.wavering > a.wavering {
            (b.wavering, b.wavering_grain)
        } else {
            (a.wavering, a.wavering_grain)
        };
        Self {
            since_last: a.since_last + b.since_last,
            since_start: a.since_start + b.since_start,
            farthest,
            farthest_grain,
            wavering,
            wavering_grain,
            not_finite: a.not_finite.or(b.not_finite),
        }
    }

    /// Iteration error w_K, the change of the last iteration over that of the step.
    pub fn error(&self) -> f64 {
        if self.since_start > 0.0 { self.since_last / self.since_start } else { 0.0 }
    }
}

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
    fn ray_scale(&self, dt: f64) -> Option<f64> {
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
        let Self { grains, trial, loads, ray_loads, inertial_mass, laws, .. } = self;
        let from_start = ahead == Ahead::AsAtStart;
        let at_time = if from_start { time } else { time + dt };
        let has_response = laws.has_response();
        let moving = (&mut trial.position[..], (&mut trial.velocity[..], &mut trial.angular_velocity[..]));
        let views = (moving, trial.loads.views());
        let leaf = |range: Range<usize>,
                    ((r, (v, w)), mut end): ((&mut [Vec3], Turning<'_>), LoadViews<'_>)| {
            let (mut change, mut correction) = (Change::default(), Correction::default());
            for (slot, grain) in range.enumerate() {
                if from_start {
                    (end.force[slot], end.torque[slot]) = (loads.force[grain], loads.torque[grain]);
                }
                let mut force = end.force[slot] * phi + loads.force[grain] * (1.0 - phi);
                let mut torque = end.torque[slot] * phi + loads.torque[grain] * (1.0 - phi);
                if let Some(scale) = ray_scale {
                    force += ray_loads.force[grain] * scale;
                    torque += ray_loads.torque[grain] * scale;
                }
                let (per_mass, per_inertia) = (dt / inertial_mass[grain], dt / grains.inertia(grain));
                let (mut kick, mut twist) = (force * per_mass, torque * per_inertia);
                if has_response {
                    let (velocity, angular_velocity) =
                        (grains.velocity[grain], grains.angular_velocity[grain]);
                    // Where and how fast the loads at the end are taken.
                    let (position, guess) = if from_start {
                        (grains.position[grain], (velocity, angular_velocity))
                    } else {
                        (r[slot], (v[slot], w[slot]))
                    };
                    let response = laws.response(grains, grain, (position, guess.0), at_time);
                    let parts = (phi * per_mass, phi * per_inertia);
                    let solved = response.solved((velocity + kick, angular_velocity + twist), guess, parts);
                    (kick, twist) = (solved.velocity - velocity, solved.angular_velocity - angular_velocity);
                    solved.correct(slot, &mut end, position, &mut correction);
                    let flow = laws.flow_change([(grains.position[grain], time), (position, at_time)]);
                    correction.bend += response.bend((kick, twist), flow);
                }
                let moved = grains.velocity[grain] * dt + kick * (phi * dt);
                let position = grains.position[grain] + moved;
                change.note(grain, position - r[slot], moved, grains.radius[grain]);
                r[slot] = position;
                v[slot] = grains.velocity[grain] + kick;
                w[slot] = grains.angular_velocity[grain] + twist;
            }
            (change, correction)
        };
        let join = |a: (Change, Correction), b: (Change, Correction)| (Change::join(a.0, b.0), a.1 + b.1);
        let (change, correction) = parallel::over(0..grains.len(), LEAF, views, &leaf, &join);
        trial.rates.correct(correction);
        change
    }

    /// Corrects the trial linear and angular velocities with the loads at the trial motion, which ends at `time` [s],
    /// positions kept.
    pub(in crate::engine::soft) fn correct_velocities(&mut self, time: f64, dt: f64) {
        let ray_scale = self.ray_scale(dt);
        let Self { grains, trial, loads, ray_loads, inertial_mass, laws, .. } = self;
        let (has_response, position) = (laws.has_response(), &trial.position);
        let views = ((&mut trial.velocity[..], &mut trial.angular_velocity[..]), trial.loads.views());
        let leaf = |range: Range<usize>, ((v, w), mut end): (Turning<'_>, LoadViews<'_>)| {
            let mut correction = Correction::default();
            for (slot, grain) in range.enumerate() {
                let mut force = (end.force[slot] + loads.force[grain]) * 0.5;
                let mut torque = (end.torque[slot] + loads.torque[grain]) * 0.5;
                if let Some(scale) = ray_scale {
                    force += ray_loads.force[grain] * scale;
                    torque += ray_loads.torque[grain] * scale;
                }
                let (per_mass, per_inertia) = (dt / inertial_mass[grain], dt / grains.inertia(grain));
                let explicit = (
                    grains.velocity[grain] + force * per_mass,
                    grains.angular_velocity[grain] + torque * per_inertia,
                );
                if has_response {
                    let guess = (v[slot], w[slot]);
                    let response = laws.response(grains, grain, (position[grain], guess.0), time);
                    let solved = response.solved(explicit, guess, (0.5 * per_mass, 0.5 * per_inertia));
                    solved.correct(slot, &mut end, position[grain], &mut correction);
                    let flow =
                        laws.flow_change([(grains.position[grain], time - dt), (position[grain], time)]);
                    let change = (
                        solved.velocity - grains.velocity[grain],
                        solved.angular_velocity - grains.angular_velocity[grain],
                    );
                    correction.bend += response.bend(change, flow);
                    (v[slot], w[slot]) = (solved.velocity, solved.angular_velocity);
                } else {
                    (v[slot], w[slot]) = explicit;
                }
            }
            correction
        };
        let correction = parallel::over(0..grains.len(), LEAF, views, &leaf, &|a, b| a + b);
        trial.rates.correct(correction);
    }
}

/// Velocities and spins that are tried.
type Turning<'a> = (&'a mut [Vec3], &'a mut [Vec3]);

impl Change {
    #[inline]
    fn note(&mut self, grain: usize, since_last: Vec3, since_start: Vec3, radius: f64) {
        let (moved, wavered) = (since_start.norm(), since_last.norm());
        self.since_last += wavered;
        if wavered > self.wavering {
            self.wavering = wavered;
            self.wavering_grain = grain as u32;
        }
        self.since_start += moved;
        let radii = moved / radius;
        if !radii.is_finite() {
            self.not_finite = self.not_finite.or(Some(grain as u32));
        } else if radii > self.farthest {
            self.farthest = radii;
            self.farthest_grain = grain as u32;
        }
    }
}

#[cfg(test)]
#[path = "advance_tests.rs"]
mod tests;
