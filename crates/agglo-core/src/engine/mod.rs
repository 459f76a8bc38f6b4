//! What advances the clock: soft spheres, and hard spheres.

mod error;
pub mod hard;
pub mod soft;
mod start;
mod types;
pub(crate) mod validate;
mod warnings;

pub use error::{Moment, SimError};
pub use start::Start;
pub use types::Engine;
pub use warnings::Warnings;
