//! How agglomerates break: the energy of the impact becomes surface.
//!
//! # Equation
//! ```text
//! b = b0/(1 + ΔK b0/(3 γ V0)),   n = (b0/b)³ = (1 + ΔK/(4 π γ b0²))³                      [B] 5.1-5.3
//! ΔZ = 4 π γ (Σ b_k² - b0²) ≤ ΔK,   b_k³ = b0³ p_k/p                                      B7
//! ΔK of partner i: m_j/(m_i + m_j) of what the pair lost;   published: |m_i (v_i'² - v_i²)/2|
//! ```
//! n is rounded down, at most p, and breaking means n ≥ 2. Fragments are whole numbers of primaries, equal up to one; n falls further
//! until ΔZ of these fragments fits into ΔK. Where masses are drawn from a power law, they are drawn for this n, before the
//! energies are worked out: ΔZ is that of the fragments that come of it.
//!
//! # Source
//! [B] T. I. Zohdi, Proc. R. Soc. Lond. A 460, 3421 (2004), section 5.
//!
//! # Symbols
//! | symbol | name in code     | unit | meaning                                                  |
//! |--------|------------------|------|----------------------------------------------------------|
//! | b0, V0 | `radius`         | m, m³| of the whole                                             |
//! | b, b_k |                  | m    | of the fragments                                         |
//! | n      | `fragments`      | -    |                                                          |
//! | p, p_k | `primaries`      | -    | primary grains of the whole and of the fragments         |
//! | ΔK     | `energy`         | J    | that breaks the partner                                  |
//! | ΔZ     | `surface`        | J    | energy of the new surfaces                               |
//! | γ      | `surface_energy` | J/m² | of the material; without it nothing breaks               |
//!
//! # Valid when
//! Fragments are spheres without pores, so surfaces between primaries inside a fragment cost nothing. Whether and into how many
//! fragments a body breaks is asked of equal ones, whose surface is the most that n fragments can have.
//!
//! # Compared with others
//! The condition printed as [B] 5.3, break if b ≤ b0, is always true. In the frame of the center of mass ΔK is the same for every
//! observer; as printed it grows with the speed of the whole cloud. [B] 5.4 calls b = b0/2 two fragments; it is eight. So
//! 5.5, b0 = 4 γ/(H af β), is the size where sticking and breaking into eight need the same speed; for two it is 0.26 of it.
//!
//! # In a scenario
//! ```toml
//! [materials.grain]
//! surface_energy = "10 J/m^2"
//!
//! [impact.fragmentation]
//! energy = "center_of_mass"
//! fragments.power_law.exponent = 1.5
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::impact::fragmentation::{fragments, surface};
//! let whole = 4.0 * std::f64::consts::PI * 1e-6 * 10.0; // b0 = 1 mm, γ = 10 J/m²
//! assert_eq!(fragments(whole * 1.001, 10.0, 1e-3, 1000), 8); // twice the surface: eight fragments of half the size
//! assert!((surface(8, 10.0, 1e-3, 1000) / whole - 1.0).abs() < 1e-14);
//! ```

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::law::{Context, Faults, Law, note_if};
use crate::math::rng::{Purpose, Stream};
use crate::particles::Property;
use crate::particles::property::SURFACE_ENERGY;

/// Fragmentation, [B] 5.1-5.5; materials need a `surface_energy`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fragmentation {
    /// Whose energy breaks a partner.
    #[serde(default)]
    pub energy: BreakingEnergy,
    /// Sizes of the fragments.
    #[serde(default)]
    pub fragments: Fragments,
}

lone_law!(Fragmentation at "impact", fragmentation);

impl Law for Fragmentation {
    const WORDS: &'static [&'static str] = &["center_of_mass", "power_law"];

    const READS: &'static [Property] = &[SURFACE_ENERGY];

    fn faults(&self, faults: &mut Faults, _: &Context<'_>) {
        if let Fragments::PowerLaw(law) = &self.fragments {
            faults.exponent("fragments.power_law.exponent", law.exponent);
        }
    }

    fn notes(&self, _: &Context<'_>) -> Vec<String> {
        let note = "impact.fragmentation.energy = published: what breaks depends on the observer; center_of_mass does not";
        note_if(self.energy == BreakingEnergy::Published, note)
    }

    fn warnings(&self) -> &'static [&'static str] {
        match self.energy {
            BreakingEnergy::CenterOfMass => &[],
            BreakingEnergy::Published => &[
                "impact.fragmentation.energy = \"published\": what breaks depends on the velocity of the observer, and \
                 surfaces can take more than the impact lost",
            ],
        }
    }
}

