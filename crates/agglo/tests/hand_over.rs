//! Runs handed over and started: what is kept, and what stands in the files.

#![allow(clippy::unwrap_used, reason = "a test that cannot run or read its own scenario has failed")]

use std::ops::ControlFlow;
use std::path::Path;

use agglo::engine::{Start, soft};
use agglo::hand_over::{Grown, Options, hand_over};
use agglo::math::Vec3;
use agglo::measure::{Clusters, RigidMotion};
use agglo::particles::Particles;
use agglo::record::Sheet;
use agglo::scenario::{Scenario, template};
use agglo_testing::{
    assert_above, assert_all, assert_below, assert_close, assert_close_vector, assert_contains, assert_gone,
    assert_near, assert_near_vector, assert_true,
};

/// Hard grains that stick at every impact, of sizes over a factor of two; 40 of them in a tight box.
const HARD: &str = r#"
version = 1
title = "Sticky"
seed = 3
time.end = "3 ms"
[engine.event_driven]
[volume]
lower = ["-1 mm", "-1 mm", "-1 mm"]
upper = ["1 mm", "1 mm", "1 mm"]
[materials.grain]
density = "2000 kg/m3"
heat_capacity = "800 J/(kg K)"
[[grains]]
material = "grain"
temperature = "450 K"
[grains.size.uniform]
smallest = "0.1 mm"
largest = "0.2 mm"
[grains.placement.fill]
count = 40
[grains.velocity_spread.maxwell]
deviation = "0.3 m/s"
[impact.restitution.constant]
restitution = 0.0
"#;

fn run(text: &str, dir: &Path) {
    let scenario = Scenario::from_toml(text).unwrap_or_else(|faults| panic!("{faults}"));
    agglo::run::run(&scenario, Path::new(""), dir, &mut |_| ControlFlow::Continue(())).unwrap();
}

fn acoustic(settings: &[&str]) -> Scenario {
    Scenario::with_overrides(template("acoustic").unwrap().text, settings).unwrap()
}

fn started(scenario: &Path) -> Start {
    let base = scenario.parent().unwrap();
    let scenario = Scenario::load(scenario).unwrap();
    agglo::run::start(&scenario, base, &mut || ControlFlow::Continue(())).unwrap()
}

/// The grains of a table's agglomerate, by its number.
fn members(table: &Path, cluster: f64) -> Vec<u32> {
    let clusters = Sheet::read(table).unwrap().numbers("cluster").unwrap();
    (0..).zip(clusters).filter(|&(_, found)| found == cluster).map(|(at, _)| at).collect()
}

fn heat(grains: &Particles) -> f64 {
    (0..grains.len()).map(|at| grains.mass[at] * 800.0 * grains.temperature[at]).sum()
}

/// Each grown grain becomes its true primaries: their radii are those of the start, and together they have its mass, place,
/// velocity and temperature.
#[test]
fn grown_grains_become_their_own_primaries() {
    let folder = tempfile::tempdir().unwrap();
    let (dir, to) = (folder.path().join("grown"), folder.path().join("soft.toml"));
    run(HARD, &dir);
    let grown = Grown::read(&dir).unwrap();
    let before = grown.start().clone();
    assert_below!(before.grains.len(), 25, "grains that are left of 40");
    let scenario = acoustic(&["bonds.beam.gap=0.01"]);
    let options = Options { with: (&scenario, "acoustic"), porosity: 0.6, seed: Some(5) };
    let record = grown.hand_over(&options, &to).unwrap();
    let after = started(&to).grains;
    assert_eq!((after.len(), record.clusters), (40, before.grains.len()));
    let sorted = |mut radii: Vec<f64>| {
        radii.sort_by(f64::total_cmp);
        radii
    };
    let first = agglo::packing::place(grown.scenario(), Path::new("")).unwrap();
    assert_eq!(sorted(after.radius.clone()), sorted(first.radius), "radii of primaries and of the start");
    assert_eq!(record.packing.as_ref().unwrap().equal_primaries, 0);
    let (all, old) = ((0..40).collect::<Vec<u32>>(), (0..before.grains.len() as u32).collect::<Vec<u32>>());
    let table = Sheet::read(&record.clusters_table).unwrap();
    let place = |at: usize| {
        let along = |name: &str| table.numbers(name).unwrap()[at];
        Vec3::new(along("x_m"), along("y_m"), along("z_m"))
    };
    let places: Vec<Vec3> = (0..before.grains.len()).map(place).collect();
    let moved = places.iter().zip(&before.grains.position).filter(|(now, before)| now != before).count();
    assert_eq!((record.moved, record.spread), (moved, 1.0));
    assert_above!(moved, 1, "agglomerates that were moved: a box that is filled by a fifth has neighbors");
    for (at, &place) in places.iter().enumerate() {
        let members = members(&record.tables[0], f64::from(before.grains.id[at]));
        assert_eq!(members.len(), before.grown[at].primaries as usize);
        let body = RigidMotion::of(&after, &members);
        assert_close!(body.mass, before.grains.mass[at], 1e-12);
        assert_close_vector!(body.momentum, before.grains.velocity[at] * before.grains.mass[at], 1e-12);
        assert_near_vector!(body.center, place, 1e-15);
        assert_near!(body.angular_momentum.norm(), 0.0, 1e-15 * body.mass);
        let heats = members.iter().map(|&member| after.temperature[member as usize]);
        assert_all!(heats, |heat| heat == before.grains.temperature[at]);
    }
    let [a, b] = [RigidMotion::of(&before.grains, &old), RigidMotion::of(&after, &all)];
    assert_close!(b.kinetic_energy, a.kinetic_energy, 1e-12);
    assert_near_vector!(b.center, a.center, 1e-15);
    assert_close!(record.after.kinetic_J, a.kinetic_energy, 1e-12);
    assert_close!(record.before.thermal_J, heat(&before.grains), 1e-12);
    assert_close!(record.after.thermal_J, record.before.thermal_J, 1e-12);
}

