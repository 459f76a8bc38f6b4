//! The list of all laws, methods and plans. It is read off the laws' pages, so that there is no second one to keep.

use agglo::pages::{Page, all, chapters, markdown};

use crate::arguments::ListForm;
use crate::{Failure, print};

/// Prints the list.
pub(crate) fn list(form: ListForm) -> Result<(), Failure> {
    if form.json {
        let laws: Vec<serde_json::Value> = all().map(as_json).collect();
        return print(&format!("{:#}", serde_json::Value::from(laws)));
    }
    print(&match form {
        ListForm { markdown: true, .. } => markdown(),
        ListForm { pages: true, .. } => chapters(),
        _ => plain(),
    })
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
    let mut lines = vec![row(["word", "for", "energy", "equations"], "what it is")];
    let mut group = "";
    for page in all() {
        if page.group != group {
            group = page.group;
            lines.push(format!("\n{group}"));
        }
        let words = [page.name, page.scope().word(), energy(page), &equations(page)];
        lines.push(row(words, page.title()));
        lines.push(format!("  {:<20}{}", "", source(page)));
        if !page.words.is_empty() {
            lines.push(format!("  {:<20}with {}", "", page.words.join(", ")));
        }
    }
    lines.join("\n")
}

fn row([word, scope, energy, equations]: [&str; 4], what: &str) -> String {
    format!("  {word:<20}{scope:<8}{energy:<8}{equations:<30}{what}")
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
        "for": page.scope().word(),
    })
}
