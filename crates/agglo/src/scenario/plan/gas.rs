//! Hard spheres as a gas: how often they meet at the start.
//!
//! The rate is Enskog's, 4 sqrt(pi) n σ² χ s per grain for velocities with the standard deviation s in each component,
//! with Carnahan and Starling's χ = (1 - φ/2)/(1 - φ)³. Other spreads enter by the mean relative speed of a
//! normal distribution with the same variance, sqrt(u² + (8/3π) Σ var): exact for a gas in equilibrium and for a
//! uniform stream, 14 % high for velocities that scatter uniformly along one axis.

use std::f64::consts::PI;

use crate::math::Vec3;
use crate::packing::{Placement, VelocitySpread};
use crate::scenario::types::{GrainGroup, Scenario};
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
    /// Mean distance of the centres of two grains that touch [m].
    pub touching: f64,
}

/// The grains of one group.
struct Kind {
    count: f64,
    radius: f64,
    mean: Vec3,
    /// Variance of the velocity [m²/s²], all components together.
    scatter: f64,
}

impl Gas {
    /// The gas that a scenario of hard spheres starts from; `counts` are the grains of each group.
    pub fn at_start(scenario: &Scenario, counts: &[u64]) -> Option<Self> {
        let volume = scenario.volume.as_ref()?.volume();
        let kinds: Vec<Kind> =
            scenario.grains.iter().zip(counts).map(|(group, count)| kind(group, *count as f64)).collect();
        let solid = |kind: &Kind| kind.count * 4.0 / 3.0 * PI * kind.radius.powi(3);
        let solid_fraction = kinds.iter().map(solid).sum::<f64>() / volume;
        let phi = solid_fraction.min(DENSEST);
        let chi = (1.0 - 0.5 * phi) / (1.0 - phi).powi(3);
        let count: f64 = kinds.iter().map(|kind| kind.count).sum();
        let (mut met, mut sections, mut speeds, mut distances) = (0.0, 0.0, 0.0, 0.0);
        for a in &kinds {
            for b in &kinds {
                let (sigma, speed) = (a.radius + b.radius, relative_speed(a, b));
                let section = PI * sigma * sigma * b.count / volume * chi;
                met += a.count * section * speed;
                sections += a.count * section;
                speeds += a.count * b.count * speed;
                distances += a.count * b.count * sigma;
            }
        }
        Some(Self {
            solid_fraction,
            // Each impact is one of two grains.
            rate: 0.5 * met,
            free_time: count / met,
            free_path: count / (std::f64::consts::SQRT_2 * sections),
            relative_speed: speeds / (count * count),
            touching: distances / (count * count),
        })
    }
}

fn relative_speed(a: &Kind, b: &Kind) -> f64 {
    ((a.mean - b.mean).norm_squared() + 8.0 / (3.0 * PI) * (a.scatter + b.scatter)).sqrt()
}

fn kind(group: &GrainGroup, count: f64) -> Kind {
    let radius = (0.75 * group.size.mean_volume() / PI).cbrt();
    let scatter = match &group.velocity_spread {
        None => 0.0,
        Some(VelocitySpread::Uniform(law)) => vector(law.bounds).norm_squared() / 3.0,
        Some(VelocitySpread::Maxwell(law)) => 3.0 * law.deviation.si().powi(2),
    };
    if let Placement::List(list) = &group.placement
        && !list.velocities.is_empty()
    {
        let velocities = || list.velocities.iter().map(|velocity| vector(*velocity));
        let part = 1.0 / list.velocities.len() as f64;
        let mean = velocities().fold(Vec3::ZERO, |sum, v| sum + v * part);
        let scatter = velocities().map(|v| part * (v - mean).norm_squared()).sum();
        return Kind { count, radius, mean, scatter };
    }
    Kind { count, radius, mean: vector(group.velocity), scatter }
}
