//! What materials grains have on the other side: density and heat capacity are the run's, the laws' constants the scenario's.

use std::collections::{BTreeMap, BTreeSet};

use super::{Grown, HandOverError, Options};
use crate::particles::{Material, Mixture, Particles};
use crate::scenario::Scenario;

/// The scenario of the other kind with the materials of the grains of the run, each by its own name: density, and heat capacity
/// if there is a use for it, of the run, all else of the scenario's material of that name, or of its only one. `used` has the
/// numbers of the run's materials that are needed.
///
/// # Errors
/// [`HandOverError::Refused`] where the scenario has several and none of that name.
pub(super) fn with_substances(
    grown: &Grown,
    options: &Options<'_>,
    used: &BTreeSet<u32>,
) -> Result<Scenario, HandOverError> {
    let (with, name) = options.with;
    let mut scenario = with.clone();
    scenario.materials = BTreeMap::new();
    for (number, (own, substance)) in grown.state.past.materials.iter().enumerate() {
        if !used.contains(&(number as u32)) {
            continue;
        }
        let Some(found) = counterpart(with, own) else {
            let known: Vec<&str> = with.materials.keys().map(String::as_str).collect();
            return Err(HandOverError::Refused(format!(
                "{} has grains of {own}, and {name} has several materials and none of that name ({}); add \
                 [materials.{own}] to it",
                grown.shown,
                known.join(", ")
            )));
        };
        // Soft spheres have no law that reads it.
        let heat_capacity = found.heat_capacity.map(|own| substance.heat_capacity.unwrap_or(own));
        let material = Material { density: substance.density, heat_capacity, ..found.clone() };
        scenario.materials.insert(own.clone(), material);
    }
    let is_known =
        |mixture: &Mixture| mixture.between.iter().all(|name| scenario.materials.contains_key(name));
    scenario.mixtures.retain(is_known);
    scenario.from = None;
    Ok(scenario)
}

/// Numbers of the run's materials in the new scenario.
pub(super) fn numbers(grown: &Grown, scenario: &Scenario) -> Vec<u32> {
    let place = |name: &String| scenario.materials.keys().position(|known| known == name).unwrap_or_default();
    grown.state.past.materials.keys().map(|name| place(name) as u32).collect()
}

fn counterpart<'a>(with: &'a Scenario, name: &str) -> Option<&'a Material> {
    let only = || with.materials.values().next().filter(|_| with.materials.len() == 1);
    with.materials.get(name).or_else(only)
}

/// Heat that grains hold [J]: sum of m C T, with the heat capacities [J/(kg K)] of their materials by number.
pub(super) fn heat(grains: &Particles, capacities: &[f64]) -> f64 {
    let of = |at: usize| grains.mass[at] * capacities[grains.material[at] as usize] * grains.temperature[at];
    (0..grains.len()).map(of).sum()
}

/// Heat capacities [J/(kg K)] by the names of the first materials, as the others have them; 0 where they have none.
pub(super) fn capacities(names: &BTreeMap<String, Material>, known: &BTreeMap<String, Material>) -> Vec<f64> {
    names.keys().map(|name| known.get(name).map_or(0.0, Material::specific_heat)).collect()
}
