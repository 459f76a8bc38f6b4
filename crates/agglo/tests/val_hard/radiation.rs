//! Radiation between impacts, [B] 6.19 with h = 0, against Runge and Kutta's fourth order with many steps.

use agglo::constants::STEFAN_BOLTZMANN;
use agglo::math::Vec3;

use crate::support::{self, EVENTS, Gas, STEPS};

const EMISSIVITY: f64 = 0.8;
const SURROUNDINGS: f64 = 350.0;
const HEAT_CAPACITY: f64 = 700.0;
const DENSITY: f64 = 2_500.0;
const MATERIAL: &str = "heat_capacity = \"700 J/(kg K)\"\nemissivity = 0.8\n";
const COOLING: &str = "[impact.cooling]\nsurroundings = \"350 K\"\n";

/// Temperature [K] of a sphere after `duration` [s]; 20,000 steps of fourth order err by 1e-15 and less.
fn cooled(temperature: f64, radius: f64, duration: f64) -> f64 {
    let factor = 3.0 * STEFAN_BOLTZMANN * EMISSIVITY / (DENSITY * radius * HEAT_CAPACITY);
    let slope = |t: f64| -factor * (t.powi(4) - SURROUNDINGS.powi(4));
    let steps = 20_000;
    let dt = duration / f64::from(steps);
    (0..steps).fold(temperature, |t, _| {
        let a = slope(t);
        let b = slope(t + 0.5 * dt * a);
        let c = slope(t + 0.5 * dt * b);
        let d = slope(t + dt * c);
        t + dt / 6.0 * (a + 2.0 * b + 2.0 * c + d)
    })
}

/// Elastic impacts do not touch the temperature but cut the time between into pieces. 1e-9: some hundred pieces, each
/// solved to some 1e-14, and twenty thousand roundings of the reference.
#[test]
fn a_gas_cools_by_radiation_from_impact_to_impact() {
    let gas = Gas {
        count: 500,
        solid_fraction: 0.2,
        radius: 1e-4,
        material: MATERIAL,
        impact: &(support::ELASTIC.to_owned() + COOLING),
        ..Gas::default()
    };
    let hot = |at: usize| 300.0 + 3.0 * at as f64;
    let mut simulation = support::start(&gas.text(), |grains| {
        for (temperature, &id) in grains.temperature.iter_mut().zip(&grains.id) {
            *temperature = hot(id as usize);
        }
    });
    let end = 0.05;
    support::run_until(&mut simulation, end);
    assert_above!(support::impacts(&simulation), 20_000);
    let snapshot = simulation.snapshot().grains;
    for (id, &found) in snapshot.id.iter().zip(&snapshot.temperature).step_by(50) {
        let wanted = cooled(hot(*id as usize), gas.radius, end);
        assert!((found / wanted - 1.0).abs() < 1e-9, "{found} for {wanted}");
    }
}

/// Two spheres cool, meet, become one and warmer, and cool on. The impact comes up to 1 ns late step by step, while the
/// temperature falls by up to 2e5 K/s.
#[test]
fn two_spheres_cool_merge_and_cool_on() {
    let (radii, temperatures, speed) = ([1e-4, 1.5e-4], [2_000.0, 900.0], 12.0);
    let (way, end) = (2.5e-2, 6e-3);
    for (engine, tolerance) in [(EVENTS, 1e-10), (STEPS, 1e-6)] {
        let group = |radius: f64, x: f64, kelvin: f64| {
            format!(
                "[[grains]]\nmaterial = \"only\"\ntemperature = \"{kelvin:?} K\"\n\
                 size.constant.radius = \"{radius:?} m\"\nplacement.list.positions = [[\"{x:?} m\", \"0 m\", \"0 m\"]]\n"
            )
        };
        let text = format!(
            "version = 1\ntime.end = \"{end:?} s\"\n{engine}\n[volume]\nlower = [\"-1 m\", \"-1 m\", \"-1 m\"]\n\
             upper = [\"1 m\", \"1 m\", \"1 m\"]\nboundary = \"open\"\n\
             [materials.only]\ndensity = \"{DENSITY:?} kg/m3\"\n{MATERIAL}{}{}{}{COOLING}",
            group(radii[0], 0.0, temperatures[0]),
            group(radii[1], way + radii[0] + radii[1], temperatures[1]),
            support::STICKY
        );
        let mut simulation = support::start(&text, |grains| grains.velocity[0] = Vec3::AXES[0] * speed);
        support::finish(&mut simulation);
        let flown = way / speed;
        let masses = radii.map(|radius| DENSITY * support::ball(radius));
        let sum = masses[0] + masses[1];
        let lost = 0.5 * masses[0] * masses[1] / sum * speed * speed;
        let before = [0, 1].map(|k| cooled(temperatures[k], radii[k], flown));
        let mixed = (masses[0] * before[0] + masses[1] * before[1]) / sum + lost / (sum * HEAT_CAPACITY);
        let radius = (radii[0].powi(3) + radii[1].powi(3)).cbrt();
        let wanted = cooled(mixed, radius, end - flown);
        let found = simulation.snapshot().grains.temperature;
        assert_eq!(found.len(), 1);
        assert!((found[0] / wanted - 1.0).abs() < tolerance, "{} for {wanted}", found[0]);
        // What was radiated is what is missing.
        let cold = sum * HEAT_CAPACITY * wanted;
        let hot = HEAT_CAPACITY * (masses[0] * temperatures[0] + masses[1] * temperatures[1]);
        let cooled = simulation.balance().cooled;
        assert!((cooled / (hot + lost - cold) - 1.0).abs() < 1e3 * tolerance, "{cooled:e}");
        support::assert_ledger(&simulation);
    }
}
