//! What a search's page shows is what its files say.

use std::fs;
use std::path::Path;

use super::*;
use crate::chart::{Chart, Drawn, Spread};
use crate::report::write;

const SEARCH: &str = r#"
version = 1
title = "Which cloud sticks best?"
seed = 5
base.template = "reacting"
[[objectives]]
minimize = "growth_deficit"
[[parameters]]
name = "v"
key = "grains.0.velocity_spread.uniform.bounds.0"
range.log = { lower = "20 m/s", upper = "200 m/s" }
[[parameters]]
name = "hardness"
key = "materials.grain.hardness"
range.linear = { lower = "0.1 MPa", upper = "1 MPa" }
[method.published_genetic]
parents = 2
offspring = 2
"#;

const EVALUATIONS: &str = "\
evaluation,generation,stage,status,replicates,violation,cost,cost_standard_error,v_m_s,hardness_Pa,growth_deficit,n_f
0,0,search,ok,2,0.0,0.9,0.01,20.0,100000.0,0.9,1.5
1,0,search,ok,2,0.0,0.7,0.01,30.0,200000.0,0.7,2.5
2,0,search,failed,0,,,,40.0,300000.0,,
3,1,search,ok,2,0.0,0.5,0.01,50.0,400000.0,0.5,3.5
4,2,confirm,ok,4,0.0,0.55,0.02,50.0,400000.0,0.55,3.25
";

const GENERATIONS: &str = "\
generation,stage,evaluations,runs,failures,excluded,cost_lowest,cost_mean,best_evaluation,best_cost,best_cost_standard_error
0,search,3,4,1,0,0.7,0.8,1,0.7,0.01
1,search,4,6,1,0,0.5,0.5,3,0.5,0.01
2,confirm,5,10,1,0,0.55,0.55,4,0.55,0.02
";

const BEST: &str = "\
rank,evaluation,cost,cost_standard_error,replicates,violation,search_evaluation,search_cost,search_cost_standard_error,search_replicates,v_m_s,hardness_Pa
1,4,0.55,0.02,4,0.0,3,0.5,0.01,2,50.0,400000.0
";

const FAILURES: &str = "evaluation,replicate,seed,reason\n2,0,77,\"no room, at all\"\n";

fn search() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let put = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    put("search.toml", SEARCH);
    put("scenario.toml", agglo::scenario::template("reacting").unwrap().text);
    put("evaluations.csv", EVALUATIONS);
    put("generations.csv", GENERATIONS);
    put("best.csv", BEST);
    put("failures.csv", FAILURES);
    folder
}

fn chart<'a>(report: &'a Report, id: &str) -> &'a Chart {
    report.charts.iter().find(|chart| chart.id == id).unwrap()
}

#[test]
fn costs_over_generations_are_those_of_the_files() {
    let folder = search();
    let report = report(folder.path());
    let series = chart(&report, "cost").series();
    assert_eq!(series[0].y, [0.7, 0.5, 0.55]);
    assert_eq!(series[0].spread, Spread::Errors(vec![0.01, 0.01, 0.02]));
    // The two parents: (0.9 + 0.7)/2, then (0.5 + 0.7)/2. Fresh replicates at the end change no parents.
    assert_eq!(series[1].name, "mean of the best 2 so far");
    for (found, wanted) in series[1].y.iter().zip([0.8, 0.6, 0.6]) {
        assert!((found - wanted).abs() < 1e-15, "{found}");
    }
    assert_eq!(series[3].y, [0.8, 0.5, 0.55]);
}

#[test]
fn parallel_coordinates_hold_the_candidates_that_ran() {
    let folder = search();
    let report = report(folder.path());
    let Drawn::Parallel(found) = &chart(&report, "parallel").drawn else { panic!("candidates are due") };
    let names: Vec<&str> = found.axes.iter().map(|axis| axis.name.as_str()).collect();
    assert_eq!(names, ["v_m_s", "hardness_Pa", "growth_deficit"], "the goal names the cost");
    assert_eq!(found.rows.iter().map(|row| row[1]).collect::<Vec<_>>(), [1e5, 2e5, 4e5]);
    assert_eq!(found.shades, [0.9, 0.7, 0.5]);
}

