//! What a search finds: two spheres that collide, and the spheres near a point.

use crate::engine::hard::spheres::Spheres;
use crate::math::Vec3;

/// Two spheres that collide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Their indices.
    pub spheres: [u32; 2],
    /// What is added to the second one's position to get the image that collides with the first [m].
    pub shift: Vec3,
}

/// Finds spheres near a point.
pub trait Surroundings {
    /// Visits every sphere whose surface may be nearer to `center` than `reach` [m] at `time` [s], with the position of
    /// its image that is near; may visit more.
    fn visit_near(
        &self,
        spheres: &Spheres,
        center: Vec3,
        reach: f64,
        time: f64,
        visit: &mut dyn FnMut(u32, Vec3),
    );
}
