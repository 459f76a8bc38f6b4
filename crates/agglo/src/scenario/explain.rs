//! The page of a law: the comment at the head of its file, so that page and code cannot drift apart.

use super::fault;

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
    "regularised" "contact/friction" "regularised" [];
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
    "staggered" "engine/soft" "staggered" [];
    "verlet" "engine/soft" "verlet" [];
    "event_driven" "engine/hard" "event_driven" [];
    "time_stepped" "engine/hard" "time_stepped" [];
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

/// The law that an unknown word most probably stands for.
pub fn nearest_law(word: &str) -> Option<&'static str> {
    fault::nearest(
        word,
        PAGES.iter().flat_map(|page| std::iter::once(page.name).chain(page.words.iter().copied())),
    )
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::scenario::{enums, schema};

    /// A choice whose variants are one file each, with the folder of those files.
    const ONE_FILE_EACH: [(&str, &str); 5] = [
        ("Normal", "contact/normal"),
        ("Damping", "contact/damping"),
        ("Friction", "contact/friction"),
        ("Bonds", "contact/bond"),
        ("Restitution", "impact/restitution"),
    ];

    #[test]
    fn every_contact_and_impact_law_has_a_file_and_a_page_of_its_name() {
        let schema = schema();
        for (choice, folder) in ONE_FILE_EACH {
            let words = enums::words(&schema["$defs"][choice]);
            assert!(!words.is_empty(), "{choice}");
            for word in words {
                let page = explain(word).unwrap_or_else(|| panic!("no page for {word}"));
                assert_eq!((page.name, page.group), (word, folder));
                let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("src/{folder}/{word}.rs"));
                assert!(file.is_file(), "{}", file.display());
            }
        }
    }

    #[test]
    fn every_other_law_is_explained() {
        let schema = schema();
        for choice in ["DragLaw", "NearFieldLaw", "RayForce"] {
            for word in enums::words(&schema["$defs"][choice]) {
                assert!(explain(word).is_some(), "no page for {word}");
            }
        }
        for word in enums::words(&schema["$defs"]["Sticking"]) {
            assert_eq!(explain(word).unwrap().name, "sticking");
        }
        for part in ["Fields", "Impact"] {
            let words = schema["$defs"][part]["properties"].as_object().unwrap().keys();
            for word in words.filter(|word| *word != "restitution") {
                assert!(explain(word).is_some(), "no page for {word}");
            }
        }
    }

    #[test]
    fn pages_have_text_without_comment_marks() {
        for page in PAGES {
            assert!(page.title().len() > 10 && !page.text().contains("//!"), "{}", page.name);
            assert!(page.text().starts_with(page.title()), "{}", page.name);
        }
        assert_eq!(explain("Radiation-Pressure").unwrap().name, "ray_force");
        assert_none!(explain("rubber"));
        assert_eq!(nearest_law("herz"), Some("hertz"));
    }
}
