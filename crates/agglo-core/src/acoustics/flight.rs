//! The rays in flight and the books of every pulse: all that a restart needs of the acoustics.

use serde::{Deserialize, Serialize};

use super::{Beam, Medium};
use crate::math::Vec3;
use crate::neighbors::ray_grid::{Clear, NO_SPHERE};

/// A ray in flight.
///
/// It remembers where its straight segment began and how far it has come since, not where it is: so what it
/// hits does not depend on the number of steps in between, to the last bit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ray {
    /// Where the segment began: its start or its last bounce [m].
    pub origin: Vec3,
    /// Unit vector.
    pub direction: Vec3,
    /// Way since the segment began [m].
    pub traveled: f64,
    /// Power now [W].
    pub power: f64,
    /// Power at the start [W].
    pub first_power: f64,
    /// Area in the beam [m²].
    pub area: f64,
    /// Way that it came on the segments before [m].
    pub way: f64,
    /// Index of the grain hit last, [`FIRST_FACE`] and the number of the face of a wall, or [`NO_SPHERE`] at the start.
    pub last_hit: u32,
    /// Bounces so far.
    pub bounces: u32,
    /// Place of its pulse in [`Flight::pulses`].
    pub pulse: u32,
    /// Its number in the pulse, from 0.
    pub number: u32,
    /// How far the way is known to be clear; not part of the state.
    #[serde(skip)]
    pub(super) clear: Clear,
}

/// In [`Ray::last_hit`] faces of walls are counted on from this number.
pub const FIRST_FACE: u32 = 1 << 31;

/// The books of one pulse. Powers obey in = absorbed + into walls + escaped + truncated + cut off + in flight.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PulseCount {
    /// Number of the beam in the scenario.
    pub beam: u32,
    /// Number of the pulse within its beam, from 0.
    pub number: u32,
    /// When it started [s].
    pub start_s: f64,
    /// Rays at the start.
    pub rays: u32,
    /// Bounces.
    pub reflections: u64,
    /// How many of them were at walls.
    pub reflections_at_walls: u64,
    /// Straight pieces that are finished: bounces and the leaving legs of rays that escaped.
    pub segments: u64,
    /// Power at the start [W].
    pub power_in: f64,
    /// Power that grains took [W].
    pub power_absorbed: f64,
    /// Power that walls took [W].
    pub power_into_walls: f64,
    /// Power of rays that left for good [W].
    pub power_escaped: f64,
    /// Power of rays that were dropped [W]: at the truncation, at the largest number of bounces, crushed between grains, or
    /// inside a grain or a wall at the start.
    pub power_truncated: f64,
    /// Power of rays that had come as far as rays are followed [W].
    pub power_cut_off: f64,
    /// Sum of power times direction of the rays that ended, as they were then [W].
    pub flow_ended: Vec3,
    /// Sum of the squared powers of the rays that ended, as they were then [W²].
    pub squares_ended: f64,
    /// Rays that were dropped at the largest number of bounces.
    pub capped: u32,
    /// Rays that were dropped between grains that closed in on them.
    pub crushed: u32,
    /// Rays that were dropped at the start, inside a grain or a wall.
    pub blocked: u32,
    /// Rays that had come as far as rays are followed.
    pub overlong: u32,
    /// Bounces of the ray that bounced most.
    pub longest_chain: u32,
    /// Rays in flight.
    pub in_flight: u32,
}

/// What is left of pulses' power, over the power that they started with ([A] 39).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BeamPower {
    /// Sum of I_q d_q.
    pub flow: Vec3,
    /// Sum of |I_q|: 1 at the start.
    pub magnitude: f64,
    /// Root of the sum of |I_q|², as Fig. 10 d of [A] has it: 1/sqrt(rays) at the start.
    pub root_of_squares: f64,
}

/// All rays in flight, of all pulses, and the books of the pulses.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Flight {
    pub(super) rays: Vec<Ray>,
    pub(super) pulses: Vec<PulseCount>,
}

