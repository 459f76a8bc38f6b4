//! The law that an unknown word most probably stands for.

use super::fault;
use crate::pages::PAGES;

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
    use crate::pages::explain;
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
                let file = Path::new(env!("CARGO_MANIFEST_DIR"))
                    .join(format!("../agglo-core/src/{folder}/{word}.rs"));
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
