//! What a run of soft spheres came to.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::acoustics::{BeamPower, PulseCount};
use crate::engine::soft::{Absorbed, Pulses, Simulation, WallState};
use crate::ledger::Balance;
use crate::math::Vec3;
use crate::run::summary::{time_row, wall_row, warnings_row};
use crate::text::readable;

use super::together::dispersion_since;

/// What a run of soft spheres came to; `summary.json` holds the same.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct SoftSummary {
    /// Version of agglo.
    pub version: String,
    /// The scenario's title.
    pub title: String,
    /// Wall time [s], all sessions together.
    pub wall_s: f64,
    /// Simulated time [s].
    pub time_s: f64,
    /// Ends [s] that the run had before it went on; none where it never got another end.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub went_on_from_s: Vec<f64>,
    /// Accepted steps.
    pub steps: u64,
    /// Iterations of the staggered scheme.
    pub iterations: u64,
    /// Tries of the staggered scheme that were rejected.
    pub rejected_steps: u64,
    /// Grains.
    pub grains: usize,
    /// Threads.
    pub threads: usize,
    /// Seed.
    pub seed: u64,
    /// Quantities of each pulse.
    pub pulses: Vec<PulseQuantities>,
    /// Acoustic energy launched [J]: the powers of all pulses times how long their hits press.
    #[serde(rename = "acoustic_energy_J")]
    pub acoustic_energy: f64,
    /// Clusters at the start.
    pub clusters_start: Clusters,
    /// Clusters at the end.
    pub clusters: Clusters,
    /// 1 - mass of the largest cluster over the total, at the end.
    pub dispersion_degree: f64,
    /// 1 - mass of the largest cluster at the end over that of the largest one at the start.
    pub dispersion_degree_relative: f64,
    /// Bonds at the start.
    pub bonds_start: usize,
    /// Bonds at the end.
    pub bonds_end: usize,
    /// Part of the bonds at the start that are fewer at the end; null without bonds at the start.
    pub bonds_broken_fraction: Option<f64>,
    /// The ledger of energy.
    pub energy: EnergyQuantities,
    /// Part of the forces that the near field's cut-off left out at the start (root mean square); null without one.
    #[serde(default)]
    pub near_field_truncation: Option<f64>,
    /// Energy of the pairs within the near field's cut-off over that of all pairs, at the start; null without one.
    #[serde(default)]
    pub near_field_energy: Option<f64>,
    /// Momentum that impulses do not explain, over the grains' momenta.
    pub momentum_drift_relative: f64,
    /// Walls at the end, in the order of the scenario.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub walls: Vec<WallQuantities>,
    /// What left through absorbing faces; not there without any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub absorbed: Option<AbsorbedQuantities>,
    /// Warnings, with how often each came up.
    pub warnings: BTreeMap<String, u64>,
}

/// What left through absorbing faces since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AbsorbedQuantities {
    /// Grains.
    pub grains: u64,
    /// Their mass [kg].
    #[serde(rename = "mass_kg")]
    pub mass: f64,
}

/// Quantities of one pulse.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct PulseQuantities {
    /// Number of the beam.
    pub beam: u32,
    /// Start [s].
    pub start_s: f64,
    /// Rays launched.
    pub rays: u64,
    /// Reflections.
    pub reflections: u64,
    /// How many of them were at walls.
    #[serde(default)]
    pub reflections_at_walls: u64,
    /// Straight segments: reflections and the leaving leg of each ray that left.
    pub segments: u64,
    /// Longest chain of reflections of one ray.
    pub longest_chain: u64,
    /// Rays in flight at the end of the run.
    pub in_flight: u64,
    /// Power launched [W].
    #[serde(rename = "power_in_W")]
    pub power_in: f64,
    /// Power that grains took [W].
    #[serde(rename = "power_absorbed_W")]
    pub power_absorbed: f64,
    /// Power that walls took [W].
    #[serde(default, rename = "power_into_walls_W")]
    pub power_into_walls: f64,
    /// Power of rays that left for good [W].
    #[serde(rename = "power_escaped_W")]
    pub power_escaped: f64,
    /// Power of rays that were dropped [W].
    #[serde(rename = "power_truncated_W")]
    pub power_truncated: f64,
    /// Power of rays that had come as far as rays are followed [W].
    #[serde(default, rename = "power_cut_off_W")]
    pub power_cut_off: f64,
    /// Power times direction of all its rays, those that ended as they were then, over the power launched ([A] 39).
    pub beam_x: f64,
    /// The same along y.
    pub beam_y: f64,
    /// The same along z.
    pub beam_z: f64,
    /// Power of all its rays, likewise.
    pub beam_magnitude: f64,
}