/// The energy that an agglomerate can break with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum BreakingEnergy {
    /// Its share of what the pair lost, in the frame of their center of mass.
    #[default]
    CenterOfMass,
    /// The change of its own kinetic energy, which depends on the observer, as printed.
    Published,
}

/// Sizes of the fragments of one agglomerate.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Fragments {
    /// Equal, up to one primary.
    #[default]
    Equal,
    /// Masses drawn from a power law.
    PowerLaw(PowerLaw),
}

/// Fragment masses with number density m^-exponent between one primary and the whole.
///
/// One mass is drawn for each fragment; each gets one primary and, of the rest, a share in proportion to its mass.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PowerLaw {
    /// The exponent, above 0.
    pub exponent: f64,
}

/// Into how many fragments a body of `primaries` breaks with an energy [J]; 1 if it stays whole.
///
/// `surface_energy` in J/m², `radius` in m.
#[inline]
pub fn fragments(energy: f64, surface_energy: f64, radius: f64, primaries: u32) -> u32 {
    if primaries < 2 || energy.is_nan() || energy <= 0.0 {
        return 1;
    }
    let ratio = 1.0 + energy / (surface_energy * sphere(radius));
    let mut count = (ratio * ratio * ratio).min(f64::from(primaries)) as u32;
    while count > 1 && surface(count, surface_energy, radius, primaries) > energy {
        count -= 1;
    }
    count.max(1)
}

/// Energy [J] of the new surfaces of `fragments` that are equal up to one primary.
pub fn surface(fragments: u32, surface_energy: f64, radius: f64, primaries: u32) -> f64 {
    if fragments < 2 {
        return 0.0;
    }
    let [small, larger] = [primaries / fragments, primaries % fragments];
    let areas = f64::from(larger) * area_of(small + 1, primaries)
        + f64::from(fragments - larger) * area_of(small, primaries);
    surface_energy * sphere(radius) * (areas - 1.0)
}

/// Surface of a fragment over that of the whole.
fn area_of(share: u32, primaries: u32) -> f64 {
    (f64::from(share) / f64::from(primaries)).cbrt().powi(2)
}

fn sphere(radius: f64) -> f64 {
    4.0 * PI * radius * radius
}

/// Random numbers for the sizes of the fragments of two partners, a sequence for each.
#[derive(Clone, Debug)]
pub struct Draws([Stream; 2]);

impl Draws {
    /// Those of an impact under a seed; numbers of impacts are two apart.
    pub fn new(seed: u64, impact: u32) -> Self {
        Self([0, 1].map(|side| Stream::new(seed, Purpose::FragmentSize, impact.wrapping_add(side))))
    }

    /// Those of the partners in the other order.
    #[must_use]
    pub fn swapped(self) -> Self {
        let [a, b] = self.0;
        Self([b, a])
    }

    /// The sequence of a partner, 0 or 1, from its beginning.
    pub fn of(&self, side: usize) -> &Stream {
        &self.0[side]
    }
}

impl Fragments {
    /// Primaries of each of `count` fragments of a body that has `primaries`, largest first; `draws` decides them.
    pub fn share(&self, primaries: u32, count: u32, draws: &Stream) -> Vec<u32> {
        let mut shares = Vec::with_capacity(count as usize);
        self.each(primaries, count, draws, |share| shares.push(share));
        shares.sort_unstable_by(|a, b| b.cmp(a));
        shares
    }

    /// Energy [J] of the new surfaces of these fragments; `surface_energy` in J/m², `radius` of the whole in m.
    pub fn surface(
        &self,
        count: u32,
        surface_energy: f64,
        radius: f64,
        primaries: u32,
        draws: &Stream,
    ) -> f64 {
        if count < 2 || matches!(self, Self::Equal) {
            return surface(count, surface_energy, radius, primaries);
        }
        let mut areas = 0.0;
        self.each(primaries, count, draws, |share| areas += area_of(share, primaries));
        surface_energy * sphere(radius) * (areas - 1.0)
    }

    fn each(&self, primaries: u32, count: u32, draws: &Stream, mut visit: impl FnMut(u32)) {
        let count = count.clamp(1, primaries.max(1));
        match self {
            Self::Equal => {
                let [each, left] = [primaries / count, primaries % count];
                (0..count).for_each(|fragment| visit(each + u32::from(fragment < left)));
            }
            Self::PowerLaw(law) => law.each(primaries, count, draws, visit),
        }
    }
}

