//! Searches and studies: what they vary, and what a point of theirs stands for.

use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use agglo::scenario::template;
use agglo::search::campaign::way_of;
use agglo::search::optimizer::{External, Method};
use agglo::search::{Campaign as Read, Candidate, Model, Problem, Scale};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::error::{InputError, raised};
use crate::json::to_python;
use crate::scenario::{Scenario, folder, folder_of, lines, text_of};

/// A checked search or study. It does not change: `replace` makes another one.
#[pyclass(module = "agglo", frozen, eq, from_py_object)]
#[derive(Clone)]
pub(crate) struct Campaign {
    pub read: Read,
    /// The folder that its files are relative to.
    pub base: PathBuf,
    /// What it evaluates, drawn up when that is asked for first: its base is read for it.
    problem: Arc<OnceLock<Problem>>,
}

impl PartialEq for Campaign {
    fn eq(&self, other: &Self) -> bool {
        self.read == other.read && self.base == other.base
    }
}

impl Campaign {
    fn of(read: Read, base: PathBuf) -> Self {
        Self { read, base, problem: Arc::default() }
    }

    fn problem(&self, py: Python<'_>) -> PyResult<&Problem> {
        if let Some(problem) = self.problem.get() {
            return Ok(problem);
        }
        let problem = Problem::new(&self.read, &self.base).map_err(|faults| raised(py, faults))?;
        Ok(self.problem.get_or_init(|| problem))
    }

    fn candidate(problem: &Problem, point: &[f64]) -> PyResult<Candidate> {
        if point.len() != problem.axes().len() {
            let (found, wanted) = (point.len(), problem.axes().len());
            return Err(InputError::new_err(format!(
                "the point has {found} numbers; {wanted} are wanted, one for each parameter"
            )));
        }
        if let Some(part) = point.iter().find(|part| !(0.0..=1.0).contains(*part)) {
            return Err(InputError::new_err(format!("{part} is not a part of a range, from 0 to 1")));
        }
        Ok(problem.candidate(point))
    }
}

#[pymethods]
impl Campaign {
    /// Reads a text in TOML. `settings` are other values of its keys, as a dict or a list of `key.path=value`; `base` is the folder that
    /// its files are relative to.
    #[new]
    #[pyo3(signature = (text, settings=None, base=PathBuf::new()))]
    fn new(py: Python<'_>, text: &str, settings: Option<Bound<'_, PyAny>>, base: PathBuf) -> PyResult<Self> {
        let (settings, base) = (lines(py, settings)?, folder(base));
        let read = Read::from_source(text, &base, &settings);
        let read = read.map_err(|faults| crate::error::of_faults(py, &faults, "campaign"))?;
        Ok(Self::of(read, base))
    }

    /// Reads a file.
    #[staticmethod]
    #[pyo3(signature = (path, settings=None))]
    fn from_file(py: Python<'_>, path: PathBuf, settings: Option<Bound<'_, PyAny>>) -> PyResult<Self> {
        let settings = lines(py, settings)?;
        let read = Read::load_with_overrides(&path, &settings).map_err(|error| raised(py, error))?;
        Ok(Self::of(read, folder_of(&path)?))
    }

    /// Takes the tables of a search or study as dicts. Quantities are text with units, or quantities of pint.
    #[staticmethod]
    #[pyo3(signature = (tables, base=PathBuf::new()))]
    fn from_dict(py: Python<'_>, tables: &Bound<'_, PyAny>, base: PathBuf) -> PyResult<Self> {
        Self::new(py, &text_of(tables, "a search or study")?, None, base)
    }

    /// The shipped search or study of this name.
    #[staticmethod]
    #[pyo3(signature = (name, settings=None))]
    fn template(py: Python<'_>, name: &str, settings: Option<Bound<'_, PyAny>>) -> PyResult<Self> {
        let found = template(name).filter(|found| Read::is_meant_by(found.text)).ok_or_else(|| {
            let all = agglo::scenario::TEMPLATES.iter().filter(|known| Read::is_meant_by(known.text));
            let known: Vec<&str> = all.map(|known| known.name).collect();
            let known = known.join(", ");
            InputError::new_err(format!("there is no search or study \"{name}\"; there are {known}"))
        })?;
        Self::new(py, found.text, settings, PathBuf::new())
    }

    /// The same with other values of keys, as a dict or a list of `key.path=value`.
    fn replace(&self, py: Python<'_>, settings: Bound<'_, PyAny>) -> PyResult<Self> {
        Self::new(py, &self.to_toml(py)?, Some(settings), self.base.clone())
    }

