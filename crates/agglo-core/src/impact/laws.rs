//! All laws of impact with the materials they are about.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use super::contact_area::ContactArea;
use super::cooling::{Cooler, Integration};
use super::fragmentation::{BreakingEnergy, Draws, Fragmentation, Fragments};
use super::heat::{Balance, HeatBalance, warmed};
use super::restitution::Restitution;
use super::restitution::hardness::{ForceTime, Hardness, Solver};
use super::solve::{Meeting, Trial};
use super::sticking::common_velocity;
use super::tangential::SlipLimit;
use super::{Body, Impact, ImpactEnergy, Outcome, Sticking, softening};
use crate::math::Vec3;
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
struct PairLaw {
    rebound: Rebound,
    friction: f64,
}

/// Where the restitution comes from.
#[derive(Clone, Copy, Debug)]
pub(super) enum Rebound {
    Constant(f64),
    Hardness,
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
        let hardness = match &impact.restitution {
            Restitution::Hardness(law) => Some(law.clone()),
            Restitution::Constant(_) => None,
        };
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

    #[inline]
    pub(super) fn matter(&self, body: &Body) -> &Matter {
        &self.materials[body.material as usize]
    }

    /// The impact of two partners of which no fragment is drawn at random, or of which the draw does not matter.
    pub fn impact(&self, bodies: [&Body; 2], normal: Vec3) -> Outcome {
        self.impact_drawn(bodies, normal, &Draws::new(0, 0))
    }

    /// Whether sizes of fragments are drawn at random.
    pub fn draws_fragments(&self) -> bool {
        self.fragmentation.as_ref().is_some_and(|law| matches!(law.fragments, Fragments::PowerLaw(_)))
    }

    /// The impact of two partners; `normal` is the unit vector from the first to the second, `draws` decide the sizes of
    /// fragments.
    ///
    /// Swapping the partners with their draws and turning the normal round gives the same bits, swapped. Partners that do not
    /// approach are left as they are, with restitution 1.
    pub fn impact_drawn(&self, bodies: [&Body; 2], normal: Vec3, draws: &Draws) -> Outcome {
        let relative = bodies[0].velocity - bodies[1].velocity;
        let approach = relative.dot(normal);
        if approach.is_nan() || approach <= 0.0 {
            return untouched(bodies);
        }
        let across = relative - normal * approach;
        let size = across.norm();
        // What rounding leaves of a head-on impact is no slip.
        let slip = if size > 8.0 * f64::EPSILON * approach { size } else { 0.0 };
        let along = if slip > 0.0 { across * (1.0 / slip) } else { Vec3::ZERO };
        let pair =
            &self.pairs[bodies[0].material as usize * self.materials.len() + bodies[1].material as usize];
        let meeting = Meeting::new(self, bodies, draws, pair.friction, [normal, along], [approach, slip]);
        let solution = meeting.solve(pair.rebound);
        let stuck = solution.restitution == 0.0 && self.sticking == Sticking::Merge;
        let trial = meeting.trial(solution.restitution, stuck);
        let mut outcome = settle(&meeting, &trial, bodies);
        outcome.sticks = stuck && outcome.fragments == [1; 2];
        outcome.velocities = if stuck {
            [common_velocity(bodies); 2]
        } else {
            let impulse = normal * trial.normal_impulse + along * trial.tangential_impulse;
            pushed(bodies, impulse)
        };
        outcome.iterations = solution.iterations;
        outcome.converged &= solution.converged;
        outcome
    }

    /// The same without losses: e = 1, no friction, no heat. What contacts are given that would collapse.
    pub fn elastic(&self, bodies: [&Body; 2], normal: Vec3) -> Outcome {
        let approach = (bodies[0].velocity - bodies[1].velocity).dot(normal);
        if approach.is_nan() || approach <= 0.0 {
            return untouched(bodies);
        }
        let reduced = bodies[0].mass * bodies[1].mass / (bodies[0].mass + bodies[1].mass);
        Outcome { velocities: pushed(bodies, normal * (2.0 * reduced * approach)), ..untouched(bodies) }
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
        let mut names = vec![match &self.impact.restitution {
            Restitution::Hardness(_) => "impact.restitution.hardness",
            Restitution::Constant(_) => "impact.restitution.constant",
        }];
        names.extend(self.impact.tangential.as_ref().map(|_| "impact.tangential"));
        names.push(match self.sticking {
            Sticking::Merge => "impact.sticking.merge",
            Sticking::Never => "impact.sticking.never",
        });
        names.extend(self.fragmentation.as_ref().map(|_| "impact.fragmentation"));
        names.extend(self.impact.cooling.as_ref().map(|_| "impact.cooling"));
        names
    }

