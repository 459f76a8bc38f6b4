//! Scenarios.

use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use agglo::engine::Start;
use agglo::packing::StartError;
use agglo::scenario::{Scenario as Read, template};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use serde_json::Value as Json;

use crate::error::{InputError, raised};
use crate::json::to_python;
use crate::work::unless;

/// A checked scenario. It does not change: `replace` makes another one.
#[pyclass(module = "agglo", frozen, eq, from_py_object)]
#[derive(Clone, PartialEq)]
pub(crate) struct Scenario {
    pub read: Read,
    /// The folder that its files are relative to.
    pub base: PathBuf,
}

impl Scenario {
    /// The grains before the clock starts, placed or taken out of the run that it names.
    pub(crate) fn start(&self, stop: &AtomicBool) -> Result<Start, StartError> {
        agglo::run::start(&self.read, &self.base, &mut || unless(stop))
    }
}

/// A function that turns values of Python into values of a scenario.
fn helper<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("agglo._settings")?.getattr(name)
}

/// Settings as `key.path=value`.
pub(crate) fn lines(py: Python<'_>, settings: Option<Bound<'_, PyAny>>) -> PyResult<Vec<String>> {
    settings.map_or_else(|| Ok(Vec::new()), |settings| helper(py, "lines")?.call1((settings,))?.extract())
}

/// A folder as Python has it, which writes no path as ".".
pub(crate) fn folder(given: PathBuf) -> PathBuf {
    if given == Path::new(".") { PathBuf::new() } else { given }
}

/// The folder of a file, wherever one is later.
pub(crate) fn folder_of(file: &Path) -> PyResult<PathBuf> {
    Ok(std::path::absolute(file.parent().unwrap_or(Path::new("")).join("."))?)
}

/// Tables in dicts as TOML; `what` they are of is for messages.
pub(crate) fn text_of(tables: &Bound<'_, PyAny>, what: &str) -> PyResult<String> {
    let json: String = helper(tables.py(), "tables")?.call1((tables,))?.extract()?;
    let bad = |error: &dyn std::fmt::Display| InputError::new_err(format!("no tables of {what}: {error}"));
    let tables: Json = serde_json::from_str(&json).map_err(|error| bad(&error))?;
    toml::to_string(&tables).map_err(|error| bad(&error))
}

#[pymethods]
impl Scenario {
    /// Reads a text in TOML. `settings` are other values of its keys, as a dict or a list of `key.path=value`; `base` is the folder that
    /// its files are relative to.
    #[new]
    #[pyo3(signature = (text, settings=None, base=PathBuf::new()))]
    fn new(py: Python<'_>, text: &str, settings: Option<Bound<'_, PyAny>>, base: PathBuf) -> PyResult<Self> {
        let settings = lines(py, settings)?;
        let base = folder(base);
        let read = Read::from_source(text, &base, &settings).map_err(|faults| raised(py, faults))?;
        Ok(Self { read, base })
    }

    /// Reads a file.
    #[staticmethod]
    #[pyo3(signature = (path, settings=None))]
    fn from_file(py: Python<'_>, path: PathBuf, settings: Option<Bound<'_, PyAny>>) -> PyResult<Self> {
        let settings = lines(py, settings)?;
        let read = Read::load_with_overrides(&path, &settings).map_err(|error| raised(py, error))?;
        Ok(Self { read, base: folder_of(&path)? })
    }

    /// Takes the tables of a scenario as dicts. Quantities are text with units, or quantities of pint.
    #[staticmethod]
    #[pyo3(signature = (tables, base=PathBuf::new()))]
    fn from_dict(py: Python<'_>, tables: &Bound<'_, PyAny>, base: PathBuf) -> PyResult<Self> {
        Self::new(py, &text_of(tables, "a scenario")?, None, base)
    }

    /// The shipped scenario of this name.
    #[staticmethod]
    #[pyo3(signature = (name, settings=None))]
    fn template(py: Python<'_>, name: &str, settings: Option<Bound<'_, PyAny>>) -> PyResult<Self> {
        let found = template(name).ok_or_else(|| {
            let known: Vec<&str> = agglo::scenario::scenario_templates().map(|known| known.name).collect();
            InputError::new_err(format!("there is no template \"{name}\"; there are {}", known.join(", ")))
        })?;
        Self::new(py, found.text, settings, PathBuf::new())
    }

    /// The same with other values of keys, as a dict or a list of `key.path=value`.
    fn replace(&self, py: Python<'_>, settings: Bound<'_, PyAny>) -> PyResult<Self> {
        Self::new(py, &self.to_toml(py)?, Some(settings), self.base.clone())
    }

    /// The same with another seed.
    fn seeded(&self, py: Python<'_>, seed: u64) -> PyResult<Self> {
        let read = Read { seed, ..self.read.clone() };
        read.check().map_err(|faults| raised(py, faults))?;
        Ok(Self { read, base: self.base.clone() })
    }

    /// The scenario as TOML, with every default written out.
    fn to_toml(&self, py: Python<'_>) -> PyResult<String> {
        self.read.to_toml().map_err(|faults| raised(py, faults))
    }

    /// The scenario as dicts, with every default written out.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.read)
    }

    /// What it is about.
    #[getter]
    fn title(&self) -> &str {
        &self.read.title
    }

    /// Whether its grains are hard spheres.
    #[getter]
    fn is_hard(&self) -> bool {
        self.read.is_hard()
    }

    /// Simulated time at the end [s].
    #[getter]
    fn end_s(&self) -> f64 {
        self.read.time.end.si()
    }

    /// The folder that its files are relative to.
    #[getter]
    fn base(&self) -> PathBuf {
        self.base.clone()
    }

    /// What a notebook shows.
    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("agglo._html")?.getattr("scenario")?.call1((slf,))
    }

    fn __repr__(&self) -> String {
        let kind = if self.read.is_hard() { "hard" } else { "soft" };
        format!("<agglo.Scenario {:?}, {kind} spheres, {} s>", self.read.title, self.read.time.end.si())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, own) = (slf.py(), slf.get());
        let arguments = (own.to_toml(py)?, py.None(), own.base.clone());
        Ok((slf.get_type().into_any(), arguments.into_pyobject(py)?))
    }
}
