//! Against closed forms: sequences of known order, functions of known variance, and tables of known contents.

use std::f64::consts::{PI, TAU};

use super::*;
use crate::math::rng::{Purpose, Stream};
use crate::search::plan::{Morris, Plan, Refinement, SobolIndices};
use agglo_testing::AWKWARD;

/// Sobol' indices and elementary effects of a constant, of one with round-off on it, and of one with true differences.
#[test]
fn what_does_not_vary_has_no_shares_and_no_effects() {
    let (morris, sobol) = (Morris::default(), SobolIndices { samples: 64, ..SobolIndices::default() });
    let mut stream = Stream::new(9, Purpose::Sampling, 0);
    for (relative, does_vary) in [(0.0, false), (1e-16, false), (1e-14, false), (1e-9, true)] {
        let mut outcome = |_: &Vec<f64>| Some([192.53 * (1.0 + relative * stream.normal()), f64::NAN]);
        let points = Plan::Morris(morris).points(&[None; 3], 1);
        let outcomes: Vec<_> = points.iter().map(&mut outcome).collect();
        for effect in elementary_effects(&points, &outcomes) {
            let quantities =
                [effect.mean, effect.mean_size, effect.standard_error, effect.standard_deviation];
            assert!(
                quantities.iter().all(|quantity| quantity.is_finite() == does_vary),
                "{relative}: {effect:?}"
            );
            assert!(effect.noise.is_nan() && effect.count == 20, "one replicate tells no noise");
        }
        let outcomes: Vec<_> =
            Plan::SobolIndices(sobol).points(&[None; 3], 1).iter().map(&mut outcome).collect();
        let shares = variance_shares(3, &outcomes, 100, 0.95, 1);
        for share in &shares.parameters {
            let quantities =
                [[share.first, share.total], share.first_interval, share.total_interval].concat();
            assert!(
                quantities.iter().all(|quantity| quantity.is_finite() == does_vary),
                "{relative}: {share:?}"
            );
        }
        assert_eq!(shares.variance == 0.0, !does_vary);
    }
}

/// Where all candidates failed, or all but one block, there are no quantities, not even of errors.
#[test]
fn what_failed_has_no_shares_and_no_effects() {
    let points = Plan::Morris(Morris::default()).points(&[None; 2], 1);
    for effect in elementary_effects(&points, &vec![None; points.len()]) {
        let quantities =
            [effect.mean, effect.mean_size, effect.standard_error, effect.standard_deviation, effect.noise];
        assert!(quantities.iter().all(|quantity| quantity.is_nan()) && effect.count == 0, "{effect:?}");
    }
    for whole in [0, 1] {
        let outcomes: Vec<_> =
            (0..40).map(|k| (k / 4 < whole).then_some([f64::from(k) * f64::from(k), 0.1])).collect();
        let shares = variance_shares(2, &outcomes, 100, 0.9, 1);
        assert_nan!(shares.variance);
        assert_nan!(shares.noise_share);
        assert_eq!(shares.blocks, whole as usize);
        assert_all!(shares.parameters.iter(), |share| share.first.is_nan()
            && share.total_interval[0].is_nan());
    }
    // One effect tells its size and no scatter.
    let first = |k: usize, _: &Vec<f64>| (k < 3).then_some([k as f64, 0.0]);
    let outcomes: Vec<_> = points.iter().enumerate().map(|(k, point)| first(k, point)).collect();
    for effect in elementary_effects(&points, &outcomes) {
        assert_finite!(effect.mean);
        assert_nan!(effect.standard_error);
        assert_eq!(effect.count, 1);
    }
}

fn ishigami(u: &[f64]) -> f64 {
    let x: Vec<f64> = u.iter().map(|u| PI * (2.0 * u - 1.0)).collect();
    x[0].sin() + 7.0 * x[1].sin().powi(2) + 0.1 * x[2].powi(4) * x[0].sin()
}

