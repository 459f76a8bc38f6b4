//! How walls move: where they are follows from time alone.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::law::Faults;
use crate::math::formula::{Names, Written};
use crate::units::{Frequency, Length, Triple, Velocity};

/// How a wall moves.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Motion {
    /// Not at all.
    #[default]
    Fixed,
    /// With a constant velocity, turning at a constant angular velocity.
    Constant(Constant),
    /// To and fro like a sine.
    Oscillating(Oscillating),
    /// With a velocity that is given as formulas of time.
    Formula(Traveling),
}

/// A constant velocity and a constant angular velocity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Constant {
    /// Velocity of the point that it turns about; 0 if left out.
    #[serde(default)]
    pub velocity: Triple<Velocity>,
    /// Angular velocity, about x, y and z; 0 if left out.
    #[serde(default)]
    pub angular_velocity: Triple<Frequency>,
    /// Where the point that it turns about is at time zero; if left out, the middle of the wall: of a plane its point, or the center
    /// of its opening.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub about: Option<Triple<Length>>,
}

/// The place a (sin(2π f t + φ) - sin φ) away from that at time zero.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Oscillating {
    /// a: amplitude along x, y and z.
    pub amplitude: Triple<Length>,
    /// f: frequency.
    pub frequency: Frequency,
    /// φ: phase at time zero, in radians; 0 if left out.
    #[serde(default)]
    pub phase: f64,
}

/// A velocity as formulas.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Traveling {
    /// Velocity [m/s] along x, y and z.
    pub velocity: [TimeFormula; 3],
}

/// A formula over time.
pub type TimeFormula = Written<OfTime>;

/// Time [s].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OfTime;

impl Names for OfTime {
    const ALL: &'static [(&'static str, &'static str, Self)] = &[("t", "s", Self)];
}

/// Parts of the run's length at which formulas are tried.
const TRIED: [f64; 9] = [0.0, 1e-6, 1e-3, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0];

impl Motion {
    /// What is wrong with it in a run of a length [s]; keys are relative to the table of the wall.
    pub fn faults(&self, faults: &mut Faults, end: f64) {
        match self {
            Self::Fixed | Self::Constant(_) => {}
            Self::Oscillating(law) => faults.positive("motion.oscillating.frequency", law.frequency),
            Self::Formula(law) => {
                for (axis, formula) in law.velocity.iter().enumerate() {
                    let key = format!("motion.formula.velocity.{axis}");
                    let value = |part: &f64| formula.at(|OfTime| part * end);
                    if let Some(message) = formula.fault() {
                        faults.fail(&key, message.to_owned());
                    } else if let Some(part) = TRIED.iter().find(|part| !value(part).is_finite()) {
                        let message =
                            format!("\"{}\" has no value at t = {:e} s", formula.text(), part * end);
                        faults.fail_with(&key, message, "give a formula that has a value in the whole run");
                    }
                }
            }
        }
    }
}
