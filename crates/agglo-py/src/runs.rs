//! The verbs that the terminal has too: run, resume, check, report.

use std::ffi::OsString;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

use agglo::Error;
use agglo::folder::RunFolder;
use agglo::forecast::Plan;
use agglo::record::frames::{Collection, FieldValues, Frame};
use agglo::run::{Ending, Progress, RunError};
use agglo::units::{Quantity, Time, parse_quantity};
use agglo_view::report::ReportError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays;
use crate::error::{InputError, RunError as Failed, raised};
use crate::hook::Fallen;
use crate::scenario::Scenario;
use crate::work::{interruptible, unless};

/// Does what the arguments of the program say; gives its exit code.
#[pyfunction]
pub(crate) fn act_on(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| agglo_cli::act_on(arguments))
}

/// Runs a scenario into a folder; gives its summary as JSON. `progress` is called about ten times a second.
#[pyfunction]
#[pyo3(signature = (scenario, folder, progress=None))]
pub(crate) fn run(
    py: Python<'_>,
    scenario: &Scenario,
    folder: PathBuf,
    progress: Option<Py<PyAny>>,
) -> PyResult<String> {
    let watcher = Watcher { progress, fallen: Fallen::default() };
    watcher.sit(py, |observer| agglo::run::run(&scenario.read, &scenario.base, &folder, observer))
}

/// Goes on with the run in a folder, to another end where one is given ("40 s"); gives its summary as JSON.
#[pyfunction]
#[pyo3(signature = (folder, until=None, progress=None))]
pub(crate) fn resume(
    py: Python<'_>,
    folder: PathBuf,
    until: Option<&str>,
    progress: Option<Py<PyAny>>,
) -> PyResult<String> {
    let watcher = Watcher { progress, fallen: Fallen::default() };
    let end = until.map(|until| parse_quantity(until, Time::DIMENSION)).transpose();
    let end = end.map_err(|error| InputError::new_err(format!("until: {error}")))?;
    watcher.sit(py, |observer| match end {
        Some(end) => agglo::run::resume_until(&folder, Quantity(end), observer),
        None => agglo::run::resume(&folder, observer),
    })
}

/// Runs a scenario without writing anything; gives its summary as JSON.
#[pyfunction]
pub(crate) fn run_quietly(py: Python<'_>, scenario: &Scenario) -> PyResult<String> {
    let outcome = interruptible(py, |stop| agglo::run::quiet(&scenario.read, &scenario.base, stop))?;
    told(py, outcome)
}

/// Who is told of a run's progress.
struct Watcher {
    progress: Option<Py<PyAny>>,
    fallen: Fallen,
}

impl Watcher {
    fn sit(
        self,
        py: Python<'_>,
        work: impl FnOnce(&mut agglo::run::Observer<'_>) -> Result<Ending, RunError> + Send,
    ) -> PyResult<String> {
        let outcome = interruptible(py, |stop: &AtomicBool| {
            work(&mut |progress: &Progress| {
                self.tell(progress);
                if self.fallen.is_there() { ControlFlow::Break(()) } else { unless(stop) }
            })
        })?;
        self.fallen.raise(py)?;
        told(py, outcome)
    }

    fn tell(&self, told: &Progress) {
        let Some(progress) = &self.progress else { return };
        Python::attach(|py| {
            let called = || {
                let table = PyDict::new(py);
                table.set_item("time_s", told.time)?;
                table.set_item("end_s", told.end)?;
                table.set_item(told.steps_are, told.step)?;
                table.set_item("now", &told.now)?;
                table.set_item("warnings", &told.warnings)?;
                progress.bind(py).call1((table,)).map(drop)
            };
            if let Err(error) = called() {
                self.fallen.keep(error);
            }
        });
    }
}

fn told(py: Python<'_>, outcome: Result<Ending, RunError>) -> PyResult<String> {
    match outcome {
        Ok(Ending::Finished(summary)) => Ok(summary.to_json()),
        Ok(Ending::Interrupted(time)) => Err(Failed::new_err(format!("stopped at t = {time} s"))),
        Err(error) => Err(raised(py, error)),
    }
}

/// What a scenario would ask of the machine, and what to keep in mind of it.
#[pyfunction]
pub(crate) fn check<'py>(py: Python<'py>, scenario: &Scenario) -> PyResult<Bound<'py, PyDict>> {
    let plan = interruptible(py, |_| Plan::new(&scenario.read, &scenario.base))?;
    let plan = plan.map_err(|error| raised(py, error))?;
    let table = PyDict::new(py);
    table.set_item("grains", plan.grains)?;
    table.set_item("rays_per_pulse", plan.rays_per_pulse)?;
    table.set_item("pulses", plan.pulses)?;
    table.set_item("impacts", plan.impacts)?;
    table.set_item("steps", plan.steps)?;
    table.set_item("memory_B", plan.memory)?;
    table.set_item("disk_B", plan.disk)?;
    table.set_item("wall_s", plan.seconds)?;
    table.set_item("quantities", &plan.quantities)?;
    table.set_item("notes", &plan.notes)?;
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
