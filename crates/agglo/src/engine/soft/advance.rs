//! The update that both schemes share: a trial motion from loads at both ends of the step.

use std::ops::Range;

use crate::math::{Vec3, parallel};

use super::system::{LEAF, System};

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

    /// Trial motion after `dt` [s] with the part `phi` of the loads taken at the end of the step:
    /// v' = v + (dt/m)(phi F' + (1 - phi) F) and r' = r + dt (phi v' + (1 - phi) v) ([A] 31-33), for r with the
    /// same loads as for v.
    pub(super) fn move_trial(&mut self, dt: f64, phi: f64, ahead: Ahead) -> Change {
        let ray_scale = self.ray_scale(dt);
        let Self { grains, trial, loads, ray_loads, inertial_mass, .. } = self;
        let end = if ahead == Ahead::AsAtStart { &*loads } else { &trial.loads };
        let (positions, velocities, spins) =
            (&mut trial.position[..], &mut trial.velocity[..], &mut trial.spin[..]);
        let leaf = |range: Range<usize>, (r, (v, w)): (&mut [Vec3], (&mut [Vec3], &mut [Vec3]))| {
            let mut change = Change::default();
            for (slot, grain) in range.enumerate() {
                let mut force = end.force[grain] * phi + loads.force[grain] * (1.0 - phi);
                let mut moment = end.moment[grain] * phi + loads.moment[grain] * (1.0 - phi);
                if let Some(scale) = ray_scale {
                    force += ray_loads.force[grain] * scale;
                    moment += ray_loads.moment[grain] * scale;
                }
                let kick = force * (dt / inertial_mass[grain]);
                let moved = grains.velocity[grain] * dt + kick * (phi * dt);
                let position = grains.position[grain] + moved;
                change.note(grain, position - r[slot], moved, grains.radius[grain]);
                r[slot] = position;
                v[slot] = grains.velocity[grain] + kick;
                w[slot] = grains.spin[grain] + moment * (dt / grains.inertia(grain));
            }
            change
        };
        parallel::over(0..positions.len(), LEAF, (positions, (velocities, spins)), &leaf, &Change::join)
    }

    /// Corrects the trial velocities and spins with the loads at the trial motion, positions kept.
    pub(super) fn correct_velocities(&mut self, dt: f64) {
        let ray_scale = self.ray_scale(dt);
        let Self { grains, trial, loads, ray_loads, inertial_mass, .. } = self;
        let end = &trial.loads;
        let views = (&mut trial.velocity[..], &mut trial.spin[..]);
        let leaf = |range: Range<usize>, (v, w): (&mut [Vec3], &mut [Vec3])| {
            for (slot, grain) in range.enumerate() {
                let mut force = (end.force[grain] + loads.force[grain]) * 0.5;
                let mut moment = (end.moment[grain] + loads.moment[grain]) * 0.5;
                if let Some(scale) = ray_scale {
                    force += ray_loads.force[grain] * scale;
                    moment += ray_loads.moment[grain] * scale;
                }
                v[slot] = grains.velocity[grain] + force * (dt / inertial_mass[grain]);
                w[slot] = grains.spin[grain] + moment * (dt / grains.inertia(grain));
            }
        };
        parallel::over(0..grains.len(), LEAF, views, &leaf, &|(), ()| ());
    }
}

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
