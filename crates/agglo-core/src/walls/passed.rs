//! What has come through the opening of a plate.

use super::shape::Shape;
use super::wall::Walls;
use crate::math::Sum;
use crate::particles::Particles;

/// Grains beyond a plate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Passed {
    /// How many.
    pub grains: u64,
    /// Their mass [kg].
    pub mass: f64,
}

impl Walls {
    /// The grains whose centers are beyond a plane with an opening at a time [s]: on the side that its normal points away from. Nothing for
    /// any other wall.
    ///
    /// It is a function of where the grains are, so those that come back are taken off again, and what is beyond and what is not add up to
    /// all.
    pub fn passed(&self, wall: usize, time: f64, grains: &Particles) -> Option<Passed> {
        let Shape::Plane(plane) = &self.bodies[wall].shape else { return None };
        plane.opening.as_ref()?;
        let pose = self.pose(wall, time);
        let (mut count, mut mass) = (0, Sum::default());
        for (place, &part) in grains.position.iter().zip(&grains.mass) {
            if plane.height(pose.as_at_start(*place)) < 0.0 {
                count += 1;
                mass.add(part);
            }
        }
        Some(Passed { grains: count, mass: mass.value() })
    }
}
