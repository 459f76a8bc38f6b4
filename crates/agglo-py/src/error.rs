//! Errors of the library as exceptions of Python.

use agglo::Error;
use agglo::scenario::{Faults, LoadError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

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
        error if error.exit_code() == 2 => InputError::new_err(error.to_string()),
        error => RunError::new_err(error.to_string()),
    }
}

/// All faults of a text at once; `name` is what it is called.
fn of_faults(py: Python<'_>, faults: &Faults, name: &str) -> PyErr {
    let made = || {
        let list = PyList::empty(py);
        for fault in faults {
            let one = PyDict::new(py);
            one.set_item("key", &fault.key)?;
            one.set_item("message", &fault.message)?;
            one.set_item("help", fault.help.as_deref())?;
            one.set_item("line", fault.line)?;
            one.set_item("column", fault.column)?;
            one.set_item("setting", fault.setting.as_deref())?;
            list.append(one)?;
        }
        Ok(ScenarioError::new_err((format!("{name}:\n{faults}"), list.unbind())))
    };
    made().unwrap_or_else(|error: PyErr| error)
}
