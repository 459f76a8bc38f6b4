//! What programs are told in JSON, as values of Python: dicts, lists, numbers, text, None.

use pyo3::prelude::*;
use serde::Serialize;

use crate::error::InputError;

/// A value of the library as Python has it. The keys are those that every other program is told.
pub(crate) fn to_python<'py>(py: Python<'py>, value: &impl Serialize) -> PyResult<Bound<'py, PyAny>> {
    let text = serde_json::to_string(value).map_err(|error| InputError::new_err(error.to_string()))?;
    py.import("json")?.call_method1("loads", (text,))
}
