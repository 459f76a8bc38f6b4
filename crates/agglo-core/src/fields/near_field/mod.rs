//! Attraction and repulsion between grains at a distance ([A] 28): the laws, and how far they are followed.
//!
//! # Equation
//! ```text
//! F_i = sum of F_ij over all j with d_ij <= cutoff                                        [A] 28
//! U(d) = ∫ F dd from d to the cut-off, or to infinity
//! ```
//!
//! # Source
//! [A] T. I. Zohdi, Comput. Mech. 57, 465 (2016), eq. 28; `coulomb` and `van_der_waals` name theirs.
//!
//! # Signs
//! As in contact: a force > 0 repels. Energies are zero at infinity, or at the cut-off where there is one.
//!
//! # Symbols
//! | symbol | name in code | unit | meaning                                              |
//! |--------|--------------|------|------------------------------------------------------|
//! | F_ij   | `law`        | N    | of the one law that is chosen                        |
//! | d_ij   | `distance`   | m    | of the centers                                       |
//! |        | `cutoff`     | m    | beyond it a pair is left out; all pairs if not given |
//! |        | `truncation` | -    | largest part of the force that may be left out       |
//!
//! # Critical step
//! ω² = gradient of the force over m*, at the smallest gap of `van_der_waals` or where contact ends the approach,
//! looked at every 100 steps; without contact where grains are, looked at every step.
//!
//! # Valid when
//! Pairs add up. What the cut-off leaves out is measured at the start, on up to 400 grains; it may grow as grains spread or
//! clump.
//!
//! # Compared with others
//! One law at a time, where LAMMPS adds up several with `pair_style hybrid/overlay`. The force is cut off, the energy is
//! shifted to zero there, so that a pair that comes in or goes out keeps its energy.
//!
//! # In a scenario
//! ```toml
//! [fields.near_field]
//! cutoff = "5 cm"
//! truncation = 0.05
//! law.van_der_waals = { hamaker = "1e-19 J", smallest_gap = "0.4 nm" }
//! ```

mod coulomb;
mod law;
mod power_pair;
mod source;
mod van_der_waals;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use law::NearLaw;
pub use power_pair::Scaling;
pub use source::Source;

use crate::law::{Chosen, Context, Faults, Law, Needs};
use crate::math::Pace;
use crate::pages::Page;
use crate::particles::Property;
use crate::text::{digits, told_apart};
use crate::units::Length;

/// The near field: a law, and how far it is followed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NearField {
    /// The law.
    pub law: NearFieldLaw,
    /// Distance of centers beyond which it is left out, above the largest diameter; all pairs if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cutoff: Option<Length>,
    /// Largest error of the forces (root mean square, over that of all pairs) that the cut-off may cause at the
    /// start; more is refused.
    #[serde(default = "default_truncation")]
    pub truncation: f64,
}

fn default_truncation() -> f64 {
    0.05
}

family! {
    /// The closed set of near-field laws.
    pub enum NearFieldLaw at "fields.near_field.law", pages in "fields/near_field", each by each_law ($) {
        PowerPair in power_pair: "a1 d^-b1 - a2 d^-b2.";
        Coulomb in coulomb: "Electrostatic force between the grains' charges.";
        VanDerWaals in van_der_waals: "Hamaker's force between spheres.";
    }
}

impl NearFieldLaw {
    /// Repulsion [N] of two grains at a distance of centers [m].
    #[inline]
    pub fn force(&self, a: &Source, b: &Source, distance: f64) -> f64 {
        each_law!(self, law => law.force(a, b, distance))
    }

    /// Energy [J]; minus its slope over the distance is the force.
    pub fn energy(&self, a: &Source, b: &Source, distance: f64) -> f64 {
        each_law!(self, law => law.energy(a, b, distance))
    }

    /// Size of the gradient of the force [N/m], or a bound on it, at a distance of centers [m].
    pub fn gradient(&self, a: &Source, b: &Source, distance: f64) -> f64 {
        each_law!(self, law => law.gradient(a, b, distance))
    }

    /// The power b with which the force falls off at least as fast as d^-b beyond any distance.
    pub fn slowest_decay(&self) -> f64 {
        each_law!(self, law => law.slowest_decay())
    }

    /// Whether the gradient has a bound however close grains come.
    pub fn is_capped(&self) -> bool {
        each_law!(self, law => law.is_capped())
    }

