//! The shipped cloud of reacting grains as a user runs it; the last frame against the genealogy; verbs.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use crate::common::{
    Bench, EVENTS, STEPS, agglo, bytes, checkpoints, complained, ended, number, reference, said, summary,
};

/// Rows of a table by the names of its columns.
fn rows(run: &Path, table: &str) -> Vec<BTreeMap<String, String>> {
    let text = fs::read_to_string(run.join(table)).unwrap();
    let mut lines = text.lines();
    let names: Vec<String> = lines.next().unwrap().split(',').map(str::to_owned).collect();
    let row = |line: &str| {
        let cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        assert_eq!(cells.len(), names.len(), "{line} in {table}");
        names.iter().cloned().zip(cells).collect()
    };
    lines.map(row).collect()
}

fn value<T: std::str::FromStr>(row: &BTreeMap<String, String>, column: &str) -> T {
    row[column].parse().unwrap_or_else(|_| panic!("{column} is {}", row[column]))
}

/// A column of whole numbers in the last frame.
fn last_frame(run: &Path, column: &str) -> Vec<u32> {
    let list = fs::read_to_string(run.join("frames/grains.pvd")).unwrap();
    let name = list.rsplit("file=\"").next().unwrap().split('"').next().unwrap();
    let file = fs::read(run.join("frames").join(name)).unwrap();
    let mark = b"<AppendedData encoding=\"raw\">";
    let end = file.windows(mark.len()).position(|window| window == mark).unwrap();
    let head = String::from_utf8(file[..end].to_vec()).unwrap();
    let array = head.split(&format!("Name=\"{column}\"")).nth(1).unwrap();
    let offset: usize = array.split("offset=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
    let start = end + file[end..].iter().position(|byte| *byte == b'_').unwrap() + 1 + offset;
    let length = u64::from_le_bytes(file[start..start + 8].try_into().unwrap()) as usize;
    let words = file[start + 8..start + 8 + length].chunks_exact(4);
    words.map(|word| u32::from_le_bytes(word.try_into().unwrap())).collect()
}

/// Primaries of all grains in the end, from the start and who became whom.
fn replayed(run: &Path, grains: u32) -> BTreeMap<u32, u32> {
    let mut primaries: BTreeMap<u32, u32> = (0..grains).map(|id| (id, 1)).collect();
    let lines = rows(run, "genealogy.csv");
    let mut at = 0;
    while at < lines.len() {
        let event: u64 = value(&lines[at], "event");
        let same = lines[at..].iter().take_while(|line| value::<u64>(line, "event") == event);
        let family: Vec<[u32; 3]> =
            same.map(|line| ["parent", "child", "primaries"].map(|column| value(line, column))).collect();
        at += family.len();
        let parents: BTreeSet<u32> = family.iter().map(|line| line[0]).collect();
        for parent in parents {
            let given: u32 = family.iter().filter(|line| line[0] == parent).map(|line| line[2]).sum();
            assert_eq!(primaries.remove(&parent), Some(given), "parent {parent} of event {event}");
        }
        for [_, child, part] in family {
            *primaries.entry(child).or_default() += part;
        }
    }
    primaries
}

fn assert_genealogy(run: &Path) {
    let (all, events) = (summary(run), rows(run, "events.csv"));
    let replayed = replayed(run, number(&all, "grains_start") as u32);
    let found: BTreeMap<u32, u32> =
        last_frame(run, "id").into_iter().zip(last_frame(run, "primaries")).collect();
    assert_eq!(replayed, found);
    assert_eq!(f64::from(*found.values().max().unwrap()), number(&all, "largest_primaries"));
    assert_eq!(events.len() as f64, number(&all, "events"));
    let numbers: Vec<usize> = events.iter().map(|row| value(row, "event")).collect();
    assert_eq!(numbers, (1..=events.len()).collect::<Vec<_>>());
    let mut descended: Vec<usize> =
        rows(run, "genealogy.csv").iter().map(|row| value(row, "event")).collect();
    descended.dedup();
    assert_eq!(descended, numbers, "each event has its lines of descent");
    let merges = events.iter().filter(|row| row["kind"] == "merge").count();
    assert_eq!(merges as f64, number(&all, "merges"));
}

/// Quantities against one another and against the last row of the tables.
fn assert_quantities(run: &Path, grains: f64) {
    let all = summary(run);
    let [ratio, n_f, pi] = ["radius_ratio", "n_f", "growth_deficit"].map(|key| number(&all, key));
    assert_close!(n_f, ratio.powi(3), 1e-14);
    let [mean, start] = ["mean_radius_m", "mean_radius_start_m"].map(|key| number(&all, key));
    assert_near!(ratio, mean / start, 2e-15 * ratio);
    // Equal spheres at the start: all the solid in one has the radius b n^(1/3). Sums of hundreds of terms.
    assert_near!(pi, 1.0 - mean / (start * grains.cbrt()), 1e-13);
    let largest = number(&all, "largest_radius_ratio");
    assert_near!(largest, number(&all, "largest_radius_m") / start, 2e-15 * largest);
    assert_close!(largest.powi(3), number(&all, "largest_primaries"), 1e-12);
    let [impacts, bounces, merges] = ["impacts", "bounces", "merges"].map(|key| number(&all, key));
    assert_above!(impacts, 100.0);
    assert_at_most!(bounces + merges, impacts);
    assert_above!(merges, 50.0);
    assert_eq!(number(&all, "grains_start"), grains);
    assert_eq!(number(&all, "grains_end"), number(&all, "grains"));
    let last = |table: &str, column: &str| value::<f64>(rows(run, table).last().unwrap(), column);
    for (table, column, key) in [
        ("series/grains.csv", "grains", "grains_end"),
        ("series/grains.csv", "radius_ratio", "radius_ratio"),
        ("series/grains.csv", "growth_deficit", "growth_deficit"),
        ("series/impacts.csv", "impacts", "impacts"),
        ("series/impacts.csv", "fragmentations", "fragmentations"),
        ("series/impacts.csv", "merges", "merges"),
        ("series/grains.csv", "time_s", "time_s"),
    ] {
        // The reader of the summary is exact to a unit in the last place.
        let wanted = number(&all, key);
        assert!((last(table, column) - wanted).abs() <= 4e-16 * wanted, "{key}");
    }
    assert_below!(number(&all["energy"], "drift_relative").abs(), 1e-12);
    assert_below!(number(&all, "momentum_drift_relative"), 1e-12);
}

#[test]
fn the_last_frame_is_what_the_genealogy_leads_to() {
    for scenario in [EVENTS, STEPS] {
        let run = reference(scenario);
        assert_genealogy(run);
        assert_quantities(run, number(&summary(run), "grains_start"));
    }
}

/// The sample problem as a user runs it.
#[test]
fn the_shipped_reacting_cloud() {
    let text = fs::read_to_string(
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/reacting-agglomeration.toml"),
    );
    let bench = Bench::with(&text.unwrap());
    let done = ended(bench.start(&[]).output().unwrap(), 0);
    let run = bench.run();
    assert!(said(&done).contains("left of 1000") && said(&done).contains("no warnings"), "{}", said(&done));
    assert!(complained(&done).is_empty(), "{}", complained(&done));
    for file in ["scenario.toml", "summary.json", "events.csv", "genealogy.csv", "frames/grains.pvd"] {
        assert!(run.join(file).is_file(), "no {file}");
    }
    assert_quantities(&run, 1000.0);
    assert_genealogy(&run);
    // 10 ms in rows of 50 us and in frames of 0.25 ms, with those of the start.
    for table in ["grains", "energy", "momentum", "impacts", "steps"] {
        assert_eq!(rows(&run, &format!("series/{table}.csv")).len(), 201, "{table}");
    }
    let frames = bytes(&run.join("frames"));
    assert_eq!(frames.keys().filter(|name| name.contains(".vtp")).count(), 41);
    assert_filled!(checkpoints(&run));
    // An independent reference has 2.54 as the mean of twelve starts, each about 0.14 from it.
    assert_near!(number(&summary(&run), "radius_ratio"), 2.54, 5.0 * 0.14);
}

/// What the pages and plans of hard spheres say can be had by their words.
#[test]
fn verbs_know_hard_spheres() {
    for word in ["event_driven", "time_stepped", "hardness", "merge", "fragmentation", "cooling", "no_slip"] {
        assert!(said(&ended(agglo(&["explain", word]), 0)).contains("# "), "{word}");
    }
    let bench = Bench::with(&said(&ended(agglo(&["new", "reacting"]), 0)));
    let plan = said(&ended(agglo(&["check", &bench.scenario()]), 0));
    assert!(plan.contains("is valid") && plan.contains("impacts"), "{plan}");
    let text = said(&ended(agglo(&["new", "reacting-published"]), 0));
    let bench = Bench::with(&text);
    let plan = said(&ended(agglo(&["check", &bench.scenario()]), 0));
    assert!(plan.contains("published"), "{plan}");
}
