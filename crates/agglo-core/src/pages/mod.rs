//! The page of each law: the comment at the head of its file, so that page and code cannot drift apart.

mod labels;

pub use labels::Engine;

/// A law's page.
#[derive(Clone, Copy, Debug)]
pub struct Page {
    /// The law's word in a scenario, and its file's name.
    pub name: &'static str,
    /// The folder of the law.
    pub group: &'static str,
    /// Words of a scenario that the page explains besides its name.
    pub words: &'static [&'static str],
    source: &'static str,
}

macro_rules! pages {
    ($($name:literal $group:literal $file:literal [$($word:literal)*];)*) => {
        /// All pages, in the order of the code.
        pub const PAGES: &[Page] = &[$(Page {
            name: $name,
            group: $group,
            words: &[$($word),*],
            source: include_str!(concat!("../", $group, "/", $file, ".rs")),
        }),*];
    };
}

pages! {
    "strain_power" "contact/normal" "strain_power" [];
    "hertz" "contact/normal" "hertz" [];
    "hooke" "contact/normal" "hooke" [];
    "viscous_area" "contact/damping" "viscous_area" [];
    "restitution" "contact/damping" "restitution" [];
    "regularized" "contact/friction" "regularized" [];
    "mindlin" "contact/friction" "mindlin" [];
    "strain_bond" "contact/bond" "strain_bond" [];
    "beam" "contact/bond" "beam" [];
    "near_field" "fields/near_field" "mod" [];
    "power_pair" "fields/near_field" "power_pair" [];
    "coulomb" "fields/near_field" "coulomb" [];
    "van_der_waals" "fields/near_field" "van_der_waals" [];
    "lorentz" "fields" "lorentz" [];
    "magnetic" "fields" "magnetic" [];
    "gravity" "fields" "gravity" [];
    "drag" "fields" "drag" ["stokes" "schiller_naumann"];
    "hardness" "impact/restitution" "hardness" ["bracketed" "fixed_point"];
    "constant" "impact/restitution" "constant" [];
    "contact_area" "impact" "contact_area" [];
    "contact_time" "impact" "contact_time" [];
    "softening" "impact" "softening" [];
    "tangential" "impact" "tangential" ["no_slip"];
    "sticking" "impact" "sticking" ["merge" "never"];
    "fragmentation" "impact" "fragmentation" ["center_of_mass" "power_law"];
    "heat" "impact" "heat" [];
    "work" "impact" "work" [];
    "reaction_heat" "impact" "reaction_heat" [];
    "cooling" "impact" "cooling" [];
    "self_gravity" "impact" "self_gravity" [];
    "beams" "acoustics" "beam" [];
    "fresnel" "acoustics" "fresnel" [];
    "follow" "acoustics" "follow" [];
    "staggered" "engine/soft/step" "staggered" [];
    "verlet" "engine/soft/step" "verlet" [];
    "event_driven" "engine/hard/drive" "event_driven" [];
    "time_stepped" "engine/hard/drive" "time_stepped" [];
    "ray_force" "acoustics" "ray_force" ["impulse" "published_step" "radiation_pressure"];
}

impl Page {
    /// The first line: what the law is.
    pub fn title(&self) -> &'static str {
        self.source.lines().next().unwrap_or("").trim_start_matches("//!").trim()
    }

    /// Whether the law's code offers the energy that it stores, whose slope its force is.
    pub fn offers_energy(&self) -> bool {
        self.source.contains("pub fn energy(")
    }

    /// The whole page as plain text with Markdown headings.
    pub fn text(&self) -> String {
        let lines = self.source.lines().map_while(|line| line.strip_prefix("//!"));
        let page: Vec<&str> = lines.map(|line| line.strip_prefix(' ').unwrap_or(line)).collect();
        page.join("\n")
    }
}

/// The page of a law; dashes count as underscores, capitals as small letters.
pub fn explain(word: &str) -> Option<&'static Page> {
    let word = word.to_lowercase().replace('-', "_");
    PAGES.iter().find(|page| page.name == word || page.words.contains(&word.as_str()))
}