impl PulseQuantities {
    fn new(count: &PulseCount, left: &BeamPower) -> Self {
        Self {
            beam: count.beam,
            start_s: count.start_s,
            rays: u64::from(count.rays),
            reflections: count.reflections,
            reflections_at_walls: count.reflections_at_walls,
            segments: count.segments,
            longest_chain: u64::from(count.longest_chain),
            in_flight: u64::from(count.in_flight),
            power_in: count.power_in,
            power_absorbed: count.power_absorbed,
            power_into_walls: count.power_into_walls,
            power_escaped: count.power_escaped,
            power_truncated: count.power_truncated,
            power_cut_off: count.power_cut_off,
            beam_x: left.flow.x,
            beam_y: left.flow.y,
            beam_z: left.flow.z,
            beam_magnitude: left.magnitude,
        }
    }

    fn of_all(pulses: &Pulses) -> Vec<Self> {
        let (counts, flight) = (pulses.counts(), pulses.flight());
        counts.iter().enumerate().map(|(place, count)| Self::new(count, &flight.pulse_power(place))).collect()
    }
}

/// What a wall came to.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct WallQuantities {
    /// Its name.
    pub name: String,
    /// Contacts with grains.
    pub contacts: u64,
    /// Force [N] of all grains on it along x, y and z.
    #[serde(rename = "force_N")]
    pub force: [f64; 3],
    /// Their torque [N m] about x, y and z through the point that it turns about.
    #[serde(rename = "torque_N_m")]
    pub torque: [f64; 3],
    /// Work [J] that it has put in since the start; negative where grains drove it.
    #[serde(rename = "work_J")]
    pub work: f64,
    /// Grains beyond a plane with an opening; not there for other walls.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub passed: Option<u64>,
    /// Their mass [kg]; likewise.
    #[serde(default, rename = "passed_kg", skip_serializing_if = "Option::is_none")]
    pub passed_mass: Option<f64>,
    /// Impulse [N s] of the rays that hit it along x, y and z, since the start.
    #[serde(default, rename = "sound_impulse_N_s")]
    pub sound_impulse: [f64; 3],
    /// Energy [J] of sound that went into it since the start.
    #[serde(default, rename = "sound_energy_J")]
    pub sound_energy: f64,
}

impl WallQuantities {
    pub(super) fn of_all(simulation: &Simulation) -> Vec<Self> {
        let states = simulation.system.wall_states(simulation.clock().time);
        let of = |(number, wall): (usize, WallState<'_>)| {
            let sound = simulation.pulses.given_to(number);
            Self {
                name: wall.name.to_owned(),
                contacts: u64::from(wall.contacts),
                force: wall.force.to_array(),
                torque: wall.torque.to_array(),
                work: wall.work,
                passed: wall.passed.map(|passed| passed.grains),
                passed_mass: wall.passed.map(|passed| passed.mass),
                sound_impulse: sound.impulse.to_array(),
                sound_energy: sound.energy,
            }
        };
        states.enumerate().map(of).collect()
    }

