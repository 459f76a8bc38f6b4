//! Pages of all that has a word of its own in a file: laws, methods of searches, plans of studies, measures. A page is the
//! comment at the head of the file of what it tells of, so that the two cannot drift apart; its keys are those of the types.

mod explain;
mod keys;
mod list;
mod notes;

pub use agglo_core::pages::{Fragment, Page, Scope};
pub use explain::{Unknown, explain};
pub use keys::{File, keys, table};
pub use list::{chapters, markdown};

/// Pages of what this crate has, beside those of the laws.
const OWN: [Page; 14] = [
    Page::new("growth", "run/hard", &["growth_deficit"], include_str!("../run/hard/growth.rs")),
    Page::new("cma_es", "search/optimizer", &[], include_str!("../search/optimizer/cma_es.rs")),
    Page::new("genetic", "search/optimizer", &[], include_str!("../search/optimizer/genetic.rs")),
    Page::new(
        "published_genetic",
        "search/optimizer",
        &[],
        include_str!("../search/optimizer/published_genetic.rs"),
    ),
    Page::new(
        "nelder_mead",
        "search/optimizer",
        &["polish"],
        include_str!("../search/optimizer/nelder_mead.rs"),
    ),
    Page::new("random", "search/optimizer", &[], include_str!("../search/optimizer/random.rs")),
    Page::new("sobol", "search/optimizer", &[], include_str!("../search/optimizer/sobol.rs")),
    Page::new("external", "search/optimizer", &[], include_str!("../search/optimizer/external.rs")),
    Page::new("grid", "search/plan", &[], include_str!("../search/plan/grid.rs")),
    Page::new("list", "search/plan", &[], include_str!("../search/plan/list.rs")),
    Page::new("refinement", "search/plan", &[], include_str!("../search/plan/refinement.rs")),
    Page::new("morris", "search/plan", &[], include_str!("../search/plan/morris.rs")),
    Page::new("sobol_indices", "search/plan", &[], include_str!("../search/plan/sobol_indices.rs")),
    Page::new(
        "ensemble",
        "search",
        &["fixed", "running_mean", "confidence"],
        include_str!("../search/ensemble.rs"),
    ),
];

/// All pages: those of the laws in the order of the code, then those of this crate.
pub fn all() -> impl Iterator<Item = &'static Page> {
    agglo_core::catalog::pages().chain(&OWN)
}

/// The page of a word; dashes count as underscores, capitals as small letters.
pub fn page(word: &str) -> Option<&'static Page> {
    all().find(|page| page.has(word))
}
