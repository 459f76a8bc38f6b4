//! Who is told how far work is: a function of Python, which may stop it.

use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;

use pyo3::prelude::*;

use crate::hook::Fallen;
use crate::work::unless;

/// Tells a function of Python how far work is; what that raises stops it.
pub(crate) struct Watcher {
    progress: Option<Py<PyAny>>,
    pub fallen: Fallen,
}

impl Watcher {
    pub(crate) fn new(progress: Option<Py<PyAny>>) -> Self {
        Self { progress, fallen: Fallen::default() }
    }

    /// Tells what is known now, as `in_python` says it, and whether to go on.
    pub(crate) fn see<T>(
        &self,
        in_python: impl for<'py> Fn(Python<'py>, &T) -> PyResult<Bound<'py, PyAny>>,
        now: &T,
        stop: &AtomicBool,
    ) -> ControlFlow<()> {
        if let Some(progress) = &self.progress {
            let told = Python::attach(|py| progress.bind(py).call1((in_python(py, now)?,)).map(drop));
            if let Err(error) = told {
                self.fallen.keep(error);
            }
        }
        if self.fallen.is_there() { ControlFlow::Break(()) } else { unless(stop) }
    }

    /// Raises what stopped it, if something of Python did.
    pub(crate) fn raise(&self, py: Python<'_>) -> PyResult<()> {
        self.fallen.raise(py)
    }
}
