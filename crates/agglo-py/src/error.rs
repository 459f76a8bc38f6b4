//! Errors of the library as exceptions of Python.

use agglo::Error;
use agglo::scenario::{Faults, LoadError};
use agglo::search::campaign::CampaignError;
use pyo3::prelude::*;

use crate::json::to_python;

mod exceptions {
    #![allow(missing_docs, reason = "the exceptions are documented where they are defined, in Python")]

    pyo3::import_exception!(agglo._errors, ScenarioError);
    pyo3::import_exception!(agglo._errors, InputError);
    pyo3::import_exception!(agglo._errors, RunError);
}

pub(crate) use exceptions::{InputError, RunError, ScenarioError};

/// The exception of an error: the faults of a text, an input that has to change, or something that failed on the way.
pub(crate) fn raised(py: Python<'_>, error: impl Into<Error>) -> PyErr {
    match error.into() {
        Error::Faults(faults) => of_faults(py, &faults, "scenario"),
        Error::Load(LoadError::Faulty { path, faults, .. }) => of_faults(py, &faults, &path),
        Error::Campaign(CampaignError::Faulty(faults)) => of_faults(py, &faults, "campaign"),
        error if error.exit_code() == 2 => InputError::new_err(error.to_string()),
        error => RunError::new_err(error.to_string()),
    }
}

/// All faults of a text at once; `name` is what it is called.
pub(crate) fn of_faults(py: Python<'_>, faults: &Faults, name: &str) -> PyErr {
    let list: Vec<_> = faults.iter().collect();
    match to_python(py, &list) {
        Ok(list) => ScenarioError::new_err((format!("{name}:\n{faults}"), list.unbind())),
        Err(error) => error,
    }
}
