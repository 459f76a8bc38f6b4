//! A pair force of one's own along the line of centers, given as a formula.
//!
//! # Equation
//! ```text
//! F = F(δ, v_n, ...),   U = ∫ F(δ', 0, ...) dδ' from -ℓ to δ,   P_n = (F(δ, v_n, ...) - F(δ, 0, ...)) v_n  CU1
//! ω² = (∂F/∂δ)/m*,   Γ = (∂F/∂v_n)/m*                                                     CU2
//! ```
//! At rest, v_n = 0, the force is elastic, and U is what it stores from where it begins to act. What it gives beyond that is
//! dissipation, P_n > 0, and booked as that of dashpots. Where it drives the grains instead, P_n < 0, the ledger books it as
//! `work_custom_J`, and the run warns.
//!
//! # Source
//! None: the formula is the scenario's own. It is booked as the springs and dashpots of P. A. Cundall and O. D. L. Strack,
//! Géotechnique 29, 47 (1979).
//!
//! # Symbols
//! | symbol | name in code     | unit | meaning                                                              |
//! |--------|------------------|------|----------------------------------------------------------------------|
//! | F      | `force`          | N    | repulsion, as a formula                                              |
//! | δ      | `overlap`        | m    | R_i + R_j - distance; below 0 at a distance, where `reach` is given  |
//! | v_n    | `speed`          | m/s  | rate of the overlap: > 0 while grains approach                       |
//! | ℓ      | `reach`          | m    | how far beyond touching the force acts                               |
//! | U      | `energy`         | J    | stored energy; integrated if not given                               |
//! | P_n    |                  | W    | power that the part with the speed takes                             |
//! | m*     | `effective_mass` | kg   | m_i m_j / (m_i + m_j)                                                |
//!
//! Names in the formulas, all in SI units: `overlap`, `speed`, `radius_sum`, `effective_radius` R_i R_j/(R_i + R_j), `smaller_radius`,
//! `larger_radius` [m], `effective_mass` [kg], and of the materials `effective_modulus` E* of Hertz' law and the mean
//! `contact_stiffness` [Pa].
//!
//! # Critical step
//! ω² and Γ of the formula's slopes (CU2) at overlaps up to that which `limits.strain` allows; looked at every 100 steps, and every
//! step where the formula has the speed.
//!
//! # Valid when
//! The formula has a value at all overlaps that are reached; some are tried before a run. The integral is good to 1e-12 where the
//! formula is smooth, also with half powers at touching. Where the force jumps as grains begin to touch, energy is kept only as
//! well as the steps resolve the jump. Friction and damping act on touching grains alone, with the whole of the normal force and
//! its slope. `damping.restitution` is exact where the force is a power of the overlap, as Hertz' law is.
//!
//! # Compared with others
//! LAMMPS has tables and, by `pair_style lepton`, formulas of the distance; energies of dissipative formulas are not booked there.
//!
//! # In a scenario
//! ```toml
//! [materials.grain]
//! youngs_modulus = "70 GPa"
//! poisson_ratio = 0.22
//!
//! [contact.custom]
//! force = "4/3*effective_modulus*sqrt(effective_radius)*overlap^1.5 + 0.02*overlap^0.25*speed"
//! energy = "8/15*effective_modulus*sqrt(effective_radius)*overlap^2.5"
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::contact::{Custom, PairConstants, ContactGeometry};
//! let law = Custom::new("2e4*overlap + 3*speed");
//! let (pair, geometry) = (PairConstants::default(), ContactGeometry { overlap: 1e-6, ..ContactGeometry::default() });
//! assert!((law.force(&pair, &geometry, 0.1) - 0.32).abs() < 1e-15);
//! assert!((law.energy(&pair, &geometry) / 1e-8 - 1.0).abs() < 1e-14);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{ContactGeometry, PairConstants};
use crate::law::{Context, Faults, Law, Needs, Sample};
use crate::math::Pace;
use crate::math::formula::{Names, Written};
use crate::math::quadrature::integral;
use crate::particles::Property;
use crate::particles::property::{CONTACT_STIFFNESS, POISSON_RATIO, SOFTENING, YOUNGS_MODULUS};
use crate::text::readable;
use crate::units::{Length, Quantity};

