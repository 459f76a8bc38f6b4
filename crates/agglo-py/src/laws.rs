//! Laws of soft spheres over arrays, and rays among given spheres.

use agglo::acoustics::fresnel::Interface;
use agglo::contact::{ContactGeometry, PairTable};
use agglo::engine::soft::{Settings, Spheres, trace as traced};
use agglo::math::Vec3;
use agglo::units::Velocity;
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays;
use crate::error::{InputError, raised};
use crate::scenario::Scenario;
use crate::simulation::in_dict;
use crate::work::here;

/// The contact laws of a scenario at overlaps [n] [m] and speeds [n] [m/s] at which two grains part: columns by their names.
#[expect(non_snake_case, reason = "units keep their letters")]
#[pyfunction]
pub(crate) fn contact<'py>(
    py: Python<'py>,
    scenario: &Scenario,
    overlap_m: PyReadonlyArray1<'py, f64>,
    separation_m_s: PyReadonlyArray1<'py, f64>,
    radii_m: [f64; 2],
    materials: [u32; 2],
    temperature_K: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let settings = settings(py, scenario)?;
    let laws =
        settings.contact.as_ref().ok_or_else(|| InputError::new_err("the scenario has no [contact]"))?;
    let are_positive = |values: &[f64]| values.iter().all(|value| value.is_finite() && *value > 0.0);
    if !are_positive(&radii_m) || !are_positive(&[temperature_K]) {
        return Err(InputError::new_err("radii_m and temperature_K must be above 0 and finite"));
    }
    let known: Vec<_> = settings.materials.values().collect();
    let of = |material: u32| {
        known
            .get(material as usize)
            .ok_or_else(|| InputError::new_err("a material has a number that none has"))
    };
    let pair = [of(materials[0])?, of(materials[1])?];
    let masses = [0, 1].map(|side: usize| pair[side].mass_of_sphere(radii_m[side]));
    let stiffness = pair.map(|material| material.stiffness_at(temperature_K));
    let table = PairTable::new(&settings.materials, &settings.mixtures, Some(laws));
    let constants = table.of(materials[0], materials[1]);
    let (overlaps, speeds) = (overlap_m.as_array(), separation_m_s.as_array());
    let sum = radii_m[0] + radii_m[1];
    let can_be = |overlap: &f64| overlap.is_finite() && *overlap < sum;
    if overlaps.len() != speeds.len() || !overlaps.iter().all(can_be) || !speeds.iter().all(|v| v.is_finite())
    {
        let message = "overlap_m and separation_m_s must be finite, of one length, and overlaps below the sum of the radii";
        return Err(InputError::new_err(message));
    }
    let found: Vec<_> = overlaps
        .iter()
        .zip(speeds)
        .map(|(overlap, speed)| {
            let geometry = ContactGeometry::new(radii_m, masses, stiffness, sum - overlap);
            // The overlap itself, without what the distance has lost of it.
            let geometry = ContactGeometry { overlap: *overlap, ..geometry };
            (laws.along(constants, &geometry, *speed), laws.energy(constants, &geometry))
        })
        .collect();
    let table = PyDict::new(py);
    table.set_item(
        "repulsion_N",
        arrays::scalars(py, found.iter().map(|(along, _)| along.repulsion).collect()),
    )?;
    table.set_item(
        "elastic_N",
        arrays::scalars(py, found.iter().map(|(along, _)| along.elastic.force).collect()),
    )?;
    table.set_item(
        "dashpot_N_s_m",
        arrays::scalars(py, found.iter().map(|(along, _)| along.dashpot).collect()),
    )?;
    table.set_item(
        "dissipation_W",
        arrays::scalars(py, found.iter().map(|(along, _)| along.dissipation).collect()),
    )?;
    table.set_item("energy_J", arrays::scalars(py, found.iter().map(|(_, energy)| *energy).collect()))?;
    Ok(table)
}

