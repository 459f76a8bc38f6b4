//! Beams in time: when pulses start, how their rays fly along with the grains, what they do to them.

mod first_pulse;
mod flight;
mod pulses;
mod setup;
mod trace;

pub use first_pulse::FirstPulse;
pub(super) use pulses::PulseState;
pub use pulses::{Pulses, WallSound};
pub use trace::{Spheres, Traced, trace};
