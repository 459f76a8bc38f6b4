//! What a scenario says of the time stepping of soft spheres.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::units::Time;

/// The schemes of soft spheres.
#[derive(Clone, Debug, PartialEq)]
pub enum Scheme {
    /// The staggered implicit scheme of [A] 31-34 with adaptive steps.
    Staggered(Staggered),
    /// Explicit velocity Verlet.
    Verlet(Verlet),
}

/// The staggered implicit scheme.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Staggered {
    /// First step, not above `largest_step`.
    pub initial_step: Time,
    /// Largest step.
    pub largest_step: Time,
    /// Largest iteration error, over the motion of the step; between 0 and 1.
    #[serde(default = "default_tolerance")]
    pub tolerance: f64,
    /// Iterations in which the tolerance is to be met; at least 1.
    #[serde(default = "default_iterations")]
    pub target_iterations: u32,
    /// φ: 0.5 is the trapezoidal rule, 1 backward Euler; from 0 to 1.
    #[serde(default = "half")]
    pub implicitness: f64,
}

fn default_tolerance() -> f64 {
    5e-4
}
fn default_iterations() -> u32 {
    10
}
fn half() -> f64 {
    0.5
}

/// Explicit velocity Verlet.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Verlet {
    /// The step, which is then never changed; above the critical one the run warns. If left out, `safety` times the
    /// critical step of all laws that act, looked at again in every step, at most a hundredth of the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub step: Option<Time>,
    /// Part of the critical step that the automatic step takes; above 0, up to 1. 0.03 is 50 steps for a contact
    /// and keeps energy to 1e-3.
    #[serde(default = "default_safety")]
    pub safety: f64,
}

fn default_safety() -> f64 {
    0.03
}

/// Bounds beyond which the physics is not to be believed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// Largest motion of a grain in one step, over its radius.
    #[serde(default = "half")]
    pub displacement: f64,
    /// Largest overlap, over the sum of the two radii; at a wall over the grain's radius.
    #[serde(default = "default_strain")]
    pub strain: f64,
    /// What happens beyond.
    #[serde(default)]
    pub on_breach: Breach,
    /// Energy that the ledger does not explain, over all that was there or came in, from which on the run warns.
    #[serde(default = "default_drift_warning")]
    pub drift_warning: f64,
    /// The part of it from which on the run ends with an error; a run with a published law that does not converge only warns.
    #[serde(default = "default_drift_error")]
    pub drift_error: f64,
}

fn default_strain() -> f64 {
    0.1
}
fn default_drift_warning() -> f64 {
    1e-3
}
fn default_drift_error() -> f64 {
    0.1
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            displacement: half(),
            strain: default_strain(),
            on_breach: Breach::default(),
            drift_warning: default_drift_warning(),
            drift_error: default_drift_error(),
        }
    }
}

/// What happens when a limit is passed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Breach {
    /// The run ends with an error.
    #[default]
    Stop,
    /// The run goes on with a counted warning.
    Warn,
}
