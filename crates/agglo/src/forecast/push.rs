//! How fast a pulse makes the grains, and how deep they then collide: one pulse of each beam is sent through the
//! grains at their start, by the run's own rays and forces ([`FirstPulse`]).

use std::f64::consts::{PI, SQRT_2};
use std::time::Instant;

use super::{Plan, counts};
use crate::acoustics::{Beam, Strength};
use crate::contact::{ContactGeometry, ContactLaws, PairConstants, PairTable};
use crate::engine::soft::{FirstPulse, Settings};
use crate::math::Vec3;
use crate::particles::Particles;
use crate::scenario::Scenario;
use crate::text::{digits, readable};
use crate::units::Quantity;

/// More rays than this are not followed: as many carry the power of all.
const MOST_RAYS: u32 = 100_000;

/// What one pulse of a beam does to the grains.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Push {
    pub beam: usize,
    /// Pulses before the end, and the time [s] from one to the next.
    pub pulses: f64,
    pub period: f64,
    /// Power and pressure of the beam [W, Pa].
    pub power: f64,
    pub pressure: f64,
    /// How long a hit presses [s].
    pub duration: f64,
    /// Hits by rays in one pulse, and the part of the power that enters grains.
    pub hits: f64,
    pub absorbed: f64,
    /// How long its rays fly [s].
    pub flight_s: f64,
    /// Whether some fly on after that.
    pub flies_on: bool,
    /// Time on the clock [s] to follow them.
    pub wall_s: f64,
    /// Speeds that it gives the grains [m/s]: in the mean, of the fastest, of their common center.
    pub mean_speed: f64,
    pub fastest: f64,
    pub common_speed: f64,
    /// Speed at which two grains collide, root of the mean square [m/s].
    pub collision_speed: f64,
    /// Time [s] in which drag takes a grain's speed, in the mean; infinite without drag.
    pub stopping_s: f64,
    /// Reynolds number of the grain for which it is largest.
    pub reynolds: f64,
    /// Overlap strain when two like grains collide at that speed, if a law of contact repels them.
    pub strain: Option<f64>,
}

/// One push for each beam.
pub(super) fn all(scenario: &Scenario, grains: &Particles) -> Vec<Push> {
    let Some(acoustics) = scenario.acoustics() else { return Vec::new() };
    let Ok(settings) = Settings::try_from(scenario) else { return Vec::new() };
    let of = |(beam, number): (&Beam, usize)| {
        let area = PI * beam.radius.si().powi(2);
        let impedance = scenario.medium.density.si() * scenario.medium.sound_speed.si();
        let (power, pressure) = power_and_pressure(beam.strength, area, impedance);
        let began = Instant::now();
        // Each beam meets the same grains, which no pulse moves.
        let pulse = FirstPulse::of(&settings, grains, number, MOST_RAYS);
        let pulses = f64::from(counts::pulses_before(beam, scenario.time.end.si()));
        let wall_s = began.elapsed().as_secs_f64();
        let period = beam.pulses.period.map_or(0.0, Quantity::si);
        let push = Push { beam: number, pulses, period, power, pressure, wall_s, ..Push::default() };
        push.with_pulse(scenario, grains, &pulse, f64::from(beam.rays))
    };
    acoustics.beams.iter().zip(0..).map(of).collect()
}

/// Power and pressure of a beam: power = p² A/(rho c).
pub(super) fn power_and_pressure(strength: Strength, area: f64, impedance: f64) -> (f64, f64) {
    match strength {
        Strength::Power(power) => (power.si(), (power.si() * impedance / area).sqrt()),
        Strength::Pressure(pressure) => (pressure.si().powi(2) * area / impedance, pressure.si()),
    }
}

impl Push {
    /// Whether all its quantities are finite. A Reynolds number is not in a medium without viscosity.
    pub fn is_known(&self) -> bool {
        let speeds = [self.mean_speed, self.fastest, self.common_speed, self.collision_speed];
        let others = [self.power, self.pressure, self.duration, self.hits, self.absorbed, self.flight_s];
        speeds.iter().chain(&others).all(|quantity| quantity.is_finite())
            && self.strain.is_none_or(f64::is_finite)
            && !self.reynolds.is_nan()
    }

