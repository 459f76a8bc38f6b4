//! Vectors, random numbers, roots and statistics. No physics.

pub mod formula;
mod pace;
pub mod parallel;
mod prefetch;
pub mod rng;
pub mod roots;
mod sum;
mod vec3;

pub use pace::Pace;
pub use sum::rounding_of_sum;
pub use vec3::Vec3;

pub use prefetch::prefetch;
