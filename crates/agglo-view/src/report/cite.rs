//! What to cite for the laws of a run.

use toml::Value;

use agglo::impact::heat::Balance;
use agglo::pages::{self, Page};
use agglo::scenario::Scenario;
use agglo::search::optimizer::Method;
use agglo::search::{Campaign, Plan};

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

/// A paper whose model is computed.
pub struct Paper {
    /// What pages call it.
    pub label: &'static str,
    title: &'static str,
    place: &'static str,
    /// Key, journal, volume, first page and year for BibTeX.
    entry: [&'static str; 5],
}

/// The papers that stand behind the models.
pub const PAPERS: [Paper; 2] = [
    Paper {
        label: "[A]",
        title: "A discrete element and ray framework for rapid simulation of acoustical dispersion of microscale \
                particulate agglomerations",
        place: "Comput. Mech. 57, 465 (2016)",
        entry: ["zohdi2016", "Computational Mechanics", "57", "465", "2016"],
    },
    Paper {
        label: "[B]",
        title: "A computational framework for agglomeration in thermochemically reacting granular flows",
        place: "Proc. R. Soc. Lond. A 460, 3421 (2004)",
        entry: ["zohdi2004", "Proceedings of the Royal Society of London. Series A", "460", "3421", "2004"],
    },
];

impl Paper {
    /// Author, title, place.
    pub fn whole(&self) -> String {
        format!("T. I. Zohdi, {}, {}", self.title, self.place)
    }
}

/// A source with the titles of the papers that it gives by their places alone.
fn in_full(source: &str) -> String {
    PAPERS.iter().fold(source.to_owned(), |text, paper| {
        text.replace(&format!("T. I. Zohdi, {}", paper.place), &paper.whole())
    })
}

/// The methods of a search or study with their sources; none for those that have no source.
pub fn methods(campaign: &Campaign) -> Vec<Citation> {
    let Campaign { method, polish, plan, .. } = campaign;
    let words =
        [method.as_ref().map(Method::word), polish.as_ref().map(|_| "polish"), plan.as_ref().map(Plan::word)];
    let mut pages: Vec<&Page> = words.into_iter().flatten().filter_map(pages::page).collect();
    pages.dedup_by_key(|page| page.name);
    pages.into_iter().filter_map(citation).collect()
}

/// What a page says of where its law comes from; nothing where it comes from nowhere.
fn citation(page: &'static Page) -> Option<Citation> {
    let source = page.reference().filter(|source| !source.starts_with("None:"))?;
    Some(Citation { law: page.name, title: page.title(), source: in_full(&plain(&source)) })
}

/// How to cite the program.
pub fn program() -> String {
    format!("The agglo developers, agglo {} (software).", env!("CARGO_PKG_VERSION"))
}

/// The same for BibTeX: the program, the papers whose model is computed, and the sources of laws as they stand.
pub fn bibtex(found: &[Citation]) -> String {
    let mut entries = vec![format!(
        "@software{{agglo,\n  author = {{{{The agglo developers}}}},\n  title = {{agglo}},\n  version = {{{}}}\n}}",
        env!("CARGO_PKG_VERSION")
    )];
    let is_named = |paper: &&Paper| found.iter().any(|one| one.source.contains(&paper.whole()));
    entries.extend(PAPERS.iter().filter(is_named).map(|paper| {
        let [key, journal, volume, page, year] = paper.entry;
        format!(
            "@article{{{key},\n  author = {{Zohdi, T. I.}},\n  title = {{{}}},\n  journal = {{{journal}}},\n  volume = \
             {{{volume}}},\n  pages = {{{page}}},\n  year = {{{year}}}\n}}",
            paper.title
        )
    }));
    entries.extend(found.iter().map(|one| {
        let (title, source) = (in_tex(one.title), in_tex(&one.source));
        format!("@misc{{agglo-{},\n  title = {{{{{title}}}}},\n  note = {{{source}}}\n}}", one.law)
    }));
    entries.join("\n\n") + "\n"
}

/// A text in which nothing is a command of TeX.
fn in_tex(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\\' => safe.push_str("\\textbackslash{}"),
            '~' => safe.push_str("\\textasciitilde{}"),
            '^' => safe.push_str("\\textasciicircum{}"),
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => {
                safe.push('\\');
                safe.push(c);
            }
            _ => safe.push(c),
        }
    }
    safe
}

