//! Vectors, random numbers and statistics. No physics.

pub mod parallel;
pub mod rng;
mod vec3;

pub use vec3::Vec3;
