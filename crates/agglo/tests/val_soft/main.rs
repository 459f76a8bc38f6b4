//! Soft spheres against closed forms and published numbers, through the whole engine.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

#[macro_use]
extern crate agglo_testing;

#[path = "../common/mod.rs"]
mod common;

mod automatic_step;
mod bonds;
mod custom;
mod fields;
mod hook;
mod impact;
mod ledger;
mod oblique;
mod one_step;
mod order;
mod pulse;
mod stability;
mod unequal;
mod unlike;
mod walls;