/// Closed form of T. Ishigami and T. Homma (1990), a = 7, b = 0.1: S = 0.3139, 0.4424, 0; ST = 0.5576, 0.4424, 0.2437.
#[test]
fn val_ishigami_homma_1990() {
    let plan = SobolIndices { samples: 1 << 16, bootstraps: 100, level: 0.95 };
    let outcomes: Vec<_> =
        Plan::SobolIndices(plan).points(&[None; 3], 5).iter().map(|u| Some([ishigami(u), 0.0])).collect();
    let shares = variance_shares(3, &outcomes, plan.bootstraps, plan.level, 5);
    let expected = [[0.3139, 0.5576], [0.4424, 0.4424], [0.0, 0.2437]];
    for (share, [first, total]) in shares.parameters.iter().zip(expected) {
        // Random points would leave standard errors of 0.004; a Sobol' sequence does better, so that one of them is wide.
        assert!((share.first - first).abs() < 0.004, "{share:?}");
        assert!((share.total - total).abs() < 0.004, "{share:?}");
    }
    // Variance: a²/8 + b π⁴/5 + b² π⁸/18 + 1/2 = 13.8446.
    assert!(
        (shares.variance / 13.8446 - 1.0).abs() < 0.002 && shares.blocks == 1 << 16,
        "{}",
        shares.variance
    );
}

/// g-function of I. M. Sobol: variances 1/(3 (1 + a)²) of each factor multiply.
#[test]
fn g_function_has_its_closed_form() {
    let a = [0.0, 1.0, 4.5, 9.0, 99.0];
    let g = |u: &[f64]| -> f64 {
        u.iter().zip(a).map(|(u, a)| ((4.0 * u - 2.0).abs() + a) / (1.0 + a)).product()
    };
    let plan = SobolIndices { samples: 1 << 16, bootstraps: 100, level: 0.95 };
    let points = Plan::SobolIndices(plan).points(&[None; 5], 6);
    let outcomes: Vec<_> = points.iter().map(|u| Some([g(u), 0.0])).collect();
    let shares = variance_shares(5, &outcomes, plan.bootstraps, plan.level, 6);
    let parts = a.map(|a: f64| 1.0 / (3.0 * (1.0 + a) * (1.0 + a)));
    let variance = parts.iter().map(|part| 1.0 + part).product::<f64>() - 1.0;
    for (share, part) in shares.parameters.iter().zip(parts) {
        // 65,536 blocks: standard errors are 0.004 at most, as the bootstrap shows; four of them.
        assert!((share.first - part / variance).abs() < 0.016, "{share:?}");
        assert!((share.total - part * (1.0 + variance) / (1.0 + part) / variance).abs() < 0.016, "{share:?}");
    }
}

/// The 95 % interval covers the truth in 95 % of all cases: of 60, with binomial standard deviation 1.7, at least 50.
#[test]
fn intervals_cover_the_truth() {
    let plan = SobolIndices { samples: 256, bootstraps: 200, level: 0.95 };
    let covered = (0..60).filter(|&seed| {
        let points = Plan::SobolIndices(plan).points(&[None; 3], seed);
        let outcomes: Vec<_> = points.iter().map(|u| Some([ishigami(u), 0.0])).collect();
        let [low, high] = variance_shares(3, &outcomes, 200, 0.95, seed).parameters[2].total_interval;
        (low..=high).contains(&0.2437)
    });
    let covered = covered.count();
    assert!(covered >= 50, "{covered}");
}

#[test]
fn failures_drop_their_block() {
    let outcomes: Vec<_> = (0..16).map(|k| (k != 5).then_some([f64::from(k), 0.1])).collect();
    let shares = variance_shares(2, &outcomes, 100, 0.9, 1);
    assert_eq!(shares.blocks, 3);
}

