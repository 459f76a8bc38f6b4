//! Searches and studies that Python leads, or whose simulations it sends elsewhere.

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use agglo::folder::CampaignFolder;
use agglo::search::campaign::{self, CampaignEnding, CampaignError, CampaignProgress, Means};
use agglo::search::optimizer::{Optimizer, Point};
use agglo::search::{Fitness, Replicate, Runner, Trouble, quantities};
use agglo_view::pictures::campaign_pictures;
use numpy::{PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyCFunction;

use crate::arrays;
use crate::campaign::Campaign;
use crate::error::{InputError, RunError, raised};
use crate::hook::Fallen;
use crate::json::to_python;
use crate::scenario::Scenario;
use crate::watcher::Watcher;
use crate::work::interruptible_apart;

/// How soon it is seen that a simulation is no longer wanted.
const LOOK_EVERY: Duration = Duration::from_millis(50);

/// Sends simulations to where a function of Python sends them.
struct Sender {
    submit: Py<PyAny>,
    /// The name of what gives the quantities there instead of runs.
    function: Option<String>,
    fallen: Fallen,
}

impl fmt::Debug for Sender {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an executor of Python")
    }
}

impl Sender {
    /// What came of a simulation that was sent away: quantities, or why it failed. None where it is no longer wanted.
    fn wait(
        &self,
        replicate: &Replicate<'_>,
        stop: &AtomicBool,
    ) -> PyResult<Option<Result<Vec<f64>, String>>> {
        let Replicate { candidate, seed, folder, columns } = *replicate;
        let text = match candidate.to_toml() {
            Ok(text) => text,
            Err(faults) => return Ok(Some(Err(faults.to_string()))),
        };
        let (send, receive) = channel();
        let future = Python::attach(|py| {
            let future = self.submit.bind(py).call1((text, folder, seed, columns.to_vec()))?;
            // Nobody listens any more where the simulation is no longer wanted.
            let tell = move |_: &Bound<'_, _>, _: Option<&Bound<'_, _>>| send.send(()).is_ok();
            future.call_method1("add_done_callback", (PyCFunction::new_closure(py, None, None, tell)?,))?;
            PyResult::Ok(future.unbind())
        })?;
        while let Err(RecvTimeoutError::Timeout) = receive.recv_timeout(LOOK_EVERY) {
            if stop.load(Ordering::Relaxed) {
                Python::attach(|py| future.bind(py).call_method0("cancel").map(drop))?;
                return Ok(None);
            }
        }
        Python::attach(|py| {
            let given = future.bind(py).call_method0("result")?;
            if let Ok(reason) = given.extract::<String>() {
                return Ok(Some(Err(reason)));
            }
            let found = given.extract::<Vec<f64>>()?;
            if found.len() == columns.len() {
                return Ok(Some(Ok(found)));
            }
            let message =
                format!("a simulation gave {} quantities; {} are wanted", found.len(), columns.len());
            Err(RunError::new_err(message))
        })
    }
}

impl Runner for Sender {
    fn run(&self, replicate: &Replicate<'_>, stop: &AtomicBool) -> Result<Vec<f64>, Trouble> {
        match self.wait(replicate, stop) {
            Ok(Some(outcome)) => outcome.map_err(Trouble::Failed),
            Ok(None) => Err(Trouble::Stopped),
            // What the executor could not do says nothing of the simulation.
            Err(error) => {
                self.fallen.keep(error);
                Err(Trouble::Stopped)
            }
        }
    }

    fn function(&self) -> Option<&str> {
        self.function.as_deref()
    }
}

/// An object of Python that proposes points.
struct Proposer {
    method: Py<PyAny>,
    dimensions: usize,
    objectives: usize,
    fallen: Fallen,
}

impl Proposer {
    fn asked(&self) -> PyResult<Vec<Point>> {
        Python::attach(|py| points(&self.method.bind(py).call_method0("ask")?, self.dimensions))
    }