    /// What the user is told once: laws that do not converge, options that break a conservation law.
    pub fn standing_warnings(&self) -> Vec<&'static str> {
        let mut warnings = Vec::new();
        if let Some(law) = &self.hardness {
            if law.force_over == ForceTime::Compression {
                warnings.push(
                    "impact.restitution.hardness.force_over = \"compression\" divides the impulse of the whole impact by \
                     the time of compression alone",
                );
            }
            if matches!(law.solver, Solver::FixedPoint(_)) {
                warnings.push(
                    "impact.restitution.hardness.solver.fixed_point need not converge: with elastic_area = 0 it flips \
                     between two values for ever",
                );
            }
        }
        if self.limit == SlipLimit::Published {
            warnings.push(
                "impact.tangential.limit = \"published\": friction can reverse the slip and add energy",
            );
        }
        if self.heat.balance == Balance::Published {
            warnings.push(
                "impact.heat.balance = \"published\" makes heat out of nothing, and its parts depend on the velocity of the \
                 observer",
            );
        }
        if self.fragmentation.as_ref().is_some_and(|law| law.energy == BreakingEnergy::Published) {
            warnings.push(
                "impact.fragmentation.energy = \"published\": what breaks depends on the velocity of the observer, and \
                 surfaces can take more than the impact lost",
            );
        }
        if self.impact.cooling.as_ref().is_some_and(|law| law.integration == Integration::Published) {
            warnings.push(
                "impact.cooling.integration = \"published\" overshoots where grains are hot: the answer depends on the step",
            );
        }
        warnings
    }
}

/// Heat, fragments and the ledger of a solved impact.
fn settle(meeting: &Meeting<'_>, trial: &Trial, bodies: [&Body; 2]) -> Outcome {
    let breakage = meeting.breakage(trial);
    let heat = meeting.heat(trial, breakage.surfaces);
    let mut booked = heat.each;
    let mut temperatures = [0.0; 2];
    let mut converged = true;
    for side in [0, 1] {
        let Body { temperature, heat_capacity, .. } = *bodies[side];
        temperatures[side] = warmed(temperature, heat_capacity, heat.each[side]).unwrap_or_else(|| {
            converged = false;
            booked[side] = 0.0;
            temperature
        });
    }
    Outcome {
        restitution: trial.restitution,
        temperatures,
        fragments: breakage.fragments,
        energy: ImpactEnergy {
            normal: trial.normal,
            tangential: trial.tangential,
            reaction: heat.reaction,
            surface: breakage.surfaces[0] + breakage.surfaces[1],
            heat: booked[0] + booked[1],
        },
        converged,
        ..Outcome::default()
    }
}

fn pair_law(impact: &Impact, own: Option<&Mixture>) -> PairLaw {
    let rebound = match (own.and_then(|mixture| mixture.restitution), &impact.restitution) {
        (Some(restitution), _) => Rebound::Constant(restitution),
        (None, Restitution::Constant(law)) => Rebound::Constant(law.restitution),
        (None, Restitution::Hardness(_)) => Rebound::Hardness,
    };
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

/// Velocities after an impulse [N s] of the first on the second.
fn pushed([a, b]: [&Body; 2], impulse: Vec3) -> [Vec3; 2] {
    [a.velocity - impulse * (1.0 / a.mass), b.velocity + impulse * (1.0 / b.mass)]
}

/// Partners that did nothing to one another.
fn untouched(bodies: [&Body; 2]) -> Outcome {
    Outcome {
        restitution: 1.0,
        velocities: bodies.map(|body| body.velocity),
        temperatures: bodies.map(|body| body.temperature),
        fragments: [1; 2],
        converged: true,
        ..Outcome::default()
    }
}

#[cfg(test)]
#[path = "solution_tests.rs"]
mod solution_tests;
#[cfg(test)]
#[path = "laws_tests.rs"]
mod tests;
