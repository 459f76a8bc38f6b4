//! The table of sizes and the figures of scale, from the state of distinct figures.

use super::distinct_tests::{distinct, scenario};
use super::*;
use crate::constants::STEFAN_BOLTZMANN;
use crate::run::distinct::tables;

/// One grain each of 1, 2 and 9 primaries, of 0.5 kg, 0.75 kg and 2 kg of 3.25 kg; none of 4 to 7.
#[test]
fn sizes_of_hard_spheres_stand_under_their_names() {
    let folder = tempfile::tempdir().unwrap();
    let mut tables = tables(Hard::TABLES, folder.path());
    let mut job = distinct();
    // Two in the class of the largest, so that their number is no number of classes.
    let bulk = &mut job.simulation.system_mut().state.spheres.bulk;
    let double = bulk.iter_mut().find(|bulk| bulk.primaries == 2).unwrap();
    double.primaries = 11;
    job.record_rows(&mut tables).unwrap();
    tables.flush().unwrap();
    let text = std::fs::read_to_string(folder.path().join("series/sizes.csv")).unwrap();
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let rows: Vec<Vec<f64>> =
        lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
    let wanted = [
        [0.5, 1.0, 1.0, 1.0, 0.5, 0.5 / 3.25],
        [0.5, 2.0, 3.0, 0.0, 0.0, 0.0],
        [0.5, 4.0, 7.0, 0.0, 0.0, 0.0],
        [0.5, 8.0, 15.0, 2.0, 2.75, 2.75 / 3.25],
    ];
    let due = ["time_s", "lower_primaries", "upper_primaries", "grains", "mass_kg", "mass_fraction"];
    assert_eq!(names, due, "columns of series/sizes.csv");
    assert_eq!(rows.len(), wanted.len(), "rows of series/sizes.csv: {rows:?}");
    for (row, wanted) in rows.iter().zip(wanted) {
        for ((name, found), wanted) in due.iter().zip(row).zip(wanted) {
            assert_near!(*found, wanted, 1e-15, "series/sizes.csv: {name} in {row:?}");
        }
    }
}

/// The largest of (h + 4 σ ε T³) b/(3 k) over the grains: 4.5 mm at 290 K, though the hottest has 420 K.
#[test]
fn the_biot_number_stands_under_its_name() {
    let mut scenario = scenario();
    let material = scenario.materials.get_mut("grain").unwrap();
    material.emissivity = Some(0.5);
    material.thermal_conductivity = Some(toml::from_str::<Conducting>("of = \"2 W/(m K)\"").unwrap().of);
    let cooling = toml::from_str("convection = \"20 W/(m2 K)\"").unwrap();
    scenario.impact.as_mut().unwrap().cooling = Some(cooling);
    let Summary::Hard(summary) = distinct().summary(&scenario, 7.25) else { panic!("of hard spheres") };
    let biot = (20.0 + 4.0 * STEFAN_BOLTZMANN * 0.5 * 290_f64.powi(3)) * 4.5e-3 / (3.0 * 2.0);
    let tree = serde_json::to_value(&summary).unwrap();
    assert_close!(tree["biot_number"].as_f64().unwrap(), biot, 1e-12, "summary.json: biot_number");
    let table = summary.table();
    let (_, said) = table.iter().find(|(what, _)| what == "Biot number").unwrap();
    assert_eq!(said, "1.71e-2: one temperature for a grain holds");
}

/// A quantity by itself.
#[derive(serde::Deserialize)]
struct Conducting {
    of: crate::units::Conductivity,
}
