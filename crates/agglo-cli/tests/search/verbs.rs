//! What the verbs say of searches and studies.

use crate::bench::{Bench, SEARCH, reference};
use crate::common::{agglo, complained, ended, said};

#[test]
fn check_says_what_a_search_would_do() {
    let bench = Bench::with(SEARCH);
    let text = said(&ended(agglo(&["check", &bench.file("campaign.toml")]), 0));
    let wanted = [
        "is valid",
        "20 m/s to 200 m/s, logarithmic  grains.0.velocity_spread.uniform.bounds.0",
        "100 kPa to 1 MPa",
        "published_genetic",
        "2 to 8, until one more moves the mean cost by less than 0.002 of itself; the same for all",
        // 20 strings, three times 14; two to eight replicates each, four for each of three again and for the best of them.
        "at most 62, then the best 3 from fresh replicates, then the best of those once more",
        "140 to 512",
        "time of all",
        "impacts",
    ];
    for words in wanted {
        assert!(text.contains(words), "no \"{words}\" in:\n{text}");
    }
}

#[test]
fn each_file_has_its_verb() {
    let bench = Bench::with(SEARCH);
    let refused = |verb: &str, file: &str| complained(&ended(agglo(&[verb, &bench.file(file)]), 2));
    let text = refused("run", "campaign.toml");
    assert!(text.contains("is a search") && text.contains("`agglo search "), "{text}");
    let text = refused("study", "campaign.toml");
    assert!(text.contains("is a search") && text.contains("`agglo search "), "{text}");
    let text = refused("search", "scenario.toml");
    assert!(text.contains("is a scenario") && text.contains("`agglo run "), "{text}");
}

#[test]
fn the_closing_table_and_the_folder_tell_the_best() {
    let bench = reference();
    let summary = bench.summary();
    let best = &summary["best"];
    assert_eq!((&best["replicates"], &best["is_confirmed"]), (&4.into(), &true.into()));
    let cost = best["cost"].as_f64().unwrap();
    // Soft and fast grains stick: anything is better than what a cloud that does not stick has, 1 - 400^(-1/3) = 0.864.
    assert!(cost < 0.8, "{cost}");
    let ranked = bench.rows("best.csv");
    assert_eq!(ranked.len(), 3);
    assert_there!(bench.out().join("best/summary.json"));
    assert_there!(bench.out().join("pictures/cost.svg"));
    // The run in best/ is the first of its fresh replicates.
    let evaluation = best["evaluation"].to_string();
    let first =
        bench.rows("runs.csv").into_iter().find(|row| row.starts_with(&format!("{evaluation},0,"))).unwrap();
    let run: serde_json::Value =
        serde_json::from_slice(&std::fs::read(bench.out().join("best/summary.json")).unwrap()).unwrap();
    assert_eq!(
        first.split(',').nth(3).unwrap().parse::<f64>().unwrap(),
        run["growth_deficit"].as_f64().unwrap()
    );
    assert_eq!(first.split(',').nth(2).unwrap(), run["seed"].to_string());
    // And so is a run of the scenario with the settings that the summary names.
    let mut arguments = vec!["run".to_owned(), bench.out().join("scenario.toml").display().to_string()];
    let other = tempfile::tempdir().unwrap();
    arguments.extend(["-o".to_owned(), other.path().join("run").display().to_string()]);
    arguments.extend(["--seed".to_owned(), best["replicate_seed"].to_string()]);
    for setting in best["settings"].as_array().unwrap() {
        arguments.extend(["--set".to_owned(), setting.as_str().unwrap().to_owned()]);
    }
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    ended(agglo(&arguments), 0);
    let again: serde_json::Value =
        serde_json::from_slice(&std::fs::read(other.path().join("run/summary.json")).unwrap()).unwrap();
    assert_eq!(again["growth_deficit"], run["growth_deficit"]);
}

#[test]
fn a_study_runs_its_plan() {
    let method = SEARCH.find("[method").unwrap();
    let study = SEARCH[..method].to_owned() + "[plan.grid]\nlevels = 3\n";
    let bench = Bench::with(&study);
    let text = said(&bench.ends("study", &["--set", "ensemble.until={ fixed = { replicates = 2 } }"], 0));
    assert!(text.contains("9 in 1 batch"), "{text}");
    assert_eq!((bench.rows("evaluations.csv").len(), bench.rows("runs.csv").len()), (9, 18));
    assert_there!(bench.out().join("measures.csv"));
    assert_gone!(bench.out().join("best"));
    let text = complained(&ended(agglo(&["search", &bench.file("campaign.toml")]), 2));
    assert!(text.contains("is a study") && text.contains("`agglo study "), "{text}");
}