/// A force along the line of centers as a formula; it stands beside `contact.normal` or in its place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Custom {
    /// Repulsion [N].
    pub force: ContactFormula,
    /// Energy [J] that the force stores at rest; integrated if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub energy: Option<ContactFormula>,
    /// How far beyond touching it acts, where the overlap is below 0; not at all if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reach: Option<Length>,
}

/// A formula over what is known of two grains in contact.
pub type ContactFormula = Written<OfPair>;

/// What is known of two grains in contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OfPair {
    /// δ [m].
    Overlap,
    /// Rate of the overlap [m/s].
    Speed,
    /// R_i + R_j [m].
    RadiusSum,
    /// R* [m].
    EffectiveRadius,
    /// The radius of the smaller one [m].
    SmallerRadius,
    /// The radius of the larger one [m].
    LargerRadius,
    /// m* [kg].
    EffectiveMass,
    /// E* [Pa].
    EffectiveModulus,
    /// Mean contact stiffness [Pa].
    ContactStiffness,
}

impl Names for OfPair {
    const ALL: &'static [(&'static str, &'static str, Self)] = &[
        ("overlap", "m", Self::Overlap),
        ("speed", "m/s", Self::Speed),
        ("radius_sum", "m", Self::RadiusSum),
        ("effective_radius", "m", Self::EffectiveRadius),
        ("smaller_radius", "m", Self::SmallerRadius),
        ("larger_radius", "m", Self::LargerRadius),
        ("effective_mass", "kg", Self::EffectiveMass),
        ("effective_modulus", "Pa", Self::EffectiveModulus),
        ("contact_stiffness", "Pa", Self::ContactStiffness),
    ];
}

/// Parts of the way from where a contact begins to its overlap at which its slope is taken.
const ON_THE_WAY: [f64; 6] = [1.0, 0.8, 0.6, 0.4, 0.2, 0.02];

impl Custom {
    /// A force [N] that acts in contact and whose energy is integrated.
    pub fn new(force: &str) -> Self {
        Self { force: Written::new(force), energy: None, reach: None }
    }

    /// Repulsion [N] at a rate of the overlap [m/s].
    #[inline]
    pub fn force(&self, pair: &PairConstants, geometry: &ContactGeometry, speed: f64) -> f64 {
        self.force.at(|name| value(name, pair, geometry, speed))
    }

    /// What the force [N] is beyond that at rest.
    #[inline]
    pub fn beyond_rest(&self, pair: &PairConstants, geometry: &ContactGeometry, speed: f64) -> f64 {
        if self.has_speed() {
            self.force(pair, geometry, speed) - self.force(pair, geometry, 0.0)
        } else {
            0.0
        }
    }

    /// Whether the force depends on the speed.
    #[inline]
    pub fn has_speed(&self) -> bool {
        self.force.has(OfPair::Speed)
    }

    /// Slopes of the force over the overlap [N/m] and the speed [N s/m].
    #[inline]
    pub fn slopes(&self, pair: &PairConstants, geometry: &ContactGeometry, speed: f64) -> [f64; 2] {
        let along = |name| match name {
            OfPair::Overlap => [1.0, 0.0],
            OfPair::Speed => [0.0, 1.0],
            _ => [0.0, 0.0],
        };
        self.force.slopes(|name| value(name, pair, geometry, speed), along)
    }

    /// Energy stored [J], 0 where the force begins to act.
    pub fn energy(&self, pair: &PairConstants, geometry: &ContactGeometry) -> f64 {
        let border = -self.reach();
        let at = |overlap: f64| ContactGeometry { overlap, ..*geometry };
        if let Some(energy) = &self.energy {
            let stored = |overlap: f64| energy.at(|name| value(name, pair, &at(overlap), 0.0));
            stored(geometry.overlap) - stored(border)
        } else {
            integral(|overlap| self.force(pair, &at(overlap), 0.0), border, geometry.overlap)
        }
    }

    /// How far beyond touching it acts [m].
    #[inline]
    pub fn reach(&self) -> f64 {
        self.reach.map_or(0.0, Length::si)
    }

    /// How fast a contact is with this overlap and this rate of it [m/s].
    pub fn pace_at(&self, pair: &PairConstants, geometry: &ContactGeometry, speed: f64) -> Pace {
        let [stiffness, dashpot] = self.slopes(pair, geometry, speed);
        Pace::of_spring(stiffness, geometry.effective_mass)
            + Pace::of_dashpot(dashpot, geometry.effective_mass)
    }

