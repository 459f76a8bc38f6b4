//! What a continuum code wants to know of the grains in a point of the flow: means, energies and rates.
//!
//! # Equation
//! ```text
//! V = sum(m v)/M,   Θ = sum(m (v - V)(v - V)^T)/M,   kinetic = M V²/2 + M tr Θ/2
//! T = sum(m C T_i)/sum(m C),   n_f = (mean b/reference b)³                                   ([B] 8.1)
//! rate = events/(volume duration)
//! ```
//!
//! # Source
//! T. I. Zohdi, Proc. R. Soc. Lond. A 460, 3421 (2004), section 9; the tensor Θ times the mass per volume is the stress
//! of the flying grains (J. T. Jenkins and S. B. Savage, J. Fluid Mech. 130, 187 (1983)).
//!
//! # Symbols
//! | symbol | name in code           | unit    | meaning                                            |
//! |--------|------------------------|---------|----------------------------------------------------|
//! | V      | `mean_velocity`        | m/s     | momentum over mass M                               |
//! | Θ      | `velocity_covariance`  | m²/s²   | tensor of the granular temperature, by mass         |
//! | T      | `mean_temperature`     | K       | by heat capacity; by mass where there is none       |
//! | b      | `mean_radius`          | m       | mean by number                                     |
//! | n_f    | `growth`               | 1       | primaries in a mean grain                          |
//!
//! # Valid when
//! There are enough grains for means to mean something: the relative scatter is about 1/sqrt(grains), that of a rate
//! 1/sqrt(events).
//!
//! # Compared with others
//! [B] names the coupling and does not work it out.

use serde::Serialize;

use crate::engine::hard::micro_state::MicroState;
use crate::engine::hard::simulation::Simulation;
use crate::math::Vec3;
use crate::measure::{DaughterRow, KernelRow};
use crate::particles::Particles;

/// The grains of a control volume after a macroscale step, and what happened in it.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Homogenized {
    /// Length of the step [s].
    #[serde(rename = "duration_s")]
    pub duration: f64,
    /// Grains.
    pub grains: u64,
    /// Their mass [kg].
    #[serde(rename = "mass_kg")]
    pub mass: f64,
    /// Grains over the volume [1/m³].
    #[serde(rename = "number_density_1_m3")]
    pub number_density: f64,
    /// Volume of the grains over that of the control volume.
    pub solid_fraction: f64,
    /// Mean radius [m].
    #[serde(rename = "mean_radius_m")]
    pub mean_radius: f64,
    /// n_f: (mean radius over that of the first state)³.
    pub growth: f64,
    /// Mean velocity by mass [m/s].
    #[serde(rename = "mean_velocity_m_s")]
    pub mean_velocity: Vec3,
    /// Mean of (v - V)(v - V)^T by mass [3, 3] [m²/s²].
    #[serde(rename = "velocity_covariance_m2_s2")]
    pub velocity_covariance: [[f64; 3]; 3],
    /// A third of its trace [m²/s²].
    #[serde(rename = "granular_temperature_m2_s2")]
    pub granular_temperature: f64,
    /// Mean temperature [K]: the one of all grains at the same thermal energy.
    #[serde(rename = "mean_temperature_K")]
    pub mean_temperature: f64,
    /// Kinetic energy [J].
    #[serde(rename = "kinetic_J")]
    pub kinetic: f64,
    /// Thermal energy m C T [J].
    #[serde(rename = "thermal_J")]
    pub thermal: f64,
    /// Momentum [kg m/s].
    #[serde(rename = "momentum_kg_m_s")]
    pub momentum: Vec3,
    /// Collisions per volume and time [1/(m³ s)].
    #[serde(rename = "collision_rate_1_m3_s")]
    pub collision_rate: f64,
    /// Merges per volume and time [1/(m³ s)].
    #[serde(rename = "merge_rate_1_m3_s")]
    pub merge_rate: f64,
    /// Grains that broke per volume and time [1/(m³ s)].
    #[serde(rename = "breakage_rate_1_m3_s")]
    pub breakage_rate: f64,
    /// Heat of all collisions in the step [J].
    #[serde(rename = "heat_J")]
    pub heat: f64,
    /// Of this, heat of reactions [J].
    #[serde(rename = "reaction_J")]
    pub reaction: f64,
    /// Heat given to gas and surroundings in the step [J].
    #[serde(rename = "cooled_J")]
    pub cooled: f64,
    /// Kernels of collision and aggregation by size.
    pub kernels: Vec<KernelRow>,
    /// What broke into what.
    pub daughters: Vec<DaughterRow>,
}

/// Means of the state at the end of a simulation of `duration` [s], and what happened in it.
pub(in crate::engine::hard) fn homogenize(
    simulation: &Simulation,
    state: &MicroState,
    duration: f64,
) -> Homogenized {
    let (grains, balance) = (&state.grains, simulation.balance());
    let system = &simulation.system().state;
    let volume = simulation.system().volume.volume();
    let (mass, momentum): (f64, Vec3) = (grains.mass.iter().sum(), simulation.momentum());
    let mean_velocity = momentum / mass;
    let velocity_covariance = covariance(grains, mean_velocity, mass);
    let number = grains.len() as f64;
    let mean_radius = grains.radius.iter().sum::<f64>() / number;
    let cubes: f64 = grains.radius.iter().map(|radius| radius.powi(3)).sum();
    let rate = |events: u64| events as f64 / (volume * duration);
    Homogenized {
        duration,
        grains: grains.len() as u64,
        mass,
        number_density: number / volume,
        solid_fraction: 4.0 / 3.0 * std::f64::consts::PI * cubes / volume,
        mean_radius,
        growth: (mean_radius / state.reference_radius).powi(3),
        mean_velocity,
        velocity_covariance,
        granular_temperature: (0..3).map(|axis| velocity_covariance[axis][axis]).sum::<f64>() / 3.0,
        mean_temperature: mean_temperature(state),
        kinetic: balance.stored.kinetic,
        thermal: balance.stored.thermal,
        momentum,
        collision_rate: rate(system.counts.collisions),
        merge_rate: rate(system.counts.merges),
        breakage_rate: rate(system.counts.fragmentations),
        heat: balance.heat,
        reaction: balance.reaction,
        cooled: balance.cooled,
        kernels: system.rates.kernel_rows(duration),
        daughters: system.rates.daughter_rows(),
    }
}

fn covariance(grains: &Particles, mean: Vec3, mass: f64) -> [[f64; 3]; 3] {
    let mut sum = [[0.0; 3]; 3];
    for (&velocity, &of_grain) in grains.velocity.iter().zip(&grains.mass) {
        let apart = velocity - mean;
        for (row, along) in sum.iter_mut().zip(apart.to_array()) {
            for (entry, across) in row.iter_mut().zip(apart.to_array()) {
                *entry += of_grain * (along * across);
            }
        }
    }
    sum.map(|row| row.map(|entry| entry / mass))
}

fn mean_temperature(state: &MicroState) -> f64 {
    let (grains, grown) = (&state.grains, &state.grown);
    let has_capacity = grown.iter().any(|grown| grown.heat_capacity > 0.0);
    let weight = |at: usize| if has_capacity { grown[at].heat_capacity } else { grains.mass[at] };
    let weights: f64 = (0..grains.len()).map(weight).sum();
    (0..grains.len()).map(|at| weight(at) * grains.temperature[at]).sum::<f64>() / weights
}
