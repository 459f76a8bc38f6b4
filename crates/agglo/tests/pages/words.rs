//! Words lead to what is known of them.

use std::collections::BTreeSet;
use std::path::Path;

use agglo::pages::{File, all, explain, page};

/// Where the laws of a choice live: one file each.
const ONE_FILE_EACH: [(&str, &str); 8] = [
    ("contact.normal", "contact/normal"),
    ("contact.damping", "contact/damping"),
    ("contact.friction", "contact/friction"),
    ("bonds", "contact/bond"),
    ("fields.near_field.law", "fields/near_field"),
    ("impact.restitution", "impact/restitution"),
    ("method", "search/optimizer"),
    ("plan", "search/plan"),
];

/// Words right below a path.
fn below(path: &str) -> Vec<&'static str> {
    let keys = File::ALL.into_iter().flat_map(File::keys);
    let words = keys.filter_map(|key| key.path.strip_prefix(path)?.strip_prefix('.'));
    words.filter(|word| !word.contains('.')).collect()
}

#[test]
fn every_choice_of_laws_and_methods_has_a_file_and_a_page_of_its_name() {
    for (path, folder) in ONE_FILE_EACH {
        let words = below(path);
        assert!(!words.is_empty(), "{path}");
        for word in words {
            let page = page(word).unwrap_or_else(|| panic!("no page for {word}"));
            assert_eq!((page.name, page.group), (word, folder));
        }
    }
    for word in below("fields").into_iter().chain(below("engine")).chain(below("acoustics.force")) {
        assert!(page(word).is_some(), "no page for {word}");
    }
    for word in below("impact").into_iter().chain(below("ensemble.until")) {
        assert!(word == "restitution" || page(word).is_some(), "no page for {word}");
    }
}

#[test]
fn no_word_has_two_pages() {
    let words: Vec<&str> = all().flat_map(|page| page.words.iter().copied().chain([page.name])).collect();
    let different: BTreeSet<&str> = words.iter().copied().collect();
    assert_eq!(different.len(), words.len());
    assert_eq!(page("Radiation-Pressure").unwrap().name, "radiation_pressure");
    assert_none!(page("rubber"));
}

#[test]
fn every_page_has_all_sections_of_a_law() {
    const ALL: [&str; 5] = ["Equation", "Source", "Symbols", "Valid when", "Compared with others"];
    for page in all() {
        assert!(page.title().len() > 10 && !page.title().contains("//!"), "{}", page.name);
        let sections = page.sections();
        let found: Vec<&str> = sections
            .iter()
            .map(|(heading, _)| heading.as_str())
            .filter(|heading| ALL.contains(heading))
            .collect();
        assert_eq!(found, ALL, "{}", page.name);
        assert!(!page.labels().is_empty(), "{}: no label in its equation", page.name);
        assert!(page.reference().is_some_and(|source| source.len() > 20), "{}: no source", page.name);
    }
}

#[test]
fn a_page_is_shown_with_its_keys_and_without_rust() {
    for page in all() {
        for word in page.words.iter().chain([&page.name]) {
            let text = explain(word).unwrap_or_else(|_| panic!("{word}"));
            assert_starts!(text, &format!("{} (", page.name));
            assert!(!text.contains("# Example") && !text.contains("assert"), "{word}: {text}");
            assert!(text.contains("```toml") && text.contains("# Keys"), "{word}: {text}");
            assert!(!text.contains("[`"), "{word}: links into the code: {text}");
        }
    }
}

/// The first words of each line that is a row of a table of keys.
fn rows(text: &str) -> Vec<&str> {
    text.lines().filter_map(|line| line.strip_prefix("| `")?.split_once('`')).map(|(path, _)| path).collect()
}

fn said(word: &str) -> String {
    explain(word).unwrap_or_else(|unknown| panic!("{word}: {unknown:?}"))
}

