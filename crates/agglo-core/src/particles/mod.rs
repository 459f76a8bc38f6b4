//! The grains: their state, and the materials they are made of.

mod columns;
mod material;
mod motion;
mod places;
pub mod property;

pub use columns::{COLUMNS, Column, ColumnValues, Particles, Row};
pub use material::{Material, Mixture, Softening};
pub use motion::Motion;
pub use places::Places;
pub use property::Property;
