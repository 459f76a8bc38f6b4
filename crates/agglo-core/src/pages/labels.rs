//! What the list of laws says of a law, read off its page: labels of its equations, its source, its engine.

use super::Page;

/// The kind of grains that a law is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engine {
    /// Grains that overlap and feel forces: `verlet`, `staggered`.
    Soft,
    /// Grains that meet at instants: `event_driven`, `time_stepped`.
    Hard,
}

impl Engine {
    /// Its word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Soft => "soft",
            Self::Hard => "hard",
        }
    }
}

impl Page {
    /// Whose law it is.
    pub fn engine(&self) -> Engine {
        if self.group.starts_with("impact") || self.group.starts_with("engine/hard") {
            Engine::Hard
        } else {
            Engine::Soft
        }
    }

    /// Labels of the law's equations, such as `[A] 70` or `A5`, in the order of the page.
    pub fn labels(&self) -> Vec<String> {
        let text = self.text();
        let equation = section(&text, "Equation").unwrap_or_default();
        let mut found: Vec<String> = Vec::new();
        for line in std::iter::once(self.title()).chain(equation.lines()) {
            for label in candidates(line).filter_map(labels_alone).flatten() {
                if !found.contains(&label) {
                    found.push(label);
                }
            }
        }
        found
    }

    /// Who the law is from, on one line; none where the page has no such section.
    pub fn reference(&self) -> Option<String> {
        let text = self.text();
        let words: Vec<&str> = section(&text, "Source")?.split_whitespace().collect();
        // Links of the code's documentation lead nowhere else.
        Some(words.join(" ").replace("[`", "`").replace("`]", "`"))
    }
}

/// What stands below a heading of a page.
fn section<'a>(text: &'a str, heading: &str) -> Option<&'a str> {
    let (_, rest) = text.split_once(&format!("# {heading}\n"))?;
    Some(rest.split("\n# ").next().unwrap_or(rest).trim())
}

/// Where labels stand in a line: within parentheses, or at the end after a gap.
fn candidates(line: &str) -> impl Iterator<Item = &str> {
    let within = line.split('(').skip(1).filter_map(|rest| rest.split_once(')')).map(|(inside, _)| inside);
    within.chain(line.rsplit_once("  ").map(|(_, end)| end))
}

/// The labels of a text that has nothing else, but for a word of a scenario that they belong to.
fn labels_alone(text: &str) -> Option<Vec<String>> {
    let mut labels: Vec<String> = Vec::new();
    for piece in text.split(", ").map(str::trim) {
        let paper = piece.strip_prefix("[A] ").or_else(|| piece.strip_prefix("[B] "));
        if paper.is_some_and(is_number) || is_own_label(piece) {
            labels.push(piece.to_owned());
        } else if is_number(piece) {
            // A further equation of the same paper.
            let last = labels.last_mut()?;
            *last = format!("{last}, {piece}");
        } else if !(piece.len() > 2 && piece.starts_with('`') && piece.ends_with('`')) {
            return None;
        }
    }
    Some(labels)
}

/// Whether this is the number of a paper's equation or a range: `70`, `4.14`, `13-15`.
fn is_number(text: &str) -> bool {
    text.starts_with(|first: char| first.is_ascii_digit())
        && text.chars().all(|part| part.is_ascii_digit() || ".-".contains(part))
}

/// Whether this is a label of the project's own: a capital and a number from 1.
fn is_own_label(text: &str) -> bool {
    let number = text.strip_prefix(|first: char| first.is_ascii_uppercase()).unwrap_or("");
    !number.starts_with('0') && number.parse::<u8>().is_ok()
}

#[cfg(test)]
mod tests {
    use super::super::{PAGES, explain};
    use super::*;

    fn labels(word: &str) -> Vec<String> {
        explain(word).unwrap().labels()
    }

    #[test]
    fn labels_are_those_of_the_pages() {
        assert_eq!(labels("hertz"), ["[A] 70"]);
        assert_eq!(labels("restitution"), ["A5"]);
        assert_eq!(labels("ray_force"), ["[A] 7", "A13", "[A] 18"]);
        assert_eq!(labels("fresnel"), ["[A] 2-3, 52-62", "[A] 4", "A12"]);
        assert_eq!(labels("cooling"), ["[B] 6.19-6.20", "B9", "[B] 6.21"]);
        assert_eq!(labels("fragmentation"), ["[B] 5.1-5.3", "B7"]);
        assert_eq!(labels("near_field"), ["[A] 28"]);
    }

    #[test]
    fn symbols_are_not_labels() {
        // A word of a scenario may stand beside labels; what only begins or ends like one may not.
        assert_eq!(labels_alone("[A] 7, `beam`"), Some(vec!["[A] 7".to_owned()]));
        for text in ["[A] 7, `beam", "[A] 7, beam`", "[A] 7, beam", "[A] 7, ``"] {
            assert_eq!(labels_alone(text), None, "{text}");
        }
        for symbol in ["T0", "T - T0", "A", "n+1", "H0 exp(Q", "2n", "", "B5 and more", "70"] {
            assert!(labels_alone(symbol).is_none_or(|found| found.is_empty()), "{symbol}");
        }
    }

    #[test]
    fn every_law_has_a_label_and_a_source() {
        for page in PAGES {
            assert!(!page.labels().is_empty(), "{}: no label in its equation", page.name);
            let reference = page.reference().unwrap_or_else(|| panic!("{}: no source", page.name));
            assert!(reference.len() > 20 && !reference.contains('\n'), "{}: {reference}", page.name);
        }
    }

    #[test]
    fn engine_and_energy_are_those_of_the_code() {
        assert_eq!(explain("hertz").map(Page::engine), Some(Engine::Soft));
        assert_eq!(explain("fresnel").map(Page::engine), Some(Engine::Soft));
        assert_eq!(explain("hardness").map(Page::engine), Some(Engine::Hard));
        assert_eq!(explain("time_stepped").map(Page::engine), Some(Engine::Hard));
        let with_energy = ["strain_power", "hertz", "hooke", "beam", "coulomb", "gravity"];
        assert_all!(with_energy.iter(), |word| explain(word).unwrap().offers_energy());
        let without = ["viscous_area", "restitution", "drag", "lorentz", "verlet", "fresnel", "sticking"];
        assert_no!(without.iter(), |word| explain(word).unwrap().offers_energy());
    }
}
