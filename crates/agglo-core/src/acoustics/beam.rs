//! Beams and their rays: a disc of parallel rays, turned, moved and scaled to its power ([A] section 3, Fig. 4).
//!
//! # Equation
//! ```text
//! I = p² A/(ρ c),   I_q = I w_q/(sum of w),   a_r = A/N_r                                    A11
//! ```
//! with A = π r² of the disc, w = 1 (uniform) or exp(-2 s²/w0²) at the distance s from its middle (Gaussian).
//!
//! # Source
//! T. I. Zohdi, Comput. Mech. 57, 465 (2016), section 3.1, remark 3, and section 3.2. Sunflower: H. Vogel, Math.
//! Biosci. 44, 179 (1979). Sobol: I. M. Sobol', USSR Comput. Math. Math. Phys. 7, 86 (1967), two dimensions.
//!
//! # Symbols
//! | symbol | name in code          | unit   | meaning                                  |
//! |--------|-----------------------|--------|------------------------------------------|
//! | I      | [`Beam::power`]       | W      | power of one pulse                       |
//! | p      | `Strength::Pressure`  | Pa     | pressure of the pulse                    |
//! | ρ c    | `Medium::impedance`   | Pa s/m | impedance of the medium                  |
//! | I_q    | `RayStart::power`     | W      | power of one ray                         |
//! | a_r    | [`Beam::ray_area`]    | m²     | the disc's area over the number of rays  |
//! | w0     | `Gaussian::waist`     | m      | radius of 1/e² of the middle's intensity |
//!
//! # Valid when
//! The wave is plane across a grain. Rays hold where k a is large ([`super::Medium::wavenumber_radius`]).
//!
//! # Compared with others
//! The paper calls I an energy of 7.06e13 J, "roughly" 150 MPa traveling at 1500 m/s over the beam's π m²; that product
//! is 7.07e11, a hundredth of it. Its force ([A] 6) needs a power: 150 MPa over a disc of radius 1 m in water is 4.7e10 W.
//!
//! # In a scenario
//! ```toml
//! [[acoustics.beams]]
//! start = ["-1 cm", "0 m", "0 m"]
//! direction = [1.0, 0.0, 0.0]
//! radius = "5 mm"
//! rays = 1000
//! strength.power = "1 kW"
//! pattern = "sunflower"
//! profile.gaussian.waist = "3 mm"
//! pulses = { first = "0 s", period = "100 us", count = 3 }
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::acoustics::{Beam, Medium, Pattern, Profile, Pulses, Strength};
//! use agglo::units::Quantity;
//! let beam = Beam {
//!     start: [0.0, 0.0, -1.0].map(Quantity), direction: [0.0, 0.0, 1.0], radius: Quantity(1.0), rays: 100,
//!     strength: Strength::Pressure(Quantity(150e6)), pattern: Pattern::Sunflower, profile: Profile::Uniform,
//!     pulses: Pulses::default(), frequency: None,
//! };
//! let by_hand = 150e6_f64.powi(2) * std::f64::consts::PI / (1000.0 * 1500.0); // 4.7e10 W
//! assert!((beam.power(&Medium::default()) / by_hand - 1.0).abs() < 1e-14);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use std::f64::consts::{PI, TAU};

use super::Medium;
use crate::domain::Disc;
use crate::math::Vec3;
use crate::math::rng::{Purpose, Stream};
use crate::units::{Frequency, Length, Power, Pressure, Time, Triple, vector};

/// A plane disc of parallel rays that is launched once or several times.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Beam {
    /// Middle of the disc in which the rays start, outside all grains.
    pub start: Triple<Length>,
    /// Direction in which they fly.
    pub direction: [f64; 3],
    /// Radius of the disc.
    pub radius: Length,
    /// Number of rays of one pulse.
    pub rays: u32,
    /// Power of one pulse, given directly or by its pressure.
    pub strength: Strength,
    /// How the rays lie in the disc.
    #[serde(default)]
    pub pattern: Pattern,
    /// How the power is spread over the disc.
    #[serde(default)]
    pub profile: Profile,
    /// When pulses start.
    #[serde(default)]
    pub pulses: Pulses,
    /// Frequency of the sound, if there is one: only for judging whether rays hold.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frequency: Option<Frequency>,
}

/// The strength of a beam.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Strength {
    /// Power of the whole beam.
    Power(Power),
    /// Pressure p: the power is p² A/(rho c).
    Pressure(Pressure),
}

