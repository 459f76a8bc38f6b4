//! What advances the clock: soft spheres, and hard spheres.

mod error;
pub mod hard;
pub mod soft;
mod start;
pub(crate) mod validate;
mod warnings;

pub use error::{Moment, SimError};
pub use start::Start;
pub use warnings::Warnings;
