//! The charts over time of hard spheres; columns say which shows them.

use crate::record::Panel;

/// How many are left.
pub static GRAINS: Panel = Panel {
    id: "grains",
    title: "Grains left",
    about: "Grains become fewer when they merge and more when they break.",
    label: "how many",
    unit: "",
};
/// How far they have grown.
pub static GROWTH: Panel = Panel {
    id: "growth",
    title: "Growth",
    about: "The mean radius by number.",
    label: "over the mean radius at the start",
    unit: "",
};
/// The largest one.
pub static LARGEST: Panel = Panel {
    id: "largest",
    title: "The largest grain",
    about: "How many of the first grains it holds.",
    label: "primaries",
    unit: "",
};
/// How warm they are.
pub static TEMPERATURE: Panel = Panel {
    id: "temperature",
    title: "Temperature",
    about: "Temperatures of the grains.",
    label: "temperature",
    unit: "K",
};
/// What happened.
pub static IMPACTS: Panel = Panel {
    id: "impacts",
    title: "Impacts",
    about: "Impacts since the start, and what came of them.",
    label: "so far",
    unit: "",
};
/// How hard it was to solve.
pub static ITERATIONS: Panel = Panel {
    id: "iterations",
    title: "Iterations of an impact's solution",
    about: "The coupled solution of an impact: most iterations that one needed so far.",
    label: "most of one impact",
    unit: "",
};
/// Motion and its losses.
pub static ENERGY: Panel = Panel {
    id: "energy",
    title: "Kinetic energy and where it went",
    about: "The ledger's kinetic energy now, and its losses since the start.",
    label: "energy",
    unit: "J",
};
/// Heat.
pub static HEAT: Panel = Panel {
    id: "heat",
    title: "Heat",
    about: "The ledger's heat since the start, and what is stored in warm grains now.",
    label: "energy",
    unit: "J",
};
/// Speeds.
pub static SPEEDS: Panel = Panel {
    id: "speeds",
    title: "Speed",
    about: "Speeds of the grains as seen from the box.",
    label: "speed",
    unit: "m/s",
};
/// Steps.
pub static STEP: Panel = Panel {
    id: "step",
    title: "Step size",
    about: "Length of the last step; from event to event, the mean time between two impacts.",
    label: "step",
    unit: "s",
};

/// All of them, in the order of the page.
pub const ALL: &[&Panel] =
    &[&GRAINS, &GROWTH, &LARGEST, &TEMPERATURE, &IMPACTS, &ITERATIONS, &ENERGY, &HEAT, &SPEEDS, &STEP];
