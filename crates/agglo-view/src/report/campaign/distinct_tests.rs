//! Charts and tables of a search and of studies: from files of distinct quantities, back by the names of series and columns.

use std::fs;

use super::*;
use crate::chart::{Axis, Bars, Chart, Curves, Drawn, Place, Reference, Spread};
use crate::report::QuantityTable;

/// What is to be large, so that each cost has another sign than its value, with a limit.
const SEARCH: &str = "version = 1\nseed = 5\nbase.template = \"reacting\"\n[[objectives]]\nmaximize = \"n_f\"\n\
    [[limits]]\nformula = \"impacts\"\nat_most = 3000\n[[parameters]]\nname = \"v\"\n\
    key = \"grains.0.velocity_spread.uniform.bounds.0\"\nrange.log = { lower = \"20 m/s\", upper = \"200 m/s\" }\n";
const HARDNESS: &str = "[[parameters]]\nname = \"hardness\"\nkey = \"materials.grain.hardness\"\n\
    range.linear = { lower = \"0.1 MPa\", upper = \"1 MPa\" }\n";
const PARENTS: &str = "[method.published_genetic]\nparents = 2\noffspring = 2\n";

const EVALUATIONS: &str = "\
evaluation,generation,stage,status,replicates,repeats,violation,cost,cost_standard_error,v_m_s,hardness_Pa,n_f,impacts
10,0,search,ok,2,,0,-2.5,0.011,21,101,2.75,31
11,0,search,ok,3,,0,-3.5,0.012,22,102,3.75,32
12,0,search,infeasible,4,,0.7,-9.5,0.013,23,103,9.75,33
13,1,search,failed,0,,,,,24,104,,
14,1,search,ok,5,,0,-4.25,0.014,25,105,4.5,34
15,2,polish,ok,6,,0,-4.75,0.015,26,106,4.875,35
16,3,confirm,ok,7,,0,-4.125,0.016,26,106,4.375,36
17,4,final,ok,8,,0,-4.0625,0.017,26,106,4.1875,37
";
const GENERATIONS: &str = "\
generation,stage,evaluations,runs,failures,excluded,cost_lowest,cost_mean,best_evaluation,best_cost,\
best_cost_standard_error,best_violation,infeasible
0,search,3,9,51,61,-3.625,-3.125,11,-3.25,0.021,0.5,71
1,search,5,14,52,62,-4.375,-4.1875,14,-4.3125,0.022,0,72
";
const BEST: &str = "\
rank,evaluation,cost,cost_standard_error,replicates,violation,search_evaluation,search_cost,search_cost_standard_error,\
search_replicates,final_evaluation,final_cost,final_cost_standard_error,final_replicates,final_violation,v_m_s,hardness_Pa
1,16,-4.1328125,0.031,41,0.25,14,-4.2578125,0.032,42,17,-4.0703125,0.033,43,0,26,106
2,11,-3.5078125,0.034,44,0.125,11,-3.5390625,0.035,45,,,,,,22,102
";

fn report_of(text: &str, files: &[(&str, &str)]) -> Report {
    let folder = tempfile::tempdir().unwrap();
    let put = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    put("search.toml", text);
    put("scenario.toml", agglo::scenario::template("reacting").unwrap().text);
    for (name, text) in files {
        put(name, text);
    }
    report(folder.path())
}

fn searched() -> Report {
    let files = [("evaluations.csv", EVALUATIONS), ("generations.csv", GENERATIONS), ("best.csv", BEST)];
    report_of(&format!("{SEARCH}{HARDNESS}{PARENTS}"), &files)
}

fn chart<'a>(report: &'a Report, id: &str) -> &'a Chart {
    let ids: Vec<&str> = report.charts.iter().map(|chart| chart.id.as_str()).collect();
    report.charts.iter().find(|chart| chart.id == id).unwrap_or_else(|| panic!("no chart {id} among {ids:?}"))
}

/// What a series is due: its name, places, heights and errors.
type Due<'a> = (&'a str, &'a [f64], &'a [f64], &'a [f64]);

fn curves(chart: &Chart) -> &Curves {
    if let Drawn::Curves(curves) = &chart.drawn {
        curves
    } else {
        panic!("chart {}: curves are due", chart.id)
    }
}

fn bars(chart: &Chart) -> &Bars {
    if let Drawn::Bars(bars) = &chart.drawn { bars } else { panic!("chart {}: bars are due", chart.id) }
}

fn errors(spread: &Spread) -> &[f64] {
    match spread {
        Spread::Unknown => &[],
        Spread::Errors(errors) => errors,
        other => panic!("errors are due: {other:?}"),
    }
}

