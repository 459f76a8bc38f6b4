//! Commented scenarios, searches and studies to start from: the files that ship with the program.

/// A scenario, a search or a study to start from.
#[derive(Clone, Copy, Debug)]
pub struct Template {
    /// The word it is asked for with.
    pub name: &'static str,
    /// What it is, in one line.
    pub title: &'static str,
    /// The file.
    pub text: &'static str,
    /// Whether it is a search or a study, and not a scenario.
    pub is_campaign: bool,
}

/// All templates.
pub const TEMPLATES: &[Template] = &[
    Template {
        name: "acoustic",
        title: "acoustic pulses on an agglomerate, with laws that converge and bonds that hold and break",
        text: include_str!("../../scenarios/acoustic-dispersal.toml"),
        is_campaign: false,
    },
    Template {
        name: "acoustic-published",
        title: "the same agglomerate with the laws of the paper as printed",
        text: include_str!("../../scenarios/acoustic-dispersal-published.toml"),
        is_campaign: false,
    },
    Template {
        name: "microscale",
        title: "pigment grains of some 10 um in water under four short pulses",
        text: include_str!("../../scenarios/ink-agglomerate.toml"),
        is_campaign: false,
    },
    Template {
        name: "reacting",
        title: "hard grains that collide, react, stick and grow, with laws that converge",
        text: include_str!("../../scenarios/reacting-agglomeration.toml"),
        is_campaign: false,
    },
    Template {
        name: "reacting-published",
        title: "the same grains with the model of the paper as printed",
        text: include_str!("../../scenarios/reacting-agglomeration-published.toml"),
        is_campaign: false,
    },
    Template {
        name: "form",
        title: "pigment grains that stick and grow, the first half of form, then disperse",
        text: include_str!("../../scenarios/form.toml"),
        is_campaign: false,
    },
    Template {
        name: "disperse",
        title: "pulses of sound on what has grown, the second half",
        text: include_str!("../../scenarios/disperse.toml"),
        is_campaign: false,
    },
    Template {
        name: "packing",
        title: "grains in a box that repeats itself and is pressed together to a dense packing",
        text: include_str!("../../scenarios/packing.toml"),
        is_campaign: false,
    },
    Template {
        name: "silo",
        title: "beads that run out of a silo through a hole in its bottom",
        text: include_str!("../../scenarios/silo.toml"),
        is_campaign: false,
    },
    Template {
        name: "drum",
        title: "beads in a rotating drum, which keeps a slope up",
        text: include_str!("../../scenarios/drum.toml"),
        is_campaign: false,
    },
    Template {
        name: "bed",
        title: "beads that settle to a bed",
        text: include_str!("../../scenarios/bed.toml"),
        is_campaign: false,
    },
    Template {
        name: "search",
        title: "a search for the grains that grow most: ten parameters, the paper's genetic algorithm",
        text: include_str!("../../scenarios/search-agglomeration.toml"),
        is_campaign: true,
    },
    Template {
        name: "search-pulse",
        title: "a search for the pulses that disperse an agglomerate with the least energy",
        text: include_str!("../../scenarios/search-pulse.toml"),
        is_campaign: true,
    },
    Template {
        name: "study",
        title: "a study of growth against crowding: a grid of values, each a mean over random starts",
        text: include_str!("../../scenarios/study-length-ratio.toml"),
        is_campaign: true,
    },
    Template {
        name: "study-rays",
        title: "a study of convergence: how many rays are enough",
        text: include_str!("../../scenarios/study-rays.toml"),
        is_campaign: true,
    },
    Template {
        name: "study-kernels",
        title: "a study of how often grains of two sizes meet and stick, for a population balance",
        text: include_str!("../../scenarios/study-kernels.toml"),
        is_campaign: true,
    },
];

/// All templates that are scenarios.
pub fn scenario_templates() -> impl Iterator<Item = &'static Template> {
    TEMPLATES.iter().filter(|template| !template.is_campaign)
}

/// The template with this name.
pub fn template(name: &str) -> Option<&'static Template> {
    TEMPLATES.iter().find(|template| template.name == name)
}

/// The template that an unknown name most probably stands for.
pub fn nearest_template(name: &str) -> Option<&'static str> {
    super::fault::nearest(name, TEMPLATES.iter().map(|template| template.name))
}
