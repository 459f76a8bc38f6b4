//! Where grains are and how they move, as the laws are asked about it.

use crate::math::Vec3;

/// Positions, velocities and angular velocities of all grains at one moment; [n] each.
#[derive(Clone, Copy, Debug)]
pub struct Motion<'a> {
    /// Centers [m].
    pub position: &'a [Vec3],
    /// Velocities of the centers [m/s].
    pub velocity: &'a [Vec3],
    /// Angular velocities [rad/s].
    pub angular_velocity: &'a [Vec3],
}
