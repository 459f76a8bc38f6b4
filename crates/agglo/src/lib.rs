//! agglo: how particulate agglomerates grow, break up and disperse.
//!
//! The modules stand in the order in which data flows. Those of the physics are of the crate `agglo-core`.

#[cfg(test)]
#[macro_use]
extern crate agglo_testing;

#[doc(inline)]
pub use agglo_core::{
    acoustics, catalog, constants, contact, domain, engine, fields, impact, law, math, measure, neighbors,
    particles, text, units,
};

pub mod packing;

pub mod record;

pub mod folder;

pub mod forecast;
pub mod run;
pub mod scenario;

pub mod search;

pub mod pages;