impl Ray {
    /// Where the ray is [m].
    #[inline]
    pub fn position(&self) -> Vec3 {
        self.origin + self.direction * self.traveled
    }

    /// Number of the face of a wall that it left last.
    #[inline]
    pub fn last_face(&self) -> Option<u32> {
        (self.last_hit >= FIRST_FACE && self.last_hit != NO_SPHERE).then(|| self.last_hit - FIRST_FACE)
    }
}

impl Flight {
    /// Launches a pulse: `pulse` counts those of its beam from 0, `number` is the beam's in the scenario.
    ///
    /// That the rays start inside a given region is checked with the scenario.
    pub fn launch(&mut self, beam: &Beam, medium: &Medium, seed: u64, number: u32, pulse: u32) {
        let place = self.pulses.len() as u32;
        let (direction, area) = (beam.axis(), beam.ray_area());
        let starts = beam.ray_starts(medium, seed, number, pulse);
        self.pulses.push(PulseCount {
            beam: number,
            number: pulse,
            start_s: beam.pulses.start_time(pulse),
            rays: beam.rays,
            in_flight: beam.rays,
            power_in: starts.iter().map(|start| start.power).sum(),
            ..PulseCount::default()
        });
        self.rays.extend((0..).zip(&starts).map(|(number, start)| Ray {
            origin: start.position,
            direction,
            traveled: 0.0,
            power: start.power,
            first_power: start.power,
            area,
            way: 0.0,
            last_hit: NO_SPHERE,
            bounces: 0,
            pulse: place,
            number,
            clear: Clear::default(),
        }));
    }

    /// Rays in flight, those of the earliest pulse first, those of one pulse by their numbers.
    pub fn rays(&self) -> &[Ray] {
        &self.rays
    }

    /// The pulses in the order of their launch.
    pub fn pulses(&self) -> &[PulseCount] {
        &self.pulses
    }

    /// Tells the rays that grains were put into another order, or are gone: the new index of each old one [n].
    pub fn reindex(&mut self, new_index_of_old: &[Option<u32>]) {
        for ray in &mut self.rays {
            // A grain that is gone, and "none", stay none.
            if ray.last_hit < FIRST_FACE {
                ray.last_hit =
                    new_index_of_old.get(ray.last_hit as usize).copied().flatten().unwrap_or(NO_SPHERE);
            }
            ray.clear = Clear::default();
        }
    }

    /// What is left of a pulse ([A] 39), summed over all its rays: those that ended count with the power and the direction
    /// that they had then. A ray that was dropped counts too, since nobody knows what would have become of it; the pulse's
    /// `power_truncated` bounds that doubt.
    pub fn pulse_power(&self, pulse: usize) -> BeamPower {
        self.power_left(|place| place == pulse)
    }

    /// [`Flight::pulse_power`] of the latest pulse of each beam together.
    pub fn beam_power(&self) -> BeamPower {
        self.power_left(|place| self.is_latest(place))
    }

    /// Of the rays in flight alone, of all pulses, over the power of the latest pulse of each beam: how far the grains
    /// still hold rays. It falls to nothing as they leave.
    pub fn power_flying(&self) -> BeamPower {
        let latest = (0..self.pulses.len()).filter(|&place| self.is_latest(place));
        let power_in = latest.map(|place| self.pulses[place].power_in).sum();
        let mut sum = Sum::default();
        self.rays.iter().for_each(|ray| sum.add(ray));
        sum.over(power_in)
    }

    fn is_latest(&self, place: usize) -> bool {
        self.pulses[place + 1..].iter().all(|later| later.beam != self.pulses[place].beam)
    }

    fn power_left(&self, counts: impl Fn(usize) -> bool) -> BeamPower {
        let (mut sum, mut power_in) = (Sum::default(), 0.0);
        let counted: Vec<bool> = (0..self.pulses.len()).map(counts).collect();
        for (pulse, _) in self.pulses.iter().zip(&counted).filter(|(_, counted)| **counted) {
            power_in += pulse.power_in;
            sum.flow += pulse.flow_ended;
            sum.magnitude += pulse.power_escaped + pulse.power_truncated + pulse.power_cut_off;
            sum.squares += pulse.squares_ended;
        }
        self.rays.iter().filter(|ray| counted[ray.pulse as usize]).for_each(|ray| sum.add(ray));
        sum.over(power_in)
    }
}

