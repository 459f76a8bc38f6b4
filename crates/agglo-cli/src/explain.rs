//! Pages of laws, methods and keys.

use agglo::pages::{all, explain as text_of};

use crate::{Failure, print};

/// Prints what is known of a word, or the list of all pages.
pub(crate) fn explain(word: Option<&str>) -> Result<(), Failure> {
    let Some(word) = word else { return list() };
    text_of(word).map_err(|unknown| {
        let advice = unknown.nearest.map(|near| format!("; did you mean \"{near}\"?")).unwrap_or_default();
        let word = agglo::text::visible(word);
        Failure::bad_input(format!(
            "error: there is no law, method or key \"{word}\"{advice}\nhelp: `agglo explain` lists all pages; keys are \
             explained by their names or paths, such as contact.normal"
        ))
    })
    .and_then(|text| print(&text))
}

fn list() -> Result<(), Failure> {
    let mut lines = Vec::new();
    let mut group = "";
    for page in all() {
        if page.group != group {
            group = page.group;
            lines.push(group.to_owned());
        }
        lines.push(format!("  {:<20}{}", page.name, page.title()));
        if !page.words.is_empty() {
            lines.push(format!("  {:<20}with {}", "", page.words.join(", ")));
        }
    }
    print(&lines.join("\n"))
}
