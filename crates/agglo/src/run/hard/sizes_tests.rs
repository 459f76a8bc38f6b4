//! The table of sizes and the quantities of scale, from the state of distinct quantities.

use super::distinct_tests::{distinct, scenario};
use super::*;
use crate::constants::STEFAN_BOLTZMANN;
use crate::measure::{BreakageRow, DaughterRow, KernelRow, SizeClasses, SizeRates};
use crate::record::columns::{Cell, Column};
use crate::run::distinct::{Named, assert_columns, tables as tables_in};

/// One grain each of 1, 2 and 9 primaries, of 0.5 kg, 0.75 kg and 2 kg of 3.25 kg; none of 4 to 7.
#[test]
fn sizes_of_hard_spheres_stand_under_their_names() {
    let folder = tempfile::tempdir().unwrap();
    let mut tables = tables_in(Hard::TABLES, folder.path());
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

fn assert_row<S>(table: &'static Table<S>, row: &S, wanted: &[Named<'_>]) {
    let value = |column: &Column<S>| match column.cell(row) {
        Cell::Number(value) => value,
        Cell::Count(count) => count as f64,
        Cell::Unknown => f64::NAN,
        Cell::Word(word) => panic!("{}: {word}", table.file),
    };
    let names: Vec<String> = table.names().into_iter().map(str::to_owned).collect();
    let values: Vec<f64> = table.columns.iter().map(value).collect();
    assert_columns(table.file, &names, &values, wanted, 0.0);
}

/// Quantities that are all different, each under its own name and bounds in their order.
#[test]
fn values_stand_under_their_columns() {
    let kernel = KernelRow {
        a: [4, 7],
        b: [2, 3],
        collisions: 101,
        merges: 102,
        breaking: 103,
        exposure: 104.5,
        collision_kernel: Some(105.5),
        aggregation_kernel: Some(106.5),
        breaking_kernel: Some(107.5),
        sticking_probability: Some(0.125),
    };
    let wanted = [
        ("a_lower_primaries", 4.0),
        ("a_upper_primaries", 7.0),
        ("b_lower_primaries", 2.0),
        ("b_upper_primaries", 3.0),
        ("collisions", 101.0),
        ("merges", 102.0),
        ("breaking_collisions", 103.0),
        ("exposure_s_m3", 104.5),
        ("collision_kernel_m3_s", 105.5),
        ("aggregation_kernel_m3_s", 106.5),
        ("breaking_kernel_m3_s", 107.5),
        ("sticking_probability", 0.125),
    ];
    assert_row(&tables::KERNELS, &kernel, &wanted);
    let breakage = BreakageRow {
        class: [8, 15],
        grains: 3,
        grain_time: 2.5,
        mean_primaries: Some(11.5),
        breakages: 5,
        breakage_rate: Some(0.75),
    };
    let wanted = [
        ("lower_primaries", 8.0),
        ("upper_primaries", 15.0),
        ("grains", 3.0),
        ("grain_time_s", 2.5),
        ("mean_primaries", 11.5),
        ("breakages", 5.0),
        ("breakage_rate_1_s", 0.75),
    ];
    assert_row(&tables::BREAKAGE, &breakage, &wanted);
    let daughter = DaughterRow {
        parent: [8, 15],
        daughter: [4, 7],
        breakages: 9,
        fragments: 20,
        primaries: 100,
        fragments_per_breakage: 2.5,
        mass_fraction: 0.625,
    };
    let wanted = [
        ("parent_lower_primaries", 8.0),
        ("parent_upper_primaries", 15.0),
        ("daughter_lower_primaries", 4.0),
        ("daughter_upper_primaries", 7.0),
        ("breakages", 9.0),
        ("fragments", 20.0),
        ("primaries", 100.0),
        ("fragments_per_breakage", 2.5),
        ("mass_fraction", 0.625),
    ];
    assert_row(&tables::DAUGHTERS, &daughter, &wanted);
}

/// Two singles that never met in 1 s have no sticking probability, and a kernel of 0.
#[test]
fn what_nothing_can_be_said_of_is_unknown() {
    let row = SizeRates::new(SizeClasses::default(), [1, 1].into_iter(), 1.0).kernel_rows(1.0).remove(0);
    let column =
        |name: &str| tables::KERNELS.columns.iter().find(|column| column.about.name == name).unwrap();
    assert_eq!(column("sticking_probability").cell(&row), Cell::Unknown);
    assert_eq!(column("collision_kernel_m3_s").cell(&row), Cell::Number(0.0));
}

/// The largest of (h + 4 σ ε T³) b/(3 k) over the grains: 4.5 mm at 290 K, though the hottest has 420 K.
#[test]
fn the_biot_number_stands_under_its_name() {
    let mut scenario = scenario();
    let material = scenario.materials.get_mut("grain").unwrap();
    material.emissivity = Some(0.5);
    material.thermal_conductivity = Some(toml::from_str::<Conducting>("of = \"2 W/(m K)\"").unwrap().of);
    let cooling = toml::from_str("convection = \"20 W/(m2 K)\"").unwrap();
    scenario.hard_mut().unwrap().impact.cooling = Some(cooling);
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
