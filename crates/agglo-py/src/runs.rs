//! The verbs that the terminal has too: run, resume, check, report.

use std::ffi::OsString;
use std::num::NonZeroU32;
use std::path::PathBuf;

use agglo::Error;
use agglo::folder::{CampaignFolder, RunFolder, tables_in};
use agglo::forecast::Plan;
use agglo::record::Sheet;
use agglo::record::frames::{Collection, FieldValues, Frame};
use agglo::run::{Ending, Guests, Progress, RunError};
use agglo::search::campaign;
use agglo::units::{Quantity, Time, parse_quantity};
use agglo_view::report::ReportError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays;
use crate::error::{InputError, RunError as Failed, raised};
use crate::guests::{Functions, Invited};
use crate::json::to_python;
use crate::scenario::Scenario;
use crate::watcher::Watcher;
use crate::work::interruptible;

/// Does what the arguments of the program say; gives its exit code.
#[pyfunction]
pub(crate) fn act_on(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| agglo_cli::act_on(arguments))
}

/// Runs a scenario into a folder, with functions that take part; gives its summary as JSON. `progress` is called about ten times a
/// second.
#[pyfunction]
#[pyo3(signature = (scenario, folder, progress=None, functions=None, domains=None))]
pub(crate) fn run(
    py: Python<'_>,
    scenario: &Scenario,
    folder: PathBuf,
    progress: Option<Py<PyAny>>,
    functions: Option<Functions>,
    domains: Option<NonZeroU32>,
) -> PyResult<String> {
    let watcher = Watcher::new(progress);
    let outcome = invited(py, functions, &watcher)?.take_part(py, |guests, stop| {
        let mut observer = |now: &Progress| watcher.see(of_run, now, stop);
        let guests = Guests { domains, ..guests };
        agglo::run::run_with(&scenario.read, &scenario.base, &folder, guests, &mut observer)
    })?;
    watcher.raise(py)?;
    told(py, outcome)
}

fn invited(py: Python<'_>, functions: Option<Functions>, watcher: &Watcher) -> PyResult<Invited> {
    functions.map_or_else(|| Ok(Invited::default()), |functions| functions.invited(py, &watcher.fallen))
}

/// Goes on with the run in a folder and the functions that take part in it, to another end where one is given ("40 s"); gives its
/// summary as JSON.
#[pyfunction]
#[pyo3(signature = (folder, until=None, progress=None, functions=None, domains=None))]
pub(crate) fn resume(
    py: Python<'_>,
    folder: PathBuf,
    until: Option<&str>,
    progress: Option<Py<PyAny>>,
    functions: Option<Functions>,
    domains: Option<NonZeroU32>,
) -> PyResult<String> {
    let watcher = Watcher::new(progress);
    let end = until.map(|until| parse_quantity(until, Time::DIMENSION)).transpose();
    let end = end.map_err(|error| InputError::new_err(format!("until: {error}")))?;
    let outcome = invited(py, functions, &watcher)?.take_part(py, |guests, stop| {
        let mut observer = |now: &Progress| watcher.see(of_run, now, stop);
        let guests = Guests { domains, ..guests };
        agglo::run::resume_with(&folder, end.map(Quantity), guests, &mut observer)
    })?;
    watcher.raise(py)?;
    told(py, outcome)
}

/// Runs a scenario without writing anything; gives its summary as JSON.
#[pyfunction]
pub(crate) fn run_quietly(py: Python<'_>, scenario: &Scenario) -> PyResult<String> {
    let outcome = interruptible(py, |stop| agglo::run::quiet(&scenario.read, &scenario.base, stop))?;
    told(py, outcome)
}

fn of_run<'py>(py: Python<'py>, now: &Progress) -> PyResult<Bound<'py, PyAny>> {
    let table = PyDict::new(py);
    table.set_item("time_s", now.time)?;
    table.set_item("end_s", now.end)?;
    table.set_item(now.steps_are, now.step)?;
    table.set_item("now", &now.now)?;
    table.set_item("warnings", &now.warnings)?;
    Ok(table.into_any())
}

fn told(py: Python<'_>, outcome: Result<Ending, RunError>) -> PyResult<String> {
    match outcome {
        Ok(Ending::Finished(summary)) => Ok(summary.to_json()),
        Ok(Ending::Interrupted(time)) => Err(Failed::new_err(format!("stopped at t = {time} s"))),
        Err(error) => Err(raised(py, error)),
    }
}

