//! The summary of soft spheres: from a state of distinct quantities, by the names of its keys.

use super::distinct::*;
use super::*;
use crate::math::Vec3;
use crate::run::distinct::assert_quantities;

fn found() -> SoftSummary {
    let Summary::Soft(summary) = distinct().summary(&scenario(), 7.25) else { panic!("of soft spheres") };
    *summary
}

/// Everything but the pulses. Half a second; 8 bonds at the start of which 2 are left; three pulses' power for 2 ms.
#[test]
fn quantities_of_soft_spheres_stand_under_their_keys() {
    let mut tree = serde_json::to_value(found()).unwrap();
    tree["pulses"] = serde_json::json!([]);
    let ByHand { drift: [drift, _], .. } = by_hand();
    let energy = energies().map(|(name, joule)| (format!("energy.{name}"), joule));
    let largest = 0.6;
    let mut wanted: Vec<(&str, f64)> = energy.iter().map(|(name, joule)| (name.as_str(), *joule)).collect();
    wanted.extend([
        ("wall_s", 7.25),
        ("time_s", TIMES[0]),
        ("steps", 71.0),
        ("iterations", 311.0),
        ("rejected_steps", 13.0),
        ("grains", 7.0),
        ("seed", 21.0),
        ("acoustic_energy_J", pulses().iter().map(|pulse| pulse.power_in).sum::<f64>() * 2e-3),
        ("clusters_start.count", 9.0),
        ("clusters_start.largest_fraction", CLUSTERS_START.largest_fraction),
        ("clusters.count", 4.0),
        ("clusters.largest_fraction", largest),
        ("dispersion_degree", 1.0 - largest),
        ("dispersion_degree_relative", 1.0 - largest / CLUSTERS_START.largest_fraction),
        ("bonds_start", 8.0),
        ("energy.at_start_J", 1.0 + 0.6 + 0.35 + 0.4 + 0.15 + 0.45 + 0.55),
        ("energy.unexplained_largest", 0.0625),
        ("energy.unexplained_limit", 0.003),
        ("near_field_truncation", 0.21),
        ("near_field_energy", 0.23),
        ("bonds_end", 2.0),
        ("bonds_broken_fraction", 0.75),
        ("momentum_drift_relative", drift.norm() / 40.0),
        ("absorbed.grains", 19.0),
        ("absorbed.mass_kg", 0.375),
        ("warnings.one", 14.0),
        ("warnings.two", 16.0),
    ]);
    // As for the table of energy.
    assert_quantities("summary.json", &tree, &wanted, &["threads"], 1e-9);
    let (title, threads) = (tree["title"].as_str(), tree["threads"].as_u64());
    assert_eq!((title, threads), (Some("distinct"), Some(rayon::current_num_threads() as u64)));
}

/// Each pulse by itself: [A] 39 with the rays that it has in flight.
#[test]
fn quantities_of_pulses_stand_under_their_keys() {
    let summary = found();
    assert_eq!(summary.pulses.len(), 3, "pulses");
    for (at, (quantities, count)) in summary.pulses.iter().zip(pulses()).enumerate() {
        let ended = count.power_escaped + count.power_truncated + count.power_cut_off;
        let (mut flow, mut magnitude) = (count.flow_ended, ended);
        for (_, _, direction, _, power) in RAYS.iter().filter(|ray| ray.0 == at) {
            flow += Vec3::from(*direction) * *power;
            magnitude += power;
        }
        let wanted = [
            ("start_s", count.start_s),
            ("rays", f64::from(count.rays)),
            ("reflections", count.reflections as f64),
            ("reflections_at_walls", count.reflections_at_walls as f64),
            ("segments", count.segments as f64),
            ("longest_chain", f64::from(count.longest_chain)),
            ("power_in_W", count.power_in),
            ("power_absorbed_W", count.power_absorbed),
            ("power_into_walls_W", count.power_into_walls),
            ("power_escaped_W", count.power_escaped),
            ("power_truncated_W", count.power_truncated),
            ("power_cut_off_W", count.power_cut_off),
            ("beam_x", flow.x / count.power_in),
            ("beam_y", flow.y / count.power_in),
            ("beam_z", flow.z / count.power_in),
            ("beam_magnitude", magnitude / count.power_in),
        ];
        let place = format!("pulse {at} of summary.json");
        let tree = serde_json::to_value(quantities).unwrap();
        assert_quantities(&place, &tree, &wanted, &["beam", "in_flight"], 1e-13);
        assert_eq!(
            (quantities.beam, quantities.in_flight),
            (count.beam, u64::from(count.in_flight)),
            "{place}: beam, in_flight"
        );
    }
}

/// What is printed at the end, each row with its own quantities.
#[test]
fn rows_of_the_closing_table_have_their_own_quantities() {
    let table: Vec<(String, String)> = found().table();
    let rows: Vec<String> = table.iter().map(|(what, quantity)| format!("{what}: {quantity}")).collect();
    let threads = rayon::current_num_threads();
    let wall = format!("wall time: 7.25 s on {threads} threads");
    let wanted = [
        "simulated time: 500 ms in 71 steps",
        &wall,
        "grains: 7",
        "pulse 1: 107 rays, 11 reflections, 24 segments, 16.50 % of the power absorbed",
        "pulse 2: 207 rays, 44 reflections, 47 segments, 16.87 % of the power absorbed",
        "pulse 3: 307 rays, 99 reflections, 70 segments, 16.94 % of the power absorbed",
        "acoustic energy: 2.818 J launched",
        "bonds: 2 of 8 left",
        "clusters at first: 9, the largest with 80.00 % of the mass",
        "clusters: 4, the largest with 60.00 % of the mass",
        "dispersion degree: 0.4000; 0.2500 relative to the start",
        "near-field cut-off: left out 21.00 % of the forces at the start; the energy is 0.230 of that of all pairs",
        "left the run: 19 grains, 0.375 kg",
    ];
    assert_eq!(rows[..wanted.len()], wanted, "found on the left, due on the right");
    let last: Vec<&str> = table[wanted.len()..].iter().map(|(what, _)| what.as_str()).collect();
    assert_eq!(last, ["energy drift", "unexplained energy", "momentum drift", "warnings"]);
    let quantity = |what: &str| &table.iter().find(|(known, _)| known == what).unwrap().1;
    let [.., (_, drift)] = energies();
    assert_eq!(*quantity("energy drift"), format!("{drift:.3e} of all energy"));
    let unexplained =
        "up to 6.250e-2 of all energy, above limits.drift_warning = 3e-3: make the step smaller";
    assert_eq!(*quantity("unexplained energy"), unexplained);
    let momentum = by_hand().drift[0].norm() / 40.0;
    assert_eq!(*quantity("momentum drift"), format!("{momentum:.3e} of all momentum"));
    assert_eq!(*quantity("warnings"), "2 kinds, 30 in all");
}