/// A linear function's effects are its coefficients, to round-off, and do not scatter.
#[test]
fn linear_functions_have_their_coefficients() {
    let coefficients = [3.0, -2.0, 0.0, 10.0];
    let points = Plan::Morris(Morris { trajectories: 10, levels: 6 }).points(&[None; 4], 3);
    let value = |u: &Vec<f64>| u.iter().zip(coefficients).map(|(u, c)| u * c).sum::<f64>();
    let outcomes: Vec<_> = points.iter().map(|u| Some([value(u), 0.3])).collect();
    for (effects, coefficient) in elementary_effects(&points, &outcomes).iter().zip(coefficients) {
        assert_near!(effects.mean, coefficient, 1e-13);
        assert_near!(effects.mean_size, coefficient.abs(), 1e-13);
        assert_below!(effects.standard_deviation, 1e-13);
        assert_eq!(effects.count, 10);
        // Two errors of 0.3 over a step of 0.6.
        assert_near!(effects.noise, 0.5 * 2.0_f64.sqrt(), 1e-13);
    }
}

/// A parameter that acts up and down has no mean effect, but a size: sin² over two periods, with levels at its quarters.
#[test]
fn signs_cancel_in_the_mean_only() {
    let points = Plan::Morris(Morris { trajectories: 200, levels: 4 }).points(&[None; 2], 4);
    let outcomes: Vec<_> = points.iter().map(|u| Some([(u[0] - 0.5) * (u[1] - 0.5), 0.0])).collect();
    let effects = elementary_effects(&points, &outcomes)[0];
    // The effect is u1 - 1/2: sizes 1/2 and 1/6 equally often: mean 1/3, standard deviation 1/6, over 200 effects: 0.012.
    assert!((effects.mean_size - 1.0 / 3.0).abs() < 4.0 * 0.012, "{effects:?}");
    // Standard deviation of the effect: sqrt((1/4 + 1/36)/2) = 0.373, over 200: 0.026.
    assert!(
        effects.mean.abs() < 4.0 * 0.026 && (effects.standard_deviation - 0.373).abs() < 0.04,
        "{effects:?}"
    );
}

/// A search in three parameters, among them a choice of words; every fifth candidate fails or misses a limit.
fn searched(objectives: usize) -> Evaluations {
    let mut stream = Stream::new(8, Purpose::Sampling, 0);
    let row = |number: u32| {
        let spread = 1.0 / (1.0 + f64::from(number) / 40.0);
        let point: Vec<f64> = (0..3).map(|_| 0.3 + spread * 0.7 * (stream.uniform() - 0.4)).collect();
        let cost = 0.65 + point.iter().map(|u| (u - 0.3).powi(2)).sum::<f64>();
        let status = match number % 10 {
            3 => Status::Failed,
            7 => Status::Infeasible,
            _ => Status::Feasible,
        };
        let costs = if status == Status::Failed {
            Vec::new()
        } else {
            vec![cost, point[0] + 0.1][..objectives].to_vec()
        };
        EvaluationRow {
            values: vec![20.0 + 180.0 * point[0], 10.0_f64.powf(5.0 + point[1]), (2.0 * point[2]).floor()],
            standard_errors: vec![0.01; costs.len()],
            replicates: (0..10).map(|_| vec![1.0 / (1.0 - cost.min(0.9)) + 0.1 * stream.normal()]).collect(),
            point,
            costs,
            status,
            generation: number / 20,
            replicate_costs: Vec::new(),
        }
    };
    Evaluations {
        title: "Agglomeration".to_owned(),
        parameters: vec![
            Axis::new("speed", "m/s"),
            Axis::new("hardness", "Pa").log(),
            Axis::choice("law", &["published", "consistent"]),
        ],
        objectives: [("growth_deficit", ""), ("energy", "J")][..objectives].iter().map(objective).collect(),
        measures: vec![Axis::new("radius_ratio", "")],
        rows: (0..300).map(row).collect(),
        ..Evaluations::default()
    }
}

fn objective(&(name, unit): &(&str, &str)) -> Objective {
    Objective { axis: Axis::new(name, unit), is_to_be_large: false }
}

