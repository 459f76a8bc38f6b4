//! What runs of hard spheres write: their files agree with one another and with conservation.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::common::{
    Bench, EVENTS, STEPS, assert_same, bytes, checkpoints, complained, ended, number, reference, said,
    summary,
};

/// A table with words and numbers.
struct Table {
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    fn read(run: &Path, name: &str) -> Self {
        let text = fs::read_to_string(run.join(name)).unwrap();
        let words = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
        let mut lines = text.lines().map(words);
        Self { columns: lines.next().unwrap(), rows: lines.collect() }
    }

    fn words(&self, column: &str) -> Vec<&str> {
        let at = self.columns.iter().position(|name| name == column).unwrap();
        self.rows.iter().map(|row| row[at].as_str()).collect()
    }

    fn numbers(&self, column: &str) -> Vec<f64> {
        self.words(column).iter().map(|word| word.parse().unwrap()).collect()
    }
}

#[test]
fn every_file_is_there() {
    for scenario in [EVENTS, STEPS] {
        let files = bytes(reference(scenario));
        for table in ["grains", "energy", "momentum", "impacts", "steps", "sizes"] {
            assert!(files.contains_key(&format!("series/{table}.csv")), "no {table}");
        }
        for name in ["scenario.toml", "summary.json", "events.csv", "genealogy.csv", "frames/grains.pvd"] {
            assert!(files.contains_key(name), "no {name}");
        }
        for name in ["kernels.csv", "breakage.csv", "daughters.csv", "frames/grains_000000.vtp"] {
            assert!(files[name].len() > 50, "nothing in {name}");
        }
        let frame = String::from_utf8_lossy(&files["frames/grains_000001.vtp"]).into_owned();
        for field in ["\"id\"", "\"primaries\"", "\"temperature_K\"", "\"velocity_m_s\"", "\"radius_m\""] {
            assert!(frame.contains(field), "no {field} in a frame");
        }
    }
}

/// Turns are multiples of the interval; the engine that goes from impact to impact stops there. Where a frame is due at the same
/// time but for rounding, one stop serves both: 4 eps.
#[test]
fn rows_of_the_event_driven_engine_are_at_their_exact_times() {
    let times = Table::read(reference(EVENTS), "series/grains.csv").numbers("time_s");
    assert_eq!(times.len(), 201);
    for (turn, time) in times[..200].iter().enumerate() {
        let due = turn as f64 * 5e-6;
        assert!((time - due).abs() <= 4.0 * f64::EPSILON * due, "{time} {due}");
    }
}

/// The genealogy, replayed from single primaries, leads to the grains that are there at the end.
#[test]
fn the_genealogy_leads_from_primaries_to_the_last_grains() {
    for scenario in [EVENTS, STEPS] {
        let (run, all) = (reference(scenario), summary(reference(scenario)));
        let lines = Table::read(run, "genealogy.csv");
        let [events, parents, children, counts] =
            ["event", "parent", "child", "primaries"].map(|column| lines.numbers(column));
        let mut grains: BTreeMap<u64, f64> =
            (0..number(&all, "grains_start") as u64).map(|id| (id, 1.0)).collect();
        let mut at = 0;
        let mut replayed = 0;
        while at < events.len() {
            let end = at + events[at..].iter().take_while(|event| **event == events[at]).count();
            replayed += 1;
            assert_eq!(events[at], f64::from(replayed), "events are numbered from 1 on");
            let mut left: BTreeMap<u64, f64> = BTreeMap::new();
            for line in at..end {
                let parent = parents[line] as u64;
                *left.entry(parent).or_insert_with(|| grains.remove(&parent).unwrap()) -= counts[line];
            }
            assert!(left.values().all(|primaries| *primaries == 0.0), "event {}: {left:?}", events[at]);
            for line in at..end {
                *grains.entry(children[line] as u64).or_insert(0.0) += counts[line];
            }
            at = end;
        }
        assert_eq!(f64::from(replayed), number(&all, "events"));
        assert_eq!(grains.len() as f64, number(&all, "grains_end"));
        assert_eq!(grains.values().copied().fold(0.0, f64::max), number(&all, "largest_primaries"));
    }
}

