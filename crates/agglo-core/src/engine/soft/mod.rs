//! Soft spheres: forces, and the schemes that integrate them.

mod at_faces;
mod crew;
mod faces;
#[cfg(test)]
mod flying_tests;
mod forces;
mod guard;
mod hook;
mod near_pairs;
mod outside;
#[cfg(test)]
mod periodic_tests;
mod rays;
#[cfg(test)]
mod relations_tests;
mod relax;
mod saved;
mod saved_contacts;
mod settings;
mod simulation;
mod skin;
mod spread;
mod step;
mod stored;
mod system;
#[cfg(test)]
mod twist_tests;
mod types;
mod validate;
mod walls;

pub use faces::Absorbed;
pub use forces::laws::Laws;
pub use forces::loads::{LoadViews, Loads};
pub use forces::truncation::{Truncation, truncation};
pub use hook::{Hook, Hooks, Scene};
pub use rays::{FirstPulse, Pulses, Spheres, Traced, WallSound, trace};
pub use relax::{RestWatch, Resting};
pub use saved::SimulationState;
pub use settings::{Relaxation, Settings};
pub use simulation::{Clock, Simulation};
pub use system::System;
pub use types::{Breach, Limits, Scheme, Staggered, Verlet};
pub use walls::{WallState, refuse_grains_in_walls};