    /// Whether it acts on charges alone.
    pub fn is_by_charge(&self) -> bool {
        each_law!(self, law => law.is_by_charge())
    }
}

/// The table of the near field, which its law is within.
const TABLE: &str = "fields.near_field";

impl Law for NearField {
    fn reads(&self) -> &'static [Property] {
        self.law.chosen().reads()
    }

    fn needs(&self) -> Needs {
        self.law.chosen().needs()
    }

    fn faults(&self, faults: &mut Faults, context: &Context<'_>) {
        if let Some(message) = self.fault_of_cutoff(context.largest_radius) {
            faults.fail_with("cutoff", message, "it counts from center to center");
        }
        faults.above_zero("truncation", self.truncation);
        self.law.chosen().faults_within(TABLE, faults, context);
    }

    fn notes(&self, context: &Context<'_>) -> Vec<String> {
        let mut notes = self.law.chosen().notes(context);
        notes.extend(self.note_of_cutoff());
        notes
    }

    fn warnings(&self) -> &'static [&'static str] {
        self.law.chosen().warnings()
    }
}

impl NearField {
    /// The page of what all its laws share.
    pub const PAGE: Page = Page::new("near_field", "fields/near_field", &[], include_str!("mod.rs"));

    /// The law that is chosen.
    pub fn chosen(&self) -> Chosen<'_> {
        Chosen::new(self.law.chosen().key(), self).with_settings_in(TABLE)
    }

    /// Repulsion [N] of two grains at a distance of centers [m]; 0 beyond the cut-off.
    #[inline]
    pub fn force(&self, a: &Source, b: &Source, distance: f64) -> f64 {
        if self.is_beyond(distance) { 0.0 } else { self.law.force(a, b, distance) }
    }

    /// How fast two grains are at a distance of centers [m], by the gradient of the force; at closest approach where
    /// that is to come.
    pub fn pace(&self, a: &Source, b: &Source, distance: f64) -> Pace {
        if self.is_beyond(distance) {
            return Pace::NONE;
        }
        Pace::of_spring(self.law.gradient(a, b, distance), a.mass * b.mass / (a.mass + b.mass))
    }

    /// Energy [J] whose slope the force is: zero at infinity, or from the cut-off on where there is one.
    pub fn energy(&self, a: &Source, b: &Source, distance: f64) -> f64 {
        match self.cutoff {
            Some(cutoff) if distance > cutoff.si() => 0.0,
            Some(cutoff) => self.law.energy(a, b, distance) - self.law.energy(a, b, cutoff.si()),
            None => self.law.energy(a, b, distance),
        }
    }

    /// What is wrong with the cut-off where the largest grain has this radius [m].
    pub fn fault_of_cutoff(&self, largest: f64) -> Option<String> {
        let cutoff = self.cutoff?.si();
        let [found, least] = told_apart([cutoff, 2.0 * largest], "m");
        (cutoff <= 2.0 * largest).then(|| {
            format!("{found} is not above the largest diameter {least}: touching grains are left out")
        })
    }

    /// What a cut-off costs.
    fn note_of_cutoff(&self) -> Option<String> {
        self.cutoff?;
        let limit = digits(100.0 * self.truncation);
        // In a cloud, sums over forces that fall off like d^-3 or more slowly grow with its size.
        let falls = if self.law.slowest_decay() <= 3.0 {
            "the force falls off so slowly that sums over a cloud do not converge, and a cut-off can turn the sign of the energy; "
        } else {
            ""
        };
        Some(format!(
            "fields.near_field.cutoff: {falls}the run measures what is left out of the forces at the start, and refuses more \
             than truncation = {limit} %"
        ))
    }

    #[inline]
    fn is_beyond(&self, distance: f64) -> bool {
        self.cutoff.is_some_and(|cutoff| distance > cutoff.si())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::check::assert_slope;
    use crate::units::Quantity;

    const A: Source = Source { mass: 2.0, radius: 1e-3, charge: 3e-9, polarity: 1.0 };
    const B: Source = Source { mass: 5.0, radius: 4e-3, charge: -1e-9, polarity: -1.0 };

    fn every_law() -> Vec<NearFieldLaw> {
        let mut laws: Vec<NearFieldLaw> =
            [(Scaling::Mass, 2.0, 4.0), (Scaling::Surface, 1.0, 3.0), (Scaling::Volume, 0.5, 1.0)]
                .map(|(scaling, attraction_exponent, repulsion_exponent)| {
                    let (attraction, repulsion) = (2.0, 3e-3);
                    let pair =
                        PowerPair { scaling, attraction, attraction_exponent, repulsion, repulsion_exponent };
                    NearFieldLaw::PowerPair(pair)
                })
                .to_vec();
        laws.push(NearFieldLaw::Coulomb(Coulomb { relative_permittivity: 80.0 }));
        let (hamaker, smallest_gap) = (Quantity(1e-19), Quantity(4e-7));
        laws.push(NearFieldLaw::VanDerWaals(VanDerWaals { hamaker, smallest_gap }));
        laws
    }

    #[test]
    fn force_is_minus_the_slope_of_energy_with_and_without_cutoff() {
        for law in every_law() {
            for cutoff in [None, Some(Quantity(0.08))] {
                let near = NearField { law: law.clone(), cutoff, truncation: 0.05 };
                for distance in [0.006, 0.01, 0.05] {
                    let energy = |d| -near.energy(&A, &B, d);
                    assert_slope(distance, energy, |d| near.force(&A, &B, d));
                    assert_eq!(near.force(&A, &B, distance), near.force(&B, &A, distance));
                }
            }
        }
    }

    /// ω² is the gradient over m* = 2 x 5/7 kg, whichever of the two is asked first; nothing beyond the cut-off.
    #[test]
    fn pace_of_unequal_grains() {
        for law in every_law() {
            let near = NearField { law: law.clone(), cutoff: Some(Quantity(0.08)), truncation: 0.05 };
            for (a, b) in [(&A, &B), (&B, &A)] {
                let by_hand = law.gradient(a, b, 0.01) * 7.0 / 10.0;
                assert_close!(near.pace(a, b, 0.01).square, by_hand, 1e-14, "in 1/s², {law:?}");
                assert_eq!(near.pace(a, b, 0.081), Pace::NONE);
            }
        }
    }

    /// Against a central difference of the force; a bound where two terms of a power pair differ in sign.
    #[test]
    fn the_gradient_is_the_slope_of_the_force() {
        for law in every_law() {
            for distance in [0.006_000_1, 0.01, 0.05] {
                let h = 1e-4 * (distance - 0.005);
                let slope = (law.force(&A, &B, distance + h) - law.force(&A, &B, distance - h)) / (2.0 * h);
                let across = law.force(&A, &B, distance) / distance;
                let gradient = law.gradient(&A, &B, distance);
                assert!(gradient >= (1.0 - 1e-6) * slope.abs().max(across.abs()), "{law:?} {distance}");
                if !matches!(law, NearFieldLaw::PowerPair(_)) {
                    assert!((gradient / slope.abs() - 1.0).abs() < 1e-6, "{law:?} {distance}");
                }
            }
        }
        let (hamaker, smallest_gap) = (Quantity(1e-19), Quantity(4e-10));
        let capped = VanDerWaals { hamaker, smallest_gap };
        let grain = Source { radius: 1e-6, ..Source::default() };
        // A R*/(3 g³) at the smallest gap, to O(g/R).
        let by_hand = 1e-19 * 0.5e-6 / (3.0 * 4e-10_f64.powi(3));
        for distance in [2e-6, 2e-6 + 4e-10] {
            assert_close!(capped.gradient(&grain, &grain, distance), by_hand, 1e-3);
        }
    }

    #[test]
    fn beyond_the_cutoff_there_is_nothing() {
        for law in every_law() {
            let near = NearField { law, cutoff: Some(Quantity(0.02)), truncation: 0.05 };
            assert_eq!([near.force(&A, &B, 0.021), near.energy(&A, &B, 0.021)], [0.0, 0.0]);
            assert_eq!(near.energy(&A, &B, 0.02), 0.0);
        }
    }

    /// Far away the force falls by 10^b over a decade; what is left of the nearer terms is of order 1e-3 there.
    #[test]
    fn forces_fall_off_as_they_say() {
        for law in every_law() {
            let decades = (law.force(&A, &B, 1e3) / law.force(&A, &B, 1e4)).log10();
            assert_near!(decades, law.slowest_decay(), 2e-3, "{law:?}");
        }
    }
}