/// What a scenario would ask of the machine, and what to keep in mind of it; the last entry says all of it in words.
#[pyfunction]
pub(crate) fn check<'py>(py: Python<'py>, scenario: &Scenario) -> PyResult<Bound<'py, PyAny>> {
    let plan = interruptible(py, |_| Plan::new(&scenario.read, &scenario.base))?;
    let plan = plan.map_err(|error| raised(py, error))?;
    let table = to_python(py, &plan)?;
    table.set_item("text", plan.to_string())?;
    Ok(table)
}

/// Writes report.html into the folder of a run, search or study; gives its path, and notes on what is missing.
#[pyfunction]
pub(crate) fn report(py: Python<'_>, folder: PathBuf) -> PyResult<(PathBuf, Vec<String>)> {
    let written = interruptible(py, |_| agglo_view::report::write(&folder))?;
    written.map_err(|error| match error {
        ReportError::NothingThere { .. } => InputError::new_err(error.to_string()),
        ReportError::Record(error) => raised(py, Error::from(error)),
    })
}

/// What the run, search or study in a folder came to; None where it has not come to its end.
#[pyfunction]
pub(crate) fn summary(py: Python<'_>, folder: PathBuf) -> PyResult<Option<Bound<'_, PyAny>>> {
    if campaign::is_one(&folder) {
        return campaign::finished(&folder).map(|summary| to_python(py, &summary)).transpose();
    }
    let found = agglo::run::summary(&folder).map_err(|error| raised(py, error))?;
    found.map(|summary| to_python(py, &summary)).transpose()
}

/// Whether a folder holds a run, a search or study, or nothing of ours: "run", "campaign" or None; and the file that says what
/// was asked for.
#[pyfunction]
pub(crate) fn what_is_in(folder: PathBuf) -> Option<(&'static str, PathBuf)> {
    if campaign::is_one(&folder) {
        return Some(("campaign", CampaignFolder::at(&folder).campaign()));
    }
    let scenario = RunFolder::at(&folder).scenario();
    scenario.is_file().then_some(("run", scenario))
}

/// Names and files of the tables in a folder.
#[pyfunction]
pub(crate) fn tables(folder: PathBuf) -> Vec<(String, PathBuf)> {
    tables_in(&folder)
}

/// The columns of a table by their names: numbers where all entries are, with NaN for those that are empty; else words.
#[pyfunction]
pub(crate) fn read_table(py: Python<'_>, path: PathBuf) -> PyResult<Bound<'_, PyDict>> {
    let sheet = Sheet::read(&path)
        .map_err(|reason| Failed::new_err(format!("cannot read {}: {reason}", path.display())))?;
    let table = PyDict::new(py);
    for name in &sheet.names {
        let words = sheet.words(name).unwrap_or_default();
        let number = |word: &&str| if word.is_empty() { Some(f64::NAN) } else { word.parse().ok() };
        match words.iter().map(number).collect() {
            Some(numbers) => table.set_item(name, arrays::scalars(py, numbers))?,
            None => table.set_item(name, words)?,
        }
    }
    Ok(table)
}

/// Times [s] and files of a run's frames of a kind.
#[pyfunction]
pub(crate) fn frames(py: Python<'_>, folder: PathBuf, kind: &str) -> PyResult<Vec<(f64, PathBuf)>> {
    let list = RunFolder::at(&folder).frame_list(kind);
    if !list.exists() {
        return Ok(Vec::new());
    }
    let found = Collection::read(&list).map_err(|error| raised(py, error))?;
    Ok(found.frames().map(|(time, file)| (time, list.with_file_name(file))).collect())
}

/// The columns of a frame: positions of its points and all fields, by their names with units.
#[pyfunction]
pub(crate) fn read_frame(py: Python<'_>, path: PathBuf) -> PyResult<Bound<'_, PyDict>> {
    let frame = Frame::read(&path).map_err(|error| raised(py, error))?;
    let table = PyDict::new(py);
    table.set_item("position_m", arrays::vectors(py, frame.points)?)?;
    for (name, values) in frame.fields {
        match values {
            FieldValues::Integers(values) => table.set_item(name, arrays::integers(py, values))?,
            FieldValues::Scalars(values) => table.set_item(name, arrays::scalars(py, values))?,
            FieldValues::Vectors(values) => table.set_item(name, arrays::vectors(py, values)?)?,
        }
    }
    Ok(table)
}
