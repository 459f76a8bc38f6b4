//! What can go wrong when grains are placed.

use crate::text::{readable, told_apart};

/// Solid fraction at which random sequential addition of equal spheres comes to its end.
pub const SATURATION: f64 = 0.382;

/// One of two values that differ, with enough digits to see it.
fn apart(values: [f64; 2], unit: &str, which: usize) -> String {
    told_apart(values, unit)[which].clone()
}

/// Why the grains could not be placed. `group` is the place in the scenario's list `grains`, from 0.
#[derive(Debug, thiserror::Error)]
pub enum PackingError {
    /// It was asked to stop.
    #[error("stopped while grains were placed")]
    Stopped,
    /// Random sequential addition found no more room.
    #[error(
        "grains[{group}]: no room left after {placed} of {wanted} grains (solid fraction {}, asked for {}); random placement of equal spheres ends at {limit}. Ask for fewer grains, give a \
         larger region, or use `lattice` placement",
        apart([*reached, *solid_fraction], "", 0), apart([*reached, *solid_fraction], "", 1), limit = SATURATION
    )]
    Saturated {
        /// Which group.
        group: usize,
        /// Grains of the group that found a place; 0 where the request was hopeless from the start.
        placed: usize,
        /// Grains that were asked for.
        wanted: usize,
        /// Volume of the grains asked for over that of the region.
        solid_fraction: f64,
        /// Volume of the grains placed over that of the region.
        reached: f64,
    },
    /// A grain is larger than the region it should lie in.
    #[error(
        "grains[{group}]: a grain of radius {} does not fit into the region, whose largest inner sphere has radius {}; \
         give smaller grains or a larger region",
        apart([*radius, *room], "m", 0), apart([*radius, *room], "m", 1)
    )]
    TooLarge {
        /// Which group.
        group: usize,
        /// Radius of the grain [m].
        radius: f64,
        /// Radius of the largest sphere in the region [m].
        room: f64,
    },
    /// Two grains have one id.
    #[error("two grains have the id {id}; each has its own in the column `id` of all tables")]
    SameId {
        /// The id.
        id: u32,
    },
    /// A value in the scenario that cannot be.
    #[error("grains[{group}].{key}: {reason}")]
    Value {
        /// Which group.
        group: usize,
        /// The key below the group.
        key: &'static str,
        /// What is wrong.
        reason: String,
    },
    /// A table of grains that cannot be had.
    #[error(transparent)]
    Table(Box<dyn std::error::Error + Send + Sync>),
    /// A grain where doubles no longer tell places apart.
    #[error(
        "grain {grain} lies {} from the origin, where neighboring places are {} apart: more than 1e-5 of its radius of \
         {}, so that contacts and motion would be round-off; move all grains toward the origin",
        readable(*.away, "m"), readable(*.spacing, "m"), readable(*.radius, "m")
    )]
    TooFar {
        /// Name of the grain.
        grain: u32,
        /// Its largest coordinate [m].
        away: f64,
        /// Distance between neighboring doubles there [m].
        spacing: f64,
        /// Its radius [m].
        radius: f64,
    },
    /// Two grains at exactly the same place.
    #[error("grains {first} and {second} are at exactly the same place, ({x} m, {y} m, {z} m)")]
    Coincident {
        /// Name of one grain.
        first: u32,
        /// Name of the other.
        second: u32,
        /// Their place [m].
        x: f64,
        /// Their place [m].
        y: f64,
        /// Their place [m].
        z: f64,
    },
    /// Two hard spheres that overlap.
    #[error(
        "{who} by {depth} at the start; hard spheres must not: move them apart, or place them with `fill` or \
         `random`",
        who = overlapping(*.first, *.second),
        depth = readable(*.overlap, "m")
    )]
    Overlapping {
        /// Name of one grain.
        first: u32,
        /// Name of the other; the same where a grain overlaps its own image.
        second: u32,
        /// How far they overlap [m].
        overlap: f64,
    },
    /// A hard sphere beyond the faces of the control volume.
    #[error(
        "grain {grain} at ({x} m, {y} m, {z} m) {where_}; move it inside, enlarge [volume], or make its boundary `open`",
        where_ = if *.walls { "reaches past the walls of [volume]" } else { "lies outside [volume]" }
    )]
    Outside {
        /// Name of the grain.
        grain: u32,
        /// Whether the faces are walls, which the whole grain must keep within.
        walls: bool,
        /// Its place [m].
        x: f64,
        /// Its place [m].
        y: f64,
        /// Its place [m].
        z: f64,
    },
}

fn overlapping(first: u32, second: u32) -> String {
    if first == second {
        format!("grain {first} is too large for the periodic [volume]: it overlaps its own image")
    } else {
        format!("grains {first} and {second} overlap")
    }
}