/// How rays lie in the disc.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Pattern {
    /// Uniformly random.
    #[default]
    Random,
    /// Vogel's sunflower spiral.
    Sunflower,
    /// Sobol's sequence.
    Sobol,
}

/// How power is spread over the disc.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Profile {
    /// The same everywhere.
    #[default]
    Uniform,
    /// exp(-2 r²/w²), cut at the disc's edge.
    Gaussian(Gaussian),
}

/// A Gaussian profile.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Gaussian {
    /// w: radius at which the intensity is 1/e² of that in the middle.
    pub waist: Length,
}

/// When pulses start.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Pulses {
    /// Start of the first pulse.
    #[serde(default)]
    pub first: Time,
    /// From one start to the next; needed for more than one pulse.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub period: Option<Time>,
    /// How many; none but those that a program asks for with 0.
    #[serde(default = "one")]
    pub count: u32,
}

fn one() -> u32 {
    1
}

impl Default for Pulses {
    fn default() -> Self {
        Self { first: Time::default(), period: None, count: 1 }
    }
}

/// Where a ray starts, and with what power.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayStart {
    /// Point in the beam's disc [m].
    pub position: Vec3,
    /// Power [W].
    pub power: f64,
}

impl Pulses {
    /// When a pulse starts [s]; `pulse` counts from 0.
    pub fn start_time(&self, pulse: u32) -> f64 {
        self.first.si() + f64::from(pulse) * self.period.map_or(0.0, Time::si)
    }

    /// When the pulses start [s], one after the other.
    pub fn start_times(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.count).map(|pulse| self.start_time(pulse))
    }
}

impl Beam {
    /// Direction of flight, a unit vector.
    pub fn axis(&self) -> Vec3 {
        Vec3::from(self.direction).normalized()
    }

    /// Area of the disc [m²].
    pub fn area(&self) -> f64 {
        PI * self.radius.si() * self.radius.si()
    }

    /// Area of one ray [m²]: the disc's over the number of rays.
    pub fn ray_area(&self) -> f64 {
        self.area() / f64::from(self.rays)
    }

    /// Power of one pulse [W] (A11).
    pub fn power(&self, medium: &Medium) -> f64 {
        match self.strength {
            Strength::Power(power) => power.si(),
            Strength::Pressure(pressure) => pressure.si() * pressure.si() * self.area() / medium.impedance(),
        }
    }

    /// Where the rays of a pulse start [rays]; random ones depend on (`seed`, `beam`, `pulse`) and on nothing else.
    ///
    /// `beam` is the beam's number in the scenario, `pulse` counts its pulses from 0. The powers add up to
    /// [`Beam::power`].
    pub fn ray_starts(&self, medium: &Medium, seed: u64, beam: u32, pulse: u32) -> Vec<RayStart> {
        let mut stream = Stream::new(seed, Purpose::Beam, beam);
        // One block of the stream holds the two numbers of a ray.
        stream.jump_to(u64::from(pulse) * u64::from(self.rays));
        let (middle, (e1, e2)) = (vector(self.start), self.axis().frame());
        let mut starts = Vec::with_capacity(self.rays as usize);
        let mut weights = 0.0;
        for ray in 0..self.rays {
            let (radius, angle) = self.pattern.point(ray, self.rays, &mut stream);
            let (sin, cos) = angle.sin_cos();
            let distance = radius * self.radius.si();
            let power = self.profile.weight(distance);
            weights += power;
            starts.push(RayStart { position: middle + (e1 * cos + e2 * sin) * distance, power });
        }
        let scale = self.power(medium) / weights;
        for start in &mut starts {
            start.power *= scale;
        }
        starts
    }

    /// The disc in which the rays start.
    pub fn disc(&self) -> Disc {
        Disc { center: vector(self.start), axis: self.axis(), radius: self.radius.si() }
    }

    /// Way [m] from the disc to the first grain that its straight rays can meet; `positions` [n, 3] [m], `radii` [n] [m]. None
    /// where all pass by.
    pub fn first_hit(&self, positions: &[Vec3], radii: &[f64]) -> Option<f64> {
        let disc = self.disc();
        let grains = positions.iter().zip(radii);
        grains.filter_map(|(&position, &radius)| disc.meets(position, radius)).min_by(f64::total_cmp)
    }
}