/// The simulation that starts from it has as many clusters as there were grown grains, and each hangs together by bonds alone.
#[test]
fn each_agglomerate_is_one_piece_held_by_bonds() {
    let folder = tempfile::tempdir().unwrap();
    let (dir, to) = (folder.path().join("grown"), folder.path().join("soft.toml"));
    run(HARD, &dir);
    for (name, gap) in [("a", "0.001"), ("b", "0.5")] {
        let scenario = acoustic(&[&format!("bonds.beam.gap={gap}"), "measures.cluster_gap=0.05"]);
        let to = to.with_file_name(format!("{name}.toml"));
        let options = Options { with: (&scenario, "acoustic"), porosity: 0.7, seed: None };
        let record = Grown::read(&dir).unwrap().hand_over(&options, &to).unwrap();
        let soft = Scenario::load(&to).unwrap();
        let simulation = soft::Simulation::start(&soft, started(&to)).unwrap();
        let grains = &simulation.system.grains;
        let bonds = simulation.system.network.bonds();
        let edges = bonds.iter().map(|bond| <(u32, u32)>::from(bond.grains));
        let pieces = Clusters::new(&grains.mass, edges).count();
        assert_eq!(
            (pieces, Some(bonds.len())),
            (record.clusters, record.packing.unwrap().bonds),
            "gap {gap}"
        );
    }
}

/// There and back: the clusters are the grown grains again, with their primaries; of the motion what bodies as a whole have.
#[test]
fn there_and_back_again() {
    let folder = tempfile::tempdir().unwrap();
    let [dir, soft, dispersed, hard] =
        ["grown", "soft.toml", "dispersed", "hard.toml"].map(|name| folder.path().join(name));
    run(HARD, &dir);
    let settings = ["time.end=1 ns", "bonds.beam.gap=0.01", "acoustics.beams.0.rays=1"];
    let scenario = acoustic(&settings);
    let options = Options { with: (&scenario, "acoustic"), porosity: 0.6, seed: None };
    let there = Grown::read(&dir).unwrap().hand_over(&options, &soft).unwrap();
    let made = Scenario::load(&soft).unwrap();
    agglo::run::run(&made, folder.path(), &dispersed, &mut |_| ControlFlow::Continue(())).unwrap();
    let with = Scenario::from_toml(HARD).unwrap();
    let options = Options { with: (&with, "sticky.toml"), porosity: 0.6, seed: None };
    let back = Grown::read(&dispersed).unwrap().hand_over(&options, &hard).unwrap();
    assert_eq!((back.clusters, back.largest), (there.clusters, there.largest));
    let before = Grown::read(&dir).unwrap().start().clone();
    let after = started(&hard);
    let primaries = |start: &Start| {
        let mut all: Vec<u32> = start.grown.iter().map(|grown| grown.primaries).collect();
        all.sort_unstable();
        all
    };
    assert_eq!(primaries(&after), primaries(&before));
    let sum = |grains: &Particles| RigidMotion::of(grains, &(0..grains.len() as u32).collect::<Vec<_>>());
    let [a, b] = [&before.grains, &after.grains].map(sum);
    assert_close!(b.mass, a.mass, 1e-12);
    // Drag of water stops grains of 0.1 mm within some 4 ms by Stokes, and six times as fast at a Reynolds number of 150.
    assert_close_vector!(b.momentum, a.momentum, 5e-6);
    assert_close!(b.kinetic_energy, a.kinetic_energy, 5e-6);
    // Spheres of the box's size at its faces: whole ones need a larger one, by a radius at most and what neighbors moved.
    let [lower, upper] = back.volume_m.expect("a control volume that holds all spheres wholly");
    let edges = lower.iter().zip(upper).map(|(lower, upper)| upper - lower);
    assert_all!(edges, |edge| (2e-3..4e-3).contains(&edge));
}

