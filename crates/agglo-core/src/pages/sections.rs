//! A page read: what stands below each of its headings. There is no other reader of pages.

use super::Page;

/// What a page shows of a file that uses its law.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fragment {
    /// A part of a scenario, as TOML.
    Scenario(String),
    /// A part of the file of a search or study, as TOML.
    Campaign(String),
}

impl Fragment {
    /// The part of the file.
    pub fn text(&self) -> &str {
        match self {
            Self::Scenario(text) | Self::Campaign(text) => text,
        }
    }
}

/// Headings of fragments.
const IN_A_SCENARIO: &str = "In a scenario";
const IN_A_CAMPAIGN: &str = "In a campaign";

impl Page {
    /// Headings with what stands below them, in Markdown; first comes the head of the page, whose heading is empty.
    pub fn sections(&self) -> Vec<(String, String)> {
        let mut sections = vec![(String::new(), Vec::new())];
        let mut is_code = false;
        for line in self.source.lines().map_while(|line| line.strip_prefix("//!")) {
            let line = line.strip_prefix(' ').unwrap_or(line);
            is_code ^= line.starts_with("```");
            match line.strip_prefix("# ") {
                Some(heading) if !is_code => sections.push((heading.trim().to_owned(), Vec::new())),
                _ => {
                    if let Some((_, lines)) = sections.last_mut() {
                        lines.push(without_links(line));
                    }
                }
            }
        }
        sections.into_iter().map(|(heading, lines)| (heading, lines.join("\n").trim().to_owned())).collect()
    }

    /// What stands below a heading.
    pub fn section(&self, heading: &str) -> Option<String> {
        self.sections().into_iter().find(|(found, _)| found == heading).map(|(_, text)| text)
    }

    /// How the law is written in a file.
    pub fn fragment(&self) -> Option<Fragment> {
        let block = |heading| {
            let text = self.section(heading)?;
            let (_, rest) = text.split_once("```toml\n")?;
            rest.split_once("```").map(|(block, _)| block.to_owned())
        };
        block(IN_A_SCENARIO).map(Fragment::Scenario).or_else(|| block(IN_A_CAMPAIGN).map(Fragment::Campaign))
    }
}

/// A line whose links into the code, which lead nowhere else, are the words that they show.
fn without_links(line: &str) -> String {
    let mut text = String::with_capacity(line.len());
    let mut rest = line;
    while let Some((before, link)) = rest.split_once("[`") {
        let Some((shown, after)) = link.split_once("`]") else { break };
        text.extend([before, "`", shown, "`"]);
        let target = after.strip_prefix('(').and_then(|target| target.split_once(')'));
        rest = target.map_or(after, |(_, after)| after);
    }
    text + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOURCE: &str = "//! A law, see [`there`](super::there) and [`here`].\n//!\n//! # Equation\n//! ```text\n//! F = 1\n//! \
                          # no heading\n//! ```\n//!\n//! # In a scenario\n//! ```toml\n//! # a comment\n//! [a.law]\n//! ```\n\
                          \nuse std;\n//! # None";
    const PAGE: Page = Page::new("law", "a", &[], SOURCE);

    #[test]
    fn sections_end_at_headings_outside_of_code() {
        let sections = PAGE.sections();
        let headings: Vec<&str> = sections.iter().map(|(heading, _)| heading.as_str()).collect();
        assert_eq!(headings, ["", "Equation", "In a scenario"]);
        assert_eq!(sections[0].1, "A law, see `there` and `here`.");
        assert_eq!(PAGE.section("Equation").unwrap(), "```text\nF = 1\n# no heading\n```");
        assert_none!(PAGE.section("no heading"));
        assert_eq!(PAGE.fragment(), Some(Fragment::Scenario("# a comment\n[a.law]\n".to_owned())));
        assert_eq!(without_links("a [`b"), "a [`b");
    }

    #[test]
    fn every_page_has_the_same_sections() {
        const ALL: [&str; 5] = ["Equation", "Source", "Symbols", "Valid when", "Compared with others"];
        for page in crate::catalog::pages() {
            let sections = page.sections();
            let found: Vec<&str> = sections.iter().map(|(heading, _)| heading.as_str()).collect();
            let known: Vec<&str> = found.iter().copied().filter(|heading| ALL.contains(heading)).collect();
            assert_eq!(known, ALL, "{}", page.name);
            assert!(sections[1..].iter().all(|(_, text)| !text.is_empty()), "{}: {found:?}", page.name);
            assert!(matches!(page.fragment(), Some(Fragment::Scenario(_))), "{}: no fragment", page.name);
        }
    }
}