impl PowerLaw {
    fn each(&self, primaries: u32, count: u32, draws: &Stream, mut visit: impl FnMut(u32)) {
        let masses = || {
            let mut draws = draws.clone();
            (0..count).map(move |_| self.mass(f64::from(primaries), draws.uniform()))
        };
        let (sum, free) = (masses().sum::<f64>(), primaries - count);
        // Cut where the running sum of masses falls: the rounded cuts add up to all there is.
        let (mut running, mut cut) = (0.0, 0);
        for (mass, fragment) in masses().zip(1..) {
            running += mass;
            let next = ((running / sum * f64::from(free)).round() as u32).clamp(cut, free);
            let next = if fragment == count { free } else { next };
            visit(1 + next - cut);
            cut = next;
        }
    }

    /// A mass between 1 and `largest` for a random number from 0 to 1.
    fn mass(&self, largest: f64, random: f64) -> f64 {
        let power = 1.0 - self.exponent;
        if power.abs() < 1e-9 {
            largest.powf(random)
        } else {
            (1.0 + random * (largest.powf(power) - 1.0)).powf(1.0 / power)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The printed form b = b0/(1 + ΔK b0/(3 γ V0)) and n = (b0/b)³, rounded down.
    #[test]
    fn val_zohdi_2004_equation_5_2() {
        let (gamma, b0): (f64, f64) = (3.0, 2e-3);
        let volume = 4.0 / 3.0 * PI * b0.powi(3);
        for energy in [1e-5, 4e-5, 5e-5, 1e-4, 1e-3] {
            let b = b0 / (1.0 + energy * b0 / (3.0 * gamma * volume));
            let wanted = ((b0 / b).powi(3) as u32).max(1);
            assert_eq!(fragments(energy, gamma, b0, 1_000_000), wanted, "{energy}");
        }
    }

    /// Thresholds in closed form: n equal fragments need (n^(1/3) - 1) of the surface of the whole; 1e-9 on either side.
    #[test]
    fn thresholds_of_two_and_of_eight() {
        let whole = 4.0 * PI * 1e-4 * 5.0;
        for count in [2_u32, 3, 8, 64] {
            let least = (f64::from(count).cbrt() - 1.0) * whole;
            assert_eq!(fragments(least * (1.0 + 1e-9), 5.0, 0.01, 960), count);
            assert_eq!(fragments(least * (1.0 - 1e-9), 5.0, 0.01, 960), count - 1);
        }
    }

    #[test]
    fn never_more_fragments_than_primaries_nor_more_surface_than_energy() {
        assert_eq!(fragments(1e9, 1.0, 1.0, 7), 7);
        assert_eq!(fragments(1e9, 1.0, 1.0, 1), 1);
        assert_eq!(fragments(1e-3, 0.0, 1.0, 7), 7);
        assert_eq!(
            (fragments(0.0, 0.0, 1.0, 7), fragments(-1.0, 1.0, 1.0, 7), fragments(f64::NAN, 1.0, 1.0, 7)),
            (1, 1, 1)
        );
        for primaries in [2, 3, 5, 17, 1000] {
            for step in 0..400 {
                let energy = 1e-3 * 1.03_f64.powi(step);
                let count = fragments(energy, 1.0, 0.5, primaries);
                assert_between!(count, 1..=primaries);
                assert_at_most!(surface(count, 1.0, 0.5, primaries), energy, "in J");
            }
        }
    }

    /// Surface of unequal fragments from the radii themselves: 7 primaries in 3 fragments are 3, 2, 2.
    #[test]
    fn surface_of_the_actual_fragments() {
        let radii = [3.0, 2.0, 2.0].map(|part: f64| 0.5 * (part / 7.0).cbrt());
        let by_hand = 4.0 * PI * 2.0 * (radii.iter().map(|b| b * b).sum::<f64>() - 0.25);
        assert_close!(surface(3, 2.0, 0.5, 7), by_hand, 1e-14, "in J");
        assert_eq!(surface(1, 2.0, 0.5, 7), 0.0);
    }

    #[test]
    fn equal_shares() {
        let any = Stream::new(3, Purpose::Sampling, 0);
        assert_eq!(Fragments::Equal.share(7, 3, &any), [3, 2, 2]);
        assert_eq!(Fragments::Equal.share(8, 4, &any), [2; 4]);
        assert_eq!(Fragments::Equal.share(3, 9, &any), [1; 3]);
    }

    /// Surfaces from the radii of the fragments that are drawn, and never more than those of equal ones. Of two that are 97 and 3
    /// they are (97^(2/3) + 3^(2/3))/100^(2/3) - 1 = 0.076 of the whole's, of halves 0.26.
    #[test]
    fn surfaces_are_those_of_the_fragments_drawn() {
        let (gamma, radius, primaries) = (2.0, 0.5, 100);
        let mut most: f64 = 0.0;
        for exponent in [0.3, 1.0, 1.83, 4.0] {
            let law = Fragments::PowerLaw(PowerLaw { exponent });
            for (part, count) in (0..200).flat_map(|part| [2, 3, 10, 99].map(|count| (part, count))) {
                let draws = Stream::new(3, Purpose::FragmentSize, part);
                let shares = law.share(primaries, count, &draws);
                let radii = shares.iter().map(|share| radius * (f64::from(*share) / 100.0).cbrt());
                let by_hand = 4.0 * PI * gamma * (radii.map(|b| b * b).sum::<f64>() - radius * radius);
                let found = law.surface(count, gamma, radius, primaries, &draws);
                // Sums of up to a hundred terms that are 1 before they are less.
                assert!((found - by_hand).abs() < 1e-13 * sphere(radius), "{found} {by_hand}");
                assert_at_most!(found, surface(count, gamma, radius, primaries) * (1.0 + 1e-12));
                most = most.max(surface(count, gamma, radius, primaries) / found);
            }
        }
        assert!(most > 2.0, "all were nearly equal: {most}");
    }

    #[test]
    fn power_law_shares_add_up_largest_first() {
        for exponent in [0.3, 1.0, 1.83, 4.0] {
            let law = Fragments::PowerLaw(PowerLaw { exponent });
            for (primaries, count) in [(2, 2), (10, 3), (1000, 17), (50, 50), (12, 1)] {
                let shares = law.share(primaries, count, &Stream::new(3, Purpose::Sampling, primaries));
                assert_eq!((shares.len(), shares.iter().sum::<u32>()), (count as usize, primaries));
                assert_true!(
                    shares.is_sorted_by(|a, b| a >= b),
                    "from the largest to the smallest: {:?}",
                    shares
                );
                assert_all!(shares.iter(), |share| *share > 0);
            }
        }
    }

    /// Each fragment has its part of what the masses drawn add up to: of a million primaries to one, by rounding.
    #[test]
    fn shares_are_those_of_the_masses_drawn() {
        let law = PowerLaw { exponent: 1.83 };
        for (part, count) in [(0, 2), (1, 3), (2, 8), (3, 40)] {
            let draws = Stream::new(3, Purpose::FragmentSize, part);
            let mut stream = draws.clone();
            let mut masses: Vec<f64> = (0..count).map(|_| law.mass(1e6, stream.uniform())).collect();
            masses.sort_by(|a, b| b.total_cmp(a));
            let sum: f64 = masses.iter().sum();
            let shares = Fragments::PowerLaw(law.clone()).share(1_000_000, count, &draws);
            for (share, mass) in shares.into_iter().zip(masses) {
                let by_hand = 1.0 + mass / sum * f64::from(1_000_000 - count);
                assert_near!(f64::from(share), by_hand, 1.0, "primaries of one of {count} fragments");
            }
        }
    }

    /// Mean of m^-a between 1 and M in closed form, five standard errors of 200,000 draws.
    #[test]
    fn masses_follow_the_power_law() {
        let (law, largest): (PowerLaw, f64) = (PowerLaw { exponent: 1.5 }, 100.0);
        let mean = (2.0 * largest.sqrt() - 2.0) / (2.0 - 2.0 / largest.sqrt());
        let square = (largest.powf(1.5) - 1.0) / 1.5 / (2.0 - 2.0 / largest.sqrt());
        let (mut stream, n) = (Stream::new(5, Purpose::Sampling, 1), 200_000);
        let sum: f64 = (0..n).map(|_| law.mass(largest, stream.uniform())).sum();
        let error = ((square - mean * mean) / f64::from(n)).sqrt();
        assert!((sum / f64::from(n) - mean).abs() < 5.0 * error, "{} {mean}", sum / f64::from(n));
    }
}
