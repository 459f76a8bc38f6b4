//! Two hard spheres at one moment: how far apart, how fast they approach, since when they touch.

use crate::engine::hard::spheres::Spheres;
use crate::engine::hard::types::Distance;
use crate::math::Vec3;

use super::contact::Contact;

/// An approach slower than this part of the velocities is rounding.
const ROUNDING: f64 = 1e-12;

/// A pair on its way.
#[derive(Clone, Copy, Debug)]
pub(in crate::engine::hard) struct Approach {
    /// From the first center to the second [m].
    between: Vec3,
    /// Velocity of the second relative to the first [m/s].
    relative: Vec3,
    /// Sum of the radii [m].
    reach: f64,
    /// Approach speed times distance [m²/s].
    closing: f64,
}

impl Approach {
    /// Looks at a pair; all bits turn round when the partners are swapped.
    #[inline]
    pub fn of(spheres: &Spheres, contact: &Contact) -> Self {
        let [a, b] = contact.spheres.map(|at| &spheres.motion[at as usize]);
        let between = (b.position - a.position) + contact.shift;
        let relative = b.velocity - a.velocity;
        Self { between, relative, reach: a.radius + b.radius, closing: -between.dot(relative) }
    }

    /// Square of the distance of the centers [m²].
    #[inline]
    pub fn distance_squared(&self) -> f64 {
        self.between.norm_squared()
    }

    /// Time [s] that the way takes at the present speed of approach, [B] 6.14; infinite for spheres that part, by their gap.
    ///
    /// With the distance of the centers it is the printed formula, which does not ask whether they part.
    #[inline]
    pub fn time_left(&self, distance: Distance) -> f64 {
        match distance {
            Distance::Gap => self.time_of_gap(),
            Distance::Centers => self.distance_squared() / self.closing.abs(),
        }
    }

    fn time_of_gap(&self) -> f64 {
        if self.closing <= 0.0 {
            return f64::INFINITY;
        }
        let apart = self.between.norm();
        let way = apart - self.reach;
        if way > 0.0 {
            way * apart / self.closing
        } else if self.approaches(apart) {
            0.0
        } else {
            f64::INFINITY
        }
    }

    /// Time [s] after which two spheres that approach are at most the part `depth` of their reach in one another;
    /// infinite for spheres that part.
    #[inline]
    pub fn time_to_sink(&self, depth: f64) -> f64 {
        if self.closing <= 0.0 {
            return f64::INFINITY;
        }
        let apart = self.between.norm();
        ((apart - self.reach).max(0.0) + depth * self.reach) * apart / self.closing
    }

    fn approaches(&self, apart: f64) -> bool {
        self.closing > ROUNDING * self.relative.norm() * apart
    }

    /// For how long [s] two spheres that approach have been touching; none if they do not touch, or part.
    ///
    /// It goes back along the straight lines they flew on.
    #[inline]
    pub fn touching_for(&self) -> Option<f64> {
        let depth = self.reach * self.reach - self.distance_squared();
        if depth < 0.0 || self.closing <= 0.0 || !self.approaches(self.distance_squared().sqrt()) {
            return None;
        }
        let root = (self.closing * self.closing + self.relative.norm_squared() * depth).sqrt();
        Some(depth / (self.closing + root))
    }
}
