//! The page of each law: the comment at the head of its file, so that page and code cannot drift apart.

mod labels;
mod sections;

pub use labels::Scope;
pub use sections::Fragment;

/// The page of a law, or of whatever else has a word of its own.
#[derive(Clone, Copy, Debug)]
pub struct Page {
    /// Its word in a scenario, and its file's name.
    pub name: &'static str,
    /// The folder of its file.
    pub group: &'static str,
    /// Words of a scenario that the page explains besides its name.
    pub words: &'static [&'static str],
    source: &'static str,
}

macro_rules! pages {
    ($($name:literal $group:literal $file:literal [$($word:literal)*];)*) => {
        /// Pages of files that no family lists, in the order of the code.
        pub const OF_SINGLE_FILES: &[Page] = &[$(Page::new(
            $name,
            $group,
            &[$($word),*],
            include_str!(concat!("../", $group, "/", $file, ".rs")),
        )),*];
    };
}

pages! {
    "contact_area" "impact" "contact_area" [];
    "contact_time" "impact" "contact_time" [];
    "softening" "impact" "softening" [];
    "sticking" "impact" "sticking" ["merge" "never"];
    "work" "impact" "work" [];
    "reaction_heat" "impact" "reaction_heat" [];
    "self_gravity" "impact" "self_gravity" [];
    "beams" "acoustics" "beam" [];
    "fresnel" "acoustics" "fresnel" [];
    "follow" "acoustics" "follow" [];
    "walls" "walls" "wall" ["wall"];
    "staggered" "engine/soft/step" "staggered" [];
    "verlet" "engine/soft/step" "verlet" [];
    "deformation" "domain" "deformation" [];
    "event_driven" "engine/hard/drive" "event_driven" [];
    "time_stepped" "engine/hard/drive" "time_stepped" [];
}

impl Page {
    /// The page at the head of a file, which is `source`.
    pub const fn new(
        name: &'static str,
        group: &'static str,
        words: &'static [&'static str],
        source: &'static str,
    ) -> Self {
        Self { name, group, words, source }
    }

    /// The first line: what it is.
    pub fn title(&self) -> &'static str {
        self.source.lines().next().unwrap_or("").trim_start_matches("//!").trim()
    }

    /// Whether the law's code offers the energy that it stores, whose slope its force is.
    pub fn offers_energy(&self) -> bool {
        self.source.contains("fn energy(")
    }

    /// Whether the page is that of a word; dashes count as underscores, capitals as small letters.
    pub fn has(&self, word: &str) -> bool {
        let word = word.to_lowercase().replace('-', "_");
        self.name == word || self.words.contains(&word.as_str())
    }
}