/// The laws that a scenario uses with their sources, in the order of the code.
pub fn citations(scenario: &Scenario) -> Vec<Citation> {
    let mut paths = Vec::new();
    if let Ok(value) = Value::try_from(scenario) {
        collect(&value, &mut Vec::new(), &mut paths);
    }
    let mut always = laws_of_every_impact(scenario);
    // How much of a ray is reflected no key chooses.
    always.extend(scenario.acoustics().map(|_| "fresnel"));
    pages::all()
        .filter(|page| paths.iter().any(|path| names(path, page)) || always.contains(&page.name))
        .filter_map(citation)
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
    // Bonds have a table of their own in a scenario, forces of rays are in one of another name, the engine's folders are not words
    // of it, and a page may stand for its own folder.
    let group = match page.group {
        "contact/bond" => "bonds",
        "acoustics/ray_force" => "acoustics/force",
        group => group,
    };
    let mut group = group
        .split('/')
        .filter(|word| !matches!(*word, "soft" | "hard" | "drive" | "step") && *word != page.name);
    named && group.all(|word| before.iter().any(|known| known == word))
}

/// Laws of impact that no key chooses; the work of an impact is part of the published balance of heat alone.
fn laws_of_every_impact(scenario: &Scenario) -> Vec<&'static str> {
    let Some(impact) = scenario.impact() else { return Vec::new() };
    let mut laws = vec!["contact_area", "contact_time", "heat"];
    laws.extend((impact.heat.balance == Balance::Published).then_some("work"));
    laws
}

/// A text without the marks of emphasis and code.
fn plain(text: &str) -> String {
    text.replace(['*', '`'], "")
}

#[cfg(test)]
mod tests {
    use super::*;
    use agglo::scenario::template;

    fn laws(name: &str) -> Vec<&'static str> {
        let scenario = Scenario::from_toml(template(name).unwrap().text).unwrap();
        citations(&scenario).iter().map(|citation| citation.law).collect()
    }

    #[test]
    fn the_laws_of_the_file_are_cited_and_no_others() {
        let consistent = laws("acoustic");
        for law in
            ["hertz", "restitution", "mindlin", "beam", "drag", "beams", "impulse", "fresnel", "verlet"]
        {
            assert!(consistent.contains(&law), "{law} is missing in {consistent:?}");
        }
        for law in
            ["radiation_pressure", "strain_power", "staggered", "hooke", "constant", "hardness", "gravity"]
        {
            assert!(!consistent.contains(&law), "{law} is in {consistent:?}");
        }
        let scenario = Scenario::from_toml(template("acoustic").unwrap().text).unwrap();
        let all = citations(&scenario);
        let of_reflection = all.iter().find(|citation| citation.law == "fresnel").unwrap();
        assert!(of_reflection.source.contains("L. M. Brekhovskikh, Waves in"), "{}", of_reflection.source);
        let hard = laws("reacting");
        assert_has_not!(hard, &"fresnel");
        for law in ["hardness", "tangential", "fragmentation", "cooling", "contact_area", "event_driven"] {
            assert!(hard.contains(&law), "{law} is missing in {hard:?}");
        }
        assert_has_not!(hard, &"work");
        assert_has!(laws("reacting-published"), &"work");
        assert!(!hard.contains(&"constant") && !hard.contains(&"restitution"), "{hard:?}");
    }

    #[test]
    fn entries_for_bibtex_are_whole_and_safe() {
        let scenario = Scenario::from_toml(template("reacting").unwrap().text).unwrap();
        let found = citations(&scenario);
        let text = bibtex(&found);
        assert_has!(text.lines().collect::<Vec<_>>(), &"@article{zohdi2004,");
        assert!(!text.contains("zohdi2016"), "the other paper is not computed");
        assert_eq!(text.matches("@misc{agglo-").count(), found.len());
        let is_closed = |text: &str| text.matches('{').count() == text.matches('}').count();
        let plain = text.replace("\\{", "").replace("\\}", "");
        assert!(plain.split("\n\n").all(is_closed), "{text}");
        assert_eq!(
            in_tex("a_b & 5 % {x^2}~\\"),
            "a\\_b \\& 5 \\% \\{x\\textasciicircum{}2\\}\\textasciitilde{}\\textbackslash{}"
        );
    }

    #[test]
    fn every_source_is_said() {
        for name in ["acoustic", "acoustic-published", "microscale", "reacting", "reacting-published"] {
            let scenario = Scenario::from_toml(template(name).unwrap().text).unwrap();
            for citation in citations(&scenario) {
                assert!(citation.source.len() > 10, "{}: {}", citation.law, citation.source);
                let is_short =
                    citation.source.contains("Zohdi, Proc") || citation.source.contains("Zohdi, Comput");
                assert!(!is_short, "{}: {}", citation.law, citation.source);
                assert!(!citation.source.contains(['*', '`']), "{}: {}", citation.law, citation.source);
            }
        }
    }
}
