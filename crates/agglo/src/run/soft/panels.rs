//! The charts over time of soft spheres; columns say which shows them.

use crate::record::Panel;

/// Clusters over the mass.
pub static DISPERSION: Panel = Panel {
    id: "dispersion",
    title: "Dispersion",
    about: "The mass of the largest cluster, what is not in it (the dispersion degree), and how much of the largest cluster \
            of the start is no longer together.",
    label: "part of the mass",
    unit: "",
};
/// Clusters by number.
pub static CLUSTERS: Panel = Panel {
    id: "clusters",
    title: "Clusters, contacts and bonds",
    about: "A cluster is what contacts and bonds hold together; single grains count as clusters.",
    label: "how many",
    unit: "",
};
/// Rays by number.
pub static RAYS: Panel = Panel {
    id: "rays",
    title: "Rays",
    about: "Rays in flight, reflections so far, and straight pieces of their ways so far.",
    label: "how many",
    unit: "",
};
/// Power by direction.
pub static BEAM: Panel = Panel {
    id: "beam",
    title: "Beam power left",
    about: "Power of all rays of the latest pulse by direction, those that left as they were then: their powers times the \
            parts of their directions, over the pulse's power. What is missing to 1 in all is what grains took.",
    label: "part of the pulse's power",
    unit: "",
};
/// Power in flight by direction.
pub static FLYING: Panel = Panel {
    id: "flying",
    title: "Power in flight",
    about: "The same of the rays in flight alone. Rays cross the grains in a short time; rows further apart see single moments \
            of it.",
    label: "part of the pulse's power",
    unit: "",
};
/// Where power went.
pub static POWER: Panel = Panel {
    id: "power",
    title: "Power of the pulses",
    about: "What was launched so far, and where it went.",
    label: "power",
    unit: "W",
};
/// Stores of the ledger.
pub static STORES: Panel = Panel {
    id: "stores",
    title: "Energy: where it is",
    about: "The stores of the ledger.",
    label: "energy",
    unit: "J",
};
/// Channels of the ledger.
pub static FLOWS: Panel = Panel {
    id: "flows",
    title: "Energy: put in and lost",
    about: "The channels of the ledger since the start, and what they and the stores do not explain.",
    label: "energy",
    unit: "J",
};
/// Speeds.
pub static SPEED: Panel =
    Panel { id: "speed", title: "Speed", about: "Speeds of the grains.", label: "speed", unit: "m/s" };
/// Steps.
pub static STEP: Panel = Panel {
    id: "step",
    title: "Step size",
    about: "Length of the last accepted step.",
    label: "step",
    unit: "s",
};
/// Iterations.
pub static ITERATIONS: Panel = Panel {
    id: "iterations",
    title: "Iterations of the staggered scheme",
    about: "Iterations and rejected tries since the start.",
    label: "so far",
    unit: "",
};
/// Overlaps.
pub static STRAIN: Panel = Panel {
    id: "strain",
    title: "Largest overlap",
    about: "The largest overlap of two grains, over the sum of their radii.",
    label: "part of the sum of the radii",
    unit: "",
};

/// All of them, in the order of the page.
pub const ALL: &[&Panel] = &[
    &DISPERSION,
    &CLUSTERS,
    &RAYS,
    &BEAM,
    &FLYING,
    &POWER,
    &STORES,
    &FLOWS,
    &SPEED,
    &STEP,
    &ITERATIONS,
    &STRAIN,
];
