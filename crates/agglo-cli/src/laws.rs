//! The list of all laws. It is read off the laws' pages, so that there is no second one to keep.

use agglo::pages::{PAGES, Page};

use crate::arguments::ListForm;
use crate::{Failure, print};

/// Prints the list.
pub(crate) fn list(form: ListForm) -> Result<(), Failure> {
    if form.json {
        let laws: Vec<serde_json::Value> = PAGES.iter().map(as_json).collect();
        return print(&format!("{:#}", serde_json::Value::from(laws)));
    }
    print(&if form.markdown { markdown() } else { plain() })
}

fn equations(page: &Page) -> String {
    page.labels().join("; ")
}

fn source(page: &Page) -> String {
    page.reference().unwrap_or_default()
}

fn energy(page: &Page) -> &'static str {
    if page.offers_energy() { "yes" } else { "-" }
}

/// Two lines a law, by folders of the code; the page's other words on a third.
fn plain() -> String {
    let mut lines = vec![row(["word", "engine", "energy", "equations"], "what it is")];
    let mut group = "";
    for page in PAGES {
        if page.group != group {
            group = page.group;
            lines.push(format!("\n{group}"));
        }
        let words = [page.name, page.engine().word(), energy(page), &equations(page)];
        lines.push(row(words, page.title()));
        lines.push(format!("  {:<15}{}", "", source(page)));
        if !page.words.is_empty() {
            lines.push(format!("  {:<15}with {}", "", page.words.join(", ")));
        }
    }
    lines.join("\n")
}

fn row([word, engine, energy, equations]: [&str; 4], what: &str) -> String {
    format!("  {word:<15}{engine:<8}{energy:<8}{equations:<30}{what}")
}

fn markdown() -> String {
    let mut lines = vec![
        "| word | also explains | what it is | equations | source | energy | engine |".to_owned(),
        "|---|---|---|---|---|---|---|".to_owned(),
    ];
    for page in PAGES {
        let also: Vec<String> = page.words.iter().map(|word| format!("`{word}`")).collect();
        let (name, also, what) = (page.name, also.join(", "), page.title());
        let (labels, source) = (equations(page), source(page));
        let (energy, engine) = (energy(page), page.engine().word());
        lines.push(format!("| `{name}` | {also} | {what} | {labels} | {source} | {energy} | {engine} |"));
    }
    lines.join("\n")
}

fn as_json(page: &Page) -> serde_json::Value {
    serde_json::json!({
        "word": page.name,
        "also_explains": page.words,
        "group": page.group,
        "what": page.title(),
        "equations": page.labels(),
        "source": page.reference(),
        "offers_energy": page.offers_energy(),
        "engine": page.engine().word(),
    })
}
