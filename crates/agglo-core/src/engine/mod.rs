//! What advances the clock: soft spheres, and hard spheres.

mod error;
pub mod hard;
pub mod soft;
pub(crate) mod sound;
mod start;
mod types;
mod warnings;

pub use error::{Moment, SimError};
pub use start::Start;
pub use types::Engine;
pub use warnings::Warnings;
