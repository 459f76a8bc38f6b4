//! Beams and their rays ([A] 3, Fig. 4).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::units::{Frequency, Length, Power, Pressure, Time, Triple};

/// A plane disc of parallel rays that is launched once or several times.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Beam {
    /// Middle of the disc in which the rays start.
    pub start: Triple<Length>,
    /// Direction in which they fly.
    pub direction: [f64; 3],
    /// Radius of the disc.
    pub radius: Length,
    /// Number of rays of one pulse.
    pub rays: u32,
    /// Power of one pulse, given directly or by its pressure.
    pub strength: Strength,
    /// How the rays lie in the disc.
    #[serde(default)]
    pub pattern: Pattern,
    /// How the power is spread over the disc.
    #[serde(default)]
    pub profile: Profile,
    /// When pulses start.
    #[serde(default)]
    pub pulses: Pulses,
    /// Frequency of the sound, if there is one: only for judging whether rays hold.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frequency: Option<Frequency>,
}

/// The strength of a beam.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Strength {
    /// Power of the whole beam.
    Power(Power),
    /// Pressure p: the power is p² A/(rho c).
    Pressure(Pressure),
}

/// How rays lie in the disc.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Pattern {
    /// Uniformly random.
    #[default]
    Random,
    /// Vogel's sunflower spiral.
    Sunflower,
    /// Sobol's sequence.
    Sobol,
}

/// How power is spread over the disc.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Profile {
    /// The same everywhere.
    #[default]
    Uniform,
    /// exp(-2 r²/w²), cut at the disc's edge.
    Gaussian(Gaussian),
}

/// A Gaussian profile.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Gaussian {
    /// w: radius at which the intensity is 1/e² of that in the middle.
    pub waist: Length,
}

/// When pulses start.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Pulses {
    /// Start of the first pulse.
    #[serde(default)]
    pub first: Time,
    /// From one start to the next; needed for more than one pulse.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub period: Option<Time>,
    /// How many.
    #[serde(default = "one")]
    pub count: u32,
}

fn one() -> u32 {
    1
}

impl Default for Pulses {
    fn default() -> Self {
        Self { first: Time::default(), period: None, count: 1 }
    }
}
