//! What advances the clock: soft spheres, and hard spheres.

mod both;
mod error;
pub mod hard;
mod simulation;
pub mod soft;
mod start;
pub(crate) mod validate;
mod warnings;

pub use error::{Moment, SimError};
pub use simulation::{Measures, Simulation};
pub use start::{SpringAtWall, Start};
pub use warnings::Warnings;
