//! The grains: their state, and the materials they are made of.

mod by_id;
mod columns;
mod material;
mod motion;
pub mod property;

pub use by_id::ById;
pub use columns::{COLUMNS, Column, ColumnValues, Particles, Row};
pub use material::{Material, Mixture, Softening};
pub use motion::Motion;
pub use property::Property;
