//! What to cite for the laws of a run.

use toml::Value;

use crate::scenario::{PAGES, Page, Scenario};

/// A law that a scenario uses, and its source.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Citation {
    /// The law's word.
    pub law: &'static str,
    /// What it is.
    pub title: &'static str,
    /// Where it comes from.
    pub source: String,
}

/// How to cite the program.
pub fn program() -> String {
    format!("The agglo developers, agglo {} (software).", env!("CARGO_PKG_VERSION"))
}

/// The laws that a scenario uses with their sources, in the order of the code.
pub fn citations(scenario: &Scenario) -> Vec<Citation> {
    let mut paths = Vec::new();
    if let Ok(value) = Value::try_from(scenario) {
        collect(&value, &mut Vec::new(), &mut paths);
    }
    let hard = scenario.engine.is_hard();
    PAGES
        .iter()
        .filter(|page| paths.iter().any(|path| names(path, page)) || (hard && has_no_key(page)))
        .filter_map(|page| {
            Some(Citation { law: page.name, title: page.title(), source: section(&page.text(), "# Source")? })
        })
        .collect()
}

/// All paths of keys, with words that stand as values at their ends; numbers of lists are left out.
fn collect(value: &Value, path: &mut Vec<String>, paths: &mut Vec<Vec<String>>) {
    match value {
        Value::Table(table) => {
            for (key, inner) in table {
                path.push(key.clone());
                paths.push(path.clone());
                collect(inner, path, paths);
                path.pop();
            }
        }
        Value::Array(items) => items.iter().for_each(|item| collect(item, path, paths)),
        Value::String(word) => {
            path.push(word.clone());
            paths.push(path.clone());
            path.pop();
        }
        _ => {}
    }
}

/// Whether a path leads to the law of a page: its group's words, then its own or one of its choices'.
fn names(path: &[String], page: &Page) -> bool {
    let Some((last, before)) = path.split_last() else { return false };
    let named = last == page.name || page.words.contains(&last.as_str());
    // Bonds have a table of their own in a scenario, the engine's folders are not words of it, and a page may stand for
    // its own folder.
    let group = if page.group == "contact/bond" { "bonds" } else { page.group };
    let mut group = group.split('/').filter(|word| !matches!(*word, "soft" | "hard") && *word != page.name);
    named && group.all(|word| before.iter().any(|known| known == word))
}

/// Laws of impact that no key chooses: every impact obeys them.
fn has_no_key(page: &Page) -> bool {
    page.group == "impact" && matches!(page.name, "contact_area" | "contact_time" | "heat" | "work")
}

/// The text below a heading, in one line.
fn section(text: &str, heading: &str) -> Option<String> {
    let lines = text.lines().skip_while(|line| !line.starts_with(heading)).skip(1);
    let below: Vec<&str> = lines.take_while(|line| !line.starts_with('#')).map(str::trim).collect();
    let joined = plain(below.join(" ").trim());
    (!joined.is_empty()).then_some(joined)
}

/// A text without the marks of emphasis, code and links.
fn plain(text: &str) -> String {
    text.replace("[`", "").replace("`]", "").replace(['*', '`'], "")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::template;

    fn laws(name: &str) -> Vec<&'static str> {
        let scenario = Scenario::from_toml(template(name).unwrap().text).unwrap();
        citations(&scenario).iter().map(|citation| citation.law).collect()
    }

    #[test]
    fn the_laws_of_the_file_are_cited_and_no_others() {
        let sound = laws("acoustic-sound");
        for law in ["hertz", "restitution", "mindlin", "beam", "drag", "beams", "ray_force", "verlet"] {
            assert!(sound.contains(&law), "{law} is missing in {sound:?}");
        }
        for law in ["strain_power", "staggered", "hooke", "constant", "hardness", "gravity"] {
            assert!(!sound.contains(&law), "{law} is in {sound:?}");
        }
        let hard = laws("reacting");
        for law in ["hardness", "tangential", "fragmentation", "cooling", "contact_area", "event_driven"] {
            assert!(hard.contains(&law), "{law} is missing in {hard:?}");
        }
        assert!(!hard.contains(&"constant") && !hard.contains(&"restitution"), "{hard:?}");
    }

    #[test]
    fn every_source_is_said() {
        for name in ["acoustic", "acoustic-sound", "microscale", "reacting", "reacting-published"] {
            let scenario = Scenario::from_toml(template(name).unwrap().text).unwrap();
            for citation in citations(&scenario) {
                assert!(citation.source.len() > 10, "{}: {}", citation.law, citation.source);
                assert!(!citation.source.contains(['*', '`']), "{}: {}", citation.law, citation.source);
            }
        }
    }
}