#[test]
fn generations_keep_the_best() {
    let mut evaluations = searched(1);
    evaluations.rows.truncate(40);
    let generations = evaluations.generations();
    assert_eq!(generations.len(), 2);
    let feasible: Vec<f64> = evaluations.rows.iter().filter_map(EvaluationRow::feasible_cost).collect();
    let least = feasible.iter().copied().fold(f64::INFINITY, f64::min);
    assert_eq!(evaluations.rows[generations[1].best.unwrap()].costs[0], least);
    // Two in twenty fail and two miss a limit.
    assert_eq!(feasible.len(), 32);
    let mut first: Vec<f64> = feasible[..16].to_vec();
    first.sort_by(f64::total_cmp);
    assert_eq!(generations[0].costs, [first[0], 0.5 * (first[7] + first[8]), first[15]]);
    // Where a generation is worse than the one before it, the best so far is still the earlier one.
    evaluations
        .rows
        .iter_mut()
        .skip(20)
        .filter(|row| !row.costs.is_empty())
        .for_each(|row| row.costs[0] += 1e3);
    let generations = evaluations.generations();
    let bests = [0, 1].map(|generation: usize| generations[generation].best.unwrap());
    assert_eq!(bests[1], bests[0], "row of the best so far after the second generation");
    assert!(bests[0] < 20, "row of the best: {bests:?}");
}

/// An interval leaves as much below as above: at 40 % it goes from the 30th to the 70th hundredth of the draws, which are nearly
/// normal and so nearly as far from the middle. 20 %: a hundred blocks are a little askew.
#[test]
fn intervals_of_shares_leave_as_much_below_as_above() {
    let sobol = SobolIndices { samples: 128, ..SobolIndices::default() };
    let outcomes: Vec<Option<[f64; 2]>> = Plan::SobolIndices(sobol)
        .points(&[None; 2], 1)
        .iter()
        .map(|point| Some([point[0] + 0.5 * point[1], 0.0]))
        .collect();
    let interval = |level: f64| variance_shares(2, &outcomes, 4000, level, 1).parameters[0].total_interval;
    let [middle, same] = interval(0.0);
    assert!(middle == same, "an interval of no width: {middle} to {same}");
    let [lower, upper] = interval(0.4);
    let ratio = (middle - lower) / (upper - middle);
    assert!(
        (ratio - 1.0).abs() < 0.2,
        "{lower} to {upper} about {middle}: {ratio} as much below, expected 1"
    );
    // Of a normal distribution the 70th hundredth is 0.524 deviations off, the 97.5th 1.960.
    let wide = interval(0.95);
    let wider = (wide[1] - wide[0]) / (upper - lower);
    assert!(
        (wider / (1.960 / 0.524) - 1.0).abs() < 0.15,
        "95 % is {wider} times as wide as 40 %, expected 3.74"
    );
}

#[test]
fn front_is_beaten_by_none() {
    let evaluations = searched(2);
    let front = evaluations.front();
    let costs = |row: usize| &evaluations.rows[row].costs;
    let beats = |a: usize, b: usize| costs(a)[0] < costs(b)[0] && costs(a)[1] < costs(b)[1];
    let feasible = |row: &usize| evaluations.rows[*row].feasible_cost().is_some();
    for row in (0..300).filter(feasible) {
        assert_eq!(front.contains(&row), !(0..300).filter(feasible).any(|other| beats(other, row)));
    }
}

/// Absorbed power against the number of rays, with an error of 40/rays and a little noise.
fn refined() -> Evaluations {
    let mut stream = Stream::new(2, Purpose::Sampling, 0);
    let row = |(number, rays): (usize, f64)| EvaluationRow {
        point: vec![(number as f64 + 0.5) / 5.0],
        values: vec![rays],
        replicates: (0..16).map(|_| vec![2.0 + 80.0 / rays + 1e-3 * stream.normal()]).collect(),
        ..EvaluationRow::default()
    };
    Evaluations {
        replicates: Replicates::Shared,
        title: "Rays".to_owned(),
        parameters: vec![Axis::new("rays", "")],
        measures: vec![Axis::new("power", "W")],
        rows: [1e3, 2e3, 4e3, 8e3, 16e3].into_iter().enumerate().map(row).collect(),
        ..Evaluations::default()
    }
}

