//! agglo: how particulate agglomerates grow, break up and disperse.
//!
//! The modules stand in the order in which data flows.

#[cfg(test)]
#[macro_use]
extern crate agglo_testing;

pub mod constants;
pub mod text;
pub mod units;

pub mod math;
pub mod particles;

pub mod domain;
pub mod neighbors;
pub mod packing;

pub mod contact;
pub mod fields;
pub mod impact;

pub mod acoustics;

pub mod engine;

pub mod measure;
pub mod record;

pub mod folder;

pub mod forecast;
pub mod run;
pub mod scenario;

pub mod search;

pub mod plot;
#[cfg(feature = "render")]
pub mod render;
#[cfg(feature = "report")]
pub mod report;
pub mod watch;
