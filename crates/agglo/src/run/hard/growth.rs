//! How far the grains have grown: quantities of one moment.
//!
//! # Equation
//! ```text
//! b = mean radius,  n_f = (b/b_0)³,  Π = 1 - b/b*,  b*³ = sum(r³)                     [B] 7.1-7.4
//! granular temperature θ = sum(|v - V|²)/(3 n),  V = sum(m v)/sum(m)
//! ```
//!
//! # Source
//! [B] T. I. Zohdi, Proc. R. Soc. Lond. A 460, 3421 (2004), section 7.
//!
//! # Symbols
//! | symbol | name in code           | unit  | meaning                                              |
//! |--------|------------------------|-------|------------------------------------------------------|
//! | b      | `mean_radius`          | m     | number mean; b_0 at the start                        |
//! | b*     | `united_radius`        | m     | radius of one sphere of all the solid                |
//! | Π      | `cost`                 | -     | 0 for one sphere, near 1 for many                    |
//! | θ      | `granular_temperature` | m²/s² | number mean about the center of mass's velocity V     |
//!
//! # Valid when
//! There is at least one grain; without any, all quantities are 0.
//!
//! # Compared with others
//! [B] starts from equal spheres, where n_f is the number of primaries of the mean sphere; with scattered sizes it is
//! a ratio of volumes of mean spheres, no more.
//!
//! # In a campaign
//! ```toml
//! [[objectives]]
//! minimize = "growth_deficit"
//! ```
//!
//! # Example
//! ```
//! use agglo::engine::hard::Snapshot;
//! use agglo::particles::Row;
//! use agglo::run::Growth;
//! let mut now = Snapshot::default();
//! for (radius, primaries) in [(1e-3, 1), (2e-3, 8)] {
//!     now.grains.push(Row { radius, mass: 1e-6 * f64::from(primaries), ..Row::default() });
//!     now.primaries.push(primaries);
//! }
//! let growth = Growth::of(&now);
//! assert!((growth.mean_radius / 1.5e-3 - 1.0).abs() < 1e-15);
//! assert!((growth.cost() - (1.0 - 1.5 / 9_f64.cbrt())).abs() < 1e-15);
//! ```

use crate::engine::hard::Snapshot;
use crate::math::Vec3;

/// Quantities of the grains at one moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Growth {
    /// How many grains.
    pub grains: usize,
    /// Mean radius [m].
    pub mean_radius: f64,
    /// Standard deviation of the radius [m].
    pub deviation_radius: f64,
    /// Radius of one sphere of all the solid [m].
    pub united_radius: f64,
    /// Radius of the largest grain [m].
    pub largest_radius: f64,
    /// Place in the snapshot of the largest grain, the first of several.
    pub largest: usize,
    /// Most primaries of a grain.
    pub largest_primaries: u32,
    /// Mass of all [kg].
    pub mass: f64,
    /// Mass of the largest grain over that of all.
    pub largest_fraction: f64,
    /// Mean temperature by mass [K].
    pub mean_temperature: f64,
    /// Lowest temperature [K].
    pub lowest_temperature: f64,
    /// Highest temperature [K].
    pub highest_temperature: f64,
    /// Velocity of the center of mass [m/s].
    pub mean_velocity: Vec3,
    /// Mean speed [m/s].
    pub mean_speed: f64,
    /// Largest speed [m/s].
    pub largest_speed: f64,
    /// Granular temperature [m²/s²].
    pub granular_temperature: f64,
}

impl Growth {
    /// Takes the quantities.
    pub fn of(now: &Snapshot) -> Self {
        let grains = &now.grains;
        let Some(largest) = largest_of(&grains.radius) else { return Self::default() };
        let count = grains.len() as f64;
        let mean = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>() / count;
        // About the first one: equal radii then have exactly their own mean.
        let first = grains.radius[0];
        let mean_radius = first + mean(&mut grains.radius.iter().map(|radius| radius - first));
        let off_mean = |radius: &f64| (radius - mean_radius) * (radius - mean_radius);
        let mass: f64 = grains.mass.iter().sum();
        let momentum = grains.velocity.iter().zip(&grains.mass).fold(Vec3::ZERO, |sum, (v, m)| sum + *v * *m);
        let heat: f64 = grains.temperature.iter().zip(&grains.mass).map(|(kelvin, m)| kelvin * m).sum();
        let mean_velocity = momentum / mass;
        let scatter = |v: &Vec3| (*v - mean_velocity).norm_squared() / 3.0;
        Self {
            grains: grains.len(),
            mean_radius,
            deviation_radius: mean(&mut grains.radius.iter().map(off_mean)).sqrt(),
            united_radius: grains.radius.iter().map(|r| r * r * r).sum::<f64>().cbrt(),
            largest_radius: grains.radius[largest],
            largest,
            largest_primaries: now.primaries.iter().copied().max().unwrap_or(0),
            mass,
            largest_fraction: grains.mass[largest] / mass,
            mean_temperature: heat / mass,
            lowest_temperature: grains.temperature.iter().copied().fold(f64::INFINITY, f64::min),
            highest_temperature: grains.temperature.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            mean_velocity,
            mean_speed: mean(&mut grains.velocity.iter().map(|v| v.norm())),
            largest_speed: grains.velocity.iter().map(|v| v.norm()).fold(0.0, f64::max),
            granular_temperature: mean(&mut grains.velocity.iter().map(scatter)),
        }
    }