#[test]
fn refinement_says_where_it_settled() {
    let (plan, evaluations) = (Plan::Refinement(Refinement { tolerance: 0.01 }), refined());
    let tables = study_tables(&plan, &evaluations, 1);
    assert_eq!([tables[0].0, tables[1].0], ["refinement.csv", "differences.csv"]);
    // 2.005 at the end; 2.08, 2.04 and 2.02 before, each known to 2.5e-4: 2.02 is the first within 0.02.
    let row = tables[0].1.lines().nth(1).unwrap();
    assert!(row.starts_with("power_W,4000,settled,converging,"), "{row}");
    let order: f64 = row.split(',').nth(4).unwrap().parse().unwrap();
    // Differences of 0.01 and 0.005 with noise of 3.5e-4: the order is known to 0.11; three of these.
    assert!((order - 1.0).abs() < 0.33, "{order}");
    let rows: Vec<Vec<&str>> = tables[1].1.lines().map(|line| line.split(',').collect()).collect();
    let column = |name: &str| rows[0].iter().position(|head| *head == name).unwrap();
    let words: Vec<&str> = rows[1..].iter().map(|row| row[column("settling")]).collect();
    assert_eq!(words, ["not_settled", "not_settled", "settled", "settled"]);
    let of = |name: &str| rows[3][column(name)].parse::<f64>().unwrap();
    assert_near!(of("difference"), 0.015, 4.0 * of("difference_standard_error"));
    assert_below!(of("difference_lower"), of("difference"));
    assert_below!(of("difference"), of("difference_upper"));
    let said = findings(&plan, &evaluations, 1);
    let wanted =
        "power [W] is settled from rays = 4000 on: within 1 % of the finest level, with 95 % confidence";
    assert_eq!(said, [wanted]);
}

/// An objective that is a column too is one thing, and stands with the sign of the column.
#[test]
fn an_objective_that_is_a_column_stands_once_with_its_own_sign() {
    let mut evaluations = refined();
    let axis = evaluations.measures[0].clone();
    evaluations.objectives = vec![Objective { axis, is_to_be_large: true }];
    for row in &mut evaluations.rows {
        row.replicate_costs = row.replicates.iter().map(|replicate| vec![-replicate[0]]).collect();
        row.costs = vec![-row.measure(0).mean];
        row.standard_errors = vec![row.measure(0).standard_error()];
    }
    let plan = Plan::Refinement(Refinement { tolerance: 0.01 });
    assert_eq!(study_tables(&plan, &evaluations, 1), study_tables(&plan, &refined(), 1));
    assert_eq!(findings(&plan, &evaluations, 1), findings(&plan, &refined(), 1));
}

