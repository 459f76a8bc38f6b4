//! What a step needs of a grain, side by side in memory: it is fetched whole, not from a column each.

use crate::link::row_of_fields;
use crate::math::Vec3;
use crate::neighbors::Places;
use crate::particles::Particles;

/// A grain on its way through a step, in rows of four numbers that lanes are filled from.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(64))]
pub struct Record {
    /// Center at the end of the step, and radius [m].
    pub(super) place: [f64; 4],
    /// Velocity at its start [m/s], and mass [kg].
    pub(super) motion: [f64; 4],
    /// Angular velocity at its start [rad/s], and contact stiffness [Pa].
    pub(super) spin: [f64; 4],
    /// Change of the velocity within the step, as it is foreseen [m/s], and the number of the material.
    pub(super) kick: [f64; 4],
    /// Change of the angular velocity likewise [rad/s], and the inverse of the moment of inertia [1/(kg m²)].
    pub(super) twist: [f64; 4],
    /// Center at the start of the step [m], and the inverse of the mass that resists acceleration [1/kg].
    start: [f64; 4],
}

row_of_fields!(Record {
    place: [f64; 4],
    motion: [f64; 4],
    spin: [f64; 4],
    kick: [f64; 4],
    twist: [f64; 4],
    start: [f64; 4],
});

/// A vector into the first three numbers of a row.
#[inline(always)]
fn put(row: &mut [f64; 4], vector: Vec3) {
    [row[0], row[1], row[2]] = vector.to_array();
}

#[inline(always)]
fn vector(row: &[f64; 4]) -> Vec3 {
    Vec3::new(row[0], row[1], row[2])
}

impl Record {
    /// A grain that has not moved yet, whose acceleration is resisted by a mass [kg].
    pub fn at_start(grains: &Particles, at: usize, inertial_mass: f64) -> Self {
        let row = |vector: Vec3, scalar: f64| [vector.x, vector.y, vector.z, scalar];
        Self {
            place: row(grains.position[at], grains.radius[at]),
            motion: row(grains.velocity[at], grains.mass[at]),
            spin: row(grains.angular_velocity[at], grains.contact_stiffness[at]),
            kick: row(Vec3::ZERO, f64::from(grains.material[at])),
            twist: row(Vec3::ZERO, 1.0 / grains.inertia(at)),
            start: row(grains.position[at], 1.0 / inertial_mass),
        }
    }

    /// Begins a step at a place [m] with a velocity [m/s] and an angular velocity [rad/s].
    #[inline(always)]
    pub fn begin(&mut self, place: Vec3, velocity: Vec3, spin: Vec3) {
        put(&mut self.start, place);
        put(&mut self.motion, velocity);
        put(&mut self.spin, spin);
    }

    /// Puts the end of the step into another image of where it is [m].
    #[inline(always)]
    pub fn shift_to(&mut self, place: Vec3) {
        put(&mut self.place, place);
    }

    /// Ends the step elsewhere [m], with these changes of the velocity [m/s] and the angular velocity [rad/s].
    #[inline(always)]
    pub fn end(&mut self, place: Vec3, kick: Vec3, twist: Vec3) {
        put(&mut self.place, place);
        put(&mut self.kick, kick);
        put(&mut self.twist, twist);
    }

    /// Center [m], velocity [m/s] and angular velocity [rad/s] at the start of the step.
    #[inline(always)]
    pub fn before(&self) -> (Vec3, Vec3, Vec3) {
        (vector(&self.start), vector(&self.motion), vector(&self.spin))
    }

    /// The same at its end, velocities as they are foreseen.
    #[inline(always)]
    pub fn now(&self) -> (Vec3, Vec3, Vec3) {
        let (kick, twist) = self.changes();
        (vector(&self.place), vector(&self.motion) + kick, vector(&self.spin) + twist)
    }

    /// Changes of the velocity [m/s] and the angular velocity [rad/s] within the step, as they are foreseen.
    #[inline(always)]
    pub fn changes(&self) -> (Vec3, Vec3) {
        (vector(&self.kick), vector(&self.twist))
    }

    /// Radius [m].
    #[inline(always)]
    pub fn radius(&self) -> f64 {
        self.place[3]
    }

    /// Inverses of the mass that resists acceleration [1/kg] and of the moment of inertia [1/(kg m²)].
    #[inline(always)]
    pub fn inverses(&self) -> [f64; 2] {
        [self.start[3], self.twist[3]]
    }
}

/// Spheres where the step ends.
impl Places for &[Record] {
    fn slots(&self) -> usize {
        self.len()
    }

    fn indices(&self) -> impl Iterator<Item = u32> + '_ {
        0..self.len() as u32
    }

    #[inline(always)]
    fn position(&self, at: u32) -> Vec3 {
        vector(&self[at as usize].place)
    }

    #[inline(always)]
    fn radius(&self, at: u32) -> f64 {
        self[at as usize].radius()
    }
}

/// Their centers alone.
#[derive(Clone, Copy)]
pub struct Centers<'a>(pub &'a [Record]);

impl Places for Centers<'_> {
    fn slots(&self) -> usize {
        self.0.len()
    }

    fn indices(&self) -> impl Iterator<Item = u32> + '_ {
        self.0.indices()
    }

    #[inline(always)]
    fn position(&self, at: u32) -> Vec3 {
        self.0.position(at)
    }

    fn radius(&self, _: u32) -> f64 {
        0.0
    }
}