impl Pattern {
    /// A point of the template disc of radius one: distance from the middle and angle [rad].
    fn point(self, ray: u32, rays: u32, stream: &mut Stream) -> (f64, f64) {
        match self {
            Self::Random => {
                let area = stream.uniform();
                (area.sqrt(), TAU * stream.uniform())
            }
            Self::Sunflower => {
                let golden_angle = PI * (3.0 - 5.0_f64.sqrt());
                let turns = (f64::from(ray) * golden_angle) % TAU;
                (((f64::from(ray) + 0.5) / f64::from(rays)).sqrt(), turns)
            }
            Self::Sobol => {
                let [area, turn] = sobol(ray);
                (area.sqrt(), TAU * turn)
            }
        }
    }
}

impl Profile {
    /// Intensity at a distance [m] from the middle, over that in the middle.
    fn weight(&self, distance: f64) -> f64 {
        match self {
            Self::Uniform => 1.0,
            Self::Gaussian(gaussian) => (-2.0 * (distance / gaussian.waist.si()).powi(2)).exp(),
        }
    }
}

/// Point of Sobol's sequence in the unit square, moved to the middle of its cell of side 2^-32.
fn sobol(index: u32) -> [f64; 2] {
    let mut second = 0_u32;
    let mut direction = 1_u32 << 31;
    let mut bits = index;
    while bits != 0 {
        if bits & 1 == 1 {
            second ^= direction;
        }
        direction ^= direction >> 1;
        bits >>= 1;
    }
    [index.reverse_bits(), second].map(|word| (f64::from(word) + 0.5) / (1_u64 << 32) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Region;
    use crate::units::Quantity;

    fn beam(pattern: Pattern, rays: u32) -> Beam {
        Beam {
            start: [1.0, -2.0, 0.5].map(Quantity),
            direction: [1.0, 2.0, -2.0],
            radius: Quantity(0.3),
            rays,
            strength: Strength::Power(Quantity(5.0)),
            pattern,
            profile: Profile::Uniform,
            pulses: Pulses::default(),
            frequency: None,
        }
    }

    #[test]
    fn power_of_the_paper_s_pressure() {
        let paper = Beam {
            radius: Quantity(1.0),
            strength: Strength::Pressure(Quantity(150e6)),
            ..beam(Pattern::Random, 10)
        };
        // 2.25e16 pi / 1.5e6 = 1.5e10 pi.
        assert_close!(paper.power(&Medium::default()), 1.5e10 * PI, 1e-14, "in W");
    }

    /// Mean of s²/R² over a uniform disc is 1/2; of n random points its standard error is 1/sqrt(12 n). The
    /// first moments vanish with standard error 1/(2 sqrt n). Ordered patterns are far better.
    #[test]
    fn patterns_fill_the_disc_evenly() {
        let n = 4096;
        for (pattern, moment, mean) in [
            (Pattern::Random, 3.0 / (12.0 * f64::from(n)).sqrt(), 1.5 / f64::from(n).sqrt()),
            (Pattern::Sunflower, 1e-12, 1e-3),
            (Pattern::Sobol, 1e-9, 1e-3),
        ] {
            let beam = beam(pattern, n);
            let axis = beam.axis();
            let (mut second, mut first) = (0.0, Vec3::ZERO);
            for start in beam.ray_starts(&Medium::default(), 3, 0, 0) {
                let from = start.position - vector(beam.start);
                assert_below!(from.dot(axis).abs(), 1e-15);
                assert_at_most!(from.norm(), 0.3 + 1e-15);
                second += from.norm_squared() / 0.09 / f64::from(n);
                first += from / (0.3 * f64::from(n));
            }
            // Sobol's radii are (k + tiny)/n: half a step short of the middle.
            let expected = if pattern == Pattern::Sobol { 0.5 - 0.5 / f64::from(n) } else { 0.5 };
            assert!((second - expected).abs() < moment, "{pattern:?} {second}");
            assert!(first.norm() < mean, "{pattern:?} {first:?}");
        }
    }

    /// First points of the sequence as published: (0, 0), (1/2, 1/2), (1/4, 3/4), (3/4, 1/4), (1/8, 5/8).
    #[test]
    fn sobol_s_first_points() {
        let known = [[0.0, 0.0], [0.5, 0.5], [0.25, 0.75], [0.75, 0.25], [0.125, 0.625]];
        for (index, point) in known.iter().enumerate() {
            let found = sobol(index as u32);
            assert!(
                (0..2).all(|k| (found[k] - point[k] - 0.5_f64.powi(33)).abs() < 1e-18),
                "{index} {found:?}"
            );
        }
    }

    #[test]
    fn random_rays_belong_to_seed_beam_and_pulse() {
        let beam = beam(Pattern::Random, 50);
        let of = |seed, number, pulse| beam.ray_starts(&Medium::default(), seed, number, pulse);
        let base = of(1, 0, 0);
        assert_eq!(base, of(1, 0, 0));
        for other in [of(2, 0, 0), of(1, 1, 0), of(1, 0, 1)] {
            assert_all!(other.iter(), |start| !base.contains(start));
        }
    }

    /// Part of the power within s of an even disc of radius R: (1 - exp(-2 s²/w²))/(1 - exp(-2 R²/w²)).
    #[test]
    fn gaussian_profile_has_the_beam_s_power_and_its_spread() {
        let mut beam = beam(Pattern::Sunflower, 20_000);
        beam.profile = Profile::Gaussian(Gaussian { waist: Quantity(0.2) });
        let starts = beam.ray_starts(&Medium::default(), 0, 0, 0);
        let total: f64 = starts.iter().map(|start| start.power).sum();
        // 20,000 roundings in a sum of positive terms.
        assert_close!(total, 5.0, 1e-12);
        let within = |s: f64| {
            let inner = starts.iter().filter(|start| (start.position - vector(beam.start)).norm() <= s);
            inner.map(|start| start.power).sum::<f64>() / 5.0
        };
        let part = |s: f64| -(-2.0 * (s / 0.2_f64).powi(2)).exp_m1();
        for s in [0.05, 0.1, 0.2] {
            // One ray of 20,000 more or less at the edge.
            assert_close!(within(s), part(s) / part(0.3), 2e-3);
        }
    }

    #[test]
    fn pulses_start_one_period_after_another() {
        let pulses = Pulses { first: Quantity(1e-3), period: Some(Quantity(2e-3)), count: 3 };
        let times: Vec<f64> = pulses.start_times().collect();
        assert_eq!(times, [1e-3, 1e-3 + 2e-3, 1e-3 + 2.0 * 2e-3]);
        assert_eq!(Pulses::default().start_times().count(), 1);
    }

    /// A beam along x from -1 m whose radius is 0.3 m: of a grain of 0.1 m at x = 2 m, 0.35 m off the axis, the rim meets the
    /// flank, √(0.1² - 0.05²) before its middle; another at x = 5 m comes later, a third is missed.
    #[test]
    fn the_first_grain_in_the_way() {
        let along = Beam {
            start: [-1.0, 0.0, 0.0].map(Quantity),
            direction: [2.0, 0.0, 0.0],
            ..beam(Pattern::Random, 1)
        };
        let positions = [Vec3::new(5.0, 0.0, 0.0), Vec3::new(2.0, 0.35, 0.0), Vec3::new(0.0, 0.41, 0.0)];
        let first = along.first_hit(&positions, &[0.1; 3]).unwrap();
        assert_near!(first, 3.0 - (0.01_f64 - 0.0025).sqrt(), 1e-14);
        assert_eq!(along.first_hit(&positions[2..], &[0.1]), None);
    }

    #[test]
    fn a_disc_in_a_box_and_in_a_cylinder() {
        let across =
            Beam { start: [Quantity(0.0); 3], direction: [0.0, 0.0, 1.0], ..beam(Pattern::Random, 1) };
        let block = |x: f64, z: f64| {
            let corner = [x, 1.0, z].map(Quantity);
            Region::Box(crate::domain::Block { lower: corner.map(|c| Quantity(-c.si())), upper: corner })
        };
        assert_true!(across.disc().lies_in(&block(0.31, 1e-3)), "the whole beam starts inside");
        assert_false!(across.disc().lies_in(&block(0.29, 1.0)), "the whole beam starts inside");
        let cylinder = |radius: f64| {
            Region::Cylinder(crate::domain::Cylinder {
                center: [Quantity(0.0); 3],
                axis: [0.0, 0.0, 2.0],
                radius: Quantity(radius),
                length: Quantity(0.1),
            })
        };
        assert_true!(across.disc().lies_in(&cylinder(0.31)), "the whole beam starts inside");
        assert_false!(across.disc().lies_in(&cylinder(0.29)), "the whole beam starts inside");
    }
}
