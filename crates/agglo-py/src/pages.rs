//! What laws say of themselves, templates, schemas and citations.

use std::path::{Path, PathBuf};

use agglo::folder::RunFolder;
use agglo::pages::all;
use agglo::scenario::{Scenario, TEMPLATES};
use agglo_view::report::{Citation, citations};
use pyo3::prelude::*;

use crate::error::{InputError, raised};

/// The page of a law or method, or a key with its unit and default.
#[pyfunction]
pub(crate) fn explain(word: &str) -> PyResult<String> {
    agglo::pages::explain(word).map_err(|unknown| {
        let advice = unknown.nearest.map(|near| format!("; did you mean \"{near}\"?")).unwrap_or_default();
        InputError::new_err(format!("there is no law, method or key \"{word}\"{advice}"))
    })
}

/// Words of all laws, methods and plans, with what each is.
#[pyfunction]
pub(crate) fn laws() -> Vec<(&'static str, &'static str)> {
    all().map(|page| (page.name, page.title())).collect()
}

/// Names of the shipped files, with what each is about.
#[pyfunction]
pub(crate) fn templates() -> Vec<(&'static str, &'static str)> {
    TEMPLATES.iter().map(|template| (template.name, template.title)).collect()
}

/// The JSON schema of scenarios, as text.
#[pyfunction]
pub(crate) fn schema() -> String {
    agglo::scenario::schema().to_string()
}

/// What to cite for the laws of a run: word, title, source.
#[pyfunction]
pub(crate) fn cite(py: Python<'_>, folder: PathBuf) -> PyResult<Vec<(&'static str, String, String)>> {
    let found = of_folder(py, &folder)?;
    Ok(found.into_iter().map(|one| (one.law, one.title.to_owned(), one.source)).collect())
}

/// The same as entries for BibTeX, with those of the program and of the papers whose model is computed.
#[pyfunction]
pub(crate) fn bibtex(py: Python<'_>, folder: PathBuf) -> PyResult<String> {
    Ok(agglo_view::report::bibtex(&of_folder(py, &folder)?))
}

fn of_folder(py: Python<'_>, folder: &Path) -> PyResult<Vec<Citation>> {
    let scenario = Scenario::load(&RunFolder::at(folder).scenario()).map_err(|error| raised(py, error))?;
    Ok(citations(&scenario))
}
