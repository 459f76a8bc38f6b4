//! Where grains are, and how large, when the clock starts: packing with the tables of grains that a scenario names.

mod bonds;
mod error;
mod place;
mod table;

#[doc(inline)]
pub use agglo_core::packing::*;

pub(crate) use bonds::pairs;
pub use error::StartError;
pub use place::{place, place_all, place_groups};
pub(crate) use table::QUANTITIES;
pub use table::TableError;
