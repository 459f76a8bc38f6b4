//! What advances the clock. Soft spheres today; hard spheres have their place here.

mod error;
pub mod soft;
mod warnings;

pub use error::{Moment, SimError};
pub use warnings::Warnings;