#[test]
fn what_there_is_nothing_to_say_of_is_said() {
    for plan in [Plan::Morris(Morris::default()), Plan::SobolIndices(SobolIndices::default())] {
        let mut constant = studied(&plan);
        for row in &mut constant.rows {
            row.costs = vec![192.53];
        }
        let said = findings(&plan, &constant, 1);
        assert!(
            said.len() == 1 && said[0].starts_with("height [m] does not vary: it is 192.5 for all"),
            "{said:?}"
        );
        let (_, table) = study_tables(&plan, &constant, 1).remove(0);
        let cells: Vec<Vec<&str>> = table.lines().skip(1).map(|line| line.split(',').collect()).collect();
        assert_eq!(cells.len(), 3);
        // Target and parameter, then nothing but the variance, 0, and the count.
        let is_number = |cell: &&&str| cell.parse::<f64>().is_ok();
        for row in &cells {
            let known = row.iter().filter(is_number).count();
            assert_eq!(known, if matches!(plan, Plan::Morris(_)) { 1 } else { 2 }, "{row:?}");
        }
        let mut failed = studied(&plan);
        failed.rows.iter_mut().for_each(|row| row.status = Status::Failed);
        assert_contains!(findings(&plan, &failed, 1)[0], "not known for any candidate");
        assert_all!(study_tables(&plan, &failed, 1)[0].1.lines().skip(1), |line| !line.contains("NaN"));
    }
    let single = {
        let mut refined = refined();
        refined.rows.iter_mut().for_each(|row| row.replicates.truncate(1));
        refined
    };
    let said = findings(&Plan::Refinement(Refinement::default()), &single, 1);
    assert!(said[0].contains("is not shown to have settled: one replicate"), "{said:?}");
}

fn studied(plan: &Plan) -> Evaluations {
    let points = plan.points(&[None; 3], 1);
    let row = |point: Vec<f64>| EvaluationRow {
        values: point.iter().map(|u| TAU * u - PI).collect(),
        costs: vec![ishigami(&point)],
        standard_errors: vec![0.1],
        point,
        ..EvaluationRow::default()
    };
    Evaluations {
        title: "Ishigami".to_owned(),
        parameters: ["x", "y", "z"].map(|name| Axis::new(name, "rad")).to_vec(),
        objectives: vec![objective(&("height", "m"))],
        rows: points.into_iter().map(row).collect(),
        ..Evaluations::default()
    }
}

#[test]
fn sensitivity_has_its_table() {
    for (plan, second) in [
        (Plan::Morris(Morris::default()), "target,parameter,mean_effect,"),
        (Plan::SobolIndices(SobolIndices::default()), "target,parameter,first,"),
    ] {
        let evaluations = studied(&plan);
        let (name, table) = study_tables(&plan, &evaluations, 1).remove(0);
        assert!(
            name == "sensitivity.csv" && table.starts_with(second) && table.lines().count() == 4,
            "{table}"
        );
        let columns = |line: &str| line.split(',').count();
        assert!(table.lines().all(|line| columns(line) == columns(table.lines().next().unwrap())), "{table}");
    }
}

/// Parameters and means of studies, of any size, come back from the table as the same doubles.
#[test]
fn awkward_numbers_come_back_from_study_tables() {
    let row = |value: f64| EvaluationRow {
        values: vec![value],
        replicates: vec![vec![value]],
        ..EvaluationRow::default()
    };
    let evaluations = Evaluations {
        parameters: vec![Axis::new("p", "")],
        measures: vec![Axis::new("m", "")],
        rows: AWKWARD.map(row).to_vec(),
        ..Evaluations::default()
    };
    let table = measures_table(&evaluations);
    assert!(table.lines().all(|line| line.len() < 80), "{table}");
    for (line, value) in table.lines().skip(1).zip(AWKWARD) {
        let cells: Vec<&str> = line.split(',').collect();
        for cell in [cells[1], cells[3]] {
            assert_eq!(cell.parse::<f64>().unwrap().to_bits(), value.to_bits(), "{line}");
        }
    }
}

#[test]
fn measures_stand_in_a_table() {
    let mut evaluations = searched(1);
    evaluations.rows.truncate(1);
    evaluations.rows[0].replicates = vec![vec![1.0], vec![2.0], vec![6.0]];
    evaluations.rows[0].values = vec![30.0, 2e5, 1.0];
    let expected = format!(
        "evaluation,speed_m_s,hardness_Pa,law,replicates,radius_ratio,radius_ratio_standard_error,radius_ratio_standard_deviation\n\
         0,30,200000,consistent,3,3,{},{}\n",
        (7.0_f64 / 3.0).sqrt(),
        7.0_f64.sqrt()
    );
    assert_eq!(measures_table(&evaluations), expected);
}
