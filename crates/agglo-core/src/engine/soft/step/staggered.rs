//! The staggered implicit scheme with adaptive steps.
//!
//! # Equation
//! ```text
//! v' = v + (Δt/m)(φ F' + (1-φ) F),   r' = r + v Δt + (φ Δt²/m)(φ F' + (1-φ) F)                [A] 31-34
//! ```
//! solved by fixed-point iteration over K (Jacobi: all forces from the iterate before); r' and F' are those at the end of
//! the step, r^L = r its start. With
//! ```text
//! w_K = sum |r^K - r^(K-1)|/sum |r^K - r^L|                                                   [A] 73-75
//! Λ_K = (TOL/w_0)^(1/(p K_d))/(w_K/w_0)^(1/(p K)),   p = 2
//! ```
//! A step is accepted when w_K <= TOL within K_d iterations; the next step is min(`largest_step`, Λ Δt). Otherwise
//! the step is tried again with Λ Δt.
//!
//! # Source
//! T. I. Zohdi, *Comput. Mech.* 57, 465 (2016), section 6 and appendix 3.
//!
//! # Symbols
//! | symbol | name in code | unit | meaning |
//! |--------|--------------|------|---------|
//! | φ | `implicitness` | - | 1/2: trapezoidal rule, second order; 1: backward Euler, first order |
//! | TOL | `tolerance` | - | largest iteration error, over the motion of the step |
//! | K_d | `target_iterations` | - | iterations in which the tolerance is to be met |
//! | Δt | `initial_step`, `largest_step` | s | first and largest step |
//! | w_0 | 1 | - | the first iterate starts from r^L, so its relative change is one |
//!
//! # Valid when
//! The iteration contracts: Δt² k/m well below one for the stiffest contact. The tolerance bounds the error of the
//! iteration, not that of the time discretization: `largest_step` bounds the latter.
//!
//! # Compared with others
//! Velocity-dependent forces, torques and the memory of contacts iterate with the rest. The loads at the start of
//! a step are those of the last iterate of the step before, which spares one evaluation a step and is within the
//! tolerance of evaluating them anew.
//!
//! # In a scenario
//! ```toml
//! [engine.staggered]
//! initial_step = "10 ns"
//! largest_step = "100 ns"
//! tolerance = 5e-4
//! target_iterations = 10
//! implicitness = 0.5
//! ```

use super::advance::Ahead;
use super::change::Change;
use crate::engine::soft::system::System;
use crate::engine::soft::types::Staggered;

/// A step shorter than this part of the first one means that the iteration cannot converge.
const SHORTEST: f64 = 1e-9;

/// An accepted step.
#[derive(Clone, Copy, Debug)]
pub struct Accepted {
    /// Its length [s].
    pub dt: f64,
    /// Length [s] that the scheme proposes for the next.
    pub next: f64,
    /// Iterations of the accepted try.
    pub iterations: u32,
    /// Tries that were rejected.
    pub rejected: u32,
    /// How far grains moved.
    pub change: Change,
}

/// Why no step was accepted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NotConverged {
    /// The last length tried [s].
    pub dt: f64,
    /// Its iteration error.
    pub error: f64,
    /// Place of the grain whose position changed most in the last iteration.
    pub grain: u32,
    /// Place of the first grain whose motion is not finite.
    pub not_finite: Option<u32>,
}

/// Tries steps from `time` [s], `dt` [s] at first, until one is accepted; the accepted motion is the trial.
///
/// # Errors
/// [`NotConverged`] where even a billionth of the first step does not converge.
pub fn step(system: &mut System, scheme: &Staggered, time: f64, dt: f64) -> Result<Accepted, NotConverged> {
    let mut dt = dt;
    let mut rejected = 0;
    loop {
        system.move_trial(time, dt, scheme.implicitness, Ahead::AsAtStart);
        let (iterations, change) = iterate(system, scheme, time, dt);
        let error = change.error();
        if error <= scheme.tolerance && change.not_finite.is_none() {
            let next = scheme.largest_step.si().min(growth(scheme, error, iterations) * dt);
            return Ok(Accepted { dt, next, iterations, rejected, change });
        }
        let shrink = growth(scheme, error, iterations);
        dt *= if shrink < 0.95 { shrink } else { 0.5 };
        rejected += 1;
        if dt < SHORTEST * scheme.initial_step.si() {
            let (grain, not_finite) = (change.wavering_grain, change.not_finite);
            return Err(NotConverged { dt, error, grain, not_finite });
        }
    }
}

fn iterate(system: &mut System, scheme: &Staggered, time: f64, dt: f64) -> (u32, Change) {
    let mut iteration = 1;
    loop {
        system.evaluate(time + dt, dt);
        let change = system.move_trial(time, dt, scheme.implicitness, Ahead::AsAtTrial);
        let settled = change.error() <= scheme.tolerance;
        if settled || iteration >= scheme.target_iterations || change.not_finite.is_some() {
            return (iteration, change);
        }
        iteration += 1;
    }
}

/// Λ_K; without a bound where the error vanishes.
fn growth(scheme: &Staggered, error: f64, iterations: u32) -> f64 {
    let order = 2.0;
    let wanted = scheme.tolerance.powf(1.0 / (order * f64::from(scheme.target_iterations)));
    let found = error.powf(1.0 / (order * f64::from(iterations)));
    if error.is_finite() { wanted / found } else { 0.0 }
}
