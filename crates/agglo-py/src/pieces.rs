//! Pieces for teaching and tests: placed grains, one collision.

use agglo::impact::{Body, ImpactLaws};
use agglo::math::Vec3;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays;
use crate::error::{InputError, raised};
use crate::scenario::Scenario;
use crate::work::interruptible;

/// The grains of a scenario as they are before its clock starts: columns by their names with units, in the order of ids.
#[pyfunction]
pub(crate) fn pack<'py>(py: Python<'py>, scenario: &Scenario) -> PyResult<Bound<'py, PyDict>> {
    let start = interruptible(py, |stop| scenario.start(stop))?;
    arrays::columns(py, &start.map_err(|error| raised(py, error))?.grains)
}

/// What becomes of two hard spheres that collide: velocities [m/s] and temperatures [K] of both, radii [m], the number of
/// their material by its name's place, and the unit vector from the first to the second.
#[expect(non_snake_case, reason = "units keep their letters")]
#[pyfunction]
#[pyo3(signature = (scenario, radii_m, velocities_m_s, temperatures_K, normal, materials=[0, 0]))]
pub(crate) fn collide<'py>(
    py: Python<'py>,
    scenario: &Scenario,
    radii_m: [f64; 2],
    velocities_m_s: [[f64; 3]; 2],
    temperatures_K: [f64; 2],
    normal: [f64; 3],
    materials: [u32; 2],
) -> PyResult<Bound<'py, PyDict>> {
    let bad = |message: &str| InputError::new_err(message.to_owned());
    let impact = scenario.read.impact().ok_or_else(|| bad("collide is for scenarios of hard spheres"))?;
    let laws = ImpactLaws::new(impact, &scenario.read.materials, &scenario.read.mixtures);
    let normal = Vec3::from(normal);
    let are_positive = |values: [f64; 2]| values.iter().all(|value| value.is_finite() && *value > 0.0);
    let velocities = velocities_m_s.map(Vec3::from);
    if !are_positive(radii_m) || !are_positive(temperatures_K) {
        return Err(bad("radii_m and temperatures_K must be above 0 and finite"));
    }
    if !(velocities.iter().all(|velocity| velocity.is_finite()) && (normal.norm() - 1.0).abs() < 1e-9) {
        return Err(bad("velocities_m_s must be finite, and the normal a unit vector"));
    }
    let known: Vec<_> = scenario.read.materials.values().collect();
    let body = |side: usize| -> PyResult<Body> {
        let material = materials[side];
        let found =
            known.get(material as usize).ok_or_else(|| bad("a material has a number that none has"))?;
        let mass = found.mass_of_sphere(radii_m[side]);
        Ok(Body {
            velocity: velocities[side],
            mass,
            radius: radii_m[side],
            temperature: temperatures_K[side],
            heat_capacity: mass * found.specific_heat(),
            material,
            primaries: 1,
        })
    };
    let bodies = [body(0)?, body(1)?];
    if (bodies[0].velocity - bodies[1].velocity).dot(normal) <= 0.0 {
        return Err(bad("the spheres do not approach each other along the normal"));
    }
    let outcome = laws.impact([&bodies[0], &bodies[1]], normal);
    let table = PyDict::new(py);
    table.set_item("restitution", outcome.restitution)?;
    table.set_item("sticks", outcome.sticks)?;
    table.set_item("velocities_m_s", arrays::vectors(py, outcome.velocities.map(Vec3::to_array))?)?;
    table.set_item("temperatures_K", arrays::scalars(py, outcome.temperatures.to_vec()))?;
    table.set_item("fragments", outcome.fragments.to_vec())?;
    table.set_item("lost_normal_J", outcome.energy.normal)?;
    table.set_item("lost_tangential_J", outcome.energy.tangential)?;
    table.set_item("reaction_J", outcome.energy.reaction)?;
    table.set_item("surface_J", outcome.energy.surface)?;
    Ok(table)
}