    /// How fast a contact is that reaches this overlap slowly.
    pub fn pace(&self, pair: &PairConstants, geometry: &ContactGeometry) -> Pace {
        let border = -self.reach();
        let at = |part: f64| {
            let overlap = border + part * (geometry.overlap - border);
            self.pace_at(pair, &ContactGeometry { overlap, ..*geometry }, 0.0)
        };
        ON_THE_WAY.map(at).into_iter().fold(Pace::NONE, Pace::max)
    }
}

#[inline]
fn value(name: OfPair, pair: &PairConstants, geometry: &ContactGeometry, speed: f64) -> f64 {
    match name {
        OfPair::Overlap => geometry.overlap,
        OfPair::Speed => speed,
        OfPair::RadiusSum => geometry.radius_sum,
        OfPair::EffectiveRadius => geometry.effective_radius,
        OfPair::SmallerRadius => geometry.smaller_radius,
        OfPair::LargerRadius => geometry.radius_sum - geometry.smaller_radius,
        OfPair::EffectiveMass => geometry.effective_mass,
        OfPair::EffectiveModulus => pair.effective_modulus,
        OfPair::ContactStiffness => geometry.stiffness,
    }
}

lone_law!(Custom at "contact", custom);

impl Law for Custom {
    const READS: &'static [Property] = &[YOUNGS_MODULUS, POISSON_RATIO, CONTACT_STIFFNESS, SOFTENING];

    fn reads(&self) -> &'static [Property] {
        match [OfPair::EffectiveModulus, OfPair::ContactStiffness].map(|name| self.names(name)) {
            [true, true] => Self::READS,
            [true, false] => &[YOUNGS_MODULUS, POISSON_RATIO],
            [false, true] => &[CONTACT_STIFFNESS, SOFTENING],
            [false, false] => &[],
        }
    }

    fn needs(&self) -> Needs {
        let properties: &[Property] =
            match [OfPair::EffectiveModulus, OfPair::ContactStiffness].map(|name| self.names(name)) {
                [true, true] => &[YOUNGS_MODULUS, POISSON_RATIO, CONTACT_STIFFNESS],
                [true, false] => &[YOUNGS_MODULUS, POISSON_RATIO],
                [false, true] => &[CONTACT_STIFFNESS],
                [false, false] => &[],
            };
        Needs { properties, because: "by the names in its formula" }
    }

    fn faults(&self, faults: &mut Faults, context: &Context<'_>) {
        let energy = self.energy.as_ref().and_then(|energy| {
            let of_speed = "the energy is that at rest: it cannot name speed";
            energy.fault().or_else(|| energy.has(OfPair::Speed).then_some(of_speed))
        });
        for (key, fault) in [("force", self.force.fault()), ("energy", energy)] {
            if let Some(message) = fault {
                faults.fail(key, message.to_owned());
            }
        }
        if let Some(reach) = self.reach {
            faults.positive("reach", reach);
        }
        if self.force.fault().is_none() && energy.is_none() {
            try_out(self, faults, context);
        }
    }

    fn notes(&self, context: &Context<'_>) -> Vec<String> {
        doubts(self, context)
    }
}

impl Custom {
    /// Whether one of its formulas has a name in it.
    pub fn names(&self, name: OfPair) -> bool {
        self.force.has(name) || self.energy.as_ref().is_some_and(|energy| energy.has(name))
    }
}

/// Overlaps that are tried, over the sum of the radii.
const STRAINS: [f64; 6] = [1e-9, 1e-6, 1e-4, 1e-3, 1e-2, 0.1];
/// Parts of the reach at which grains that do not touch are tried.
const APART: [f64; 4] = [0.999, 0.5, 0.1, 1e-3];
/// Speeds that are tried [m/s], both ways.
const SPEEDS: [f64; 4] = [1e-3, -1e-3, 1.0, -1.0];
/// Kinds of grains that are tried with one another.
const MOST_KINDS: usize = 8;
/// Part of the force by which the slope of an energy may differ from it.
const TOLERANCE: f64 = 1e-6;
/// A force above this part of that at a strain of a thousandth jumps where it begins.
const JUMP: f64 = 1e-3;