    /// The cost Π = 1 - b/b* of [B].
    pub fn cost(&self) -> f64 {
        if self.united_radius > 0.0 { 1.0 - self.mean_radius / self.united_radius } else { 0.0 }
    }
}

fn largest_of(radii: &[f64]) -> Option<usize> {
    let larger = |best: usize, at: usize| if radii[at] > radii[best] { at } else { best };
    (0..radii.len()).reduce(larger)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particles::Row;

    fn snapshot(rows: &[(f64, f64, f64, [f64; 3], u32)]) -> Snapshot {
        let mut now = Snapshot::default();
        for &(radius, mass, temperature, velocity, primaries) in rows {
            let velocity = Vec3::from(velocity);
            now.grains.push(Row { velocity, radius, mass, temperature, ..Row::default() });
            now.primaries.push(primaries);
        }
        now
    }

    /// Three grains by hand; numbers are small integers, so that sums carry no rounding but that of thirds.
    #[test]
    fn quantities_by_hand() {
        let rows = [
            (1.0, 1.0, 100.0, [4.0, 0.0, 0.0], 1),
            (3.0, 2.0, 400.0, [1.0, 0.0, 3.0], 7),
            (2.0, 1.0, 300.0, [-2.0, 0.0, -2.0], 9),
        ];
        let growth = Growth::of(&snapshot(&rows));
        assert_eq!((growth.grains, growth.mean_radius, growth.largest_radius), (3, 2.0, 3.0));
        assert_eq!((growth.largest, growth.largest_primaries, growth.largest_fraction), (1, 9, 0.5));
        assert_near!(growth.united_radius, 36_f64.cbrt(), 1e-15, "in m");
        assert_near!(growth.deviation_radius, (2.0_f64 / 3.0).sqrt(), 1e-15, "in m");
        assert_eq!((growth.mass, growth.mean_temperature), (4.0, 1200.0 / 4.0));
        assert_eq!((growth.lowest_temperature, growth.highest_temperature), (100.0, 400.0));
        // V = (4 + 2 - 2, 0, 6 - 2)/4 = (1, 0, 1); deviations (3, -1), (0, 2), (-3, -3): 10 + 4 + 18 over 9.
        assert_eq!(growth.mean_velocity, Vec3::new(1.0, 0.0, 1.0));
        assert_near!(growth.granular_temperature, 32.0 / 9.0, 1e-15, "in K");
        let speed = (4.0 + 10_f64.sqrt() + 8_f64.sqrt()) / 3.0;
        assert_near!(growth.mean_speed, speed, 1e-15, "in m/s");
        assert_eq!(growth.largest_speed, 4.0);
    }

    /// [B], section 8: b_f = 3.2292 mean radii of 1000 equal spheres has Π = 1 - 3.2292/10 = 0.67708.
    #[test]
    fn val_zohdi_2004_cost_of_the_best() {
        let growth = Growth { mean_radius: 3.2292, united_radius: 1000_f64.cbrt(), ..Growth::default() };
        assert_near!(growth.cost(), 0.67708, 1e-12);
    }

    #[test]
    fn equal_grains_have_their_own_radius() {
        let growth = Growth::of(&snapshot(&vec![(0.1, 1.0, 300.0, [0.0; 3], 1); 1000]));
        assert_eq!((growth.mean_radius, growth.deviation_radius), (0.1, 0.0));
    }

    #[test]
    fn no_grains_are_no_trouble() {
        let growth = Growth::of(&Snapshot::default());
        assert_eq!((growth, growth.cost()), (Growth::default(), 0.0));
    }
}
