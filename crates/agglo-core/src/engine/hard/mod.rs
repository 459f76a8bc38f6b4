//! Hard spheres that impact, stick and break, in a control volume.

mod agenda;
mod approach;
mod around;
pub mod books;
mod cascade;
mod cells;
mod cloud;
mod collapse;
mod embedded;
mod event_driven;
mod events;
mod frame;
mod grid;
mod homogenized;
mod level;

mod near;
mod nearest;
mod pieces;
mod queue;
mod search;
mod settings;
mod simulation;
mod spans;
mod spheres;
mod standstill;
mod time_stepped;
mod types;
mod validate;
mod walls;

#[cfg(test)]
mod cases_tests;
#[cfg(test)]
mod corner_tests;
#[cfg(test)]
mod digits_tests;
#[cfg(test)]
mod oracle_tests;
#[cfg(test)]
mod test_clouds;

pub use cloud::{Change, Cloud, CloudState, Contact, Surroundings};
pub use embedded::{EmbeddedError, MicroGrains, MicroState, Microscale};
pub use events::{Descent, EventKind, GrainEvent};
pub use homogenized::Homogenized;
pub use settings::{Driver, Settings};
pub use simulation::{Clock, Grown, Simulation, SimulationState, Snapshot};
pub use spheres::{Bulk, Sphere, Spheres};
pub use types::{Distance, EventDriven, Pairs, TimeStepped};