/// Holds all series of a chart to what they are due, in their order; a height that is NaN is a gap.
fn assert_series(chart: &Chart, due: &[Due<'_>]) {
    let series = &curves(chart).series;
    let names: Vec<&str> = series.iter().map(|series| series.name.as_str()).collect();
    assert_eq!(names, due.iter().map(|due| due.0).collect::<Vec<_>>(), "series of {}", chart.id);
    for (series, (name, x, y, error)) in series.iter().zip(due) {
        let what = format!("chart {}, series {name:?}", chart.id);
        assert_numbers(&format!("{what}: places"), &series.x, x);
        assert_numbers(&format!("{what}: heights"), &series.y, y);
        assert_numbers(&format!("{what}: errors"), errors(&series.spread), error);
    }
}

/// The same of bars: names, lengths, and how far these are known.
fn assert_bars(chart: &Chart, due: &[(&str, &[f64], Spread)]) {
    let series = &bars(chart).series;
    let names: Vec<&str> = series.iter().map(|bar| bar.name.as_str()).collect();
    assert_eq!(names, due.iter().map(|due| due.0).collect::<Vec<_>>(), "bars of {}", chart.id);
    for (bar, (name, values, spread)) in series.iter().zip(due) {
        let what = format!("chart {}, bars {name:?}", chart.id);
        assert_numbers(&format!("{what}: lengths"), &bar.values, values);
        let ends = |spread: &Spread| -> Vec<f64> {
            (0..values.len()).filter_map(|number| spread.of(number, values[number])).flatten().collect()
        };
        assert_numbers(&format!("{what}: ends of their bars of error"), &ends(&bar.spread), &ends(spread));
    }
}

/// Sums of two and differences: one rounding.
fn assert_numbers(what: &str, found: &[f64], wanted: &[f64]) {
    let agree = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-15 * b.abs() || a.is_nan() && b.is_nan();
    let agrees = found.len() == wanted.len() && found.iter().zip(wanted).all(agree);
    assert!(agrees, "{what}: found {found:?}, due {wanted:?}");
}

const NONE: f64 = f64::NAN;

/// The two parents so far: 10 and 11, then 11 and 14. What misses a limit is no best.
#[test]
fn series_of_costs_stand_under_their_names() {
    let report = searched();
    let chart = chart(&report, "cost");
    let x = [0.0, 1.0];
    assert_series(
        chart,
        &[
            ("best so far", &x, &[NONE, 4.3125], &[0.021, 0.022]),
            ("mean of the best 2 so far", &x, &[3.0, 3.875], &[]),
            ("best of the generation", &x, &[3.625, 4.375], &[]),
            ("mean of the generation", &x, &[3.125, 4.1875], &[]),
            ("nearest to the limits so far, which it MISSES", &x, &[3.25, NONE], &[]),
        ],
    );
    let Curves { x, y, .. } = curves(chart);
    assert_eq!((x, y), (&Axis::new("generation", ""), &Axis::new("n_f", "")), "axes");
    assert_eq!(chart.title, "n_f against generation");
}

/// Each stage by itself, without the failed one.
#[test]
fn series_of_candidates_stand_under_their_names() {
    let report = searched();
    let chart = chart(&report, "candidates");
    assert_series(
        chart,
        &[
            ("candidates", &[10.0, 11.0, 14.0], &[2.5, 3.5, 4.25], &[0.011, 0.012, 0.014]),
            ("polished", &[15.0], &[4.75], &[0.015]),
            ("run again", &[16.0], &[4.125], &[0.016]),
            ("the best, once more", &[17.0], &[4.0625], &[0.017]),
            ("MISS A LIMIT", &[12.0], &[9.5], &[0.013]),
        ],
    );
    let Curves { x, y, series, .. } = curves(chart);
    assert_eq!(series[0].texts[1], "v_m_s = 22<br>hardness_Pa = 102", "parameters of candidate 11");
    assert_eq!(series[4].texts[0], "v_m_s = 23<br>hardness_Pa = 103", "parameters of candidate 12");
    assert_eq!((x, y), (&Axis::new("candidate", ""), &Axis::new("n_f", "")), "axes");
}

/// The candidates of the search that ran and keep the limits.
#[test]
fn parallel_axes_stand_under_their_names() {
    let report = searched();
    let Drawn::Parallel(found) = &chart(&report, "parallel").drawn else { panic!("candidates are due") };
    let names: Vec<&str> = found.axes.iter().map(|axis| axis.name.as_str()).collect();
    assert_eq!(names, ["v_m_s", "hardness_Pa", "n_f"], "axes");
    assert_eq!(found.rows, [[21.0, 101.0, 2.5], [22.0, 102.0, 3.5], [25.0, 105.0, 4.25]], "candidates");
    assert_eq!((&found.shades[..], found.shade.name.as_str()), (&[2.5, 3.5, 4.25][..], "n_f"), "colors");
    assert!(found.is_large_good, "large values of {} are to be good", found.shade.name);
    let pairs = chart(&report, "pairs");
    let Drawn::Pairs(good) = &pairs.drawn else { panic!("candidates are due") };
    assert_eq!(good.axes, found.axes[..2], "parameters");
    assert_eq!(good.rows, [[25.0, 105.0], [22.0, 102.0], [21.0, 101.0]], "the best first");
    assert_eq!((&good.shades, &good.shade), (&vec![4.25, 3.5, 2.5], &found.shade), "colors");
    assert_eq!(pairs.words, ["v_m_s from 21 to 25", "hardness_Pa from 101 to 105"]);
}

fn table<'a>(report: &'a Report, title: &str) -> &'a QuantityTable {
    let titles: Vec<&str> = report.tables.iter().map(|table| table.title.as_str()).collect();
    let found = report.tables.iter().find(|table| table.title.contains(title));
    found.unwrap_or_else(|| panic!("no table {title:?} among {titles:?}"))
}

