//! What the list of laws says of a law, read off its page: its equations and their labels, its source, what it is for.

use super::Page;

/// What a page is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// Grains that overlap and feel forces: `verlet`, `staggered`.
    Soft,
    /// Grains that meet at instants: `event_driven`, `time_stepped`.
    Hard,
    /// Searches and studies, whatever they vary.
    Search,
}

impl Scope {
    /// Its word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Soft => "soft",
            Self::Hard => "hard",
            Self::Search => "search",
        }
    }
}

impl Page {
    /// What it is about.
    pub fn scope(&self) -> Scope {
        let mut folders = self.group.split('/');
        match folders.next() {
            Some("search") => Scope::Search,
            Some("impact") => Scope::Hard,
            _ if folders.next() == Some("hard") => Scope::Hard,
            _ => Scope::Soft,
        }
    }

    /// Labels of the law's equations, such as `[A] 70` or `A5`, in the order of the page.
    pub fn labels(&self) -> Vec<String> {
        let equation = self.section("Equation").unwrap_or_default();
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

    /// Equations that stand on a line with their labels: the line without them, and the labels.
    pub fn equations(&self) -> Vec<(String, String)> {
        let equation = self.section("Equation").unwrap_or_default();
        let labelled = |line: &str| {
            let (equation, end) = line.rsplit_once("  ")?;
            let labels = labels_alone(end).filter(|labels| !labels.is_empty())?;
            let words: Vec<&str> = equation.split_whitespace().collect();
            Some((words.join(" "), labels.join(", ")))
        };
        equation.lines().filter_map(labelled).collect()
    }

    /// Who the law is from, on one line; none where the page has no such section.
    pub fn reference(&self) -> Option<String> {
        let text = self.section("Source")?;
        let words: Vec<&str> = text.split_whitespace().collect();
        Some(words.join(" "))
    }
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

/// Whether this is a label of the project's own: one or two capitals and a number from 1.
fn is_own_label(text: &str) -> bool {
    let number = text.trim_start_matches(|first: char| first.is_ascii_uppercase());
    (1..=2).contains(&(text.len() - number.len()))
        && number.starts_with(|first: char| matches!(first, '1'..='9'))
        && number.parse::<u8>().is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::pages;

    fn page(word: &str) -> &'static Page {
        pages().find(|page| page.has(word)).unwrap()
    }

    fn labels(word: &str) -> Vec<String> {
        page(word).labels()
    }

    #[test]
    fn labels_are_those_of_the_pages() {
        assert_eq!(labels("hertz"), ["[A] 70"]);
        assert_eq!(labels("restitution"), ["A5"]);
        assert_eq!(labels("impulse"), ["[A] 7", "[A] 18"]);
        assert_eq!(labels("radiation_pressure"), ["A13", "[A] 18"]);
        assert_eq!(labels("fresnel"), ["[A] 2-3, 52-62", "[A] 4", "A12"]);
        assert_eq!(labels("cooling"), ["[B] 6.19-6.20", "B9", "[B] 6.21"]);
        assert_eq!(labels("fragmentation"), ["[B] 5.1-5.3", "B7"]);
        assert_eq!(labels("near_field"), ["[A] 28"]);
    }

    #[test]
    fn symbols_are_not_labels() {
        // A word of a scenario may stand beside labels; what only begins or ends like one may not.
        assert_eq!(labels_alone("[A] 7, `beam`"), Some(vec!["[A] 7".to_owned()]));
        assert_eq!(labels_alone("SA1"), Some(vec!["SA1".to_owned()]));
        for text in ["[A] 7, `beam", "[A] 7, beam`", "[A] 7, beam", "[A] 7, ``"] {
            assert_eq!(labels_alone(text), None, "{text}");
        }
        for symbol in
            ["T0", "T - T0", "A", "n+1", "H0 exp(Q", "2n", "", "B5 and more", "70", "ABC1", "5", "E+1", "T0"]
        {
            assert!(labels_alone(symbol).is_none_or(|found| found.is_empty()), "{symbol}");
        }
    }

    #[test]
    fn every_law_has_a_label_and_a_source() {
        for page in pages() {
            assert!(!page.labels().is_empty(), "{}: no label in its equation", page.name);
            let reference = page.reference().unwrap_or_else(|| panic!("{}: no source", page.name));
            assert!(reference.len() > 20 && !reference.contains('\n'), "{}: {reference}", page.name);
        }
    }

    #[test]
    fn scope_and_energy_are_those_of_the_code() {
        assert_eq!(page("hertz").scope(), Scope::Soft);
        assert_eq!(page("fresnel").scope(), Scope::Soft);
        assert_eq!(page("hardness").scope(), Scope::Hard);
        assert_eq!(page("time_stepped").scope(), Scope::Hard);
        let with_energy = ["strain_power", "hertz", "hooke", "beam", "coulomb", "gravity"];
        assert_all!(with_energy.iter(), |word| page(word).offers_energy());
        let without = ["viscous_area", "restitution", "drag", "lorentz", "verlet", "fresnel", "sticking"];
        assert_no!(without.iter(), |word| page(word).offers_energy());
    }
}
