//! Simulations, step by step.

use std::sync::{Mutex, MutexGuard, TryLockError};
use std::time::Duration;

use agglo::Error;
use agglo::acoustics::PulseCount;
use agglo::engine::{Measures, SimError, Simulation as Engine, hard, soft};
use agglo::ledger::Balance;
use agglo::math::Vec3;
use agglo::particles::ById;
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};

use crate::arrays;
use crate::error::{InputError, raised};
use crate::hook::{Callback, Fallen, refuse_within_a_force};
use crate::scenario::Scenario;
use crate::work::{Signals, here, interruptible};

/// How soon it is looked again whether another thread is done with a simulation.
const LOOK_AGAIN: Duration = Duration::from_millis(2);

/// Either engine.
enum Kind {
    Soft(Box<soft::Simulation>),
    Hard(Box<hard::Simulation>),
}

/// Does the same with whichever engine there is.
macro_rules! each {
    ($kind:expr, $simulation:ident => $call:expr) => {
        match $kind {
            Kind::Soft($simulation) => $call,
            Kind::Hard($simulation) => $call,
        }
    };
}

/// A simulation at some moment of its time.
#[pyclass(module = "agglo", frozen)]
pub(crate) struct Simulation {
    scenario: Scenario,
    kind: Mutex<Kind>,
    fallen: Fallen,
}

impl Simulation {
    fn of(scenario: Scenario, kind: Kind) -> Self {
        Self { scenario, kind: Mutex::new(kind), fallen: Fallen::default() }
    }

    /// The engine; another thread of Python that steps it is waited for without the interpreter's lock, and until Ctrl-C.
    ///
    /// It is taken here and never on the pool, whose threads take up one another's work while they wait: one that steps would come
    /// to wait for itself.
    fn lock<'a>(&'a self, py: Python<'_>) -> PyResult<MutexGuard<'a, Kind>> {
        refuse_within_a_force()?;
        loop {
            match self.kind.try_lock() {
                Ok(kind) => return Ok(kind),
                Err(TryLockError::Poisoned(kind)) => return Ok(kind.into_inner()),
                Err(TryLockError::WouldBlock) => {
                    py.check_signals()?;
                    py.detach(|| std::thread::sleep(LOOK_AGAIN));
                }
            }
        }
    }
}

#[pymethods]
impl Simulation {
    /// Places the grains of a scenario, or takes them out of the run that it names.
    #[new]
    fn new(py: Python<'_>, scenario: &Scenario) -> PyResult<Self> {
        let read = &scenario.read;
        let made = interruptible(py, |stop| {
            let start = scenario.start(stop)?;
            Ok::<Kind, Error>(if read.is_hard() {
                Kind::Hard(Box::new(hard::Simulation::start(read, start)?))
            } else {
                Kind::Soft(Box::new(soft::Simulation::start(read, start)?))
            })
        })?;
        Ok(Self::of(scenario.clone(), made.map_err(|error| raised(py, error))?))
    }

    /// Goes on from what `save` gave under the same scenario, with the same bits.
    #[staticmethod]
    fn restore(py: Python<'_>, scenario: &Scenario, state: &[u8]) -> PyResult<Self> {
        let read = &scenario.read;
        let broken = |error| InputError::new_err(format!("this is no state of a simulation: {error}"));
        let kind = if read.is_hard() {
            let state = postcard::from_bytes(state).map_err(broken)?;
            hard::Simulation::resume(read, state).map(|simulation| Kind::Hard(Box::new(simulation)))
        } else {
            let state = postcard::from_bytes(state).map_err(broken)?;
            soft::Simulation::resume(read, state).map(|simulation| Kind::Soft(Box::new(simulation)))
        };
        Ok(Self::of(scenario.clone(), kind.map_err(|error| raised(py, error))?))
    }

