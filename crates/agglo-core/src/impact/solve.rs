//! The coupled equations of one impact: restitution, velocities, heat, temperatures and hardness hang together.
//!
//! All of it happens in two numbers, the speeds along the normal and along the slip; vectors come back at the end.

use super::fragmentation::{self, BreakingEnergy, Draws};
use super::heat::{Balance, parts, warmed};
use super::laws::{ImpactLaws, Matter};
use super::restitution::hardness::{FixedPoint, Solver};
use super::restitution::{Hardness, Rebound};
use super::{Body, Sticking, reaction_heat, tangential, work};
use crate::math::Vec3;
use crate::math::roots::root_between;

/// Most substitutions; two to six are usual.
const SUBSTITUTIONS: u32 = 60;
/// Part of its step that a substitution leaves for the next, from which looking ahead pays.
const SLOW: f64 = 0.3;
/// Change of e at which it is solved: round-off.
const SOLVED: f64 = 4.0 * f64::EPSILON;

/// An impact before it is solved.
pub(super) struct CollidingPair<'a> {
    laws: &'a ImpactLaws,
    matter: [&'a Matter; 2],
    bodies: [&'a Body; 2],
    draws: &'a Draws,
    friction: f64,
    pub reduced_mass: f64,
    pub approach: f64,
    pub slip: f64,
    smaller_radius: f64,
    /// Each partner's own speed toward the other, and along the slip of its own surface [m/s].
    own_speeds: [[f64; 2]; 2],
}

/// An impact at a restitution.
#[derive(Clone, Copy)]
pub(super) struct Trial {
    pub restitution: f64,
    /// Impulses [N s] along the normal and against the slip.
    pub normal_impulse: f64,
    pub tangential_impulse: f64,
    /// Kinetic energies lost [J].
    pub normal: f64,
    pub tangential: f64,
}

/// Heat of an impact [J].
#[derive(Clone, Copy)]
pub(super) struct Heat {
    /// Of each partner.
    pub each: [f64; 2],
    /// What the reaction puts in.
    pub reaction: f64,
}

/// The restitution, and how it was found.
#[derive(Clone, Copy)]
pub(super) struct Solution {
    pub restitution: f64,
    pub iterations: u32,
    pub converged: bool,
}

impl<'a> CollidingPair<'a> {
    /// `slip` is its size [m/s], `along` its direction.
    pub fn new(
        laws: &'a ImpactLaws,
        bodies: [&'a Body; 2],
        draws: &'a Draws,
        friction: f64,
        [normal, along]: [Vec3; 2],
        [approach, slip]: [f64; 2],
    ) -> Self {
        let [a, b] = bodies;
        let speeds = |body: &Body, sign: f64| {
            let velocity = body.velocity * sign;
            [velocity.dot(normal), velocity.dot(along)]
        };
        Self {
            laws,
            matter: [laws.matter(a), laws.matter(b)],
            bodies,
            draws,
            friction,
            reduced_mass: a.mass * b.mass / (a.mass + b.mass),
            approach,
            slip,
            smaller_radius: a.radius.min(b.radius),
            own_speeds: [speeds(a, 1.0), speeds(b, -1.0)],
        }
    }

    /// What happens at a restitution; a pair that is `stuck` has one velocity after.
    pub fn trial(&self, restitution: f64, stuck: bool) -> Trial {
        let normal_impulse = self.reduced_mass * (1.0 + restitution) * self.approach;
        let tangential_impulse = if stuck {
            self.reduced_mass * self.slip
        } else {
            self.laws.limit.impulse(self.friction, normal_impulse, self.reduced_mass, self.slip)
        };
        Trial {
            restitution,
            normal_impulse,
            tangential_impulse,
            normal: 0.5 * (1.0 - restitution) * normal_impulse * self.approach,
            tangential: tangential::loss(tangential_impulse, self.reduced_mass, self.slip),
        }
    }

    /// A partner's own loss of kinetic energy [J], in the frame of the box.
    pub fn own_loss(&self, trial: &Trial, side: usize) -> f64 {
        let [along_normal, along_slip] = self.own_speeds[side];
        let (jn, jt) = (trial.normal_impulse, trial.tangential_impulse);
        jn * along_normal + jt * along_slip - (jn * jn + jt * jt) / (2.0 * self.bodies[side].mass)
    }

    /// Heat of the partners, less the energies [J] of their new surfaces.
    pub fn heat(&self, trial: &Trial, surfaces: [f64; 2]) -> Heat {
        let per_area = reaction_heat::of_pair(self.matter.map(|matter| matter.reaction_heat));
        let area = self.laws.area.of(trial.restitution, self.smaller_radius);
        let reaction = reaction_heat::reaction_heat(per_area, area);
        match self.laws.heat.balance {
            Balance::Energy => {
                let total = trial.normal + trial.tangential + reaction - (surfaces[0] + surfaces[1]);
                let masses = self.bodies.map(|body| body.mass);
                Heat { each: parts(self.laws.heat.share, masses).map(|part| part * total), reaction }
            }
            Balance::Published => {
                let force_over = self.laws.hardness.as_ref().map(|law| law.force_over).unwrap_or_default();
                let done = work::work(force_over, self.reduced_mass, self.approach, trial.restitution);
                let of = |side: usize| self.own_loss(trial, side) + done + reaction - surfaces[side];
                Heat { each: [of(0), of(1)], reaction: 2.0 * reaction }
            }
        }
    }

    /// The restitution of this impact.
    pub fn solve(&self, rebound: Rebound) -> Solution {
        match (rebound, &self.laws.hardness) {
            (Rebound::Constant(restitution), _) => Solution { restitution, iterations: 0, converged: true },
            (Rebound::Hardness, Some(law)) => {
                let load = law.load(self.reduced_mass, self.approach, self.smaller_radius);
                match &law.solver {
                    Solver::Bracketed => self.bracketed(law, load),
                    Solver::FixedPoint(limits) => self.fixed_point(law, load, limits),
                }
            }
            (Rebound::Hardness, None) => Solution { restitution: 1.0, iterations: 0, converged: true },
        }
    }

    fn bracketed(&self, law: &Hardness, load: f64) -> Solution {
        let solved = |restitution, iterations| Solution { restitution, iterations, converged: true };
        if !self.softens() {
            return solved(law.restitution(load / self.hardness_before()), 0);
        }
        let next = |restitution: f64, stuck: bool| {
            law.restitution(load / self.hardness_after(&self.trial(restitution, stuck)))
        };
        let first = next(0.0, self.laws.sticking == Sticking::Merge);
        if first == 0.0 {
            return solved(0.0, 1);
        }
        let residual = |e: f64| next(e, false) - e;
        let (mut lower, mut rise_there, mut here) = (0.0, first, first);
        for iterations in 2..=SUBSTITUTIONS {
            let rise = residual(here);
            if rise.abs() <= SOLVED {
                return solved((here + rise).clamp(0.0, 1.0), iterations);
            }
            let near = if rise < 0.0 {
                Some(([lower, here], [rise_there, rise]))
            } else {
                close_ahead(here, rise, rise / rise_there, &residual)
            };
            if let Some((ends, values)) = near {
                let root = root_between(residual, ends, values, SOLVED);
                return solved(root.at, iterations + root.evaluations);
            }
            (lower, rise_there, here) = (here, rise, here + rise);
        }
        let root = root_between(residual, [here, 1.0], [residual(here), residual(1.0)], SOLVED);
        solved(root.at, SUBSTITUTIONS + root.evaluations)
    }

    /// The staggering box of [B], section 6 b: it starts from e = 0 and the hardness before the impact.
    fn fixed_point(&self, law: &Hardness, load: f64, limits: &FixedPoint) -> Solution {
        let (mut restitution, mut hardness) = (0.0, self.hardness_before());
        for iterations in 1..=limits.most_iterations {
            let next = law.substituted(restitution, load / hardness);
            let converged = (next - restitution).abs() <= limits.tolerance * restitution;
            restitution = next;
            if converged {
                return Solution { restitution, iterations, converged };
            }
            let stuck = restitution == 0.0 && self.laws.sticking == Sticking::Merge;
            hardness = self.hardness_after(&self.trial(restitution, stuck));
        }
        Solution { restitution, iterations: limits.most_iterations, converged: false }
    }

    /// Whether heat can change the hardness.
    fn softens(&self) -> bool {
        let softens =
            |side: usize| self.matter[side].hardness.softens() && self.bodies[side].heat_capacity > 0.0;
        softens(0) || softens(1)
    }

    fn hardness_before(&self) -> f64 {
        let of = |side: usize| self.matter[side].hardness.at(self.bodies[side].temperature);
        of(0).min(of(1))
    }

    /// Of the softer partner, hot from the impact. In the consistent balance surfaces part after that.
    fn hardness_after(&self, trial: &Trial) -> f64 {
        let surfaces = match self.laws.heat.balance {
            Balance::Energy => [0.0; 2],
            Balance::Published => self.breakage(trial).surfaces,
        };
        let heat = self.heat(trial, surfaces);
        let of = |side: usize| {
            let body = self.bodies[side];
            let temperature = warmed(body.temperature, body.heat_capacity, heat.each[side]);
            self.matter[side].hardness.at(temperature.unwrap_or(body.temperature))
        };
        of(0).min(of(1))
    }

    /// How the partners break.
    pub fn breakage(&self, trial: &Trial) -> Breakage {
        let mut breakage = Breakage { fragments: [1; 2], surfaces: [0.0; 2] };
        let Some(law) = &self.laws.fragmentation else { return breakage };
        for side in [0, 1] {
            let body = self.bodies[side];
            let Some(surface_energy) = self.matter[side].surface_energy else { continue };
            let energy = self.breaking_energy(law.energy, trial, side);
            let fragments = fragmentation::fragments(energy, surface_energy, body.radius, body.primaries);
            breakage.fragments[side] = fragments;
            breakage.surfaces[side] = law.fragments.surface(
                fragments,
                surface_energy,
                body.radius,
                body.primaries,
                self.draws.of(side),
            );
        }
        breakage
    }

    fn breaking_energy(&self, which: BreakingEnergy, trial: &Trial, side: usize) -> f64 {
        match which {
            BreakingEnergy::CenterOfMass => {
                let masses = self.bodies.map(|body| body.mass);
                masses[1 - side] / (masses[0] + masses[1]) * (trial.normal + trial.tangential)
            }
            BreakingEnergy::Published => self.own_loss(trial, side).abs(),
        }
    }
}

/// How two partners break.
pub(super) struct Breakage {
    pub fragments: [u32; 2],
    /// Energies of the new surfaces [J].
    pub surfaces: [f64; 2],
}

/// A bracket of the root that slow substitution heads for, if a look half as far again finds the other side.
fn close_ahead(
    here: f64,
    rise: f64,
    ratio: f64,
    residual: &impl Fn(f64) -> f64,
) -> Option<([f64; 2], [f64; 2])> {
    if !(SLOW..1.0).contains(&ratio) {
        return None;
    }
    let ahead = (here + 1.5 * rise / (1.0 - ratio)).min(1.0);
    let there = residual(ahead);
    (there <= 0.0).then_some(([here, ahead], [rise, there]))
}
