//! The readers that fuzzers throw bytes at: those of the test `hostile`, so that both hold them to the same.

#[macro_use]
extern crate agglo_testing;

use std::sync::LazyLock;

#[path = "../../crates/agglo-view/tests/hostile/readers.rs"]
pub mod readers;
#[path = "../../crates/agglo-view/tests/hostile/seeds.rs"]
pub mod seeds;

/// The folders that the readers work in.
pub static BENCH: LazyLock<readers::Bench> = LazyLock::new(readers::Bench::new);
