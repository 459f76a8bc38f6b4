//! What the motion of several grains comes to if they are taken for one body.
//!
//! # Equation
//! ```text
//! L = sum(m (r - r_cm) × (v - v_cm) + I w),   I = 2/5 m R²
//! J = sum(m (|s|² 1 - s s) + I 1),   s = r - r_cm,   J Ω = L
//! ```
//! Ω is the rotation of the rigid body that has the angular momentum of the grains.

use crate::math::Vec3;
use crate::particles::Particles;

use super::center_of_mass;

/// Several grains as one body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RigidMotion {
    /// Mass [kg].
    pub mass: f64,
    /// Center of mass [m].
    pub center: Vec3,
    /// Momentum [kg m/s].
    pub momentum: Vec3,
    /// Angular momentum [kg m²/s] about the center of mass, with the grains' own.
    pub angular_momentum: Vec3,
    /// Moments of inertia [3, 3] [kg m²] about the center of mass, row by row.
    pub inertia: [Vec3; 3],
    /// Energy of all motion [J], turning included.
    pub kinetic_energy: f64,
}

impl RigidMotion {
    /// Of the grains `members` [index], of which there is one at least.
    ///
    /// ```
    /// # extern crate agglo_core as agglo;
    /// use agglo::{math::Vec3, measure::RigidMotion, particles::{Particles, Row}};
    /// // Two grains of 1 kg at the ends of a rod of 2 m that turns about z with them: J = 2 (1 + 2/5 0.1²) kg m².
    /// let mut grains = Particles::default();
    /// let angular_velocity = Vec3::new(0.0, 0.0, 3.0);
    /// for side in [-1.0, 1.0] {
    ///     let [position, velocity] = [Vec3::new(side, 0.0, 0.0), Vec3::new(0.0, 3.0 * side, 0.0)];
    ///     grains.push(Row { position, velocity, angular_velocity, mass: 1.0, radius: 0.1, ..Row::default() });
    /// }
    /// let rod = RigidMotion::of(&grains, &[0, 1]);
    /// assert!((rod.angular_momentum.z - 3.0 * 2.008).abs() < 1e-12);
    /// assert!((rod.kinetic_energy - 4.5 * 2.008).abs() < 1e-12);
    /// assert!((rod.angular_velocity().z - 3.0).abs() < 1e-12);
    /// ```
    pub fn of(grains: &Particles, members: &[u32]) -> Self {
        let center = center_of_mass(&grains.position, &grains.mass, members);
        let mut body = Self { center, ..Self::default() };
        for at in members.iter().map(|&grain| grain as usize) {
            body.mass += grains.mass[at];
            body.momentum += grains.velocity[at] * grains.mass[at];
        }
        let common = body.momentum / body.mass;
        for at in members.iter().map(|&grain| grain as usize) {
            let (mass, own, turning) = (grains.mass[at], grains.inertia(at), grains.angular_velocity[at]);
            let (arm, velocity) = (grains.position[at] - center, grains.velocity[at]);
            body.angular_momentum += arm.cross(velocity - common) * mass + turning * own;
            body.kinetic_energy += 0.5 * (mass * velocity.norm_squared() + own * turning.norm_squared());
            for (axis, row) in body.inertia.iter_mut().enumerate() {
                *row += Vec3::AXES[axis] * (mass * arm.norm_squared() + own) - arm * (mass * arm[axis]);
            }
        }
        body
    }

    /// The angular velocity [rad/s] of a rigid body of these grains with their angular momentum.
    pub fn angular_velocity(&self) -> Vec3 {
        self.turning_with(self.angular_momentum)
    }

    /// The angular velocity [rad/s] of a rigid body of these grains with another angular momentum [kg m²/s].
    pub fn turning_with(&self, angular_momentum: Vec3) -> Vec3 {
        // Grains have a size: the matrix is symmetric and far from singular.
        let [a, b, c] = self.inertia;
        let determinant = a.dot(b.cross(c));
        (b.cross(c) * angular_momentum.x + c.cross(a) * angular_momentum.y + a.cross(b) * angular_momentum.z)
            / determinant
    }