/// Holds a row of a table to what stands under each of its heads.
fn assert_row(table: &QuantityTable, row: usize, wanted: &[(&str, &str)]) {
    let found: Vec<(&str, &str)> =
        table.head.iter().map(String::as_str).zip(table.rows[row].iter().map(String::as_str)).collect();
    assert_eq!(found, wanted, "row {row} of {:?}", table.title);
}

#[test]
fn parameters_of_the_best_stand_under_their_heads() {
    let report = searched();
    let table = table(&report, "their parameters");
    assert_eq!(table.rows.len(), 2, "rows of {:?}", table.title);
    assert_row(table, 0, &[("rank", "1"), ("evaluation", "16"), ("v_m_s", "26"), ("hardness_Pa", "106")]);
    assert_row(table, 1, &[("rank", "2"), ("evaluation", "11"), ("v_m_s", "22"), ("hardness_Pa", "102")]);
}

/// The first keeps the limit when it is run once more, which is what counts; the second misses it. The means of quantities are
/// those of the evaluation.
#[test]
fn outcomes_of_the_best_stand_under_their_heads() {
    let report = searched();
    let table = table(&report, "what they come to");
    assert_eq!(table.rows.len(), 2, "rows of {:?}", table.title);
    let heads = [
        "rank",
        "limits",
        "n_f",
        "standard_error",
        "replicates",
        "once_more",
        "once_more_standard_error",
        "in_the_search",
        "search_replicates",
        "impacts",
    ];
    let first = ["1", "kept", "4.1328125", "0.031", "41", "4.0703125", "0.033", "4.2578125", "42", "36"];
    let second = ["2", "MISSED", "3.5078125", "0.034", "44", "", "", "3.5390625", "45", "32"];
    for (row, wanted) in [first, second].iter().enumerate() {
        let found: Vec<(&str, &str)> =
            table.head.iter().map(String::as_str).zip(table.rows[row].iter().map(String::as_str)).collect();
        for ((head, found), (due, wanted)) in found.iter().zip(heads.iter().zip(wanted)) {
            assert_eq!(head, due, "heads of {:?}", table.title);
            // Numbers are cut to the digits that tell them apart.
            let agrees = match (found.parse::<f64>(), wanted.parse::<f64>()) {
                (Ok(found), Ok(wanted)) => (found / wanted - 1.0).abs() < 2e-3,
                _ => found == wanted,
            };
            assert!(agrees, "row {row}, {head}: found {found}, due {wanted}");
        }
        assert_eq!(found.len(), heads.len(), "heads of {:?}: {:?}", table.title, table.head);
    }
}