    /// In words.
    pub(super) fn told(&self) -> String {
        let force = Vec3::from(self.force).norm();
        let contacts = if self.contacts == 1 { "contact" } else { "contacts" };
        let passed = match (self.passed, self.passed_mass) {
            (Some(grains), Some(mass)) => {
                let word = if grains == 1 { "grain" } else { "grains" };
                format!(", {grains} {word} beyond it with {}", readable(mass, "kg"))
            }
            _ => String::new(),
        };
        let sound = if self.sound_energy > 0.0 || self.sound_impulse != [0.0; 3] {
            let [impulse, energy] = [Vec3::from(self.sound_impulse).norm(), self.sound_energy];
            format!("; of sound {} and {}", readable(impulse, "N s"), readable(energy, "J"))
        } else {
            String::new()
        };
        format!(
            "{} {contacts}, {} on it, {} put in{passed}{sound}",
            self.contacts,
            readable(force, "N"),
            readable(self.work, "J")
        )
    }
}

/// Clusters of grains that touch, are bonded, or are closer than the scenario's gap.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Clusters {
    /// How many, single grains included.
    pub count: usize,
    /// Mass of the largest over the total.
    pub largest_fraction: f64,
}

/// The ledger of energy with its drift.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct EnergyQuantities {
    /// The channels and the drift.
    #[serde(flatten)]
    pub balance: Balance,
    /// Largest part of all energy that was not explained at any look.
    #[serde(default)]
    pub unexplained_largest: f64,
    /// The part from which on the run warns, `limits.drift_warning`.
    #[serde(default)]
    pub unexplained_limit: f64,
}

impl EnergyQuantities {
    /// Whether so much is not explained that the run warned.
    pub fn is_alarming(&self) -> bool {
        self.unexplained_largest > self.unexplained_limit
    }
}

