//! All laws of impact with the materials they are about.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use super::contact_area::ContactArea;
use super::cooling::{Cooler, Integration};
use super::fragmentation::{Fragmentation, Fragments};
use super::heat::HeatBalance;
use super::restitution::{Hardness, Rebound};
use super::tangential::SlipLimit;
use super::{Body, Impact, Sticking, softening};
use crate::law::Chosen;
use crate::math::rng::Stream;
use crate::particles::{Material, Mixture};
use crate::units::Quantity;

/// The laws of impact of some materials.
#[derive(Clone, Debug)]
pub struct ImpactLaws {
    impact: Impact,
    /// By number: materials are numbered in the order of their names.
    materials: Vec<Matter>,
    /// By the numbers of two materials.
    pairs: Vec<PairLaw>,
    pub(super) hardness: Option<Hardness>,
    pub(super) area: ContactArea,
    pub(super) limit: SlipLimit,
    pub(super) sticking: Sticking,
    pub(super) heat: HeatBalance,
    pub(super) fragmentation: Option<Fragmentation>,
}

/// What the laws know of a material.
#[derive(Clone, Debug)]
pub(super) struct Matter {
    pub hardness: softening::Hardness,
    /// α [J/m²].
    pub reaction_heat: f64,
    /// γ [J/m²].
    pub surface_energy: Option<f64>,
    cooler: Option<Cooler>,
}

/// What two materials have in common.
#[derive(Clone, Copy, Debug)]
pub(super) struct PairLaw {
    pub rebound: Rebound,
    pub friction: f64,
}

impl ImpactLaws {
    /// Gathers what holds for each material and each pair of them.
    pub fn new(impact: &Impact, materials: &BTreeMap<String, Material>, mixtures: &[Mixture]) -> Self {
        let names: Vec<&String> = materials.keys().collect();
        let mut pairs = Vec::with_capacity(names.len() * names.len());
        for a in &names {
            for b in &names {
                pairs.push(pair_law(impact, Mixture::of(mixtures, a, b)));
            }
        }
        let hardness = impact.restitution.hardness().cloned();
        Self {
            materials: materials.values().map(|material| matter(impact, material)).collect(),
            pairs,
            area: hardness.as_ref().map_or_else(ContactArea::default, Hardness::area),
            hardness,
            limit: impact.tangential.as_ref().map_or_else(SlipLimit::default, |law| law.limit),
            sticking: impact.sticking,
            heat: impact.heat.clone(),
            fragmentation: impact.fragmentation.clone(),
            impact: impact.clone(),
        }
    }

    /// What two materials have in common.
    #[inline]
    pub(super) fn pair(&self, bodies: [&Body; 2]) -> PairLaw {
        self.pairs[bodies[0].material as usize * self.materials.len() + bodies[1].material as usize]
    }

    #[inline]
    pub(super) fn matter(&self, body: &Body) -> &Matter {
        &self.materials[body.material as usize]
    }

    /// Whether sizes of fragments are drawn at random.
    pub fn draws_fragments(&self) -> bool {
        self.fragmentation.as_ref().is_some_and(|law| matches!(law.fragments, Fragments::PowerLaw(_)))
    }

    /// Temperature [K] of a body after cooling alone for `duration` [s].
    pub fn cooled(&self, body: &Body, duration: f64) -> f64 {
        match (&self.matter(body).cooler, area_over_capacity(body)) {
            (Some(cooler), Some(area)) => cooler.cooled(body.temperature, area, duration),
            _ => body.temperature,
        }
    }

    /// Whether `cooled` holds the temperature, because the published step would fall to zero or below.
    pub fn cooling_overshoots(&self, body: &Body, duration: f64) -> bool {
        match (&self.matter(body).cooler, area_over_capacity(body)) {
            (Some(cooler), Some(area)) => cooler.overshoots(body.temperature, area, duration),
            _ => false,
        }
    }

    /// Whether temperatures change with time alone.
    pub fn cools(&self) -> bool {
        self.materials.iter().any(|matter| matter.cooler.is_some())
    }

    /// Whether temperatures depend on the steps they are worked out in, as [B] 6.21 has it.
    pub fn cools_in_steps(&self) -> bool {
        let published =
            self.impact.cooling.as_ref().is_some_and(|law| law.integration == Integration::Published);
        published && self.cools()
    }

    /// Numbers of primaries of the fragments of a body that breaks into `fragments`, largest first; they add up to its own. With
    /// the numbers that its impact was given, they are those whose surfaces it booked.
    pub fn share_primaries(&self, body: &Body, fragments: u32, draws: &Stream) -> Vec<u32> {
        match &self.fragmentation {
            Some(law) => law.fragments.share(body.primaries, fragments, draws),
            None => vec![body.primaries],
        }
    }

    /// Words of the laws that act, for messages.
    pub fn names(&self) -> Vec<&'static str> {
        self.impact.chosen().map(Chosen::key).collect()
    }

    /// What the user is told once: laws that do not converge, options that break a conservation law.
    pub fn standing_warnings(&self) -> Vec<&'static str> {
        self.impact.chosen().flat_map(Chosen::warnings).copied().collect()
    }
}

fn pair_law(impact: &Impact, own: Option<&Mixture>) -> PairLaw {
    let own_restitution = own.and_then(|mixture| mixture.restitution);
    let rebound = own_restitution.map_or_else(|| impact.restitution.rebound(), Rebound::Constant);
    let of_law = impact.tangential.as_ref().map_or(0.0, |law| law.friction);
    PairLaw { rebound, friction: own.and_then(|mixture| mixture.dynamic_friction).unwrap_or(of_law) }
}

fn matter(impact: &Impact, material: &Material) -> Matter {
    let emissivity = material.emissivity.unwrap_or(0.0);
    Matter {
        hardness: softening::Hardness::of(material).unwrap_or_else(softening::Hardness::infinite),
        reaction_heat: material.reaction_heat.map_or(0.0, Quantity::si),
        surface_energy: material.surface_energy.map(Quantity::si),
        cooler: impact.cooling.as_ref().map(|law| Cooler::new(law, emissivity)).filter(Cooler::acts),
    }
}

/// Surface over heat capacity [m² K/J]; nothing without heat capacity.
fn area_over_capacity(body: &Body) -> Option<f64> {
    (body.heat_capacity > 0.0).then(|| 4.0 * PI * body.radius * body.radius / body.heat_capacity)
}
