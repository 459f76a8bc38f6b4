//! What a pass needs of a grain, side by side in memory: a partner is fetched whole, not from a column each.

use std::ops::Range;

use super::world::ContactWorld;
use crate::math::parallel;

/// A grain, in rows of four numbers that lanes are filled from.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(32))]
pub(super) struct Record {
    /// Center and radius [m].
    pub place: [f64; 4],
    /// Velocity [m/s] and mass [kg].
    pub motion: [f64; 4],
    /// Angular velocity [rad/s] and contact stiffness [Pa].
    pub spin: [f64; 4],
    /// Sum of the velocities at both ends of the step [m/s], and the number of the material.
    pub way: [f64; 4],
    /// Sum of the angular velocities at both ends of the step [rad/s].
    pub turn: [f64; 4],
}

/// Grains per leaf of the parallel loop.
const LEAF: usize = 1024;

/// Writes down all grains.
pub(super) fn write_down(world: &ContactWorld<'_>, records: &mut [Record]) {
    let leaf = |range: Range<usize>, records: &mut [Record]| {
        let ContactWorld { grains, before, now, .. } = world;
        for (record, at) in records.iter_mut().zip(range) {
            let (place, motion, spin) = (now.position[at], now.velocity[at], now.angular_velocity[at]);
            let (way, turn) = (before.velocity[at] + motion, before.angular_velocity[at] + spin);
            *record = Record {
                place: [place.x, place.y, place.z, grains.radius[at]],
                motion: [motion.x, motion.y, motion.z, grains.mass[at]],
                spin: [spin.x, spin.y, spin.z, grains.contact_stiffness[at]],
                way: [way.x, way.y, way.z, f64::from(grains.material[at])],
                turn: [turn.x, turn.y, turn.z, 0.0],
            };
        }
    };
    parallel::over(0..records.len(), LEAF, records, &leaf, &|(), ()| ());
}