/// Sums over rays: of I d, |I| and |I|².
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    flow: Vec3,
    magnitude: f64,
    squares: f64,
}

impl Sum {
    fn add(&mut self, ray: &Ray) {
        self.flow += ray.direction * ray.power;
        self.magnitude += ray.power;
        self.squares += ray.power * ray.power;
    }

    fn over(&self, power_in: f64) -> BeamPower {
        if power_in <= 0.0 {
            return BeamPower::default();
        }
        BeamPower {
            flow: self.flow / power_in,
            magnitude: self.magnitude / power_in,
            root_of_squares: self.squares.sqrt() / power_in,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::acoustics::{Pattern, Profile, Pulses, Strength};
    use crate::units::Quantity;

    fn beam(direction: [f64; 3], power: f64) -> Beam {
        Beam {
            start: [Quantity(0.0); 3],
            direction,
            radius: Quantity(1.0),
            rays: 64,
            strength: Strength::Power(Quantity(power)),
            pattern: Pattern::Sunflower,
            profile: Profile::Uniform,
            pulses: Pulses { first: Quantity(1.0), period: Some(Quantity(0.5)), count: 4 },
            frequency: None,
        }
    }

    #[test]
    fn power_of_fresh_pulses() {
        let mut flight = Flight::default();
        assert_eq!(flight.beam_power(), BeamPower::default());
        let medium = Medium::default();
        flight.launch(&beam([0.0, 3.0, 4.0], 2.0), &medium, 1, 0, 2);
        let assert_power = |found: BeamPower, [x, y, z, magnitude]: [f64; 4]| {
            assert_near_vector!(found.flow, Vec3::new(x, y, z), 1e-14, "per unit of power");
            assert_near!(found.magnitude, magnitude, 1e-14, "per unit of power");
        };
        assert!((flight.beam_power().root_of_squares - 1.0 / 8.0).abs() < 1e-14, "of 64 rays");
        assert_power(flight.beam_power(), [0.0, 0.6, 0.8, 1.0]);
        flight.launch(&beam([-1.0, 0.0, 0.0], 6.0), &medium, 1, 1, 0);
        assert_power(flight.beam_power(), [-0.75, 0.15, 0.2, 1.0]);
        assert_power(flight.pulse_power(0), [0.0, 0.6, 0.8, 1.0]);
        // A second pulse of beam 0 while all of its first is about: that counts among those in flight, (2 + 2 + 6)/(2 + 6),
        // and not among the rays of the latest pulses.
        flight.launch(&beam([0.0, 3.0, 4.0], 2.0), &medium, 1, 0, 3);
        assert_power(flight.power_flying(), [-0.75, 0.3, 0.4, 1.25]);
        assert_power(flight.beam_power(), [-0.75, 0.15, 0.2, 1.0]);
        assert_eq!([0, 1, 2].map(|k| flight.pulses()[k].start_s), [2.0, 1.0, 2.5]);
    }

    #[test]
    fn rays_follow_grains_into_another_order() {
        let mut flight = Flight::default();
        flight.launch(&beam([1.0, 0.0, 0.0], 1.0), &Medium::default(), 1, 0, 0);
        for (place, last) in [(0, 0), (1, 2), (2, 5)] {
            flight.rays[place].last_hit = last;
        }
        flight.reindex(&[Some(2), Some(0), Some(1)]);
        assert_eq!([0, 1, 2, 3].map(|k| flight.rays[k].last_hit), [2, 1, NO_SPHERE, NO_SPHERE]);
        flight.reindex(&[Some(0), None, Some(1)]);
        assert_eq!([0, 1, 2, 3].map(|k| flight.rays[k].last_hit), [1, NO_SPHERE, NO_SPHERE, NO_SPHERE]);
    }
}
