//! What functions of Python do in a run that writes a folder: a force, measures, and when to stop.

use std::sync::atomic::AtomicBool;

use agglo::engine::soft::Hook;
use agglo::run::{Guests, Look, Onlooker, Sight};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays;
use crate::error::InputError;
use crate::hook::{Callback, Fallen};
use crate::work::{interruptible, interruptible_apart};

/// Functions of Python that take part in a run, as they are handed over.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Functions {
    force: Option<Py<PyAny>>,
    stiffness_over_mass: Option<f64>,
    damping_over_mass: Option<f64>,
    measures: Vec<(String, Py<PyAny>)>,
    stop: Option<Py<PyAny>>,
}

impl Functions {
    /// Those that take part; what they raise is kept in `fallen`.
    pub(crate) fn invited(self, py: Python<'_>, fallen: &Fallen) -> PyResult<Invited> {
        let measures = self.measures.iter().map(|(name, function)| (format!("the measure {name}"), function));
        let others = [("the force", &self.force), ("stop", &self.stop)].into_iter();
        let others = others.filter_map(|(name, function)| Some((name.to_owned(), function.as_ref()?)));
        for (name, function) in others.chain(measures) {
            if !function.bind(py).is_callable() {
                return Err(PyTypeError::new_err(format!("{name} must be callable")));
            }
        }
        let (stiffness, damping) = (self.stiffness_over_mass, self.damping_over_mass);
        let force =
            self.force.map(|function| Callback::new(function.bind(py), stiffness, damping, fallen.clone()));
        let force = force.transpose()?;
        let looks = !self.measures.is_empty() || self.stop.is_some();
        let looker = Looker { measures: self.measures, stop: self.stop, fallen: fallen.clone() };
        Ok(Invited { force, looker: looks.then_some(looker) })
    }
}

/// What takes part in a run.
#[derive(Default)]
pub(crate) struct Invited {
    force: Option<Callback>,
    looker: Option<Looker>,
}

impl Invited {
    /// Runs something with them. Where there are some it has threads of its own: what functions of Python call may want the pool.
    pub(crate) fn take_part<R: Send>(
        mut self,
        py: Python<'_>,
        run: impl FnOnce(Guests<'_>, &AtomicBool) -> R + Send,
    ) -> PyResult<R> {
        if self.force.is_none() && self.looker.is_none() {
            return interruptible(py, |stop| run(Guests::default(), stop));
        }
        interruptible_apart(py, |stop| {
            let forces = self.force.into_iter().map(|force| Box::new(force) as Box<dyn Hook>).collect();
            let onlooker = self.looker.as_mut().map(|looker| looker as &mut dyn Onlooker);
            run(Guests { forces, onlooker, domains: None }, stop)
        })
    }
}

/// Functions of the time [s] and of the columns of the grains that give numbers, and one that says whether to stop.
struct Looker {
    measures: Vec<(String, Py<PyAny>)>,
    stop: Option<Py<PyAny>>,
    fallen: Fallen,
}

impl Looker {
    fn ask(&self, py: Python<'_>, now: &Sight<'_>) -> PyResult<Look> {
        // Each function has copies of its own: what one does to them is nothing to the others.
        let call = |function: &Py<PyAny>| function.bind(py).call1((now.time, columns(py, now)?));
        let mut look = Look::default();
        for (name, function) in &self.measures {
            let given = call(function)?;
            let value = if given.is_none() { Ok(f64::NAN) } else { given.extract() };
            look.values.push(value.map_err(|_| {
                let kind = given.get_type();
                InputError::new_err(format!(
                    "the measure {name} gives a number, or None; this one gave a {kind}"
                ))
            })?);
        }
        if let Some(stop) = &self.stop {
            look.is_over = call(stop)?.is_truthy()?;
        }
        Ok(look)
    }
}

/// Columns of the grains by their names, as `Simulation.grains` gives them.
fn columns<'py>(py: Python<'py>, now: &Sight<'_>) -> PyResult<Bound<'py, PyDict>> {
    let table = arrays::columns(py, now.grains)?;
    if let Some(primaries) = now.primaries {
        table.set_item("primaries", arrays::integers(py, primaries.to_vec()))?;
    }
    Ok(table)
}

impl Onlooker for Looker {
    fn measures(&self) -> Vec<String> {
        self.measures.iter().map(|(name, _)| name.clone()).collect()
    }

    fn has_rule(&self) -> bool {
        self.stop.is_some()
    }

    fn look(&mut self, now: &Sight<'_>) -> Result<Look, String> {
        Python::attach(|py| {
            self.ask(py, now).map_err(|error| {
                let words = error.to_string();
                self.fallen.keep(error);
                words
            })
        })
    }
}