#[test]
fn tables_show_the_best_and_what_failed() {
    let folder = search();
    let report = report(folder.path());
    let table = |start: &str| report.tables.iter().find(|table| table.title.contains(start)).unwrap();
    assert_eq!(table("their parameters").rows, [["1", "4", "50", "400000"].map(str::to_owned)]);
    let outcomes = table("what they come to");
    let at = |name: &str| outcomes.head.iter().position(|head| head == name).unwrap();
    assert_eq!(outcomes.rows[0][at("n_f")], "3.25");
    assert_eq!(outcomes.rows[0][at("in_the_search")], "0.5");
    // The goal is a column as well, and stands once.
    assert_eq!(outcomes.head.iter().filter(|head| *head == "growth_deficit").count(), 1);
    assert_eq!(outcomes.rows[0][at("growth_deficit")], "0.55");
    assert_eq!(table("could not be run").rows[0][3], "no room, at all");
}

#[test]
fn missing_and_damaged_files_are_said_and_the_rest_is_shown() {
    let folder = search();
    let path = |name: &str| folder.path().join(name);
    fs::remove_file(path("generations.csv")).unwrap();
    fs::write(path("evaluations.csv"), &EVALUATIONS[..EVALUATIONS.len() - 7]).unwrap();
    fs::write(path("search.toml"), SEARCH.replace("version = 1", "version = 9")).unwrap();
    fs::write(path("summary.json"), r#"{"version": "0.0.1"}"#).unwrap();
    let (page, notes) = write(folder.path()).unwrap();
    for wanted in
        ["generations.csv is missing", "evaluations.csv is cut", "search.toml is damaged", "agglo 0.0.1"]
    {
        assert!(notes.iter().any(|note| note.contains(wanted)), "{wanted}: {notes:?}");
    }
    let text = fs::read_to_string(page).unwrap();
    assert_contains!(text, "Every candidate");
    assert_lacks!(text, "against generation");
}

#[test]
fn two_costs_make_a_front() {
    let folder = search();
    let text =
        SEARCH.replace("[method.published_genetic]\nparents = 2\noffspring = 2\n", "[method.genetic]\n");
    let text = text.replace(
        "[[parameters]]\nname = \"v\"",
        "[[objectives]]\nmaximize = \"n_f\"\n[[parameters]]\nname = \"v\"",
    );
    fs::write(folder.path().join("search.toml"), text).unwrap();
    let evaluations = "\
evaluation,generation,stage,status,replicates,violation,cost_1,cost_2,cost_1_standard_error,cost_2_standard_error,v_m_s,hardness_Pa,growth_deficit
0,0,search,ok,2,0.0,0.9,-2.5,0.01,0.1,20.0,100000.0,0.9
1,0,search,ok,2,0.0,0.7,-1.5,0.01,0.1,30.0,200000.0,0.7
";
    fs::write(folder.path().join("evaluations.csv"), evaluations).unwrap();
    let report = report(folder.path());
    let series = chart(&report, "front").series();
    assert_eq!((&series[0].x[..], &series[0].y[..]), (&[0.9, 0.7][..], &[2.5, 1.5][..]), "with its own sign");
    assert_no!(report.charts.iter(), |chart| chart.id == "candidates");
}

fn study(plan: &str, files: &[(&str, &str)]) -> Report {
    let folder = search();
    let text = SEARCH.split("[method").next().unwrap().to_owned() + plan;
    fs::write(folder.path().join("search.toml"), text).unwrap();
    for (name, text) in files {
        fs::write(Path::new(folder.path()).join(name), text).unwrap();
    }
    report(folder.path())
}

#[test]
fn a_study_shows_what_its_plan_is_for() {
    let effects = "target,parameter,mean_effect,mean_size,mean_size_standard_error,standard_deviation,noise,effects\n\
                   growth_deficit,v,-0.2,0.25,0.01,0.02,0.005,6\n\
                   growth_deficit,hardness,0.1,0.125,0.01,0.03,0.005,6\n";
    let morris = study("[plan.morris]\n", &[("sensitivity.csv", effects)]);
    assert_eq!(morris.kind, "A study");
    let Drawn::Bars(bars) = &chart(&morris, "sensitivity-0").drawn else { panic!("bars are due") };
    assert_eq!(bars.names, ["v", "hardness"]);
    assert_eq!(bars.series[0].values, [0.25, 0.125]);
    assert_any!(morris.tables.iter(), |table| table.title == "Sensitivity");

    let shares = "target,parameter,first,first_lower,first_upper,total,total_lower,total_upper,variance,noise_share,blocks\n\
                  growth_deficit,v,0.5,0.25,0.75,0.625,0.5,0.75,0.1,0.01,16\n";
    let sobol = study("[plan.sobol_indices]\n", &[("sensitivity.csv", shares)]);
    let Drawn::Bars(bars) = &chart(&sobol, "sensitivity-0").drawn else { panic!("bars are due") };
    assert_eq!((bars.series[1].values[0], bars.series[1].spread.of(0, 0.625)), (0.625, Some([0.5, 0.75])));
}

/// What is to be large is shown as it is, and what misses a limit is marked wherever it is shown.
#[test]
fn limits_that_are_missed_are_marked_and_signs_are_their_own() {
    let folder = search();
    let put = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    let limit = "[[limits]]\nformula = \"impacts\"\nat_most = 3\n[[parameters]]\nname = \"v\"";
    let text = SEARCH.replace("minimize = \"growth_deficit\"", "maximize = \"n_f\"");
    put("search.toml", &text.replacen("[[parameters]]\nname = \"v\"", limit, 1));
    put(
        "evaluations.csv",
        "\
evaluation,generation,stage,status,replicates,repeats,violation,cost,cost_standard_error,v_m_s,hardness_Pa,n_f,impacts
0,0,search,infeasible,2,,0.5,-2.5,0.01,20,100000,2.5,4.5
1,1,search,ok,2,,0,-1.5,0.01,30,200000,1.5,3
2,2,confirm,infeasible,4,,0.25,-1.25,0.02,30,200000,1.25,3.75
",
    );
    put(
        "generations.csv",
        "\
generation,stage,evaluations,runs,failures,excluded,cost_lowest,cost_mean,best_evaluation,best_cost,\
best_cost_standard_error,best_violation,infeasible
0,search,1,2,0,0,,,0,-2.5,0.01,0.5,1
1,search,2,4,0,0,-1.5,-1.5,1,-1.5,0.01,0,1
",
    );
    put(
        "best.csv",
        "\
rank,evaluation,cost,cost_standard_error,replicates,violation,search_evaluation,search_cost,search_cost_standard_error,\
search_replicates,v_m_s,hardness_Pa
1,2,-1.25,0.02,4,0.25,1,-1.5,0.01,2,30,200000
",
    );
    let report = report(folder.path());
    let of = |id: &str, name: &str| -> Vec<f64> {
        let series = chart(&report, id).series().iter().find(|series| series.name.contains(name)).unwrap();
        series.y.iter().copied().filter(|value| value.is_finite()).collect()
    };
    assert_eq!((of("cost", "best so far"), of("cost", "MISSES")), (vec![1.5], vec![2.5]));
    assert_eq!(of("candidates", "MISS A LIMIT"), [2.5, 1.25]);
    assert_eq!(of("candidates", "candidates"), [1.5]);
    let Drawn::Parallel(found) = &chart(&report, "parallel").drawn else { panic!("candidates are due") };
    assert!(found.is_large_good && found.shades == [1.5], "bright ones are better: {:?}", found.shades);
    let table = report.tables.iter().find(|table| table.title.contains("what they come to")).unwrap();
    let at = |name: &str| table.head.iter().position(|head| head == name).unwrap();
    let row = &table.rows[0];
    assert_eq!([&row[at("limits")], &row[at("n_f")], &row[at("in_the_search")]], ["MISSED", "1.25", "1.5"]);
}
