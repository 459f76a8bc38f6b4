//! From a file to a checked, typed scenario in SI units.
//!
//! A text goes through three stages, and each collects all of its faults: syntax (TOML), form (keys, kinds, words and
//! units against the schema that derives from the types), and the rules between keys.

mod check;
mod embedded;
mod enums;
mod fault;
mod file;
mod key_list;
mod keys;
mod laws;
mod parse;
mod scalars;
mod settings;
mod spheres;
mod templates;
mod tree;
mod types;
mod walk;

pub(crate) use fault::nearest;
pub use fault::{Fault, Faults};
pub use key_list::{Key, keys_of};
pub(crate) use keys::{KeyKind, Keys};
pub(crate) use parse::{Document, load, read};
pub use parse::{LoadError, schema};
pub use templates::{TEMPLATES, Template, nearest_template, scenario_templates, template};
pub use types::{Engine, HardSpheres, Measures, Output, PulseOutput, Scenario, SoftSpheres, TimeSpan};
