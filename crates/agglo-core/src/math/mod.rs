//! Vectors, random numbers, roots and statistics. No physics.

pub mod formula;
mod groups;
pub mod lanes;
mod pace;
pub mod parallel;
mod prefetch;
pub mod quadrature;
mod real;
pub mod rng;
mod room;
pub mod roots;
mod sum;
mod vector;

pub use groups::Groups;
pub use pace::Pace;
pub use real::Real;
pub use room::{make_room_for, refill};
pub use sum::{Sum, rounding_of_sum};
pub use vector::{Vec3, Vector};

pub use prefetch::prefetch;
