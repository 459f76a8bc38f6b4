//! How many steps, and how long they take.

use std::f64::consts::PI;

use super::Plan;
use crate::acoustics::{Acoustics, RayForce};
use crate::contact::{Bonds, Normal};
use crate::engine::Engine;
use crate::engine::soft::step_size::rayleigh_time;
use crate::packing::Placement;
use crate::particles::Material;
use crate::scenario::types::{GrainGroup, Scenario};

/// Time [s] of one evaluation of all forces on one grain by one thread; measured runs are within a few times of it.
const SECONDS_PER_GRAIN: f64 = 4e-7;
/// Time [s] in which one thread follows a ray from hit to hit.
const SECONDS_PER_SEGMENT: f64 = 5e-7;
/// Segments of one ray's way through an agglomerate.
const SEGMENTS_PER_RAY: f64 = 6.0;
/// Rays leave an agglomerate after some times the way straight through it.
const DIAMETERS_OF_FLIGHT: f64 = 4.0;

pub(super) fn estimate(plan: &mut Plan, scenario: &Scenario) {
    let end = scenario.time.end.si();
    let flights = plan.pulses as f64 * flight_steps(scenario);
    let (step, evaluations) = match &scenario.engine {
        Engine::Staggered(law) => (law.largest_step.si(), f64::from(law.target_iterations.max(2)) / 2.0),
        Engine::Verlet(law) => match law.step {
            Some(step) => (step.si(), 1.0),
            None => ((law.safety * critical_step(scenario)).min(end / 100.0), 1.0),
        },
        Engine::EventDriven(_) | Engine::TimeStepped(_) => return,
    };
    plan.step = step;
    plan.steps = end / step + flights;
    let threads = std::thread::available_parallelism().map_or(1.0, |count| count.get() as f64);
    let forces = plan.steps * plan.grains as f64 * evaluations * SECONDS_PER_GRAIN;
    let rays = plan.pulses as f64 * plan.rays_per_pulse as f64 * SEGMENTS_PER_RAY * SECONDS_PER_SEGMENT;
    plan.seconds = (forces + rays) / threads;
}

/// Steps while the rays of one pulse fly, where the ray force fixes their length.
fn flight_steps(scenario: &Scenario) -> f64 {
    let Some(Acoustics { force: RayForce::PublishedStep(law), .. }) = &scenario.acoustics else { return 0.0 };
    let widest = scenario.grains.iter().map(extent).fold(0.0, f64::max);
    let radius = scenario.grains.iter().map(mean_radius).fold(f64::INFINITY, f64::min);
    DIAMETERS_OF_FLIGHT * widest / (law.step_fraction * radius)
}

/// Diameter [m] of the region of a group.
fn extent(group: &GrainGroup) -> f64 {
    match &group.placement {
        Placement::Random(law) => 2.0 * law.region.enclosing_radius(),
        Placement::Lattice(law) => 2.0 * law.region.enclosing_radius(),
        Placement::Table(_) | Placement::List(_) | Placement::Fill(_) => 2.0 * mean_radius(group),
    }
}

fn mean_radius(group: &GrainGroup) -> f64 {
    (0.75 * group.size.mean_volume() / PI).cbrt()
}

/// Shortest of the critical steps [s] of all groups; infinite where nothing is stiff.
fn critical_step(scenario: &Scenario) -> f64 {
    let of_group = |group: &GrainGroup| {
        let material = scenario.materials.get(&group.material)?;
        let contact = contact_step(scenario, group, material);
        Some(contact.min(bond_step(scenario, group, material)))
    };
    scenario.grains.iter().filter_map(of_group).fold(f64::INFINITY, f64::min)
}

/// Rayleigh's time for Hertz contact, 2/omega of the contact spring otherwise, of the smallest grains.
fn contact_step(scenario: &Scenario, group: &GrainGroup, material: &Material) -> f64 {
    let radius = group.size.smallest();
    let (volume, density) = (4.0 / 3.0 * PI * radius.powi(3), material.density.si());
    match scenario.contact.as_ref().map(|laws| &laws.normal) {
        None => f64::INFINITY,
        Some(Normal::Hertz(_)) => rayleigh_time(material, radius).unwrap_or(f64::INFINITY),
        Some(Normal::Hooke(law)) => 2.0 * (0.5 * density * volume / law.stiffness.si()).sqrt(),
        Some(Normal::StrainPower(_)) => {
            let slope = material.stiffness_at(group.temperature.si()) * PI * radius * scenario.limits.strain;
            2.0 * (0.5 * density * volume / slope).sqrt()
        }
    }
}

fn bond_step(scenario: &Scenario, group: &GrainGroup, material: &Material) -> f64 {
    let Some(Bonds::Beam(bond)) = &scenario.bonds else { return f64::INFINITY };
    let radius = group.size.smallest();
    let stiffness = bond.youngs_modulus.si() * PI * (bond.radius_ratio * radius).powi(2) / (2.0 * radius);
    let mass = material.density.si() * 4.0 / 3.0 * PI * radius.powi(3);
    2.0 * (mass / stiffness).sqrt()
}