/// Every event has its energies and partners; kinds are counted in the summary. The consistent balance: heat is what was
/// lost and set free, to the rounding of four sums.
#[test]
fn events_add_up_to_the_summary() {
    for scenario in [EVENTS, STEPS] {
        let (run, all) = (reference(scenario), summary(reference(scenario)));
        let events = Table::read(run, "events.csv");
        let count = |kind: &str| events.words("kind").iter().filter(|word| **word == kind).count() as f64;
        assert_eq!(count("merge"), number(&all, "merges"));
        // An impact may break both partners.
        let breaks = count("break");
        assert_above!(breaks, 10.0);
        assert_at_most!(breaks, number(&all, "fragmentations"));
        assert_eq!(count("merge") + breaks, number(&all, "events"));
        let (impacts, bounces) = (number(&all, "impacts"), number(&all, "bounces"));
        assert_eq!(impacts, bounces + number(&all, "events"));
        let times = events.numbers("time_s");
        assert_all!(times.windows(2), |pair| pair[0] <= pair[1]);
        let [normal, tangential, reaction, surface, heat] =
            ["lost_normal_J", "lost_friction_J", "reaction_J", "surface_J", "heat_J"]
                .map(|name| events.numbers(name));
        for at in 0..heat.len() {
            let given = normal[at] + tangential[at] + reaction[at] - surface[at];
            let size = normal[at] + tangential[at] + reaction[at] + surface[at];
            assert!((heat[at] - given).abs() <= 4.0 * f64::EPSILON * size, "event {at}");
        }
    }
}

/// Momentum and energy: what walls gave and impacts lost explains all but the rounding of some thousand impacts.
#[test]
fn books_balance() {
    for scenario in [EVENTS, STEPS] {
        let all = summary(reference(scenario));
        assert_below!(number(&all, "momentum_drift_relative"), 1e-13);
        let energy = &all["energy"];
        assert_below!(number(energy, "drift_relative").abs(), 1e-12);
        assert_below!(number(energy, "kinetic_drift_relative").abs(), 1e-12);
        assert_above!(number(energy, "surface_J"), 0.0);
        assert_above!(number(energy, "cooled_J"), 0.0);
        let walls = number(&all, "impacts_walls");
        assert_eq!(walls > 0.0, scenario == STEPS);
    }
}

/// Sizes: grains and mass of all classes are those of the summary, the mass that of the start.
#[test]
fn size_classes_hold_all_grains_and_all_mass() {
    for scenario in [EVENTS, STEPS] {
        let (run, all) = (reference(scenario), summary(reference(scenario)));
        let sizes = Table::read(run, "series/sizes.csv");
        let [times, grains, masses, parts] =
            ["time_s", "grains", "mass_kg", "mass_fraction"].map(|column| sizes.numbers(column));
        let sum = |values: &[f64], time: f64| -> f64 {
            values.iter().zip(&times).filter(|(_, at)| **at == time).map(|(value, _)| value).sum()
        };
        let last = *times.last().unwrap();
        assert_eq!(sum(&grains, last), number(&all, "grains_end"));
        assert_eq!(sum(&grains, 0.0), number(&all, "grains_start"));
        // Sums of some hundred masses round at 1e-14 or so.
        assert_close!(sum(&masses, last), sum(&masses, 0.0), 1e-12);
        assert_near!(sum(&parts, last), 1.0, 1e-12);
    }
}

/// The summary's quantities of growth follow from one another and are those of the last row.
#[test]
fn growth_in_the_summary_is_that_of_the_tables() {
    for scenario in [EVENTS, STEPS] {
        let (run, all) = (reference(scenario), summary(reference(scenario)));
        let table = Table::read(run, "series/grains.csv");
        let last = |column: &str| *table.numbers(column).last().unwrap();
        for (column, key) in [
            ("mean_radius_m", "mean_radius_m"),
            ("radius_ratio", "radius_ratio"),
            ("n_f", "n_f"),
            ("growth_deficit", "growth_deficit"),
            ("largest_radius_m", "largest_radius_m"),
            ("mean_temperature_K", "temperature_mean_K"),
            ("highest_temperature_K", "temperature_highest_K"),
            ("granular_temperature_m2_s2", "granular_temperature_m2_s2"),
        ] {
            // The reader of the summary is exact to a unit in the last place.
            assert!((last(column) / number(&all, key) - 1.0).abs() < 1e-15, "{key}");
        }
        // Equal grains of 0.4 mm at the start: b* = n^(1/3) 0.4 mm.
        assert_eq!(number(&all, "mean_radius_start_m"), 4e-4);
        let united = number(&all, "grains_start").cbrt() * 4e-4;
        assert_near!(number(&all, "growth_deficit"), 1.0 - number(&all, "mean_radius_m") / united, 1e-12);
        let ratio = number(&all, "radius_ratio");
        assert_close!(number(&all, "n_f"), ratio.powi(3), 1e-14);
        assert_above!(number(&all, "largest_radius_ratio"), ratio);
        assert_above!(ratio, 1.0);
        assert_below!(number(&all, "biot_number"), 0.1);
        assert_below!(number(&all, "largest_over_self_gravity"), 1e-6);
        assert_eq!(all["reynolds_number"], serde_json::Value::Null);
    }
}