    fn with_pulse(self, scenario: &Scenario, grains: &Particles, pulse: &FirstPulse, rays: f64) -> Self {
        let count = &pulse.count;
        let mass: f64 = grains.mass.iter().sum();
        let weighted = grains.mass.iter().zip(&pulse.kicks);
        let common = weighted.map(|(mass, kick)| *kick * *mass).fold(Vec3::ZERO, |sum, part| sum + part)
            * (1.0 / mass);
        let part = 1.0 / grains.len() as f64;
        let speeds = || pulse.kicks.iter().map(|kick| kick.norm());
        let scatter: f64 = pulse.kicks.iter().map(|kick| part * (*kick - common).norm_squared()).sum();
        let reynolds =
            grains.radius.iter().zip(speeds()).map(|(radius, speed)| {
                scenario.medium.reynolds_number(*radius, speed).unwrap_or(f64::INFINITY)
            });
        let collision_speed = SQRT_2 * scatter.sqrt();
        Self {
            duration: pulse.duration_s,
            hits: count.reflections as f64 * rays / f64::from(count.rays),
            absorbed: count.power_absorbed / count.power_in,
            flight_s: pulse.flight_s,
            flies_on: count.in_flight > 0,
            mean_speed: part * speeds().sum::<f64>(),
            fastest: speeds().fold(0.0, f64::max),
            common_speed: common.norm(),
            collision_speed,
            stopping_s: stopping(scenario, grains),
            reynolds: reynolds.fold(0.0, f64::max),
            strain: deepest(scenario, grains, collision_speed),
            ..self
        }
    }

    /// How far [m] grains have come from one another at each of the later pulses, added up, if nothing but drag holds them:
    /// σ τ (1 - e^(-t/τ)) at t = T, 2 T ... (n - 1) T, with σ the scatter of their speeds.
    pub(super) fn spreads(&self) -> f64 {
        let (count, scatter) = (self.pulses, self.collision_speed / SQRT_2);
        let decay = self.period / self.stopping_s;
        if count <= 1.0 || self.period == 0.0 {
            0.0
        } else if decay == 0.0 {
            scatter * self.period * 0.5 * count * (count - 1.0)
        } else {
            scatter * self.stopping_s * (count - (-count * decay).exp_m1() / (-decay).exp_m1())
        }
    }
}

/// Time [s] in which drag takes a grain's speed, in the mean over the grains: by Stokes' law, the weakest of all.
fn stopping(scenario: &Scenario, grains: &Particles) -> f64 {
    let Some(drag) = scenario.soft().and_then(|soft| soft.fields.drag.as_ref()) else { return f64::INFINITY };
    let of = |(mass, radius): (&f64, &f64)| {
        let moved = mass + drag.added_mass(&scenario.medium, *radius);
        moved / drag.coefficient(&scenario.medium, *radius, Vec3::ZERO)
    };
    grains.mass.iter().zip(&grains.radius).map(of).sum::<f64>() / grains.len() as f64
}

/// Largest overlap strain of all materials, for grains as they are in the mean.
fn deepest(scenario: &Scenario, grains: &Particles, speed: f64) -> Option<f64> {
    let laws = scenario.soft()?.contact.as_ref()?;
    let pairs = PairTable::new(&scenario.materials, &scenario.mixtures, Some(laws));
    let of = |material: usize| {
        let all = || (0..grains.len()).filter(|&at| grains.material[at] as usize == material);
        let part = 1.0 / all().count() as f64;
        let mean = |column: &[f64]| all().map(|at| part * column[at]).sum::<f64>();
        let (radius, mass) = (mean(&grains.radius), mean(&grains.mass));
        let geometry =
            ContactGeometry::new([radius; 2], [mass; 2], [mean(&grains.contact_stiffness); 2], 2.0 * radius);
        let pair = pairs.of(material as u32, material as u32);
        (part <= 1.0).then(|| strain_at(laws, pair, &geometry, speed))
    };
    (0..scenario.materials.len()).filter_map(of).reduce(f64::max)
}

/// Largest overlap strain of two grains that collide at a relative speed, without losses; 1 where they pass through one
/// another.
fn strain_at(laws: &ContactLaws, pair: &PairConstants, geometry: &ContactGeometry, speed: f64) -> f64 {
    let energy = 0.5 * geometry.effective_mass * speed * speed;
    laws.deepest_overlap(pair, geometry, energy).map_or(1.0, |overlap| overlap / geometry.radius_sum)
}

/// Adds the quantities of all pushes to a plan.
pub(super) fn describe(plan: &mut Plan, pushes: &[Push]) {
    let mut row = |label: String, value: String| plan.quantities.push((label, value));
    for push in pushes {
        let Push { beam, power, pressure, .. } = *push;
        row(format!("beam {beam}"), format!("{}, {}", readable(power, "W"), readable(pressure, "Pa")));
        let flight = readable(push.flight_s, "s");
        let at_least = if push.flies_on { "more than " } else { "" };
        let what = format!(
            "{} hits, {} % of the power enters grains, rays fly for {at_least}{flight}",
            digits(push.hits.round()),
            digits(100.0 * push.absorbed)
        );
        row("  its first pulse".to_owned(), what);
        let [mean, fastest, common] =
            [push.mean_speed, push.fastest, push.common_speed].map(|speed| readable(speed, "m/s"));
        row(
            "  speeds after it".to_owned(),
            format!("{mean} in the mean, {fastest} at most; all together {common}"),
        );
        if let Some(strain) = push.strain {
            let value = if strain < 1.0 { digits(strain) } else { "1: through one another".to_owned() };
            let speed = readable(push.collision_speed, "m/s");
            row("  overlap strain".to_owned(), format!("{value} when two collide at {speed}"));
        }
    }
}
