//! From a file to a checked, typed scenario in SI units.

mod types;

pub use types::{GrainGroup, Measures, Output, Relaxation, Scenario, Start, TimeSpan};
