//! Hard spheres against kinetic theory, closed forms and published numbers, through the whole engine.
//!
//! Cases that need many starts or many impacts have a short form that always runs and a long one that runs on request:
//! `cargo test --release -p agglo --test val_hard -- --ignored --nocapture`.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

#[macro_use]
extern crate agglo_testing;

#[path = "../common/mod.rs"]
mod common;
mod support;

mod aggregation;
mod breaking;
mod collapse;
mod gas;
mod haff;
mod impact;
mod mixture;
mod radiation;
mod reacting;
mod unlike;