    /// What is done by Python, or nothing where that raises something: the campaign stops then.
    fn or_fallen<T>(&self, done: PyResult<T>) -> Option<T> {
        done.map_err(|error| self.fallen.keep(error)).ok()
    }
}

impl Optimizer for Proposer {
    fn ask(&mut self) -> Vec<Point> {
        self.or_fallen(self.asked()).unwrap_or_default()
    }

    fn tell(&mut self, fitnesses: &[Fitness]) {
        let told = Python::attach(|py| {
            let fitness = in_arrays(py, fitnesses, self.objectives)?;
            self.method.bind(py).call_method1("tell", (fitness,)).map(drop)
        });
        self.or_fallen(told);
    }

    fn recommended(&self) -> Option<Point> {
        let asked = Python::attach(|py| {
            let method = self.method.bind(py);
            if !method.hasattr("recommended")? {
                return Ok(None);
            }
            let point = method.call_method0("recommended")?;
            if point.is_none() {
                return Ok(None);
            }
            let point: Point = point.extract()?;
            refuse_outside(&point, self.dimensions)?;
            Ok(Some(point))
        });
        self.or_fallen(asked).flatten()
    }

    fn has_failed(&self) -> bool {
        self.fallen.is_there()
    }
}

/// Points of the unit cube from an array [n, parameters]; none from None or an empty one.
fn points(given: &Bound<'_, PyAny>, dimensions: usize) -> PyResult<Vec<Point>> {
    if given.is_none() || given.len().is_ok_and(|len| len == 0) {
        return Ok(Vec::new());
    }
    let py = given.py();
    let given = py.import("numpy")?.call_method1("ascontiguousarray", (given, "float64"))?;
    let array: PyReadonlyArray2<'_, f64> = given.extract().map_err(|_| {
        InputError::new_err(format!(
            "points are an array [n, {dimensions}], with a number for each parameter"
        ))
    })?;
    let rows: Vec<Point> = array.as_array().rows().into_iter().map(|row| row.to_vec()).collect();
    rows.iter().try_for_each(|row| refuse_outside(row, dimensions))?;
    Ok(rows)
}

fn refuse_outside(point: &[f64], dimensions: usize) -> PyResult<()> {
    let found = point.len();
    if found != dimensions {
        return Err(InputError::new_err(format!("a point has {found} numbers; {dimensions} are wanted")));
    }
    match point.iter().find(|part| !(0.0..=1.0).contains(*part)) {
        Some(part) => Err(InputError::new_err(format!("{part} is not a part of a range, from 0 to 1"))),
        None => Ok(()),
    }
}

/// Costs [n, objectives], their standard errors, and violations [n]; costs of failures are not a number.
fn in_arrays<'py>(py: Python<'py>, fitnesses: &[Fitness], objectives: usize) -> PyResult<Bound<'py, PyAny>> {
    let rows = |of: &dyn Fn(&Fitness) -> &[f64]| -> PyResult<Bound<'py, PyArray2<f64>>> {
        let row =
            |fitness| (0..objectives).map(|at| of(fitness).get(at).copied().unwrap_or(f64::NAN)).collect();
        let rows: Vec<Vec<f64>> = fitnesses.iter().map(row).collect();
        Ok(PyArray2::from_vec2(py, &rows)?)
    };
    let costs = rows(&|fitness| &fitness.costs)?;
    let errors = rows(&|fitness| &fitness.standard_errors)?;
    let violations = arrays::scalars(py, fitnesses.iter().map(|fitness| fitness.violation).collect());
    py.import("agglo._fitness")?.getattr("Fitness")?.call1((costs, errors, violations))
}

