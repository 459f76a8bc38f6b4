//! Forces between two soft spheres in contact.
//!
//! Signs, once and for all: overlap > 0 in contact; the normal points from i to j; a normal force > 0 repels;
//! the tangential velocity is that of j's surface relative to i's, and friction acts along it on i.

pub mod bond;
pub mod closeness;
mod custom;
pub mod damping;
mod elastic;
pub mod friction;
mod geometry;
mod laws;
pub mod network;
pub mod normal;
mod pair_constants;
mod pairs;
pub mod pass;

#[cfg(test)]
pub(crate) mod check;
#[cfg(test)]
mod collision;

pub use bond::Bonds;
pub use custom::{ContactFormula, Custom, OfPair};
pub use damping::Damping;
pub use elastic::Elastic;
pub use friction::Friction;
pub use geometry::{ContactGeometry, lever_arms};
pub use laws::{Along, ContactLaws};
pub use normal::Normal;
pub use pair_constants::PairConstants;
pub use pairs::PairTable;
