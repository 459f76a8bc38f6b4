//! Grains that are bonded by a table: the bits of those that the law bonds, where the table has the same pairs.

#![allow(clippy::unwrap_used, reason = "a test that cannot run has failed")]

#[macro_use]
extern crate agglo_testing;

use std::fs;
use std::ops::ControlFlow;
use std::path::Path;

use agglo::engine::soft::Simulation;
use agglo::run::{self, Ending, Progress};
use agglo::scenario::Scenario;

/// A block of twelve grains, bonded to their neighbors, that fly apart.
const ROW: &str = r#"
version = 1
time.end = "0.5 ms"
[engine.verlet]
[materials.glass]
density = "2500 kg/m3"
youngs_modulus = "10 MPa"
poisson_ratio = 0.2
[[grains]]
material = "glass"
size.constant.radius = "1 mm"
placement.list.positions = [
    ["0 mm", "0 mm", "0 mm"], ["0 mm", "0 mm", "2 mm"], ["0 mm", "2 mm", "0 mm"], ["0 mm", "2 mm", "2 mm"],
    ["2 mm", "0 mm", "0 mm"], ["2 mm", "0 mm", "2 mm"], ["2 mm", "2 mm", "0 mm"], ["2 mm", "2 mm", "2 mm"],
    ["4 mm", "0 mm", "0 mm"], ["4 mm", "0 mm", "2 mm"], ["4 mm", "2 mm", "0 mm"], ["4 mm", "2 mm", "2 mm"],
]
velocity_spread.maxwell.deviation = "0.5 m/s"
[contact.normal.hertz]
[bonds.beam]
youngs_modulus = "10 MPa"
tensile_strength = "50 kPa"
shear_strength = "50 kPa"
gap = 0.1
"#;

fn on(_: &Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// The scenario with bonds from a table beside it.
fn with_table() -> Scenario {
    Scenario::with_overrides(ROW, &["start.bonds=bonds.csv"]).unwrap_or_else(|error| panic!("{error}"))
}

fn started(scenario: &Scenario, base: &Path) -> Simulation {
    let start = run::start(scenario, base, &mut || ControlFlow::Continue(())).unwrap();
    Simulation::start(scenario, start).unwrap()
}

/// Pairs of the bonds at the start, as a table.
fn table(scenario: &Scenario) -> Vec<String> {
    let simulation = started(scenario, Path::new(""));
    simulation.system.network.bonds().iter().map(|bond| format!("{},{}", bond.ids[1], bond.ids[0])).collect()
}

fn series(dir: &Path) -> String {
    ["energy", "moments", "clusters"]
        .map(|name| fs::read_to_string(dir.join("series").join(name).with_extension("csv")).unwrap())
        .concat()
}

#[test]
fn bonds_of_a_table_are_those_that_the_law_makes() {
    let folder = tempfile::tempdir().unwrap();
    let by_law = Scenario::from_toml(ROW).unwrap();
    let mut pairs = table(&by_law);
    assert_eq!(pairs.len(), 2 * 4 + 2 * 3 + 2 * 3);
    pairs.reverse();
    fs::write(folder.path().join("bonds.csv"), format!("grain_i,grain_j\n{}\n", pairs.join("\n"))).unwrap();
    let [law, own, again] = ["law", "own", "again"].map(|name| folder.path().join(name));
    let ran = |scenario: &Scenario, base: &Path, dir: &Path| match run::run(scenario, base, dir, &mut on)
        .unwrap()
    {
        Ending::Finished(_) => series(dir),
        Ending::Interrupted(_) => panic!("nobody asked it to stop"),
    };
    let due = ran(&by_law, Path::new(""), &law);
    assert_eq!(ran(&with_table(), folder.path(), &own), due);
    let events = fs::read_to_string(own.join("events.csv")).unwrap();
    assert!(events.lines().count() > 3, "bonds break: {events}");
    // The folder has the table, and runs again from wherever it is.
    fs::remove_file(folder.path().join("bonds.csv")).unwrap();
    let moved = Scenario::load(&own.join("scenario.toml")).unwrap();
    assert_eq!(ran(&moved, &own, &again), due);
}

#[test]
fn only_the_pairs_of_the_table_are_bonded() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("bonds.csv"), "grain_i,grain_j\n11,0\n3,2\n").unwrap();
    let simulation = started(&with_table(), folder.path());
    let found: Vec<_> = simulation.system.network.bonds().iter().map(|bond| bond.ids).collect();
    assert_eq!((found, simulation.system.network.made_at_start()), (vec![[0, 11], [2, 3]], 2));
    fs::write(folder.path().join("bonds.csv"), "grain_i,grain_j\n").unwrap();
    assert_empty!(started(&with_table(), folder.path()).system.network.bonds());
    fs::write(folder.path().join("bonds.csv"), "grain_i,grain_j\n0,12\n").unwrap();
    let error =
        run::start(&with_table(), folder.path(), &mut || ControlFlow::Continue(())).unwrap_err().to_string();
    assert_contains!(&error, "start.bonds: ");
    assert_contains!(&error, "bonds.csv, line 2, column grain_j: `12` is no grain; they are 0 to 11");
}

#[test]
fn a_table_of_bonds_needs_a_law_that_holds_them() {
    let table = "start.bonds=bonds.csv";
    let strain = ROW.split("[bonds.beam]").next().unwrap().to_owned();
    let faults = Scenario::with_overrides(&strain, &[table]).unwrap_err().to_string();
    assert_contains!(faults, "start.bonds: is given, and there is no [bonds.beam] that says how bonds hold");
    let hard = agglo::scenario::template("form").unwrap().text;
    let faults = Scenario::with_overrides(hard, &[table]).unwrap_err().to_string();
    assert_contains!(faults, "start.bonds: belongs to soft spheres");
    let law = ROW.split("[contact.normal.hertz]").nth(1).unwrap();
    let from = ROW.split("[[grains]]").next().unwrap().to_owned() + law;
    let faults = Scenario::with_overrides(&from, &[table, "start.from=out"]).unwrap_err().to_string();
    assert_contains!(faults, "start.bonds: is given, but start.from takes the bonds of another run");
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("row.toml"), format!("{ROW}[start]\nbonds = \"bonds.csv\"\n")).unwrap();
    let error = Scenario::load(&folder.path().join("row.toml")).unwrap_err().to_string();
    assert_contains!(error, "start.bonds: cannot open \"bonds.csv\"");
}
