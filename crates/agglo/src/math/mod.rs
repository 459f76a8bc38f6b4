//! Vectors, random numbers, roots and statistics. No physics.

pub mod parallel;
mod prefetch;
pub mod rng;
pub mod roots;
mod vec3;

pub use vec3::Vec3;

pub use prefetch::prefetch;
