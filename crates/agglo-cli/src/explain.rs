//! Pages of laws.

use agglo::pages::{PAGES, explain as page_of};
use agglo::scenario::nearest_law;

use crate::{Failure, print};

/// Prints a law's page, or the list of all.
pub(crate) fn explain(law: Option<&str>) -> Result<(), Failure> {
    let Some(word) = law else { return list() };
    if let Some(page) = page_of(word) {
        return print(&format!("{} ({})\n\n{}", page.name, page.group, page.text()));
    }
    let advice = nearest_law(word).map(|near| format!("; did you mean \"{near}\"?")).unwrap_or_default();
    let message = format!("error: there is no law \"{word}\"{advice}\nhelp: `agglo explain` lists all laws");
    Err(Failure::bad_input(message))
}

fn list() -> Result<(), Failure> {
    let mut lines = Vec::new();
    let mut group = "";
    for page in PAGES {
        if page.group != group {
            group = page.group;
            lines.push(group.to_owned());
        }
        lines.push(format!("  {:<14}{}", page.name, page.title()));
        if !page.words.is_empty() {
            lines.push(format!("  {:<14}with {}", "", page.words.join(", ")));
        }
    }
    print(&lines.join("\n"))
}
