//! Contracts: the same bits for any number of threads and across a restart, and a ledger that closes.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

#[macro_use]
extern crate agglo_testing;

#[path = "../common/mod.rs"]
mod common;

mod across_faces;
mod crowd;
mod custom;
mod domains;
mod from;
mod guests;
mod halving;
mod hard;
mod ledger;
mod order_of_input;
mod pairs;
mod rest;
mod restart;
mod sound;
mod threads;
