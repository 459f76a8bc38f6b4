//! The impact of two bodies: the coupled equations solved, and what follows for velocities, temperatures and fragments.

use super::fragmentation::Draws;
use super::heat::warmed;
use super::laws::ImpactLaws;
use super::solve::{CollidingPair, Trial};
use super::sticking::common_velocity;
use super::{Body, ImpactEnergy, Outcome, Sticking};
use crate::math::Vec3;

impl ImpactLaws {
    /// The impact of two partners of which no fragment is drawn at random, or of which the draw does not matter.
    pub fn impact(&self, bodies: [&Body; 2], normal: Vec3) -> Outcome {
        self.impact_drawn(bodies, normal, &Draws::new(0, 0))
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
        let constants = self.pair(bodies);
        let directions = [normal, along];
        let pair = CollidingPair::new(self, bodies, draws, constants.friction, directions, [approach, slip]);
        let solution = pair.solve(constants.rebound);
        let stuck = solution.restitution == 0.0 && self.sticking == Sticking::Merge;
        let trial = pair.trial(solution.restitution, stuck);
        let mut outcome = settle(&pair, &trial, bodies);
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
}

/// Heat, fragments and the ledger of a solved impact.
fn settle(pair: &CollidingPair<'_>, trial: &Trial, bodies: [&Body; 2]) -> Outcome {
    let breakage = pair.breakage(trial);
    let heat = pair.heat(trial, breakage.surfaces);
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
