//! What the package `agglo` for Python is made of: scenarios, simulations, runs. No physics, and no copy of a check: all of it is
//! the library's.
//!
//! Arrays go to Python as copies, in SI units that their names tell. Work that takes time leaves the interpreter to others, and
//! ends at Ctrl-C (`work`).

#![allow(clippy::needless_pass_by_value, reason = "arguments come from Python as values of their own")]

mod arrays;
mod campaign;
mod error;
mod guests;
mod hand_over;
mod hook;
mod json;
mod laws;
mod pages;
mod pieces;
mod runs;
mod scenario;
mod search;
mod simulation;
mod watcher;
mod work;

use pyo3::prelude::*;

#[pymodule]
mod _agglo {
    #[pymodule_export]
    use super::campaign::Campaign;
    #[pymodule_export]
    use super::hand_over::hand_over;
    #[pymodule_export]
    use super::laws::{contact, reflect, trace};
    #[pymodule_export]
    use super::pages::{bibtex, cite, explain, laws, schema, templates};
    #[pymodule_export]
    use super::pieces::{collide, pack};
    #[pymodule_export]
    use super::runs::{
        act_on, check, frames, read_frame, read_table, report, resume, run, run_quietly, summary, tables,
        what_is_in,
    };
    #[pymodule_export]
    use super::scenario::Scenario;
    #[pymodule_export]
    use super::search::{best_run, conduct, processors, replicate};
    #[pymodule_export]
    use super::simulation::Simulation;
    #[pymodule_export]
    use super::work::set_threads;

    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
