//! Two grains that touch, or several such pairs side by side.

use crate::contact::ContactGeometry;
use crate::math::Vector;
use crate::math::lanes::Lanes;

/// The geometry of a pair and the frame of its contact.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch<F> {
    pub geometry: ContactGeometry<F>,
    /// Unit vector from the owner to its partner.
    pub normal: Vector<F>,
    /// Distances from the two centers to the contact [m]: owner's and partner's.
    pub lever_arms: [F; 2],
}

impl<F: Lanes> Touch<F> {
    /// Two grains with radii [m], masses [kg] and contact stiffness [Pa], whose centers are `apart` [m].
    #[inline(always)]
    pub fn new(radii: [F; 2], masses: [F; 2], stiffness: [F; 2], apart: Vector<F>) -> Self {
        let (zero, one) = (F::of(0.0), F::of(1.0));
        let distance = apart.norm();
        // Two centers in one point have no normal; any will do, since the next step parts them.
        let is_apart = zero.below(distance);
        let inverse = F::select(is_apart, one / distance, zero);
        let normal = apart * inverse;
        let near = F::of(0.5) * (distance - (radii[1] - radii[0]) * (radii[1] + radii[0]) * inverse);
        Self {
            geometry: ContactGeometry::new(radii, masses, stiffness, distance),
            normal: Vector::new(F::select(is_apart, normal.x, one), normal.y, normal.z),
            lever_arms: [near, distance - near],
        }
    }

    /// Velocity [m/s] of the partner's surface relative to the owner's at the contact, from velocities [m/s] and angular
    /// velocities [rad/s].
    #[inline(always)]
    pub fn relative_velocity(&self, velocities: [Vector<F>; 2], spins: [Vector<F>; 2]) -> Vector<F> {
        let rolling = spins[0] * self.lever_arms[0] + spins[1] * self.lever_arms[1];
        velocities[1] - velocities[0] - rolling.cross(self.normal)
    }
}
