//! The verbs `report` and `cite`.

use std::io::{self, Write};
use std::path::Path;

use agglo::report::{self, ReportError};
use agglo::scenario::Scenario;

use crate::{Failure, print};

/// Writes the page of what has just finished and says so; a page that cannot be written is a warning, since all
/// results are there.
pub(crate) fn at_the_end(folder: &Path) -> String {
    match report::write(folder) {
        Ok(_) => "; report.html shows it".to_owned(),
        Err(error) => {
            // Nothing is left to do where even this warning cannot be written.
            let _ = writeln!(io::stderr(), "warning: there is no report: {error}");
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
    let file = folder.join("scenario.toml");
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