/// Conducts a search or study into a folder, or goes on with the one there where no campaign is given; gives its summary.
///
/// `at_once` simulations are under way at once; `sender` sends one away and gives its future, with the name of what gives the
/// quantities there if that is no run; `method` proposes the points.
#[pyfunction]
#[pyo3(signature = (campaign, folder, at_once, sender=None, method=None, progress=None))]
pub(crate) fn conduct<'py>(
    py: Python<'py>,
    campaign: Option<&Campaign>,
    folder: PathBuf,
    at_once: usize,
    sender: Option<(Py<PyAny>, Option<String>)>,
    method: Option<Py<PyAny>>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    if at_once == 0 {
        return Err(InputError::new_err("at_once is 0; 1 or more is wanted"));
    }
    let watcher = Watcher::new(progress);
    let proposer =
        method.map(|method| proposer(py, campaign, &folder, method, &watcher.fallen)).transpose()?;
    let sender = sender.map(|(submit, function)| Sender { submit, function, fallen: watcher.fallen.clone() });
    let outcome = interruptible_apart(py, |stop| {
        let means = Means {
            threads: at_once,
            draw: Some(&campaign_pictures),
            runner: sender.map(|sender| Arc::new(sender) as Arc<dyn Runner>),
            proposer: proposer.map(|proposer| Box::new(proposer) as Box<dyn Optimizer>),
        };
        let mut observer = |now: &CampaignProgress| watcher.see(of_campaign, now, stop);
        match campaign {
            Some(campaign) => campaign::run(&campaign.read, &campaign.base, &folder, means, &mut observer),
            None => campaign::resume(&folder, means, &mut observer),
        }
    })?;
    watcher.raise(py)?;
    told(py, outcome)
}

fn told(py: Python<'_>, outcome: Result<CampaignEnding, CampaignError>) -> PyResult<Bound<'_, PyAny>> {
    match outcome {
        Ok(CampaignEnding::Finished(summary)) => to_python(py, &summary),
        Ok(CampaignEnding::Interrupted) => {
            Err(RunError::new_err("stopped; all simulations that ended are kept"))
        }
        Err(error) => Err(raised(py, error)),
    }
}

fn of_campaign<'py>(py: Python<'py>, now: &CampaignProgress) -> PyResult<Bound<'py, PyAny>> {
    let table = to_python(py, now)?;
    table.set_item("warnings", &now.warnings)?;
    Ok(table)
}

/// A proposer for a campaign, or for the one in a folder.
fn proposer(
    py: Python<'_>,
    campaign: Option<&Campaign>,
    folder: &Path,
    method: Py<PyAny>,
    fallen: &Fallen,
) -> PyResult<Proposer> {
    let found;
    let read = if let Some(campaign) = campaign {
        &campaign.read
    } else {
        let file = CampaignFolder::at(folder).campaign();
        found = agglo::search::Campaign::load(&file).map_err(|error| raised(py, error))?;
        &found
    };
    let (dimensions, objectives) = (read.parameters.len(), read.objectives.len().max(1));
    Ok(Proposer { method, dimensions, objectives, fallen: fallen.clone() })
}

/// What a scenario with this seed comes to: quantities of its summary by these names, not a number where it has none; or, in
/// words, why it failed. It runs on the calling thread alone, as each simulation of a search does.
#[pyfunction]
pub(crate) fn replicate<'py>(
    py: Python<'py>,
    scenario: &Scenario,
    seed: u64,
    columns: Vec<String>,
) -> PyResult<Bound<'py, PyAny>> {
    let never = AtomicBool::new(false);
    let run = || {
        let alone = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
        let found = quantities(&scenario.read, seed, &scenario.base, &columns, &never);
        drop(alone);
        found
    };
    let found = py.detach(|| std::thread::scope(|scope| scope.spawn(run).join()));
    match found {
        Ok(Ok(found)) => Ok(found.into_pyobject(py)?.into_any()),
        Ok(Err(Trouble::Failed(reason))) => Ok(reason.into_pyobject(py)?.into_any()),
        Ok(Err(Trouble::Stopped)) | Err(_) => Err(RunError::new_err("the simulation broke off")),
    }
}

/// How many simulations a search has under way at once if nothing else is said: as many as there are processors.
#[pyfunction]
pub(crate) fn processors() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// The folder of the run of a search's best.
#[pyfunction]
pub(crate) fn best_run(folder: PathBuf) -> PathBuf {
    CampaignFolder::at(&folder).best()
}