/// Kernels: impacts of all classes are all impacts; fragments hold the primaries that broke.
#[test]
fn rates_by_size_add_up() {
    for scenario in [EVENTS, STEPS] {
        let (run, all) = (reference(scenario), summary(reference(scenario)));
        let kernels = Table::read(run, "kernels.csv");
        let sum = |table: &Table, column: &str| table.numbers(column).iter().sum::<f64>();
        assert_eq!(sum(&kernels, "collisions"), number(&all, "impacts"));
        assert_eq!(sum(&kernels, "merges"), number(&all, "merges"));
        let breakage = Table::read(run, "breakage.csv");
        assert_eq!(sum(&breakage, "breakages"), number(&all, "fragmentations"));
        assert_eq!(sum(&breakage, "grains"), number(&all, "grains_end"));
        let fragments = sum(&Table::read(run, "daughters.csv"), "fragments");
        let grown = number(&all, "grains_start") - number(&all, "merges");
        assert_eq!(grown + fragments - number(&all, "fragmentations"), number(&all, "grains_end"));
    }
}

#[test]
fn ctrl_c_stops_and_resume_ends_with_the_same_files_and_words() {
    for scenario in [EVENTS, STEPS] {
        let bench = Bench::with(scenario);
        bench.stopped_after(200, &[]);
        let done = said(&ended(bench.resume().output().unwrap(), 0));
        for words in
            ["left of", "mean radius", "largest grain", "bounces", "merges", "breakages", "temperature"]
        {
            assert!(done.contains(words), "no {words} in {done}");
        }
        assert_same(&bench.run(), reference(scenario));
        let again = said(&ended(bench.resume().output().unwrap(), 0));
        assert!(again.contains("has finished already") && again.contains("mean radius"), "{again}");
    }
}

/// Everything that meets sticks, in a volume that is too flat for what comes of it: the run ends with words, and the
/// last checkpoint is there.
#[test]
fn a_sphere_that_outgrows_its_volume_ends_the_run_with_its_name() {
    let scenario = r#"
version = 1
title = "flat"
time.end = "10 s"
engine.event_driven = {}
[volume]
lower = ["0 cm", "0 cm", "0 cm"]
upper = ["10 cm", "10 cm", "2 cm"]
[materials.wax]
density = "900 kg/m3"
[[grains]]
material = "wax"
size.constant.radius = "4 mm"
placement.fill.count = 150
velocity_spread.uniform.bounds = ["1 m/s", "1 m/s", "1 m/s"]
[impact.restitution.constant]
restitution = 0.0
[output]
checkpoints = "1 ms"
"#;
    let bench = Bench::with(scenario);
    let text = complained(&ended(bench.start(&[]).output().unwrap(), 1));
    for words in
        ["t = ", "grain ", "has grown to a diameter of", "use a larger volume", "last good checkpoint"]
    {
        assert!(text.contains(words), "no {words} in {text}");
    }
    assert_gone!(bench.run().join("summary.json"));
    let last = checkpoints(&bench.run()).last().unwrap().0;
    assert!(last > 10, "the last checkpoint is that of event {last}");
    // It fails again in the same way: a run is the same to the last bit.
    let again = complained(&ended(bench.resume().output().unwrap(), 1));
    assert_eq!(
        again.lines().find(|line| line.starts_with("error")),
        text.lines().find(|line| line.starts_with("error"))
    );
}
