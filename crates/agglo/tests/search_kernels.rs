//! Kernels and breakage over the replicates of a study: the sums of those of its runs, wherever and in how many parts it ran.

#![allow(clippy::unwrap_used, reason = "a test that cannot run has failed")]

#[macro_use]
extern crate agglo_testing;

use std::collections::BTreeMap;
use std::fs;
use std::ops::ControlFlow;
use std::path::Path;

use agglo::search::Campaign;
use agglo::search::campaign::{self, CampaignEnding, CampaignProgress, Means, Part};
use agglo::search::kernels::ratio;

/// Grains that stick below a speed and break above another.
const STUDY: &str = r#"
version = 1
kernels = true
base.template = "reacting"
settings = [
    "time.end=4 ms", "grains.0.size.length_ratio.count=60", "grains.0.placement.fill.count=60",
    "output.size_classes=[1, 2, 4, 9]", "materials.grain.surface_energy=1e4 J/m2",
]
columns = ["grains_end", "impacts"]
ensemble.until.fixed.replicates = 3
[[parameters]]
name = "v"
key = "grains.0.velocity_spread.uniform.bounds.1"
range.choices = ["60 m/s", "150 m/s"]
[plan.grid]
"#;

fn campaign() -> Campaign {
    Campaign::from_toml(STUDY).unwrap_or_else(|error| panic!("{error}"))
}

