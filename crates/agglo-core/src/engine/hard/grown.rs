//! Grains that are made of several.

use serde::{Deserialize, Serialize};

/// What a grain that has grown keeps of its parts, which need not be of one material.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Grown {
    /// How many primary grains it is made of.
    pub primaries: u32,
    /// Heat capacity of the whole grain [J/K].
    pub heat_capacity: f64,
}
