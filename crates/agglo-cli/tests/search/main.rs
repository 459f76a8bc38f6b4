//! Searches and studies from the terminal: the same for any number of threads, after a kill, and with failures.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test that cannot start the program or read its files has failed")]

#[macro_use]
extern crate agglo_testing;

#[allow(dead_code, reason = "made for the tests of runs, which use the rest of it")]
#[path = "../runs/common.rs"]
mod common;

mod bench;
mod json;
mod killed;
mod parts;
mod trouble;
mod verbs;
