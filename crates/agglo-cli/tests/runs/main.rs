//! Whole runs through the program: what a user may count on when a run is killed, stopped, damaged, starved of disk
//! or started with other threads and other output.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test that cannot start the program or read its files has failed")]

#[macro_use]
extern crate agglo_testing;

mod common;
mod company;
mod damage;
mod disk;
mod domains;
mod end;
mod folders;
mod foreign;
mod from;
mod hand_over;
mod hard;
mod hostile;
mod json;
mod killed;
mod moved;
mod output;
mod pictures;
mod report;
mod shipped;
mod signals;
mod summary;
mod trouble;
mod until;
mod verbs;
mod wall_time;
mod watching;
