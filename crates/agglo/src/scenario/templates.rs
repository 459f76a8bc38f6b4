//! Commented scenarios to start from: the files that ship with the program.

/// A scenario to start from.
#[derive(Clone, Copy, Debug)]
pub struct Template {
    /// The word it is asked for with.
    pub name: &'static str,
    /// What it is, in one line.
    pub title: &'static str,
    /// The file.
    pub text: &'static str,
}

/// All templates.
pub const TEMPLATES: &[Template] = &[
    Template {
        name: "acoustic",
        title: "an acoustic pulse on an agglomerate, with the laws of the paper as printed",
        text: include_str!("../../../../scenarios/acoustic-dispersal.toml"),
    },
    Template {
        name: "acoustic-sound",
        title: "the same agglomerate with laws that converge and bonds that hold and break",
        text: include_str!("../../../../scenarios/acoustic-dispersal-sound.toml"),
    },
    Template {
        name: "microscale",
        title: "pigment grains of some 10 um in water under four short pulses",
        text: include_str!("../../../../scenarios/ink-agglomerate.toml"),
    },
    Template {
        name: "reacting",
        title: "hard grains that collide, react, stick and grow, with laws that converge",
        text: include_str!("../../../../scenarios/reacting-agglomeration.toml"),
    },
    Template {
        name: "reacting-published",
        title: "the same grains with the model of the paper as printed",
        text: include_str!("../../../../scenarios/reacting-agglomeration-published.toml"),
    },
];

/// The template with this name.
pub fn template(name: &str) -> Option<&'static Template> {
    TEMPLATES.iter().find(|template| template.name == name)
}

/// The template that an unknown name most probably stands for.
pub fn nearest_template(name: &str) -> Option<&'static str> {
    super::fault::nearest(name, TEMPLATES.iter().map(|template| template.name))
}