    /// All that is needed to go on with the same bits: see `restore`.
    fn save<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let kind = self.lock(py)?;
        let bytes = each!(&*kind, simulation => postcard::to_stdvec(&simulation.save()));
        let bytes = bytes.map_err(|error| InputError::new_err(error.to_string()))?;
        Ok(PyBytes::new(py, &bytes))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        let (py, own) = (slf.py(), slf.get());
        let arguments = (own.scenario.clone(), own.save(py)?);
        Ok((slf.get_type().getattr("restore")?, arguments).into_pyobject(py)?.into_any())
    }

    /// What it follows from.
    #[getter]
    fn scenario(&self) -> Scenario {
        self.scenario.clone()
    }

    /// Simulated time [s].
    #[getter]
    fn time_s(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(each!(&*self.lock(py)?, simulation => Engine::time(simulation.as_ref())))
    }

    /// Simulated time at the end [s].
    #[getter]
    fn end_s(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(each!(&*self.lock(py)?, simulation => Engine::end(simulation.as_ref())))
    }

    /// Steps so far, or events.
    #[getter]
    fn steps(&self, py: Python<'_>) -> PyResult<u64> {
        Ok(each!(&*self.lock(py)?, simulation => Engine::steps(simulation.as_ref())))
    }

    /// Whether the end is reached.
    #[getter]
    fn is_finished(&self, py: Python<'_>) -> PyResult<bool> {
        Ok(each!(&*self.lock(py)?, simulation => Engine::is_finished(simulation.as_ref())))
    }

    /// Goes on for a little while: one step, or some thousand events of hard spheres.
    fn step(&self, py: Python<'_>) -> PyResult<()> {
        let mut held = self.lock(py)?;
        let kind = &mut *held;
        let outcome = here(py, || {
            each!(kind, simulation => {
                if Engine::is_finished(simulation.as_ref()) { Ok(()) } else { Engine::step(simulation.as_mut()) }
            })
        })?;
        self.fallen.raise(py)?;
        outcome.map_err(|error| raised(py, error))
    }

    /// Goes on until a time [s], or to the end if that is sooner. Where time goes in steps, the last one may lead past it.
    fn run_until(&self, py: Python<'_>, time_s: f64) -> PyResult<()> {
        if time_s.is_nan() {
            return Err(InputError::new_err("time_s is not a number"));
        }
        let mut held = self.lock(py)?;
        let kind = &mut *held;
        let outcome = here(py, || {
            let mut signals = Signals::new();
            each!(kind, simulation => {
                let simulation = simulation.as_mut();
                while Engine::time(simulation) < time_s
                    && !Engine::is_finished(simulation)
                    && !self.fallen.is_there()
                {
                    if let Err(signal) = signals.ask() {
                        self.fallen.keep(signal);
                        break;
                    }
                    Engine::advance(simulation, time_s)?;
                }
            });
            Ok::<(), SimError>(())
        })?;
        self.fallen.raise(py)?;
        outcome.map_err(|error| raised(py, error))
    }

    /// Columns of the grains by their names with units, as copies in the order of their ids.
    fn grains<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        match &*self.lock(py)? {
            Kind::Soft(simulation) => arrays::columns(py, &simulation.system.grains),
            Kind::Hard(simulation) => {
                let snapshot = simulation.snapshot();
                let columns = arrays::columns(py, &snapshot.grains)?;
                columns.set_item("primaries", arrays::integers(py, snapshot.primaries))?;
                Ok(columns)
            }
        }
    }

    /// What the grains come to together.
    fn measures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let Measures { grains, mass, momentum, kinetic_energy, unexplained } =
            each!(&*self.lock(py)?, simulation => Engine::measures(simulation.as_ref()));
        let table = PyDict::new(py);
        table.set_item("grains", grains)?;
        table.set_item("mass_kg", mass)?;
        table.set_item("momentum_kg_m_s", arrays::scalars(py, momentum.to_array().to_vec()))?;
        table.set_item("kinetic_energy_J", kinetic_energy)?;
        table.set_item("unexplained", unexplained)?;
        Ok(table)
    }

    /// The ledger: stored energies, what came in and what was lost, by the names of the tables.
    fn balance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let balance: Balance = each!(&*self.lock(py)?, simulation => simulation.balance());
        let table = PyDict::new(py);
        for entry in balance.entries.all() {
            table.set_item(entry.name, (entry.of)(&balance))?;
        }
        Ok(table)
    }

    /// Warnings so far, and how often each came up.
    fn warnings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let table = PyDict::new(py);
        let kind = self.lock(py)?;
        let warnings = match &*kind {
            Kind::Soft(simulation) => &simulation.warnings,
            Kind::Hard(simulation) => &simulation.system().state.warnings,
        };
        for (text, count) in warnings.counts() {
            table.set_item(text, count)?;
        }
        Ok(table)
    }

    /// Bonds [n, 2] of soft spheres: the ids of the grains that each holds together.
    fn bonds<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let kind = self.lock(py)?;
        let simulation = soft_alone(&kind, "bonds")?;
        let ids: Vec<u32> = simulation.system.network.bonds().iter().flat_map(|bond| bond.ids).collect();
        let count = ids.len() / 2;
        arrays::integers(py, ids).call_method1("reshape", ((count, 2),))
    }

    /// Pulses of sound so far: rays, reflections, powers.
    fn pulses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let kind = self.lock(py)?;
        let list = PyList::empty(py);
        for pulse in soft_alone(&kind, "pulses")?.pulses.flight().pulses() {
            let one = in_dict(py, pulse)?;
            list.append(one)?;
        }
        Ok(list)
    }

    /// Launches a pulse of a beam of the scenario now, beside those that it has; soft spheres alone have beams.
    #[pyo3(signature = (beam=0))]
    fn pulse(&self, py: Python<'_>, beam: u32) -> PyResult<()> {
        let mut kind = self.lock(py)?;
        let Kind::Soft(simulation) = &mut *kind else { return Err(for_soft("pulse")) };
        simulation.pulse(beam).map_err(|error| InputError::new_err(error.to_string()))
    }

    /// Gives soft spheres impulses [N s] at their centers, at once: ids [n], impulses [n, 3]. The ledger has their work.
    #[expect(non_snake_case, reason = "units keep their letters")]
    fn kick(
        &self,
        py: Python<'_>,
        ids: PyReadonlyArray1<'_, u32>,
        impulses_N_s: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<()> {
        let (ids, impulses) = (ids.as_array(), impulses_N_s.as_array());
        if impulses.shape() != [ids.len(), 3] {
            let message =
                format!("impulses have the shape {:?}; [{}, 3] is wanted", impulses.shape(), ids.len());
            return Err(InputError::new_err(message));
        }
        if !impulses.iter().all(|value| value.is_finite()) {
            return Err(InputError::new_err("impulses are not all finite"));
        }
        let mut kind = self.lock(py)?;
        let Kind::Soft(simulation) = &mut *kind else { return Err(for_soft("kick")) };
        let all = ById::of(&simulation.system.grains.id);
        let place =
            |id: &u32| all.find(*id).ok_or_else(|| InputError::new_err(format!("there is no grain {id}")));
        let places = ids.iter().map(place).collect::<PyResult<Vec<usize>>>()?;
        for (place, impulse) in places.into_iter().zip(impulses.rows()) {
            simulation.kick(place, Vec3::new(impulse[0], impulse[1], impulse[2]));
        }
        Ok(())
    }

    /// Lets a force of one's own act on soft spheres from now on.
    #[pyo3(signature = (force, stiffness_over_mass=None, damping_over_mass=None))]
    fn attach(
        &self,
        py: Python<'_>,
        force: Bound<'_, PyAny>,
        stiffness_over_mass: Option<f64>,
        damping_over_mass: Option<f64>,
    ) -> PyResult<()> {
        if !force.is_callable() {
            return Err(PyTypeError::new_err("the force must be callable"));
        }
        let callback = Callback::new(&force, stiffness_over_mass, damping_over_mass, self.fallen.clone())?;
        let mut held = self.lock(py)?;
        let Kind::Soft(simulation) = &mut *held else { return Err(for_soft("attach")) };
        // It is asked at once, and takes the interpreter's lock itself.
        here(py, || simulation.attach(Box::new(callback)))?;
        self.fallen.raise(py)
    }

    /// What a notebook shows.
    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("agglo._html")?.getattr("simulation")?.call1((slf,))
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let (time, end, steps) = (self.time_s(py)?, self.end_s(py)?, self.steps(py)?);
        Ok(format!(
            "<agglo.Simulation {:?}, t = {time} s of {end} s, {steps} steps>",
            self.scenario.read.title
        ))
    }
}