    /// The same search with points that a program outside proposes, so many at the most.
    fn led(&self, py: Python<'_>, evaluations: usize) -> PyResult<Self> {
        if self.is_study() {
            return Err(InputError::new_err("a study tries what its plan says; only a search can be led"));
        }
        let read = Read { method: Some(Method::External(External { evaluations })), ..self.read.clone() };
        let text = read.to_toml().map_err(|faults| raised(py, faults))?;
        Self::new(py, &text, None, self.base.clone())
    }

    /// The file as TOML, with every default written out.
    fn to_toml(&self, py: Python<'_>) -> PyResult<String> {
        self.read.to_toml().map_err(|faults| raised(py, faults))
    }

    /// The file as dicts, with every default written out.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.read)
    }

    /// What it is about.
    #[getter]
    fn title(&self) -> &str {
        &self.read.title
    }

    /// Whether it is a study, which tries what it is told to, and no search.
    #[getter]
    fn is_study(&self) -> bool {
        self.read.plan.is_some()
    }

    /// What proposes its points: "method" or "plan", and its word.
    #[getter]
    fn way(&self) -> (&'static str, String) {
        way_of(&self.read)
    }

    /// The folder that its files are relative to.
    #[getter]
    fn base(&self) -> PathBuf {
        self.base.clone()
    }

    /// What is varied, in the order of a point's numbers: name, unit, scale, lower and upper bound in SI units, choices.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let problem = self.problem(py)?;
        let one = |axis: &agglo::search::Axis| {
            let table = PyDict::new(py);
            table.set_item("name", &axis.name)?;
            table.set_item("unit", &axis.unit)?;
            match &axis.scale {
                Scale::Linear([lower, upper]) => bounds(&table, "linear", *lower, *upper)?,
                Scale::Log([lower, upper]) => bounds(&table, "log", *lower, *upper)?,
                Scale::Whole([lower, upper]) => bounds(&table, "whole", *lower, *upper)?,
                Scale::Choices(choices) => {
                    table.set_item("scale", "choices")?;
                    let labels: Vec<&str> = choices.iter().map(|choice| choice.label.as_str()).collect();
                    table.set_item("choices", labels)?;
                }
            }
            Ok(table)
        };
        problem.axes().iter().map(one).collect()
    }

    /// What is made small or large: formulas, and whether each is to be large.
    #[getter]
    fn objectives(&self, py: Python<'_>) -> PyResult<Vec<(String, bool)>> {
        Ok(self.problem(py)?.objectives().map(|(formula, large)| (formula.to_owned(), large)).collect())
    }

    /// Names of the quantities of a run that it asks for.
    #[getter]
    fn columns(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        Ok(self.problem(py)?.columns().to_vec())
    }

    /// What a point of the unit cube stands for: values by the names of the parameters in SI units, a choice by its label.
    fn values<'py>(&self, py: Python<'py>, point: Vec<f64>) -> PyResult<Bound<'py, PyDict>> {
        let problem = self.problem(py)?;
        let candidate = Self::candidate(problem, &point)?;
        let table = PyDict::new(py);
        for (axis, value) in problem.axes().iter().zip(&candidate.values) {
            if matches!(axis.scale, Scale::Choices(_)) {
                table.set_item(&axis.name, axis.label(*value))?;
            } else {
                table.set_item(&axis.name, value)?;
            }
        }
        Ok(table)
    }

    /// The scenario of a point of the unit cube.
    fn scenario(&self, py: Python<'_>, point: Vec<f64>) -> PyResult<Scenario> {
        let problem = self.problem(py)?;
        let candidate = Self::candidate(problem, &point)?;
        let read = problem.scenario(&candidate).map_err(|faults| raised(py, faults))?;
        Ok(Scenario { read, base: problem.folder().to_owned() })
    }

    fn __repr__(&self) -> String {
        let kind = if self.is_study() { "study" } else { "search" };
        let (way, word) = self.way();
        format!("<agglo.Campaign {:?}, {kind}, {way} {word}>", self.read.title)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, own) = (slf.py(), slf.get());
        let arguments = (own.to_toml(py)?, py.None(), own.base.clone());
        Ok((slf.get_type().into_any(), arguments.into_pyobject(py)?))
    }
}

fn bounds<'py, T: IntoPyObject<'py>>(
    table: &Bound<'py, PyDict>,
    scale: &str,
    lower: T,
    upper: T,
) -> PyResult<()> {
    table.set_item("scale", scale)?;
    table.set_item("lower", lower)?;
    table.set_item("upper", upper)
}
