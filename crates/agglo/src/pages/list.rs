//! All pages as one text: the table of all, and the pages one after another as they stand in the guide.

use super::keys::keys_table;
use super::{Page, all, table};

/// The table of all pages, in Markdown.
pub fn markdown() -> String {
    let head = ["word", "also explains", "what it is", "equations", "source", "energy", "for"];
    let row = |page: &Page| {
        let also: Vec<String> = page.words.iter().map(|word| format!("`{word}`")).collect();
        let energy = if page.offers_energy() { "yes" } else { "-" };
        vec![
            format!("`{}`", page.name),
            also.join(", "),
            page.title().to_owned(),
            page.labels().join("; "),
            page.reference().unwrap_or_default(),
            energy.to_owned(),
            page.scope().word().to_owned(),
        ]
    };
    table(&head, &all().map(row).collect::<Vec<_>>())
}

/// All pages, in Markdown, as chapters below a heading of the first order.
pub fn chapters() -> String {
    all().map(chapter).collect::<Vec<_>>().join("\n\n")
}

fn chapter(page: &Page) -> String {
    let mut parts = vec![format!("## {}", page.name)];
    for (heading, text) in page.sections() {
        match heading.as_str() {
            "" => parts.push(text),
            "Example" => parts.push(format!("**In Rust**\n\n{}", as_read(&text))),
            _ => parts.push(format!("**{heading}**\n\n{text}")),
        }
    }
    parts.extend(keys_table(page).map(|table| format!("**Keys**\n\n{table}")));
    parts.join("\n\n")
}

/// An example as a reader sees it: a block without a language is Rust, and lines that begin with `# ` are for the compiler alone.
fn as_read(example: &str) -> String {
    let seen: Vec<&str> = example.lines().filter(|line| !line.starts_with("# ")).collect();
    seen.join("\n").replacen("```\n", "```rust\n", 1)
}
