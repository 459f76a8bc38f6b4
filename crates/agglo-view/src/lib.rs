//! What agglo shows: charts, pictures and movies of runs, pages, and a run while it goes on.
//!
//! It reads what runs, searches and studies have written, and knows no engine. The physics is in `agglo-core`; scenarios, runs
//! and searches are in `agglo`.

#[cfg(test)]
#[macro_use]
extern crate agglo_testing;

pub mod chart;
pub mod pictures;
pub mod plot;
#[cfg(feature = "render")]
pub mod render;
#[cfg(feature = "report")]
pub mod report;
pub mod watch;
