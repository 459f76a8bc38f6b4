//! Space that changes as its volume is deformed: all of it follows from time.

use super::deformation::volume_of_spheres;
use super::space::Space;
use super::volume::Volume;
use crate::math::Vec3;
use crate::units::vector;

/// Space as it is at any time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpaceInTime {
    start: Space,
    strain_rate: Vec3,
    end: f64,
}

impl SpaceInTime {
    /// Space as the faces of a volume make it, among grains of these radii [m].
    pub fn new(volume: Option<&Volume>, radii: impl Iterator<Item = f64>) -> Self {
        let solid = volume_of_spheres(radii);
        let start = volume.map_or(Space::OPEN, Volume::space);
        let deformation = volume.and_then(|volume| Some((volume, volume.deformation.as_ref()?)));
        let (strain_rate, end) = deformation.map_or((Vec3::ZERO, 0.0), |(volume, deformation)| {
            (
                vector(deformation.strain_rate),
                deformation.end(volume.volume(), solid).unwrap_or(f64::INFINITY),
            )
        });
        Self { start, strain_rate, end }
    }

    /// Whether it is another at other times.
    #[inline]
    pub fn changes(&self) -> bool {
        self.strain_rate != Vec3::ZERO
    }

    /// Space at a time [s].
    pub fn at(&self, time: f64) -> Space {
        if !self.changes() {
            return self.start;
        }
        let [lower, upper] = self.start.corners();
        let (middle, half) = ((lower + upper) * 0.5, (upper - lower) * 0.5);
        let factors = self.strain_rate.to_array().map(|rate| (rate * time.min(self.end)).exp());
        let half = Vec3::new(half.x * factors[0], half.y * factors[1], half.z * factors[2]);
        let axes = [0, 1, 2].map(|axis| self.start.repeats_along(axis));
        let now = Space::repeating([middle - half, middle + half], axes);
        if time < self.end { now.strained(self.strain_rate) } else { now }
    }

    /// How places follow it from one time [s] to another.
    pub fn stretch(&self, from: f64, to: f64) -> Option<Stretch> {
        if !self.changes() {
            return None;
        }
        let [lower, upper] = self.start.corners();
        let passed = to.min(self.end) - from.min(self.end);
        let factors = self.strain_rate.to_array().map(|rate| (rate * passed).exp());
        Some(Stretch { middle: (lower + upper) * 0.5, factors: factors.into() })
    }
}

/// How places follow space that changes.
#[derive(Clone, Copy, Debug)]
pub struct Stretch {
    middle: Vec3,
    factors: Vec3,
}

impl Stretch {
    /// Where a place [m] comes to.
    #[inline(always)]
    pub fn of(&self, place: Vec3) -> Vec3 {
        let from = place - self.middle;
        self.middle + Vec3::new(from.x * self.factors.x, from.y * self.factors.y, from.z * self.factors.z)
    }
}
