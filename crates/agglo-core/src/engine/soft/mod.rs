//! Soft spheres: forces, and the schemes that integrate them.

mod advance;
mod books;
mod first_pulse;
mod laws;
mod loads;
mod look;
mod pulses;
#[cfg(test)]
mod relations_tests;
mod relax;
mod response;
mod settings;
mod simulation;
mod skin;
pub mod staggered;
pub mod step_size;
#[cfg(test)]
mod step_size_tests;
mod system;
mod tempo;
mod truncation;
#[cfg(test)]
mod twist_tests;
mod types;
mod validate;
mod validity;
pub mod verlet;

pub use first_pulse::FirstPulse;
pub use laws::Laws;
pub use loads::{Loads, Rates, Supplies, Supply};
pub use pulses::Pulses;
pub use relax::{RestWatch, Resting};
pub use settings::{Relaxation, Settings};
pub use simulation::{Clock, Simulation, SimulationState};
pub use system::System;
pub use truncation::{Truncation, truncation};
pub use types::{Breach, Limits, Scheme, Staggered, Verlet};
pub use validity::of_bonds as warning_of_bonds;