/// Counts and powers of a pulse.
pub(crate) fn in_dict<'py>(py: Python<'py>, pulse: &PulseCount) -> PyResult<Bound<'py, PyDict>> {
    let one = PyDict::new(py);
    one.set_item("beam", pulse.beam)?;
    one.set_item("number", pulse.number)?;
    one.set_item("start_s", pulse.start_s)?;
    one.set_item("rays", pulse.rays)?;
    one.set_item("in_flight", pulse.in_flight)?;
    one.set_item("reflections", pulse.reflections)?;
    one.set_item("segments", pulse.segments)?;
    one.set_item("power_in_W", pulse.power_in)?;
    one.set_item("power_absorbed_W", pulse.power_absorbed)?;
    one.set_item("reflections_at_walls", pulse.reflections_at_walls)?;
    one.set_item("power_into_walls_W", pulse.power_into_walls)?;
    one.set_item("power_escaped_W", pulse.power_escaped)?;
    one.set_item("power_cut_off_W", pulse.power_cut_off)?;
    Ok(one)
}

fn for_soft(what: &str) -> PyErr {
    InputError::new_err(format!("{what} is for soft spheres; this simulation is one of hard spheres"))
}

fn soft_alone<'a>(kind: &'a Kind, what: &str) -> PyResult<&'a soft::Simulation> {
    match kind {
        Kind::Soft(simulation) => Ok(simulation),
        Kind::Hard(_) => Err(for_soft(what)),
    }
}
