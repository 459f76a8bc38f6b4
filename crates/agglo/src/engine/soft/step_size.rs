//! How long the first step is: given, or worked out from the stiffest contact and bond.
//!
//! # Equation
//! $$ \Delta t = s \, \min\left( 2\sqrt{m/k_{max}}, \; \frac{\pi R \sqrt{\rho/G}}{0.1631 \nu + 0.8766} \right) $$          (S1)
//! with k_max the stiffness that a grain can meet: that of the contact at the largest overlap that the limits allow,
//! or of all its bonds together. The second term is Rayleigh's time, for Hertz contact.
//!
//! # Source
//! Rayleigh time: Y. Li, Y. Xu, C. Thornton, *Powder Technol.* 160, 219 (2005).

use crate::contact::{Bonds, Normal, Touch};
use crate::particles::Material;
use crate::scenario::Scenario;

use super::system::System;
use crate::engine::Engine;

/// The first step [s] of a scenario.
pub fn first(scenario: &Scenario, system: &System) -> f64 {
    match &scenario.engine {
        Engine::Staggered(scheme) => scheme.initial_step.si().min(scheme.largest_step.si()),
        Engine::Verlet(scheme) => match scheme.step {
            Some(step) => step.si(),
            None => (scheme.safety * critical(scenario, system)).min(scenario.time.end.si() / 100.0),
        },
        // Hard spheres have no forces that bound a step.
        Engine::EventDriven(_) | Engine::TimeStepped(_) => scenario.time.end.si(),
    }
}

/// The critical step [s] of explicit integration; infinite where nothing is stiff.
pub fn critical(scenario: &Scenario, system: &System) -> f64 {
    rayleigh(scenario, system).min(contact(scenario, system)).min(bonds(scenario, system))
}

/// Rayleigh's time [s] of a grain of this radius [m]; nothing for a material without a Young's modulus.
pub fn rayleigh_time(material: &Material, radius: f64) -> Option<f64> {
    let poisson = material.poisson_ratio.unwrap_or(0.0);
    let shear = material.youngs_modulus?.si() / (2.0 * (1.0 + poisson));
    let time = std::f64::consts::PI * radius * (material.density.si() / shear).sqrt();
    Some(time / (0.1631 * poisson + 0.8766))
}

fn rayleigh(scenario: &Scenario, system: &System) -> f64 {
    let is_hertz = matches!(scenario.contact.as_ref().map(|laws| &laws.normal), Some(Normal::Hertz(_)));
    let materials: Vec<_> = scenario.materials.values().collect();
    let grains = &system.grains;
    let times = (0..grains.len()).filter_map(|at| {
        let material = materials[grains.material[at] as usize];
        rayleigh_time(material, grains.radius[at])
    });
    if is_hertz { times.fold(f64::INFINITY, f64::min) } else { f64::INFINITY }
}

/// From the stiffness of a contact of like grains at the largest overlap that the limits allow.
fn contact(scenario: &Scenario, system: &System) -> f64 {
    let Some(laws) = &scenario.contact else { return f64::INFINITY };
    let grains = &system.grains;
    let times = (0..grains.len()).map(|at| {
        let (radius, mass, stiffness) = (grains.radius[at], grains.mass[at], grains.contact_stiffness[at]);
        let distance = 2.0 * radius * (1.0 - scenario.limits.strain.min(0.5));
        let touch = Touch::new([radius; 2], [mass; 2], [stiffness; 2], distance);
        let pair = system.laws.pairs.of(grains.material[at], grains.material[at]);
        2.0 * (touch.effective_mass / laws.normal.tangent_stiffness(pair, &touch)).sqrt()
    });
    times.fold(f64::INFINITY, f64::min)
}

fn bonds(scenario: &Scenario, system: &System) -> f64 {
    let Some(Bonds::Beam(law)) = &scenario.bonds else { return f64::INFINITY };
    let grains = &system.grains;
    let bonds = system.network.bonds();
    let mut counts = vec![0_u32; grains.len()];
    for bond in bonds {
        bond.grains.iter().for_each(|grain| counts[*grain as usize] += 1);
    }
    let times = bonds.iter().map(|bond| {
        let places = bond.grains.map(|grain| grain as usize);
        let arms = places.map(|at| grains.radius[at] / (grains.radius[places[0]] + grains.radius[places[1]]));
        let step = law.critical_step(
            &bond.state,
            places.map(|at| grains.mass[at]),
            places.map(|at| grains.inertia(at)),
            arms.map(|arm| arm * bond.state.length),
        );
        step / f64::from(counts[places[0]].max(counts[places[1]])).sqrt()
    });
    times.fold(f64::INFINITY, f64::min)
}
