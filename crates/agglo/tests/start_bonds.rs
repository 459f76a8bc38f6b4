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
    assert_contains!(&error, "bonds.csv, line 2, column grain_j: there is no grain `12`");
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

/// A state with ids that are not 0, 1, 2 ... is one to go on from, to the same bits.
fn goes_on_after_a_save(scenario: &Scenario, mut simulation: Simulation) {
    let mut again = Simulation::resume(scenario, simulation.state()).unwrap();
    for one in [&mut simulation, &mut again] {
        (0..20).for_each(|_| one.step().unwrap());
    }
    assert_eq!(again.system.grains.id, simulation.system.grains.id);
    assert_eq!(again.system.grains.position, simulation.system.grains.position);
    let ids = &mut again.system.grains.id;
    ids[3] = ids[7];
    let twice = ids[7];
    let refused = Simulation::resume(scenario, again.state()).unwrap_err().to_string();
    assert_contains!(refused, &format!("two have the id {twice}"));
}

/// Grains of a table with ids of its own, out of their order: they, their bonds and their rest before the start are those of grains
/// that are numbered as they come.
#[test]
fn ids_of_a_table_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    let plain = started(&Scenario::from_toml(ROW).unwrap(), Path::new(""));
    let grains = &plain.system.grains;
    let name = |id: u32| 1000 - 7 * id;
    let row = |at: usize| {
        let (r, v) = (grains.position[at], grains.velocity[at]);
        format!("{},{},{},{},{},{},{}\n", name(grains.id[at]), r.x, r.y, r.z, v.x, v.y, v.z)
    };
    let rows: String = (0..grains.len()).map(row).collect();
    fs::write(folder.path().join("grains.csv"), format!("id,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s\n{rows}"))
        .unwrap();
    let bonds = plain.system.network.bonds();
    let pairs: String = bonds
        .iter()
        .map(|bond| format!("{},{}", name(bond.ids[0]), name(bond.ids[1])))
        .collect::<Vec<_>>()
        .join("\n");
    fs::write(folder.path().join("bonds.csv"), format!("grain_i,grain_j\n{pairs}")).unwrap();
    let listed = ROW.find("placement.list").unwrap()..ROW.find("velocity_spread").unwrap();
    let spread = ROW.find("velocity_spread").unwrap()..ROW.find("[contact").unwrap();
    let text = ROW.replace(&ROW[spread], "").replace(&ROW[listed], "placement.table.file = \"grains.csv\"\n");
    let relax = "start.relax={ speed = \"1 mm/s\", longest = \"10 ms\", damping_time = \"0.1 ms\" }";
    for more in [&["start.bonds=bonds.csv"][..], &["start.bonds=bonds.csv", relax]] {
        let scenario = Scenario::with_overrides(&text, more).unwrap_or_else(|error| panic!("{error}"));
        let own = started(&scenario, folder.path());
        for at in 0..grains.len() {
            let place = own.system.grains.id.iter().position(|id| *id == name(grains.id[at])).unwrap();
            assert_eq!(own.system.grains.velocity[place], grains.velocity[at], "grain {at} with {more:?}");
        }
        assert_eq!(own.system.network.made_at_start(), bonds.len());
        assert_all!(own.system.network.bonds().iter(), |bond| bond.ids[0] < bond.ids[1]
            && bond.ids[0] >= name(11));
        goes_on_after_a_save(&scenario, own);
    }
    fs::write(folder.path().join("grains.csv"), "id,x_m,y_m,z_m\n4,0,0,0\n4,1,0,0\n").unwrap();
    let scenario = Scenario::from_toml(&text).unwrap();
    let error =
        run::start(&scenario, folder.path(), &mut || ControlFlow::Continue(())).unwrap_err().to_string();
    assert_contains!(error, "two grains have the id 4; each has its own");
    let another = "[[grains]]\nmaterial = \"glass\"\nsize.constant.radius = \"1 mm\"\n\
                   placement.list.positions = [[\"9 m\", \"0 m\", \"0 m\"]]\n[contact";
    let scenario = Scenario::from_toml(&text.replace("[contact", another)).unwrap();
    let error =
        run::start(&scenario, folder.path(), &mut || ControlFlow::Continue(())).unwrap_err().to_string();
    assert_contains!(error, "either all grains have ids of a table's column `id`, or none");
}
