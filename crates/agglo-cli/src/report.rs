//! The verbs `report` and `cite`.

use std::path::{Path, PathBuf};

use agglo::folder::RunFolder;
use agglo::folder::names::REPORT;
use agglo::scenario::Scenario;
use agglo_view::report::{self, ReportError};

use crate::signals::Ear;
use crate::{Failure, print};

/// What became of the page of what has finished.
pub(crate) enum Page {
    /// Nobody wants one.
    Unwanted,
    /// It is there.
    Written(PathBuf),
    /// It was left out, since an end was asked for.
    LeftOut,
    /// It cannot be written; all results are there.
    Failed(String),
}

impl Page {
    /// What is put behind the name of the folder that it is of.
    pub(crate) fn words(&self, folder: &Path) -> String {
        match self {
            Self::Unwanted | Self::Failed(_) => String::new(),
            Self::Written(_) => format!("; {REPORT} shows it"),
            Self::LeftOut => format!("; stopped before its page: {}", advice(folder)),
        }
    }
}

fn advice(folder: &Path) -> String {
    format!("`agglo report {}` writes {REPORT}", folder.display())
}

/// Writes the page of what has just finished.
///
/// Nothing else is left to be saved: a signal ends the program at once, and one that came before leaves the page out.
pub(crate) fn at_the_end(folder: &Path, ear: &Ear) -> Page {
    if ear.is_asked() {
        return Page::LeftOut;
    }
    let (shown, advice) = (folder.display(), advice(folder));
    ear.ends_at_once(format!("stopped while the page was written; all results are in {shown}, and {advice}"));
    match report::write(folder) {
        Ok((page, _)) => Page::Written(page),
        Err(error) => Page::Failed(error.to_string()),
    }
}

/// Writes the page of a folder.
pub(crate) fn report(folder: &Path) -> Result<(), Failure> {
    let (page, notes) = report::write(folder).map_err(|error| refusal(&error))?;
    let lines = notes.iter().map(|note| format!("note: {note}")).chain([page.display().to_string()]);
    print(&lines.collect::<Vec<_>>().join("\n"))
}

/// Prints what to cite for a run's folder, in words or for BibTeX.
pub(crate) fn cite(folder: &Path, is_bibtex: bool) -> Result<(), Failure> {
    let file = RunFolder::at(folder).scenario();
    let scenario = Scenario::load(&file).map_err(|error| Failure::bad_input(format!("error: {error}")))?;
    let laws = report::citations(&scenario);
    if is_bibtex {
        return print(report::bibtex(&laws).trim_end());
    }
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