/// Two outcomes of two parameters each.
#[test]
fn series_of_elementary_effects_stand_under_their_names() {
    let effects = "target,parameter,mean_effect,mean_size,mean_size_standard_error,standard_deviation,noise,effects\n\
                   n_f,v,-0.21,0.25,0.01,0.02,0.005,6\nn_f,hardness,0.11,0.125,0.015,0.03,0.007,7\n\
                   impacts,v,-1.21,1.25,1.01,1.02,1.005,8\nimpacts,hardness,1.11,1.125,1.015,1.03,1.007,9\n";
    let text = format!("{SEARCH}{HARDNESS}[plan.morris]\n");
    let report = report_of(&text, &[("evaluations.csv", EVALUATIONS), ("sensitivity.csv", effects)]);
    for (id, target, more) in [("sensitivity-0", "n_f", 0.0), ("sensitivity-1", "impacts", 1.0)] {
        let chart = chart(&report, id);
        let of = |values: [f64; 2]| values.map(|value| value + more);
        assert_bars(
            chart,
            &[
                ("mean size μ*", &of([0.25, 0.125]), Spread::Errors(of([0.01, 0.015]).to_vec())),
                ("deviation σ", &of([0.02, 0.03]), Spread::Unknown),
                ("of which chance", &of([0.005, 0.007]), Spread::Unknown),
            ],
        );
        assert_eq!(chart.title, format!("What moves {target}"));
        assert_eq!(bars(chart).names, ["v", "hardness"], "names along the axis");
    }
}

/// Bars of error are the intervals, wherever the share itself is.
#[test]
fn series_of_shares_stand_under_their_names() {
    let shares = "target,parameter,first,first_lower,first_upper,total,total_lower,total_upper,variance,noise_share,blocks\n\
                  n_f,v,0.5,0.25,0.75,0.625,0.5,0.875,0.1,0.01,16\nn_f,hardness,0.375,0.25,0.3125,0.4375,0.375,0.5,0.2,0.02,17\n";
    let text = format!("{SEARCH}{HARDNESS}[plan.sobol_indices]\n");
    let report = report_of(&text, &[("evaluations.csv", EVALUATIONS), ("sensitivity.csv", shares)]);
    let alone = Spread::Intervals(vec![[0.25, 0.75], [0.25, 0.3125]]);
    let total = Spread::Intervals(vec![[0.5, 0.875], [0.375, 0.5]]);
    assert_bars(
        chart(&report, "sensitivity-0"),
        &[("alone", &[0.5, 0.375], alone), ("with all interactions", &[0.625, 0.4375], total)],
    );
}