/// Looks at every pair of kinds, at every overlap that is tried; stops where `look` finds something.
fn first<R>(
    law: &Custom,
    context: &Context<'_>,
    mut look: impl FnMut(&PairConstants, &ContactGeometry, &str) -> Option<R>,
) -> Option<R> {
    let kinds = &context.samples[..context.samples.len().min(MOST_KINDS)];
    for (at, a) in kinds.iter().enumerate() {
        for b in &kinds[at..] {
            let geometry = touch_of(a, b);
            let pair = PairConstants::of_elastic(a.material, b.material);
            let overlaps = STRAINS.map(|strain| strain * geometry.radius_sum);
            let apart = APART.map(|part| -part * law.reach());
            let apart = if law.reach() > 0.0 { &apart[..] } else { &[] };
            for &overlap in overlaps.iter().chain(apart) {
                let who = format!(
                    "an overlap of {} of grains of {} and {} radius",
                    readable(overlap, "m"),
                    readable(a.radius, "m"),
                    readable(b.radius, "m")
                );
                if let Some(found) = look(&pair, &ContactGeometry { overlap, ..geometry }, &who) {
                    return Some(found);
                }
            }
        }
    }
    None
}

fn touch_of(a: &Sample<'_>, b: &Sample<'_>) -> ContactGeometry {
    let stiffness = [a, b].map(|kind| kind.material.contact_stiffness.map_or(0.0, Quantity::si));
    ContactGeometry::new([a.radius, b.radius], [a.mass, b.mass], stiffness, a.radius + b.radius)
}

/// Values that are none, and an energy that is not that of the force.
fn try_out(law: &Custom, faults: &mut Faults, context: &Context<'_>) {
    let no_number = first(law, context, |pair, geometry, who| {
        let speeds = if law.has_speed() { &SPEEDS[..] } else { &[] };
        let bad = |speed: &f64| !law.force(pair, geometry, *speed).is_finite();
        let speed = [0.0].iter().chain(speeds).copied().find(bad)?;
        let force = law.force(pair, geometry, speed);
        let speed =
            if speed == 0.0 { String::new() } else { format!(" and a speed of {}", readable(speed, "m/s")) };
        Some(format!("\"{}\" is {} at {who}{speed}", law.force.text(), what_it_is(force)))
    });
    if let Some(message) = no_number {
        return faults.fail_with("force", message, "give a formula that has a value wherever grains touch");
    }
    let Some(energy) = &law.energy else { return };
    let other = first(law, context, |pair, geometry, who| {
        let along = |name| [f64::from(u8::from(name == OfPair::Overlap))];
        let [slope] = energy.slopes(|name| value(name, pair, geometry, 0.0), along);
        let force = law.force(pair, geometry, 0.0);
        let agrees = (slope - force).abs() <= TOLERANCE * slope.abs().max(force.abs());
        (!agrees).then(|| {
            let [slope, force] = [slope, force].map(|newton| readable(newton, "N"));
            format!(
                "is not the energy of the force: at {who} its slope is {slope}, the force at rest {force}"
            )
        })
    });
    if let Some(message) = other {
        faults.fail_with("energy", message, "leave it out, and it is integrated");
    }
}

fn what_it_is(force: f64) -> &'static str {
    if force.is_nan() { "not a number" } else { "infinite" }
}

/// Where the force adds energy, and where it jumps as it begins to act.
fn doubts(law: &Custom, context: &Context<'_>) -> Vec<String> {
    let driven = first(law, context, |pair, geometry, who| {
        let drives = |speed: &&f64| law.beyond_rest(pair, geometry, **speed) * **speed < 0.0;
        let speed = SPEEDS.iter().find(drives)?;
        Some(format!(
            "contact.custom drives grains instead of slowing them at {who} and a speed of {}: the ledger books that as work_custom_J",
            readable(*speed, "m/s")
        ))
    });
    let Some(kind) = context.samples.first() else { return driven.into_iter().collect() };
    let (pair, geometry) = (PairConstants::of_elastic(kind.material, kind.material), touch_of(kind, kind));
    let at = |overlap: f64| law.force(&pair, &ContactGeometry { overlap, ..geometry }, 0.0);
    let begins = at(1e-12 * geometry.radius_sum - law.reach());
    let jumps = begins.abs() > JUMP * at(1e-3 * geometry.radius_sum).abs();
    let jump = jumps.then(|| {
        format!(
            "contact.custom jumps to {} where it begins to act: energy is kept only as well as steps resolve that",
            readable(begins, "N")
        )
    });
    driven.into_iter().chain(jump).collect()
}

#[cfg(test)]
#[path = "custom_tests.rs"]
mod tests;