/// What becomes of a ray's power at a grain of a material, by the cosines [n] of its angle with the normal: the parts that are
/// reflected, go on as a shear wave, and go on as sound.
#[pyfunction]
pub(crate) fn reflect<'py>(
    py: Python<'py>,
    scenario: &Scenario,
    cosine: PyReadonlyArray1<'py, f64>,
    material: u32,
) -> PyResult<Bound<'py, PyDict>> {
    let settings = settings(py, scenario)?;
    let found = settings.materials.values().nth(material as usize);
    let found = found.ok_or_else(|| InputError::new_err("the material has a number that none has"))?;
    let Some(sound) = found.sound_speed.map(Velocity::si) else {
        return Err(InputError::new_err("the material has no sound_speed"));
    };
    let cosines = cosine.as_array();
    if !cosines.iter().all(|cosine| (0.0..=1.0).contains(cosine)) {
        return Err(InputError::new_err("cosines are from 0 to 1"));
    }
    let shear = found.shear_sound_speed.map_or(0.0, Velocity::si);
    let interface = Interface::new(&settings.medium, found.density.si(), sound, shear);
    let normal = Vec3::AXES[2];
    let scattered = cosines.iter().map(|cosine| {
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        interface.scatter(Vec3::new(sine, 0.0, -cosine), normal)
    });
    let scattered: Vec<_> = scattered.collect();
    let table = PyDict::new(py);
    let column = |of: &dyn Fn(usize) -> f64| arrays::scalars(py, (0..scattered.len()).map(of).collect());
    table.set_item("reflected", column(&|at| scattered[at].reflectance))?;
    table.set_item("sheared", column(&|at| scattered[at].sheared))?;
    table.set_item("refracted", column(&|at| 1.0 - scattered[at].reflectance - scattered[at].sheared))?;
    Ok(table)
}

/// A pulse traced to its end among spheres held still: columns of its hits, and its counts and powers.
#[pyfunction]
pub(crate) fn trace<'py>(
    py: Python<'py>,
    scenario: &Scenario,
    position_m: PyReadonlyArray2<'py, f64>,
    radius_m: PyReadonlyArray1<'py, f64>,
    material: PyReadonlyArray1<'py, u32>,
    beam: u32,
    pulse: u32,
) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyDict>)> {
    let settings = settings(py, scenario)?;
    let n = radius_m.len()?;
    if position_m.as_array().shape() != [n, 3] || material.len()? != n {
        let message = format!("position_m is [n, 3], radius_m and material are [n]; found {n} radii");
        return Err(InputError::new_err(message));
    }
    let row = |row: numpy::ndarray::ArrayView1<'_, f64>| Vec3::new(row[0], row[1], row[2]);
    let position: Vec<Vec3> = position_m.as_array().rows().into_iter().map(row).collect();
    let (radius, material) = (radius_m.as_array().to_vec(), material.as_array().to_vec());
    let materials = settings.materials.len() as u32;
    let are_spheres = position.iter().all(|place| place.is_finite())
        && radius.iter().all(|radius| radius.is_finite() && *radius > 0.0)
        && material.iter().all(|material| *material < materials);
    if !are_spheres {
        let message =
            format!("positions must be finite, radii above 0 and finite, materials below {materials}");
        return Err(InputError::new_err(message));
    }
    let spheres = Spheres { position: &position, radius: &radius, material: &material };
    let found = here(py, || traced(&settings, spheres, beam, pulse))?;
    let found = found.map_err(|error| InputError::new_err(error.to_string()))?;
    let hits = PyDict::new(py);
    let vectors = |of: &dyn Fn(&agglo::acoustics::Hit) -> Vec3| {
        arrays::vectors(py, found.hits.iter().map(|hit| of(hit).to_array()))
    };
    let scalars =
        |of: &dyn Fn(&agglo::acoustics::Hit) -> f64| arrays::scalars(py, found.hits.iter().map(of).collect());
    hits.set_item("sphere", arrays::integers(py, found.hits.iter().map(|hit| hit.grain).collect()))?;
    hits.set_item("wall", arrays::integers(py, found.hits.iter().map(|hit| hit.wall).collect()))?;
    hits.set_item("point_m", vectors(&|hit| hit.point)?)?;
    hits.set_item("normal", vectors(&|hit| hit.normal)?)?;
    hits.set_item("direction_in", vectors(&|hit| hit.direction_in)?)?;
    hits.set_item("direction_out", vectors(&|hit| hit.direction_out)?)?;
    hits.set_item("power_in_W", scalars(&|hit| hit.power_in))?;
    hits.set_item("reflected", scalars(&|hit| hit.reflectance))?;
    let name = if found.are_impulses { "impulse_N_s" } else { "force_N" };
    hits.set_item(name, arrays::vectors(py, found.loads.iter().map(|load| load.to_array()))?)?;
    Ok((hits, in_dict(py, &found.count)?))
}

fn settings(py: Python<'_>, scenario: &Scenario) -> PyResult<Settings> {
    Settings::try_from(&scenario.read).map_err(|error| raised(py, error))
}