/// Two materials: primaries keep their own, each in a table of its own.
#[test]
fn primaries_of_two_materials_keep_their_own() {
    let folder = tempfile::tempdir().unwrap();
    let (dir, to) = (folder.path().join("grown"), folder.path().join("soft.toml"));
    let group = HARD.split_once("[[grains]]").unwrap().1.split_once("[impact").unwrap().0;
    let other =
        group.replace("\"grain\"", "\"other\"").replace("count = 40", "count = 10").replace("450", "300");
    let text = HARD
        .replace(
            "[[grains]]",
            "[materials.other]\ndensity = \"5000 kg/m3\"\nheat_capacity = \"400 J/(kg K)\"\n[[grains]]",
        )
        .replace("count = 40", "count = 30")
        .replace("[impact", &format!("[[grains]]{other}[impact"));
    run(&text, &dir);
    let scenario = acoustic(&["bonds.beam.gap=0.01"]);
    let options = Options { with: (&scenario, "acoustic"), porosity: 0.6, seed: None };
    let record = Grown::read(&dir).unwrap().hand_over(&options, &to).unwrap();
    assert_eq!(record.tables.len(), 2);
    let after = started(&to).grains;
    let made = Scenario::load(&to).unwrap();
    let densities: Vec<f64> = made.materials.values().map(|material| material.density.si()).collect();
    assert_eq!(densities, [2000.0, 5000.0]);
    assert_eq!(after.material.iter().filter(|&&number| number == 1).count(), 10);
    assert_close!(record.after.mass_kg, record.before.mass_kg, 1e-12);
    // Without the tables of the run nobody knows the parts of a mixture.
    std::fs::remove_file(dir.join("genealogy.csv")).unwrap();
    let to = to.with_file_name("other.toml");
    let refused = Grown::read(&dir).unwrap().hand_over(&options, &to).unwrap_err().to_string();
    assert_contains!(refused, "is a mixture of several materials");
}

#[test]
fn what_cannot_be_handed_over_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let (dir, to) = (folder.path().join("grown"), folder.path().join("soft.toml"));
    let none = Grown::read(&dir).err().unwrap().to_string();
    assert_contains!(none, "grown");
    run(HARD, &dir);
    let refused = |scenario: &Scenario, porosity: f64, to: &Path| {
        let options = Options { with: (scenario, "it.toml"), porosity, seed: None };
        Grown::read(&dir).unwrap().hand_over(&options, to).unwrap_err().to_string()
    };
    let soft = acoustic(&[]);
    for porosity in [-0.1, 1.0, f64::NAN] {
        assert_contains!(refused(&soft, porosity, &to), "must be 0 or more and below 1");
    }
    assert_contains!(
        refused(&Scenario::from_toml(HARD).unwrap(), 0.5, &to),
        "is a run of hard spheres, and so is it.toml"
    );
    assert_contains!(refused(&acoustic(&["bonds.beam.gap=0"]), 0.5, &to), "bonds.beam.gap is 0");
    assert_contains!(refused(&soft, 0.5, &to.with_extension("csv")), "ends with .toml");
    assert_gone!(to);
    assert_gone!(to.with_file_name("soft-grains.csv"));
    hand_over(&dir, None, &to).unwrap();
    assert_contains!(refused(&soft, 0.5, &to), "is there already");
}

/// The same seed, the same bytes.
#[test]
fn a_hand_over_is_reproducible() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path().join("grown");
    run(HARD, &dir);
    let scenario = acoustic(&[]);
    let table = |name: &str, seed: u64| {
        let options = Options { with: (&scenario, "acoustic"), porosity: 0.6, seed: Some(seed) };
        let record = Grown::read(&dir).unwrap().hand_over(&options, &folder.path().join(name)).unwrap();
        std::fs::read_to_string(&record.tables[0]).unwrap()
    };
    let first = table("a.toml", 1);
    assert_eq!(first, table("b.toml", 1));
    assert_true!(first != table("c.toml", 2), "two seeds, one table: {}", first.lines().nth(1).unwrap());
}