impl SoftSummary {
    /// Draws up the summary of a simulation that ended; it has the clusters of the start and of now.
    pub fn new(
        title: &str,
        seed: u64,
        simulation: &Simulation,
        [clusters_start, clusters]: [Clusters; 2],
        wall_s: f64,
    ) -> Self {
        let clock = simulation.clock();
        let network = &simulation.system.network;
        let (bonds_start, bonds_end) = (network.made_at_start(), network.bonds().len());
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            title: title.to_owned(),
            wall_s,
            time_s: clock.time,
            went_on_from_s: Vec::new(),
            steps: clock.step,
            iterations: clock.iterations,
            rejected_steps: clock.rejected,
            grains: simulation.system.grains.len(),
            threads: rayon::current_num_threads(),
            seed,
            pulses: PulseQuantities::of_all(&simulation.pulses),
            acoustic_energy: simulation.pulses.energy(),
            clusters_start,
            clusters,
            dispersion_degree: 1.0 - clusters.largest_fraction,
            dispersion_degree_relative: dispersion_since(&clusters_start, &clusters),
            bonds_start,
            bonds_end,
            bonds_broken_fraction: (bonds_start > 0).then(|| 1.0 - bonds_end as f64 / bonds_start as f64),
            energy: EnergyQuantities {
                balance: simulation.balance(),
                unexplained_largest: simulation.ledger.worst,
                unexplained_limit: simulation.drift_warning(),
            },
            near_field_truncation: simulation.truncation.map(|found| found.forces),
            near_field_energy: simulation.truncation.and_then(|found| found.energy),
            momentum_drift_relative: simulation.momentum_drift_relative(),
            walls: WallQuantities::of_all(simulation),
            absorbed: simulation
                .absorbed()
                .map(|Absorbed { grains, mass }| AbsorbedQuantities { grains, mass }),
            warnings: simulation.warnings.counts().clone(),
        }
    }

    /// The summary as rows of a table: what, how much.
    pub fn table(&self) -> Vec<(String, String)> {
        let mut rows = Vec::new();
        let mut row = |what: &str, quantity: String| rows.push((what.to_owned(), quantity));
        row("simulated time", time_row(self.time_s, self.steps, "steps"));
        row("wall time", wall_row(self.wall_s, self.threads));
        row("grains", self.grains.to_string());
        for (pulse, number) in self.pulses.iter().zip(1..) {
            let absorbed = 100.0 * pulse.power_absorbed / pulse.power_in;
            row(
                &format!("pulse {number}"),
                format!(
                    "{} rays, {} reflections, {} segments, {absorbed:.2} % of the power absorbed",
                    pulse.rays, pulse.reflections, pulse.segments
                ),
            );
        }
        if self.acoustic_energy > 0.0 {
            row("acoustic energy", format!("{} launched", readable(self.acoustic_energy, "J")));
        }
        if self.bonds_start > 0 {
            row("bonds", format!("{} of {} left", self.bonds_end, self.bonds_start));
        }
        let largest = |clusters: &Clusters| {
            format!(
                "{}, the largest with {:.2} % of the mass",
                clusters.count,
                100.0 * clusters.largest_fraction
            )
        };
        row("clusters at first", largest(&self.clusters_start));
        row("clusters", largest(&self.clusters));
        let [degree, since] = [self.dispersion_degree, self.dispersion_degree_relative];
        row("dispersion degree", format!("{degree:.4}; {since:.4} relative to the start"));
        if let Some(part) = self.near_field_truncation {
            let energy = self
                .near_field_energy
                .map_or(String::new(), |energy| format!("; the energy is {energy:.3} of that of all pairs"));
            row(
                "near-field cut-off",
                format!("left out {:.2} % of the forces at the start{energy}", 100.0 * part),
            );
        }
        for wall in &self.walls {
            row(&format!("wall {}", wall.name), wall.told());
        }
        if let Some(AbsorbedQuantities { grains, mass }) = self.absorbed {
            row("left the run", format!("{grains} grains, {}", readable(mass, "kg")));
        }
        row("energy drift", format!("{:.3e} of all energy", self.energy.balance.drift_relative));
        if self.energy.is_alarming() {
            row(
                "unexplained energy",
                format!(
                    "up to {:.3e} of all energy, above limits.drift_warning = {:e}: make the step smaller",
                    self.energy.unexplained_largest, self.energy.unexplained_limit
                ),
            );
        }
        row("momentum drift", format!("{:.3e} of all momentum", self.momentum_drift_relative));
        row("warnings", warnings_row(&self.warnings));
        rows
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::atomic::AtomicBool;

    use crate::run::{Ending, Summary, quiet};
    use crate::scenario::Scenario;

    /// Three pulses of p = 1 MPa through a disc of radius 1 mm in water, each pressing for 2 us:
    /// E = 3 · (1e6 Pa)² · pi (1e-3 m)²/(1.5e6 Pa s/m) · 2e-6 s = 12.57 uJ. The fourth is due after the end. Rays
    /// share the power, so their sum is rounded 50 times a pulse.
    #[test]
    fn acoustic_energy_is_power_times_duration() {
        let text = r#"
            version = 1
            time.end = "0.35 ms"
            [engine.verlet]
            [materials.glass]
            density = "2500 kg/m3"
            sound_speed = "5000 m/s"
            youngs_modulus = "1 MPa"
            poisson_ratio = 0.2
            [[grains]]
            material = "glass"
            size.constant.radius = "0.1 mm"
            placement.list.positions = [["0 m", "0 m", "0 m"]]
            [contact.normal.hertz]
            [acoustics.force.impulse]
            duration = "2 us"
            [[acoustics.beams]]
            start = ["-5 mm", "0 m", "0 m"]
            direction = [1.0, 0.0, 0.0]
            radius = "1 mm"
            rays = 50
            strength.pressure = "1 MPa"
            pulses = { first = "0.05 ms", period = "0.1 ms", count = 4 }
        "#;
        let scenario = Scenario::from_toml(text).unwrap_or_else(|faults| panic!("{faults}"));
        let ending = quiet(&scenario, Path::new(""), &AtomicBool::new(false)).unwrap();
        let Ending::Finished(Summary::Soft(summary)) = ending else { panic!("{ending:?}") };
        let by_hand = 3.0 * 1e12 * std::f64::consts::PI * 1e-6 / 1.5e6 * 2e-6;
        assert!((summary.acoustic_energy / by_hand - 1.0).abs() < 1e-13, "{}", summary.acoustic_energy);
        assert_eq!(summary.bonds_broken_fraction, None);
    }
}
