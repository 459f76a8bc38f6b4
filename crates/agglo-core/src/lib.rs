//! The physics of agglo: laws, engines, packing and measures.
//!
//! It knows no file, no folder and no terminal: plain settings in, plain state out. Users name the crate `agglo`, which
//! has all of it and reads scenarios, runs them and writes what they find.

#[cfg(test)]
#[macro_use]
extern crate agglo_testing;

#[macro_use]
pub mod law;

pub mod constants;
pub mod text;
pub mod units;

pub mod math;
pub mod particles;

pub mod domain;
pub mod link;
pub mod neighbors;
pub mod packing;

pub mod contact;
pub mod fields;
pub mod impact;

pub mod acoustics;

pub mod ledger;

pub mod walls;

pub mod engine;

pub mod measure;

pub mod catalog;

pub mod pages;

#[cfg(test)]
mod testing;
