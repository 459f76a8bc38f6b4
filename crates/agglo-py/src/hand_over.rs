//! A run handed over to the other kind of spheres.

use std::path::PathBuf;

use agglo::hand_over::{Grown, Options, POROSITY};
use agglo::scenario::{Scenario as Read, template};
use pyo3::prelude::*;

use crate::error::raised;
use crate::json::to_python;
use crate::scenario::Scenario;
use crate::work::here;

/// Hands the run in a folder over: writes a scenario with its tables; gives the record, and the same in words.
#[pyfunction]
#[pyo3(signature = (grown, to, scenario=None, porosity=None, seed=None))]
pub(crate) fn hand_over<'py>(
    py: Python<'py>,
    grown: PathBuf,
    to: PathBuf,
    scenario: Option<&Scenario>,
    porosity: Option<f64>,
    seed: Option<u64>,
) -> PyResult<(Bound<'py, PyAny>, String)> {
    let grown = Grown::read(&grown).map_err(|error| raised(py, error))?;
    let usual = grown.usual_template();
    let (with, name) = if let Some(scenario) = scenario {
        (scenario.read.clone(), "the scenario")
    } else {
        let text = template(usual).map_or("", |template| template.text);
        (Read::from_toml(text).map_err(|faults| raised(py, faults))?, usual)
    };
    let options = Options { with: (&with, name), porosity: porosity.unwrap_or(POROSITY), seed };
    let record = here(py, || grown.hand_over(&options, &to))?.map_err(|error| raised(py, error))?;
    Ok((to_python(py, &record)?, record.to_string()))
}
