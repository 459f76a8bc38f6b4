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
    /// Overlap over the sum of the radii.
    pub strain: F,
}

/// Part of the sum of the radii below which two centers lie in one point.
const NO_DISTANCE: f64 = 1e-100;

impl<F: Lanes> Touch<F> {
    /// Two grains with radii [m], masses [kg] and contact stiffness [Pa], whose centers are `apart` [m].
    #[inline(always)]
    pub fn new(radii: [F; 2], masses: [F; 2], stiffness: [F; 2], apart: Vector<F>) -> Self {
        let (half, one) = (F::of(0.5), F::of(1.0));
        let distance = apart.norm();
        let (radius_sum, mass_sum) = (radii[0] + radii[1], masses[0] + masses[1]);
        // Two centers in one point have no normal; any will do, since the next step parts them.
        let is_apart = (F::of(NO_DISTANCE) * radius_sum).below(distance);
        let divisor = F::select(is_apart, distance, one);
        // One division for all three inverses: it takes as long as five products.
        let all = one / (divisor * radius_sum * mass_sum);
        let per_distance = F::select(is_apart, all * (radius_sum * mass_sum), F::of(0.0));
        let per_radii = all * (divisor * mass_sum);
        let per_masses = all * (divisor * radius_sum);
        let overlap = radius_sum - distance;
        let normal = apart * per_distance;
        let near = half * (distance - (radii[1] - radii[0]) * radius_sum * per_distance);
        Self {
            geometry: ContactGeometry {
                overlap,
                radius_sum,
                smaller_radius: radii[0].min(radii[1]),
                effective_radius: radii[0] * radii[1] * per_radii,
                effective_mass: masses[0] * masses[1] * per_masses,
                stiffness: half * (stiffness[0] + stiffness[1]),
                flatness: one,
            },
            normal: Vector::new(F::select(is_apart, normal.x, one), normal.y, normal.z),
            lever_arms: [near, distance - near],
            strain: overlap * per_radii,
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
