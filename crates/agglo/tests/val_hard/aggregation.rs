//! Ballistic aggregation: whatever meets becomes one. G. F. Carnevale, Y. Pomeau and W. R. Young, Phys. Rev. Lett. 64, 2913
//! (1990): mean mass M ~ t^(6/5) in three dimensions if velocities do not depend on one another. E. Trizac and J.-P. Hansen, J.
//! Stat. Phys. 82, 1345 (1996): the exponent depends on density, since they do.

use std::f64::consts::PI;

use agglo::math::Vec3;
use agglo::math::rng::{Purpose, Stream};

use crate::common;
use crate::support::{self, Gas, Mean, STICKY};

/// Exponent ξ of M ~ t^ξ from a straight line through ln M over ln t between two mean masses, in primaries; `grains_at` says how
/// many are left at a time [s].
fn exponent(count: u32, [from, to]: [f64; 2], mut grains_at: impl FnMut(f64) -> usize) -> f64 {
    let (mut time, mut mass, mut points) = (1e-4_f64, 1.0, Vec::new());
    while mass < to {
        mass = f64::from(count) / grains_at(time) as f64;
        if mass >= from {
            points.push((time.ln(), mass.ln()));
        }
        time *= 1.02;
    }
    let n = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |sum, point| (sum.0 + point.0 / n, sum.1 + point.1 / n));
    let off = points.iter().map(|point| (point.0 - x, point.1 - y));
    let (above, below) = off.fold((0.0, 0.0), |sum, (x, y)| (sum.0 + x * y, sum.1 + x * x));
    above / below
}

/// The exponent of a whole simulation.
fn simulated(gas: &Gas<'_>, window: [f64; 2]) -> f64 {
    let mut simulation = gas.start();
    let found = exponent(gas.count, window, |time| {
        support::run_until(&mut simulation, time);
        simulation.grains()
    });
    support::assert_ledger(&simulation);
    found
}

/// The same gas without places: pairs are drawn at random and merge with a probability in proportion to π σ² |g|, so that nothing is
/// correlated (G. A. Bird, *Molecular Gas Dynamics and the Direct Simulation of Gas Flows*, 1994). It solves Boltzmann's
/// equation, the limit of no density.
struct Placeless {
    /// Masses in primaries, and velocities [m/s].
    grains: Vec<(f64, Vec3)>,
    radius: f64,
    volume: f64,
    time: f64,
    stream: Stream,
}

impl Placeless {
    fn start(gas: &Gas<'_>) -> Self {
        let mut stream = Stream::new(gas.seed, Purpose::Sampling, 7);
        let mut velocity = || Vec3::new(stream.normal(), stream.normal(), stream.normal());
        let grains = (0..gas.count).map(|_| (1.0, velocity())).collect();
        Self { grains, radius: gas.radius, volume: gas.edge().powi(3), time: 0.0, stream }
    }

    fn grains_at(&mut self, time: f64) -> usize {
        let radius = |mass: f64| self.radius * mass.cbrt();
        let mut largest = self.grains.iter().map(|grain| radius(grain.0)).fold(0.0, f64::max);
        // Merging makes no velocity larger.
        let fastest = self.grains.iter().map(|grain| grain.1.norm()).fold(0.0, f64::max);
        while self.grains.len() > 1 {
            let n = self.grains.len() as f64;
            let most = PI * 4.0 * largest * largest * 2.0 * fastest;
            let pairs = 0.5 * n * (n - 1.0);
            let wait = -(1.0 - self.stream.uniform()).ln() * self.volume / (pairs * most);
            if self.time + wait > time {
                // Waiting has no memory.
                break;
            }
            self.time += wait;
            let a = (n * self.stream.uniform()) as usize;
            let b = (a + 1 + ((n - 1.0) * self.stream.uniform()) as usize) % self.grains.len();
            let (one, other) = (self.grains[a], self.grains[b]);
            let reach = radius(one.0) + radius(other.0);
            let rate = PI * reach * reach * (one.1 - other.1).norm();
            if self.stream.uniform() * most < rate {
                let mass = one.0 + other.0;
                self.grains[a] = (mass, (one.1 * one.0 + other.1 * other.0) / mass);
                self.grains.swap_remove(b);
                largest = largest.max(radius(mass));
            }
        }
        self.time = time;
        self.grains.len()
    }
}

