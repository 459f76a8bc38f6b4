//! The grains: their state, and the materials they are made of.

mod columns;
mod material;
mod motion;

pub use columns::{COLUMNS, Column, ColumnValues, Particles, Row};
pub use material::{Material, Mixture, PairTable, Softening};
pub use motion::Motion;
