//! A force that a function of Python gives.

use std::cell::Cell;
use std::sync::{Arc, Mutex, PoisonError};

use agglo::engine::soft::{Hook, LoadViews, Scene};
use agglo::math::{Pace, Vec3};
use agglo::particles::ById;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;

use crate::arrays::Vectors;
use crate::error::{InputError, RunError};

thread_local! {
    /// Whether this thread asks a force, for which the simulation is held.
    static ASKS: Cell<bool> = const { Cell::new(false) };
}

/// A force that asks the simulation that asks it would wait for itself.
pub(crate) fn refuse_within_a_force() -> PyResult<()> {
    if ASKS.get() {
        let message = "a force cannot ask the simulation while it is asked itself; all that it needs is among its arguments, \
                       and columns that do not change can be taken before";
        return Err(RunError::new_err(message));
    }
    Ok(())
}

/// What a function of Python raised while a step was made; the step has no force of it.
#[derive(Clone, Default)]
pub(crate) struct Fallen(Arc<Mutex<Option<PyErr>>>);

impl Fallen {
    /// Whether something was raised.
    pub(crate) fn is_there(&self) -> bool {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).is_some()
    }

    /// Raises it, once.
    pub(crate) fn raise(&self, _: Python<'_>) -> PyResult<()> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take().map_or(Ok(()), Err)
    }

    /// What was raised, in words.
    pub(crate) fn words(&self) -> Option<String> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).as_ref().map(ToString::to_string)
    }

    pub(crate) fn keep(&self, error: PyErr) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
    }
}

/// ω² [1/s²] and Γ [1/s] of a force, if one of them is given.
fn pace_of(stiffness_over_mass: Option<f64>, damping_over_mass: Option<f64>) -> PyResult<Option<(f64, f64)>> {
    let pace = match (stiffness_over_mass, damping_over_mass) {
        (None, None) => None,
        (square, rate) => Some((square.unwrap_or(0.0), rate.unwrap_or(0.0))),
    };
    if pace.is_some_and(|(square, rate)| !(square >= 0.0 && rate >= 0.0 && (square + rate).is_finite())) {
        let message = "stiffness_over_mass and damping_over_mass must be finite and not below 0";
        return Err(InputError::new_err(message));
    }
    Ok(pace)
}

/// A function of time [s], positions [n, 3] [m], velocities [n, 3] [m/s] and angular velocities [n, 3] [rad/s], all in the order of
/// ids, that gives forces [n, 3] [N], or forces and torques about the centers [n, 3] [N m].
pub(crate) struct Callback {
    function: Py<PyAny>,
    /// "the function breeze": what a run knows it by.
    name: String,
    /// ω² [1/s²] and Γ [1/s], where they are given.
    pace: Option<(f64, f64)>,
    fallen: Fallen,
    desk: Mutex<Desk>,
}

/// What is kept from one question to the next.
#[derive(Default)]
struct Desk {
    order: Order,
    positions: Vectors,
    velocities: Vectors,
    angular_velocities: Vectors,
}

/// Where grains are in memory, in the order of their ids. They change places seldom.
#[derive(Default)]
struct Order {
    ids: Vec<u32>,
    places: Vec<u32>,
}

impl Order {
    fn of(&mut self, ids: &[u32]) -> &[u32] {
        if self.ids != ids {
            ids.clone_into(&mut self.ids);
            self.places = ById::of(ids).places().collect();
        }
        &self.places
    }
}

impl Callback {
    /// ω² [1/s²] and Γ [1/s] of the force are known if one of them is given.
    pub(crate) fn new(
        function: &Bound<'_, PyAny>,
        stiffness_over_mass: Option<f64>,
        damping_over_mass: Option<f64>,
        fallen: Fallen,
    ) -> PyResult<Self> {
        let pace = pace_of(stiffness_over_mass, damping_over_mass)?;
        let name: String =
            function.py().import("agglo._guests")?.getattr("name_of")?.call1((function,))?.extract()?;
        let (function, name) = (function.clone().unbind(), format!("the function {name}"));
        Ok(Self { function, name, pace, fallen, desk: Mutex::default() })
    }

    fn ask(&self, py: Python<'_>, now: &Scene<'_>, loads: &mut LoadViews<'_>) -> PyResult<()> {
        let mut desk = self.desk.lock().unwrap_or_else(PoisonError::into_inner);
        let Desk { order, positions, velocities, angular_velocities } = &mut *desk;
        let order = order.of(&now.grains.id);
        let arguments = (
            now.time,
            positions.filled(py, now.motion.position, order)?,
            velocities.filled(py, now.motion.velocity, order)?,
            angular_velocities.filled(py, now.motion.angular_velocity, order)?,
        );
        ASKS.set(true);
        let given = self.function.bind(py).call1(arguments);
        ASKS.set(false);
        let given = given?;
        if let Ok((force, torque)) = given.extract::<(PyReadonlyArray2<'_, f64>, PyReadonlyArray2<'_, f64>)>()
        {
            put(&force, order, loads.force, "forces")?;
            return put(&torque, order, loads.torque, "torques");
        }
        let force = given.extract::<PyReadonlyArray2<'_, f64>>().map_err(|_| {
            InputError::new_err(
                "a force gives an array [n, 3] of float64, or one of forces and one of torques; this one gave something else",
            )
        })?;
        put(&force, order, loads.force, "forces")
    }
}

/// Puts an array in the order of ids to where the grains are.
fn put(given: &PyReadonlyArray2<'_, f64>, order: &[u32], loads: &mut [Vec3], what: &str) -> PyResult<()> {
    let given = given.as_array();
    if given.shape() != [order.len(), 3] {
        let message = format!("{what} have the shape {:?}; [{}, 3] is wanted", given.shape(), order.len());
        return Err(InputError::new_err(message));
    }
    // Rows follow one another in memory but for arrays that were turned or cut.
    let given = given.as_standard_layout();
    let (rows, _) = given.as_slice().unwrap_or_default().as_chunks::<3>();
    for (row, &at) in rows.iter().zip(order) {
        loads[at as usize] = Vec3::from(*row);
    }
    match rows.iter().position(|row| !row.iter().all(|value| value.is_finite())) {
        Some(at) => Err(InputError::new_err(format!("{what} are not finite in row {at}"))),
        None => Ok(()),
    }
}

impl Hook for Callback {
    fn name(&self) -> &str {
        &self.name
    }

    fn load(&self, now: &Scene<'_>, loads: &mut LoadViews<'_>) {
        Python::attach(|py| {
            if let Err(error) = self.ask(py, now, loads) {
                loads.force.fill(Vec3::ZERO);
                loads.torque.fill(Vec3::ZERO);
                self.fallen.keep(error);
            }
        });
    }

    fn pace(&self, _: &Scene<'_>) -> Option<Pace> {
        self.pace.map(|(square, rate)| Pace { square, rate })
    }

    fn fault(&self) -> Option<String> {
        self.fallen.words()
    }
}
