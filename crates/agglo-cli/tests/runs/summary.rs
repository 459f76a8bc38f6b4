//! What `summary.json` holds.

use serde_json::Value;

use crate::common::{self, STAGGERED, VERLET, number, reference};

fn summary(scenario: &'static str) -> Value {
    common::summary(reference(scenario))
}

#[test]
fn every_quantity_is_there() {
    for (scenario, seed) in [(STAGGERED, 11), (VERLET, 14)] {
        let all = summary(scenario);
        assert_above!(number(&all, "wall_s"), 0.0);
        assert_at_least!(number(&all, "threads"), 1.0);
        assert_eq!((number(&all, "grains"), number(&all, "seed")), (200.0, f64::from(seed)));
        assert_above!(number(&all, "steps"), 100.0);
        assert_eq!(all["pulses"].as_array().unwrap().len(), 2);
        let clusters = &all["clusters"];
        let largest = number(clusters, "largest_fraction");
        assert_at_least!(number(clusters, "count"), 1.0);
        assert_above!(largest, 0.0);
        assert_at_most!(largest, 1.0);
        // 1 - x is exact to half a unit in the last place.
        assert_near!(number(&all, "dispersion_degree"), 1.0 - largest, 1e-15);
        assert_below!(number(&all, "momentum_drift_relative").abs(), 1e-12);
        assert_matches!(all["warnings"], Value::Object(_));
    }
}

/// Rays reflected or absorbed: what goes in comes out, per pulse, to rounding of some thousand sums.
#[test]
fn the_power_of_each_pulse_is_accounted_for() {
    for scenario in [STAGGERED, VERLET] {
        for pulse in summary(scenario)["pulses"].as_array().unwrap() {
            let input = number(pulse, "power_in_W");
            let parts = ["power_absorbed_W", "power_escaped_W", "power_truncated_W"];
            let output: f64 = parts.iter().map(|part| number(pulse, part)).sum();
            assert_eq!(number(pulse, "in_flight"), 0.0);
            assert!((output / input - 1.0).abs() < 1e-12, "{output} of {input} W");
            // 150 MPa over a disc of 0.4 m in water: p²/(ρ c) π R².
            let wanted = 150e6_f64.powi(2) / (1000.0 * 1500.0) * std::f64::consts::PI * 0.16;
            assert!((input / wanted - 1.0).abs() < 1e-12, "{input} instead of {wanted} W");
            let (rays, reflections) = (number(pulse, "rays"), number(pulse, "reflections"));
            assert_eq!(rays, 500.0);
            // Each ray left in the end: one leaving leg each.
            assert_eq!(number(pulse, "segments"), reflections + rays);
        }
    }
}

/// The channels add up to the drift that is stated.
#[test]
fn the_channels_of_energy_add_up_to_the_drift() {
    for scenario in [STAGGERED, VERLET] {
        let energy = &summary(scenario)["energy"];
        let sum = |keys: &[&str]| keys.iter().map(|key| number(energy, key)).sum::<f64>();
        let stores = sum(&[
            "kinetic_J",
            "rotational_J",
            "elastic_J",
            "tangential_spring_J",
            "bonds_J",
            "near_field_J",
            "fields_J",
        ]);
        let works = sum(&[
            "work_rays_J",
            "work_gravity_J",
            "work_fields_J",
            "work_volume_J",
            "work_custom_J",
            "work_walls_J",
        ]);
        let losses = sum(&[
            "lost_drag_J",
            "lost_contact_damping_J",
            "lost_friction_J",
            "lost_bond_damping_J",
            "lost_broken_bonds_J",
        ]);
        let drift = stores - number(energy, "at_start_J") - works + losses;
        // Differences of some hundred joules carry rounding of 1e-13 J.
        assert!((drift - number(energy, "drift_J")).abs() < 1e-10, "{drift}");
        // Bonds break and contacts open within steps: the scheme holds energy to about the step squared.
        assert_below!(number(energy, "drift_relative").abs(), 0.02);
    }
}
