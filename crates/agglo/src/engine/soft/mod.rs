//! Soft spheres: forces, and the schemes that integrate them.

mod types;

pub use types::{Breach, Engine, Limits, Staggered, Verlet};
