//! How fast a pulse makes the grains, and how deep they then collide.

use std::f64::consts::PI;

use super::Plan;
use crate::acoustics::{Beam, RayForce, Strength};
use crate::contact::Normal;
use crate::particles::Material;
use crate::scenario::figures::{digits, readable};
use crate::scenario::types::{GrainGroup, Scenario};

/// What one pulse of a beam does to a grain of mean volume of a group.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Push {
    pub beam: usize,
    pub group: usize,
    /// Radius of the grain [m].
    pub radius: f64,
    /// Power and pressure of the beam [W, Pa].
    pub power: f64,
    pub pressure: f64,
    /// Force of one ray head-on [N], and how long it lasts [s].
    pub force: f64,
    pub duration: f64,
    /// Hits by rays in one pulse.
    pub hits: f64,
    /// Change of speed by one hit [m/s].
    pub per_hit: f64,
    /// Speed after one pulse [m/s]: hits from all sides, all hits the same way.
    pub speed: [f64; 2],
    /// Reynolds number at the lower speed.
    pub reynolds: f64,
    /// Overlap strain when two such grains meet at the lower speed, if a law of contact repels them.
    pub strain: Option<f64>,
}

/// One push for each beam and group of grains.
pub(super) fn all(scenario: &Scenario) -> Vec<Push> {
    let Some(acoustics) = &scenario.acoustics else { return Vec::new() };
    let mut pushes = Vec::new();
    for (number, beam) in acoustics.beams.iter().enumerate() {
        for (index, group) in scenario.grains.iter().enumerate() {
            if let Some(material) = scenario.materials.get(&group.material) {
                let mut push = of_beam(scenario, &acoustics.force, beam, group, material);
                (push.beam, push.group) = (number, index);
                pushes.push(push);
            }
        }
    }
    pushes
}

fn of_beam(
    scenario: &Scenario,
    law: &RayForce,
    beam: &Beam,
    group: &GrainGroup,
    material: &Material,
) -> Push {
    let medium = &scenario.medium;
    let (outer, sound) = (medium.density.si() * medium.sound_speed.si(), medium.sound_speed.si());
    let inner = material.density.si() * material.sound_speed.map_or(0.0, crate::units::Quantity::si);
    let reflected = ((inner - outer) / (inner + outer)).powi(2);
    let area = PI * beam.radius.si().powi(2);
    let (power, pressure) = power_and_pressure(beam.strength, area, outer);
    let (ray_power, ray_area) = (power / f64::from(beam.rays), area / f64::from(beam.rays));
    let volume = group.size.mean_volume();
    let radius = (0.75 * volume / PI).cbrt();
    // [A] 7, or the momentum of a ray that is partly reflected head-on.
    let printed = (ray_power * (1.0 - reflected) * inner * ray_area).sqrt();
    let (force, duration) = match law {
        RayForce::Impulse(law) => (printed, law.duration.si()),
        RayForce::PublishedStep(law) => (printed, law.step_fraction * radius / sound),
        RayForce::RadiationPressure(law) => (ray_power / sound * (1.0 + reflected), law.duration.si()),
    };
    let mass = material.density.si() * volume;
    let per_hit = force * duration / mass;
    // Mean-chord argument: a grain of an agglomerate as wide as the beam is hit by (r/R)^2 of the rays.
    let hits = f64::from(beam.rays) * (radius / beam.radius.si()).powi(2);
    let speed = [per_hit * hits.max(1.0).sqrt(), per_hit * hits.max(1.0)];
    let reynolds = medium.reynolds_number(radius, speed[0]).unwrap_or(f64::INFINITY);
    let strain = strain_at(scenario, group, material, [radius, mass, speed[0]]);
    Push {
        beam: 0,
        group: 0,
        radius,
        power,
        pressure,
        force,
        duration,
        hits,
        per_hit,
        speed,
        reynolds,
        strain,
    }
}

/// Power and pressure of a beam: power = p² A/(rho c).
pub(super) fn power_and_pressure(strength: Strength, area: f64, impedance: f64) -> (f64, f64) {
    match strength {
        Strength::Power(power) => (power.si(), (power.si() * impedance / area).sqrt()),
        Strength::Pressure(pressure) => (pressure.si().powi(2) * area / impedance, pressure.si()),
    }
}

/// Largest overlap strain of two equal grains [radius, mass, speed] that meet at a relative speed, without losses.
fn strain_at(scenario: &Scenario, group: &GrainGroup, material: &Material, grain: [f64; 3]) -> Option<f64> {
    let [radius, mass, speed] = grain;
    let reduced = 0.5 * mass;
    let overlap = match &scenario.contact.as_ref()?.normal {
        Normal::Hertz(_) => {
            let poisson = material.poisson_ratio?;
            let modulus = 0.5 * material.youngs_modulus?.si() / (1.0 - poisson * poisson);
            (15.0 * reduced * speed * speed / (16.0 * modulus * (0.5 * radius).sqrt())).powf(0.4)
        }
        Normal::Hooke(law) => speed * (reduced / law.stiffness.si()).sqrt(),
        Normal::StrainPower(law) => {
            // Energy of F = K (δ/2r)^p π r δ, the law at small overlap.
            let (p, stiffness) = (law.exponent, material.stiffness_at(group.temperature.si()));
            let energy = 0.5 * reduced * speed * speed;
            let product = energy * (p + 2.0) * (2.0 * radius).powf(p) / (stiffness * PI * radius);
            product.powf(1.0 / (p + 2.0))
        }
    };
    Some(overlap / (2.0 * radius))
}

/// Adds the figures of all pushes to a plan.
pub(super) fn describe(plan: &mut Plan, pushes: &[Push]) {
    for push in pushes {
        let beam = push.beam;
        if push.group == 0 {
            let value = format!("{}, {}", readable(push.power, "W"), readable(push.pressure, "Pa"));
            plan.figures.push((format!("beam {beam}"), value));
        }
        let who = format!("beam {beam} on grains {}", push.group);
        let hit = format!(
            "{} for {}, {} a hit, about {} hits a pulse",
            readable(push.force, "N"),
            readable(push.duration, "s"),
            readable(push.per_hit, "m/s"),
            digits(push.hits)
        );
        plan.figures.push((who, hit));
        let [low, high] = push.speed;
        let speed = format!("{} to {} after a pulse", readable(low, "m/s"), readable(high, "m/s"));
        plan.figures.push(("  speed".to_owned(), speed));
        if let Some(strain) = push.strain {
            let value = if strain < 1.0 { digits(strain) } else { "1: through one another".to_owned() };
            plan.figures
                .push(("  overlap strain".to_owned(), format!("{value} when two meet at the lower speed")));
        }
    }
}