/// One chart for each outcome of the only parameter.
#[test]
fn series_of_outcomes_stand_under_their_names() {
    let evaluations = "evaluation,generation,stage,status,replicates,repeats,violation,cost,cost_standard_error,v_m_s,n_f,impacts\n\
                       0,0,search,ok,2,,0,-2.5,0.25,21,2.5,31\n1,0,search,ok,2,,0,-3.5,0.375,22,3.5,32\n";
    let measures = "evaluation,replicates,v_m_s,n_f,n_f_standard_error,impacts,impacts_standard_error\n\
                    0,2,21,2.5,0.25,31,0.5\n1,3,22,3.5,0.375,32,0.625\n";
    let text = format!("{SEARCH}[plan.grid]\nlevels = 2\n");
    let report = report_of(&text, &[("evaluations.csv", evaluations), ("measures.csv", measures)]);
    let x = [21.0, 22.0];
    let due: [(&str, &str, Due<'_>); 2] = [
        ("outcome-0", "n_f over v_m_s", ("n_f", &x, &[2.5, 3.5], &[0.25, 0.375])),
        ("outcome-1", "impacts over v_m_s", ("impacts", &x, &[31.0, 32.0], &[0.5, 0.625])),
    ];
    for (id, title, series) in due {
        let chart = chart(&report, id);
        assert_series(chart, &[series]);
        let Curves { x, y, .. } = curves(chart);
        assert_eq!((&*chart.title, &*x.name, &*y.name), (title, "v_m_s", series.0));
    }
}

/// What is within the tolerance of the finest level, and where each outcome has settled; the second has not.
#[test]
fn refinement_shows_where_outcomes_settle() {
    let measures = "evaluation,replicates,v_m_s,n_f,n_f_standard_error,impacts,impacts_standard_error\n\
                    0,2,21,2.5,0.25,31,0.5\n1,3,22,3.5,0.375,32,0.625\n2,3,23,4,0.5,40,1\n";
    let settled = "target,settled_from\nn_f,22\nimpacts,\n";
    let lists = SEARCH.split("range.log").next().unwrap().to_owned()
        + "range.choices = [\"21 m/s\", \"22 m/s\", \"23 m/s\"]\n[plan.refinement]\ntolerance = 0.125\n";
    let files = [("evaluations.csv", EVALUATIONS), ("measures.csv", measures), ("refinement.csv", settled)];
    let report = report_of(&lists, &files);
    let reference = |name: &str, at| Reference { name: name.to_owned(), at };
    let within = |ends| reference("within the tolerance of the last", Place::Heights(ends));
    let from = reference("settled from", Place::Across(22.0));
    for (id, due) in
        [("outcome-0", vec![within([3.5, 4.5]), from]), ("outcome-1", vec![within([35.0, 45.0])])]
    {
        assert_eq!(curves(chart(&report, id)).references, due, "chart {id}");
    }
}

/// Replicates of each candidate by themselves; of the second there are too few.
#[test]
fn distributions_are_those_of_their_replicates() {
    let evaluations = "evaluation,generation,stage,status,replicates,repeats,violation,cost,cost_standard_error,v_m_s,n_f,impacts\n\
                       0,0,search,ok,8,,0,-2.5,0.25,21,2.5,31\n1,0,search,ok,2,,0,-3.5,0.375,22,3.5,32\n";
    let first: Vec<String> =
        (0..8).map(|replicate| format!("0,{replicate},7,0,{replicate},{}\n", 100 + replicate)).collect();
    let first = first.concat();
    let runs = format!("evaluation,replicate,seed,cost,n_f,impacts\n{first}1,0,7,0,50,60\n1,1,7,0,51,61\n");
    let text = format!("{SEARCH}[plan.grid]\nlevels = 2\n");
    let report = report_of(&text, &[("evaluations.csv", evaluations), ("runs.csv", &runs)]);
    for (id, title, range, mean) in [
        ("distribution-0", "n_f, v_m_s = 21", [0.0, 7.0], 3.5),
        ("distribution-1", "impacts, v_m_s = 21", [100.0, 107.0], 103.5),
    ] {
        let chart = chart(&report, id);
        let Drawn::Histogram(found) = &chart.drawn else { panic!("chart {id}: bins are due") };
        assert_eq!((chart.title.as_str(), found.range), (title, range), "chart {id}");
        assert_eq!(found.counts.iter().sum::<u64>(), 8, "values in all bins of {id}");
        // Eight numbers in a row scatter by sqrt(6), so that their mean is known to sqrt(6/8).
        let [found, error] = found.mean.unwrap();
        assert_near!(found, mean, 1e-12);
        assert_near!(error, 0.75_f64.sqrt(), 1e-12);
    }
    let ids = report.charts.iter().filter(|chart| chart.id.starts_with("distribution")).count();
    assert_eq!(ids, 2, "histograms");
}

/// The front has each cost with its own sign on its own axis, in the order of the first.
#[test]
fn series_of_the_front_stand_under_their_names() {
    let evaluations = "evaluation,generation,stage,status,replicates,repeats,violation,cost_1,cost_2,cost_1_standard_error,\
                       cost_2_standard_error,v_m_s,hardness_Pa,n_f,impacts\n\
                       0,0,search,ok,2,,0,-2.5,31,0.1,0.2,21,101,2.5,31\n1,0,search,ok,2,,0,-3.5,32,0.3,0.4,22,102,3.5,32\n";
    let point = |number: u32, costs: [f64; 2]| {
        serde_json::json!({
            "evaluation": number, "costs": costs, "standard_errors": [0.1, 0.2], "parameters": {}, "violation": 0.0,
        })
    };
    let summary = serde_json::json!({
        "version": "0", "title": "", "seed": 5, "objectives": [], "best": null,
        "front": [point(1, [-3.5, 32.0]), point(0, [-2.5, 31.0])], "generations": 1, "evaluations": 2, "runs": 4, "failures": 0,
        "excluded": 0, "noise": { "replicate_deviation": null, "replicates_mean": null, "significant_difference": null }, "wall_s": 1.0,
    })
    .to_string();
    let text = SEARCH.replace("[[limits]]", "[[objectives]]\nminimize = \"impacts\"\n[[limits]]");
    let files = [("evaluations.csv", evaluations), ("summary.json", summary.as_str())];
    let report = report_of(&format!("{text}{HARDNESS}[method.genetic]\n"), &files);
    let chart = chart(&report, "front");
    let (x, y) = ([2.5, 3.5], [31.0, 32.0]);
    assert_series(chart, &[("candidates", &x, &y, &[]), ("beaten by no other", &x, &y, &[])]);
    assert_eq!((&*curves(chart).x.name, &*curves(chart).y.name), ("n_f", "impacts"), "axes");
    let words: Vec<&str> = chart.words.iter().map(String::as_str).collect();
    assert_eq!(words, ["n_f = 2.5 with impacts = 31", "n_f = 3.5 with impacts = 32"]);
}