/// A study without objectives measures; it makes nothing small, and has no best.
#[test]
fn a_study_without_objectives_measures() {
    let method = SEARCH.find("[method").unwrap();
    let study = SEARCH[..method].replace("[[objectives]]\nminimize = \"growth_deficit\"\n", "")
        + "[plan.grid]\nlevels = 2\n";
    let study = study.replacen("seed = 5\n", "seed = 5\ncolumns = [\"radius_ratio\", \"impacts\"]\n", 1);
    let bench = Bench::with(&study);
    let checked = said(&ended(agglo(&["check", &bench.file("campaign.toml")]), 0));
    assert!(checked.contains("radius_ratio, impacts") && checked.contains("measured"), "{checked}");
    assert!(!checked.contains("to be small"), "{checked}");
    let text = said(&bench.ends("study", &["--set", "ensemble.until={ fixed = { replicates = 2 } }"], 0));
    assert!(text.contains("search 4 of 4") && !text.contains("best") && !text.contains("smallest"), "{text}");
    let header = std::fs::read_to_string(bench.out().join("evaluations.csv")).unwrap();
    let header = header.lines().next().unwrap();
    let once = header.split(',').filter(|name| *name == "radius_ratio").count();
    assert!(once == 1 && !header.contains("cost"), "{header}");
    assert_eq!(bench.summary()["best"], serde_json::Value::Null);
}

/// Grains of a table: the search takes it into its folder and goes on, moved and without what it was made from, with the
/// same files; its folder searches again, and the best one's folder runs again.
#[test]
fn a_search_over_a_table_goes_on_wherever_it_is_moved() {
    let table = |bench: &Bench| {
        let at = |k: u32| -9.0 + 2.0 * f64::from(k);
        let places = (0..1000).map(|n| [at(n % 10), at(n / 10 % 10), at(n / 100)]);
        let rows: Vec<String> = places.map(|[x, y, z]| format!("{x}e-3,{y}e-3,{z}e-3\n")).collect();
        std::fs::write(bench.file("grains.csv"), "x_m,y_m,z_m\n".to_owned() + &rows.concat()).unwrap();
        let text = std::fs::read_to_string(bench.file("scenario.toml")).unwrap();
        let text =
            text.replace("[grains.placement.fill]\ncount = 400\n", "placement.table.file = \"grains.csv\"\n");
        std::fs::write(bench.file("scenario.toml"), text).unwrap();
    };
    let [whole, moved] = [Bench::with(SEARCH), Bench::with(SEARCH)];
    let few = ["--set", "method.published_genetic.generations=1", "--no-report"];
    table(&whole);
    whole.ends("search", &few, 0);
    let absolute = whole.file("");
    for name in ["scenario.toml", "search.toml", "best/scenario.toml"] {
        let text = std::fs::read_to_string(whole.out().join(name)).unwrap();
        assert!(!text.contains(&absolute), "{name}: {text}");
    }
    table(&moved);
    let child = moved.order("search", &few).spawn().unwrap();
    moved.wait_for_replicates(3);
    crate::common::signal(&child, "INT");
    child.wait_with_output().unwrap();
    let away = tempfile::tempdir().unwrap();
    let out = away.path().join("out");
    std::fs::rename(moved.out(), &out).unwrap();
    std::fs::remove_file(moved.file("grains.csv")).unwrap();
    ended(agglo(&["resume", out.to_str().unwrap(), "--no-report"]), 0);
    crate::bench::assert_same(&out, &whole.out());
    let again = |verb: &str, file: &str, to: &str| {
        let (file, to) = (out.join(file), away.path().join(to));
        let arguments = [verb, file.to_str().unwrap(), "-o", to.to_str().unwrap(), "--no-report"];
        ended(agglo(&arguments), 0);
        to
    };
    crate::bench::assert_same(&again("search", "search.toml", "again"), &whole.out());
    crate::bench::assert_same(&again("run", "best/scenario.toml", "best-again"), &out.join("best"));
    // What runs can do and searches cannot is told.
    for (option, value) in [("--until", "1 s"), ("--domains", "2")] {
        let text = complained(&ended(agglo(&["resume", out.to_str().unwrap(), option, value]), 2));
        assert!(text.contains(&format!("{option} is for runs")), "{text}");
    }
}
