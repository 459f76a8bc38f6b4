//! Tests of the tables of hard spheres.

use super::*;
use crate::impact::ImpactEnergy;
use crate::particles::Row;

fn columns(table: usize) -> &'static [&'static str] {
    TABLES[table].1
}

/// The value of a column in a row that has as many values as its table has columns.
fn value(table: usize, row: &[f64], column: &str) -> f64 {
    assert_eq!(row.len(), columns(table).len());
    row[columns(table).iter().position(|name| *name == column).unwrap()]
}

#[test]
fn growth_stands_under_its_columns() {
    let growth = Growth {
        grains: 12,
        mean_radius: 3e-3,
        united_radius: 6e-3,
        largest_primaries: 40,
        largest_fraction: 0.25,
        mean_temperature: 500.0,
        mean_velocity: Vec3::new(1.0, 2.0, 3.0),
        granular_temperature: 7.0,
        ..Growth::default()
    };
    let row = grains(0.5, &growth, 1.5e-3);
    let wanted = [
        ("time_s", 0.5),
        ("grains", 12.0),
        ("mean_radius_m", 3e-3),
        ("radius_ratio", 2.0),
        ("n_f", 8.0),
        ("growth_deficit", 0.5),
        ("largest_primaries", 40.0),
        ("largest_fraction", 0.25),
        ("mean_temperature_K", 500.0),
        ("mean_vy_m_s", 2.0),
        ("granular_temperature_m2_s2", 7.0),
    ];
    for (column, wanted) in wanted {
        assert_eq!(value(0, &row, column), wanted, "{column}");
    }
}

#[test]
fn energies_stand_under_the_names_of_the_summary() {
    let mut balance = Balance::default();
    balance.stored.kinetic = 1.0;
    balance.stored.thermal = 2.0;
    (balance.normal, balance.tangential, balance.reaction, balance.surface) = (3.0, 4.0, 5.0, 6.0);
    (balance.heat, balance.unbalanced, balance.cooled) = (7.0, 8.0, 9.0);
    (balance.kinetic_drift_relative, balance.drift, balance.drift_relative) = (10.0, 11.0, 12.0);
    let row = energy(0.25, &balance);
    let named = serde_json::to_value(balance).unwrap();
    for column in &columns(1)[1..] {
        assert_eq!(value(1, &row, column), named[column].as_f64().unwrap(), "{column}");
    }
}

#[test]
fn counts_stand_under_their_columns() {
    let counts = Counts {
        collisions: 100,
        bounces: 60,
        merges: 30,
        fragmentations: 10,
        events: 38,
        guarded: 5,
        no_room: 4,
        overlapping: 3,
        walls: 2,
        iterations: 700,
        most_iterations: 17,
        not_converged: 1,
    };
    let row = impacts(1.0, &counts, 0.125);
    let named = serde_json::to_value(&counts).unwrap();
    for column in &columns(3)[1..columns(3).len() - 1] {
        let name = if *column == "fragmentations_without_room" { "no_room" } else { column };
        assert_eq!(value(3, &row, column), named[name].as_f64().unwrap(), "{column}");
    }
    assert_eq!(value(3, &row, "mean_free_time_s"), 0.125);
}

/// Of 20, then 10 grains, 30 impacts in 2 s: each grain takes part in 4, so it flies for half a second.
#[test]
fn the_mean_free_time_counts_both_partners() {
    let last = LastRow { time: 1.0, grains: 20.0, impacts: 5 };
    let now = LastRow { time: 3.0, grains: 10.0, impacts: 35 };
    assert_eq!(last.mean_free_time(&now), 15.0 * 2.0 / 60.0);
    assert_nan!(now.mean_free_time(&now));
}

/// Two singles, one of 5 and one of 7, of 1 kg a primary: 2 of 14 kg, none, 12 of 14 kg.
#[test]
fn sizes_have_a_row_a_class() {
    let mut now = Snapshot::default();
    for primaries in [1, 5, 1, 7_u32] {
        now.grains.push(Row { radius: 1.0, mass: f64::from(primaries), ..Row::default() });
        now.primaries.push(primaries);
    }
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("series")).unwrap();
    let layout = &TABLES[SIZES_TABLE..=SIZES_TABLE];
    let mut tables = crate::run::tables::Tables::create(layout, folder.path()).unwrap();
    for row in sizes(0.5, &now, &Growth::of(&now)) {
        tables.cells(0, &row).unwrap();
    }
    tables.sync().unwrap();
    let text = std::fs::read_to_string(folder.path().join("series/sizes.csv")).unwrap();
    let lines: Vec<&str> = text.lines().skip(1).collect();
    assert_eq!(
        lines,
        ["0.5,1,1,2,2,0.14285714285714285", "0.5,2,3,0,0,0", "0.5,4,7,2,12,0.8571428571428571"]
    );
}

#[test]
fn events_and_descents_fit_their_tables() {
    let folder = tempfile::tempdir().unwrap();
    let mut tables = crate::run::tables::Tables::create(&TABLES[EVENTS_TABLE..], folder.path()).unwrap();
    let merge = GrainEvent {
        number: 3,
        time: 0.125,
        kind: EventKind::Merge,
        grains: [4, 9],
        masses: [1e-6, 2.5e-6],
        speed: 2.0,
        restitution: 0.0,
        energy: ImpactEnergy { normal: 1.0, tangential: 2.0, reaction: 3.0, surface: 4.0, heat: 5.0 },
    };
    tables.cells(0, &event(&merge)).unwrap();
    tables.cells(0, &event(&GrainEvent { kind: EventKind::Break, ..merge })).unwrap();
    let line = Descent { event: 3, parent: 4, child: 9, primaries: 12, mass: 1e-6 };
    tables.cells(1, &descent(&line)).unwrap();
    tables.sync().unwrap();
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let events = read("events.csv");
    let lines: Vec<&str> = events.lines().collect();
    assert_eq!(lines[1], "3,0.125,merge,4,9,1e-6,2.5e-6,2,0,1,2,3,4,5");
    assert_starts!(lines[2], "3,0.125,break,");
    assert_eq!(read("genealogy.csv"), "event,parent,child,primaries,mass_kg\n3,4,9,12,1e-6\n");
}
