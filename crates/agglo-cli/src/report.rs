//! The verbs `report` and `cite`.

use std::path::Path;

use agglo::folder::RunFolder;
use agglo::folder::names::REPORT;
use agglo::scenario::Scenario;
use agglo_view::report::{self, ReportError};

use crate::signals::Ear;
use crate::{Failure, print, tell};

/// Writes the page of what has just finished and says so; a page that cannot be written is a warning, since all
/// results are there.
///
/// Nothing else is left to be saved: a signal ends the program at once, and one that came before leaves the page out.
pub(crate) fn at_the_end(folder: &Path, ear: &Ear) -> String {
    let shown = folder.display();
    let advice = format!("`agglo report {shown}` writes {REPORT}");
    if ear.is_asked() {
        return format!("; stopped before its page: {advice}");
    }
    ear.ends_at_once(format!("stopped while the page was written; all results are in {shown}, and {advice}"));
    match report::write(folder) {
        Ok(_) => format!("; {REPORT} shows it"),
        Err(error) => {
            tell(&format!("warning: there is no report: {error}"));
            String::new()
        }
    }
}

/// Writes the page of a folder.
pub(crate) fn report(folder: &Path) -> Result<(), Failure> {
    let (page, notes) = report::write(folder).map_err(|error| refusal(&error))?;
    let lines = notes.iter().map(|note| format!("note: {note}")).chain([page.display().to_string()]);
    print(&lines.collect::<Vec<_>>().join("\n"))
}

/// Prints what to cite for a run's folder.
pub(crate) fn cite(folder: &Path) -> Result<(), Failure> {
    let file = RunFolder::at(folder).scenario();
    let scenario = Scenario::load(&file).map_err(|error| Failure::bad_input(format!("error: {error}")))?;
    let laws = report::citations(&scenario);
    let lines =
        laws.iter().map(|citation| format!("{}: {}\n  {}", citation.law, citation.title, citation.source));
    print(&format!("{}\n\n{}", report::program(), lines.collect::<Vec<_>>().join("\n")))
}

fn refusal(error: &ReportError) -> Failure {
    match error {
        ReportError::NothingThere { .. } => Failure::bad_input(format!("error: {error}")),
        ReportError::Record(_) => Failure::failed(format!("error: {error}")),
    }
}