    /// Energy of the motion [J] of the body as a whole: of its center, and of its turning as a rigid body.
    pub fn rigid_energy(&self) -> f64 {
        0.5 * (self.momentum.norm_squared() / self.mass + self.angular_momentum.dot(self.angular_velocity()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::{Purpose, Stream};
    use crate::particles::Row;

    /// Grains of a cloud that moves as a rigid body.
    fn turning(velocity: Vec3, turning: Vec3) -> Particles {
        let mut stream = Stream::new(2, Purpose::Sampling, 0);
        let mut grains = Particles::default();
        for k in 0..20 {
            let position = stream.direction() * stream.uniform() + Vec3::new(5.0, -3.0, 1.0);
            let (mass, radius) = (1.0 + f64::from(k), 0.1 + 0.01 * f64::from(k));
            grains.push(Row { position, mass, radius, angular_velocity: turning, ..Row::default() });
        }
        let members: Vec<u32> = (0..20).collect();
        let center = center_of_mass(&grains.position, &grains.mass, &members);
        grains.velocity =
            grains.position.iter().map(|&place| velocity + turning.cross(place - center)).collect();
        grains
    }

    /// A rigid body gives back what it was moved with, and all its energy is that of the body as a whole.
    #[test]
    fn a_rigid_body_is_found_again() {
        let (velocity, spin) = (Vec3::new(1.0, 2.0, -4.0), Vec3::new(0.3, -0.7, 1.1));
        let body = RigidMotion::of(&turning(velocity, spin), &(0..20).collect::<Vec<u32>>());
        assert_close!(body.mass, 210.0, 1e-14);
        assert_close_vector!(body.momentum, velocity * 210.0, 1e-13);
        assert_close_vector!(body.angular_velocity(), spin, 1e-12);
        assert_close!(body.rigid_energy(), body.kinetic_energy, 1e-13);
    }

    /// Two solid spheres in touch: J = 2 (2/5 + 1) m R² across the line of centers and 2 · 2/5 m R² along it.
    #[test]
    fn inertia_of_two_touching_spheres() {
        let mut grains = Particles::default();
        for side in [-1.0, 1.0] {
            grains.push(Row {
                position: Vec3::new(0.0, 2.0 * side, 0.0),
                mass: 3.0,
                radius: 2.0,
                ..Row::default()
            });
        }
        let body = RigidMotion::of(&grains, &[0, 1]);
        let wanted = [2.8, 0.8, 2.8].map(|part| part * 12.0);
        for (axis, (row, wanted)) in body.inertia.into_iter().zip(wanted).enumerate() {
            assert_close_vector!(row, Vec3::AXES[axis] * wanted, 1e-14);
        }
    }

    /// Grains that move at random have more energy than the body as a whole.
    #[test]
    fn what_is_not_rigid_is_not_in_its_energy() {
        let mut grains = turning(Vec3::ZERO, Vec3::AXES[2]);
        let members: Vec<u32> = (0..20).collect();
        let before = RigidMotion::of(&grains, &members);
        // Two grains of unlike masses, against one another along the line of their centers: no momentum of any kind.
        let along = (grains.position[9] - grains.position[4]).normalized();
        grains.velocity[4] -= along * (1.0 / grains.mass[4]);
        grains.velocity[9] += along * (1.0 / grains.mass[9]);
        let after = RigidMotion::of(&grains, &members);
        assert_close_vector!(after.angular_momentum, before.angular_momentum, 1e-13);
        assert_close!(after.rigid_energy(), before.rigid_energy(), 1e-12);
        let gain = 0.5 * (1.0 / 5.0 + 1.0 / 10.0);
        assert_close!(after.kinetic_energy - after.rigid_energy(), gain, 1e-9);
    }
}
