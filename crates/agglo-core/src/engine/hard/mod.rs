//! Hard spheres that collide, stick and break, in a control volume.

mod collide;
mod drive;
mod embedded;
mod grown;
mod micro_state;
mod record;
mod search;
mod settings;
mod simulation;
mod spheres;
mod types;

#[cfg(test)]
mod cases_tests;
#[cfg(test)]
mod corner_tests;
#[cfg(test)]
mod digits_tests;
#[cfg(test)]
mod oracle_tests;
#[cfg(test)]
mod test_systems;

pub use collide::{Change, HardSystem, HardSystemState};
pub use drive::Clock;
pub use embedded::{EmbeddedError, MicroGrains, Microscale};
pub use grown::Grown;
pub use micro_state::MicroState;
pub use record::{Counts, Descent, EventKind, GrainEvent, Homogenized};
pub use search::{Contact, Surroundings};
pub use settings::{Driver, Settings};
pub use simulation::{Simulation, SimulationState, Snapshot};
pub use spheres::{Bulk, Sphere, Spheres};
pub use types::{Distance, EventDriven, Pairs, TimeStepped};