fn on(_: &CampaignProgress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Rows of a table of numbers by the names of its columns; what is not there is not a number.
fn rows(file: &Path) -> Vec<BTreeMap<String, f64>> {
    let mut reader = csv::Reader::from_path(file).unwrap();
    let names: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let row = |record: csv::StringRecord| {
        let values = record.iter().map(|cell| cell.parse().unwrap_or(f64::NAN)).collect::<Vec<_>>();
        names.iter().cloned().zip(values).collect()
    };
    reader.records().map(|record| row(record.unwrap())).collect()
}

/// Columns of one row of each run, or 0 where it has none: of the row whose cells are those of `like` under these names.
fn of_runs(
    runs: &[Vec<BTreeMap<String, f64>>],
    like: &BTreeMap<String, f64>,
    keys: &[&str],
    name: &str,
) -> Vec<f64> {
    let is_like = |row: &&BTreeMap<String, f64>| keys.iter().all(|key| row[*key] == like[*key]);
    runs.iter().map(|rows| rows.iter().find(is_like).map_or(0.0, |row| row[name])).collect()
}

#[test]
fn rates_are_those_of_all_runs_together() {
    let folder = tempfile::tempdir().unwrap();
    let (campaign, out) = (campaign(), folder.path().join("study"));
    campaign::run(&campaign, Path::new(""), &out, Means::threads(2), &mut on).unwrap();
    let told = rows(&out.join("runs.csv"));
    assert_eq!(told.len(), 6);
    let heading = fs::read_to_string(out.join("runs.csv")).unwrap().lines().next().unwrap().to_owned();
    assert_eq!(heading, "evaluation,replicate,seed,grains_end,impacts");
    let problem = agglo::search::Problem::new(&campaign, Path::new("")).unwrap();
    let mut breakages = 0.0;
    for evaluation in [0_u64, 1] {
        let runs: Vec<_> = told.iter().filter(|row| row["evaluation"] == evaluation as f64).collect();
        let folders: Vec<_> =
            runs.iter().map(|row| folder.path().join(format!("run-{evaluation}-{}", row["seed"]))).collect();
        for (row, dir) in runs.iter().zip(&folders) {
            let candidate = agglo::search::Model::candidate(&problem, &[0.25 + 0.5 * evaluation as f64]);
            let scenario = agglo::scenario::Scenario {
                seed: row["seed"] as u64,
                ..problem.scenario(&candidate).unwrap()
            };
            agglo::run::run(&scenario, Path::new(""), dir, &mut |_| ControlFlow::Continue(())).unwrap();
        }
        let all = |name: &str| folders.iter().map(|dir| rows(&dir.join(name))).collect::<Vec<_>>();
        let of_it = |name: &str| {
            rows(&out.join(name))
                .into_iter()
                .filter(|row| row["evaluation"] == evaluation as f64)
                .collect::<Vec<_>>()
        };
        let (kernels, pairs) = (all("kernels.csv"), ["a_lower_primaries", "b_lower_primaries"]);
        let found = of_it("kernels.csv");
        let collisions: f64 = found.iter().map(|row| row["collisions"]).sum();
        assert_eq!(collisions, runs.iter().map(|row| row["impacts"]).sum::<f64>());
        for row in &found {
            let each = |name: &str| of_runs(&kernels, row, &pairs, name);
            let exposure = each("exposure_s_m3");
            assert_eq!((row["replicates"], row["exposure_s_m3"]), (3.0, exposure.iter().sum::<f64>()));
            for (events, rate) in [("collisions", "collision_kernel"), ("merges", "aggregation_kernel")] {
                let due = ratio(&each(events), &exposure);
                assert_eq!(row[events], each(events).iter().sum::<f64>());
                let error = row[&format!("{rate}_standard_error_m3_s")];
                assert_eq!(
                    (Some(row[&format!("{rate}_m3_s")]), (!error.is_nan()).then_some(error)),
                    (due.value, due.error)
                );
            }
        }
        let (rates, parts) = (all("breakage.csv"), all("daughters.csv"));
        for row in of_it("breakage.csv") {
            let each = |name: &str| of_runs(&rates, &row, &["lower_primaries"], name);
            assert_eq!(row["grain_time_s"], each("grain_time_s").iter().sum::<f64>());
            assert_eq!(row["breakages"], each("breakages").iter().sum::<f64>());
            assert_true!(row["mean_primaries"] >= row["lower_primaries"], "a mean of its class");
            breakages += row["breakages"];
        }
        for row in of_it("daughters.csv") {
            let keys = ["parent_lower_primaries", "daughter_lower_primaries"];
            let each = |name: &str| of_runs(&parts, &row, &keys, name);
            assert_eq!(row["fragments"], each("fragments").iter().sum::<f64>());
            assert_eq!(row["primaries"], each("primaries").iter().sum::<f64>());
        }
    }
    assert!(breakages > 5.0, "{breakages} breakages");
}

#[test]
fn parts_on_other_threads_give_the_same_tables() {
    let folder = tempfile::tempdir().unwrap();
    let campaign = campaign();
    let [whole, joined, first, second] =
        ["whole", "joined", "first", "second"].map(|name| folder.path().join(name));
    campaign::run(&campaign, Path::new(""), &whole, Means::threads(1), &mut on).unwrap();
    for (dir, part) in [(&first, "1/2"), (&second, "2/2")] {
        let part: Part = part.parse().unwrap();
        campaign::run_part(&campaign, Path::new(""), (dir, part), Means::threads(3), &mut on).unwrap();
    }
    let parts = [first, second];
    let ending = campaign::join(&parts, &joined, Means::threads(2), &mut on).unwrap();
    assert_matches!(ending, CampaignEnding::Finished(_));
    for name in ["kernels.csv", "breakage.csv", "daughters.csv", "measures.csv"] {
        assert_eq!(
            fs::read_to_string(joined.join(name)).unwrap(),
            fs::read_to_string(whole.join(name)).unwrap()
        );
    }
}

#[test]
fn kernels_of_soft_spheres_are_refused() {
    let text = STUDY.lines().filter(|line| !line.contains("grains.0") && !line.contains("surface_energy"));
    let text: Vec<&str> = text.collect();
    let text = text.join("\n").replace("reacting", "acoustic").replace("settings = [\n]", "");
    let text =
        text.replace("range.choices", "key = \"contact.damping.restitution.restitution\"\nrange.choices");
    let faults = Campaign::from_toml(&text).unwrap_err().to_string();
    assert_contains!(faults, "kernels are for hard spheres, and the base has soft ones");
}

#[test]
fn what_cannot_have_kernels_is_told_why() {
    let edited = |old: &str, new: &str| {
        assert_eq!(STUDY.matches(old).count(), 1, "{old}");
        let faults = Campaign::from_toml(&STUDY.replace(old, new)).unwrap_err();
        faults.to_string()
    };
    let varied = "output.size_classes.1\"\nrange.whole = { lower = 2, upper = 3 }";
    for (old, new, words) in [
        ("\"output.size_classes=[1, 2, 4, 9]\", ", "", "no output.size_classes"),
        ("[plan.grid]", "[method.random]\npoints = 4", "kernels are for studies, and this is a search"),
        ("[1, 2, 4, 9]", "[2, 4, 9]", "found 2 first; the first class begins at 1"),
        ("[1, 2, 4, 9]", "[1, 4, 4]", "found 4 after 4; each class begins above the one before"),
        (
            "grains.0.velocity_spread.uniform.bounds.1\"\nrange.choices = [\"60 m/s\", \"150 m/s\"]",
            varied,
            "is varied",
        ),
        ("[1, 2, 4, 9]", "[]", "found an empty list; the first class begins at 1"),
    ] {
        assert_contains!(edited(old, new), words);
    }
}