/// The mean over starts of an exponent.
fn mean(what: &str, gas: &Gas<'_>, window: [f64; 2], starts: u64, of: fn(&Gas<'_>, [f64; 2]) -> f64) -> Mean {
    let exponents: Vec<f64> = (1..=starts).map(|seed| of(&Gas { seed, ..*gas }, window)).collect();
    let found = Mean::of(&exponents);
    support::report(&format!(
        "aggregation, {what}, {} grains, solid fraction {}: mean mass {} to {} grows with the power {:.3} +- {:.3} of time \
         ({starts} starts)",
        gas.count, gas.solid_fraction, window[0], window[1], found.mean, found.error
    ));
    common::found(
        &format!("aggregation_{what}_{}", gas.count),
        &[("power", found.mean), ("error", found.error)],
    );
    found
}

fn placeless(gas: &Gas<'_>, window: [f64; 2]) -> f64 {
    let mut gas = Placeless::start(gas);
    exponent(gas.grains.len() as u32, window, |time| gas.grains_at(time))
}

#[test]
fn val_carnevale_1990_growth_of_the_mean_mass() {
    let gas = Gas { count: 6_000, solid_fraction: 0.01, impact: STICKY, ..Gas::default() };
    let window = [5.0, 60.0];
    let found = mean("event-driven", &gas, window, 8, simulated);
    let dilute = mean("Boltzmann", &gas, window, 8, placeless);
    assert!(found.error < 0.03, "{found:?}");
    assert!(found.apart(&dilute) < 3.0, "{found:?} {dilute:?}");
}

#[test]
#[ignore = "1.6 million merges"]
fn val_carnevale_1990_growth_at_several_densities() {
    for window in [[5.0, 20.0], [20.0, 200.0]] {
        let gas = Gas { count: 50_000, solid_fraction: 1e-4, impact: STICKY, ..Gas::default() };
        let dilute = mean("Boltzmann", &gas, window, 8, placeless);
        for solid_fraction in [1e-4, 1e-3, 0.01, 0.1, 0.2] {
            let gas = Gas { solid_fraction, ..gas };
            let found = mean("event-driven", &gas, window, 8, simulated);
            assert!(solid_fraction > 2e-3 || found.apart(&dilute) < 3.0, "{found:?} {dilute:?}");
        }
    }
}

/// Most memory that the process has used so far [bytes], where the system tells.
fn peak_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(1024.0 * line.split_whitespace().nth(1)?.parse::<f64>().ok()?)
}

/// The memory is that of the process: to be run alone.
#[test]
#[ignore = "a million grains"]
fn a_million_grains_merge_in_a_gigabyte() {
    let gas = Gas { count: 1_000_000, solid_fraction: 0.05, impact: STICKY, ..Gas::default() };
    let mut simulation = gas.start();
    simulation.system_mut().keeps_events = false;
    let mut time = 1e-3;
    let mut turns = agglo_testing::Turns::at_most(10_000_000, "grains to merge");
    while simulation.grains() > 1_000 {
        turns.take();
        support::run_until(&mut simulation, time);
        time *= 1.2;
    }
    support::assert_ledger(&simulation);
    let (merges, peak) = (simulation.system().state.counts.merges, peak_memory());
    support::report(&format!("a million grains: {merges} merges, {peak:?} bytes at the most"));
    assert_eq!(merges + simulation.grains() as u64, 1_000_000);
    assert!(peak.is_none_or(|bytes| bytes < 1e9), "{peak:?}");
}