#[test]
fn a_key_gives_its_line_with_unit_and_default() {
    let gap = said("bonds.beam.gap");
    assert_eq!(rows(&gap), ["bonds.beam.gap"]);
    assert_contains!(gap, "| -    | 0.001   | Grains whose surfaces");
    let hamaker = said("hamaker");
    assert_eq!(rows(&hamaker), ["fields.near_field.law.van_der_waals.hamaker"]);
    assert_contains!(hamaker, "| J    | -       |");
    // Numbers of entries and names of one's own may be given or left out.
    for path in ["acoustics.beams.0.rays", "acoustics.beams.rays", "beams.rays", "rays"] {
        assert_has!(rows(&said(path)), &"acoustics.beams.N.rays");
    }
    for path in ["materials.glass.poisson_ratio", "materials.poisson_ratio", "Poisson-Ratio"] {
        assert_eq!(rows(&said(path)), ["materials.NAME.poisson_ratio"], "{path}");
    }
    let normal = said("contact.normal");
    assert_has!(rows(&normal), &"contact.normal.hooke.stiffness");
    assert_has!(rows(&normal), &"contact.normal.strain_power.exponent");
    let faces = ["volume.boundary", "volume.faces.x", "volume.faces.y", "volume.faces.z"];
    assert_eq!(rows(&said("periodic")), faces.map(|key| format!("{key} = \"periodic\"")));
    assert_eq!(rows(&said("volume.boundary.open")), ["volume.boundary = \"open\""]);
}

#[test]
fn a_word_of_two_meanings_leads_to_both() {
    let growth = said("growth");
    assert_starts!(growth, "growth (run/hard)");
    assert_contains!(growth, "# Elsewhere in a search or study");
    assert_has!(rows(&growth), &"method.cma_es.growth");
    let sobol = said("sobol");
    assert_starts!(sobol, "sobol (search/optimizer)");
    assert_contains!(sobol, "acoustics.beams.N.pattern = \"sobol\"");
    let both = said("limits");
    assert!(both.contains("# In a scenario") && both.contains("# In a search or study"), "{both}");
    // What is on the page is not said again.
    assert_lacks!(said("hertz"), "Elsewhere");
    assert_lacks!(said("cma_es"), "Elsewhere");
}

#[test]
fn what_one_could_mean_otherwise_is_named() {
    let rolling = said("rolling");
    assert!(rolling.contains("no law of rolling") && rolling.contains("agglo explain beam"), "{rolling}");
    let beam = said("beam");
    assert_starts!(beam, "beam (contact/bond)");
    assert_contains!(beam, "agglo explain beams");
    let beams = said("beams");
    assert_starts!(beams, "beams (acoustics)");
    assert_contains!(beams, "`agglo explain beam`");
}

#[test]
fn unknown_words_give_the_nearest() {
    let nearest = |word: &str| explain(word).unwrap_err().nearest;
    assert_eq!(nearest("herz").as_deref(), Some("hertz"));
    assert_eq!(nearest("moris").as_deref(), Some("morris"));
    assert_eq!(nearest("hamacker").as_deref(), Some("hamaker"));
    assert_eq!(nearest("contact.norml").as_deref(), Some("contact.normal"));
    assert_eq!(nearest("qqqqqq"), None);
}

/// Whoever names `agglo explain WORD` names a word that is explained.
#[test]
fn what_is_told_to_be_explained_is() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let guide = std::fs::read_dir(root.join("docs")).unwrap().flatten().map(|entry| entry.path());
    let files = guide.filter(|path| path.extension().is_some_and(|end| end == "md"));
    let mut texts: Vec<String> =
        files.chain([root.join("README.md")]).map(|path| std::fs::read_to_string(path).unwrap()).collect();
    let words = ["rolling", "beam", "beams", "adhesion", "walls"];
    texts.extend(words.map(said));
    let mut count = 0;
    for text in texts {
        for rest in text.split("agglo explain ").skip(1) {
            let word: String = rest
                .chars()
                .take_while(|part| part.is_ascii_alphanumeric() || "_.".contains(*part))
                .collect();
            let word = word.trim_end_matches('.');
            if word.is_empty() || word == "WORD" {
                continue;
            }
            assert!(explain(word).is_ok(), "`agglo explain {word}` is named and not known");
            count += 1;
        }
    }
    assert_at_least!(count, 8);
}
