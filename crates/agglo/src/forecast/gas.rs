//! Hard spheres as a gas: how often they meet at the start.
//!
//! The rate is Enskog's, 4 sqrt(pi) n σ² χ s per grain for velocities with the standard deviation s in each component,
//! with Carnahan and Starling's χ = (1 - φ/2)/(1 - φ)³. Other spreads enter by the mean relative speed of a
//! normal distribution with the same variance, sqrt(u² + (8/3π) Σ var): exact for a gas in equilibrium and for a
//! uniform stream, 14 % high for velocities that scatter uniformly along one axis.

use std::f64::consts::PI;
use std::ops::Range;

use crate::math::Vec3;
use crate::packing::{GrainGroup, VelocitySpread};
use crate::particles::Particles;
use crate::scenario::Scenario;
use crate::units::vector;

/// A gas above this solid fraction is none.
const DENSEST: f64 = 0.7;

/// What is known of the gas at the start.
pub(super) struct Gas {
    /// Volume of the grains over the control volume.
    pub solid_fraction: f64,
    /// Impacts of all grains per time [1/s].
    pub rate: f64,
    /// Mean time between two impacts of one grain [s]; infinite at rest.
    pub free_time: f64,
    /// Mean way between two impacts of one grain [m], as seen from the mean motion.
    pub free_path: f64,
    /// Mean relative speed of two grains [m/s].
    pub relative_speed: f64,
    /// Mass of all [kg].
    pub mass: f64,
    /// Kinetic energy [J], as seen by one at rest and by one who moves with the center of mass.
    pub kinetic: [f64; 2],
    /// The group with most of the mass.
    pub heaviest: Option<GrainGroup>,
}

/// The grains of one group.
struct Kind {
    count: f64,
    /// Mass of all of them [kg].
    mass: f64,
    radius: f64,
    mean: Vec3,
    /// Variance of the velocity [m²/s²], all components together.
    scatter: f64,
}

impl Gas {
    /// The gas that a scenario of hard spheres starts from; `counts` are the grains of each group, and `placed` all of
    /// them, group after group, where they were placed.
    pub fn at_start(scenario: &Scenario, counts: &[u64], placed: Option<&Particles>) -> Option<Self> {
        let volume = scenario.volume()?.volume();
        let mut first = 0_usize;
        let mut kinds = Vec::new();
        for (group, &count) in scenario.grains.iter().zip(counts) {
            let range = first..first.saturating_add(count as usize);
            first = range.end;
            kinds.push(match placed {
                Some(grains) => Kind::of_grains(grains, range),
                None => Kind::of_group(scenario, group, count as f64),
            });
        }
        let solid = |kind: &Kind| kind.count * 4.0 / 3.0 * PI * kind.radius.powi(3);
        let solid_fraction = kinds.iter().map(solid).sum::<f64>() / volume;
        let phi = solid_fraction.min(DENSEST);
        let chi = (1.0 - 0.5 * phi) / (1.0 - phi).powi(3);
        let count: f64 = kinds.iter().map(|kind| kind.count).sum();
        let (mut met, mut sections, mut speeds) = (0.0, 0.0, 0.0);
        for a in &kinds {
            for b in &kinds {
                let (sigma, speed) = (a.radius + b.radius, relative_speed(a, b));
                let section = PI * sigma * sigma * b.count / volume * chi;
                met += a.count * section * speed;
                sections += a.count * section;
                speeds += a.count * b.count * speed;
            }
        }
        let heaviest = (0..kinds.len()).max_by(|a, b| kinds[*a].mass.total_cmp(&kinds[*b].mass));
        Some(Self {
            mass: kinds.iter().map(|kind| kind.mass).sum(),
            kinetic: kinetic(&kinds),
            heaviest: heaviest.map(|at| scenario.grains[at].clone()),
            solid_fraction,
            // Each impact is one of two grains.
            rate: 0.5 * met,
            free_time: count / met,
            free_path: count / (std::f64::consts::SQRT_2 * sections),
            relative_speed: speeds / (count * count),
        })
    }
}

/// Kinetic energy [J] as seen at rest, and from the center of mass.
fn kinetic(kinds: &[Kind]) -> [f64; 2] {
    let mass: f64 = kinds.iter().map(|kind| kind.mass).sum();
    let momentum = kinds.iter().fold(Vec3::ZERO, |sum, kind| sum + kind.mean * kind.mass);
    let of = |kind: &Kind| 0.5 * kind.mass * (kind.mean.norm_squared() + kind.scatter);
    let all: f64 = kinds.iter().map(of).sum();
    let common = if mass > 0.0 { 0.5 * momentum.norm_squared() / mass } else { 0.0 };
    [all, (all - common).max(0.0)]
}

fn relative_speed(a: &Kind, b: &Kind) -> f64 {
    ((a.mean - b.mean).norm_squared() + 8.0 / (3.0 * PI) * (a.scatter + b.scatter)).sqrt()
}

impl Kind {
    /// Grains as they were placed.
    fn of_grains(grains: &Particles, range: Range<usize>) -> Self {
        let count = range.len() as f64;
        let part = 1.0 / count.max(1.0);
        let cubes: f64 = range.clone().map(|at| part * grains.radius[at].powi(3)).sum();
        let mean = range.clone().fold(Vec3::ZERO, |sum, at| sum + grains.velocity[at] * part);
        Self {
            count,
            mass: range.clone().map(|at| grains.mass[at]).sum(),
            radius: cubes.cbrt(),
            mean,
            scatter: range.map(|at| part * (grains.velocity[at] - mean).norm_squared()).sum(),
        }
    }

    /// Grains as the scenario asks for them.
    fn of_group(scenario: &Scenario, group: &GrainGroup, count: f64) -> Self {
        let density = scenario.materials.get(&group.material).map_or(0.0, |material| material.density.si());
        let mass = count * density * group.size.mean_volume();
        let radius = (0.75 * group.size.mean_volume() / PI).cbrt();
        let scatter = match &group.velocity_spread {
            None => 0.0,
            Some(VelocitySpread::Uniform(law)) => vector(law.bounds).norm_squared() / 3.0,
            Some(VelocitySpread::Maxwell(law)) => 3.0 * law.deviation.si().powi(2),
        };
        Self { count, mass, radius, mean: vector(group.velocity), scatter }
    }
}
