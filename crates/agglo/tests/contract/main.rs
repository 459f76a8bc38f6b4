//! Contracts: the same bits for any number of threads and across a restart, and books that close.

#[path = "../common/mod.rs"]
mod common;

mod crowd;
mod restart;
mod threads;
