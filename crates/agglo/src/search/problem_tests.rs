use super::*;
use crate::math::rng::{Purpose, Stream};
use crate::run::{self, Ending};

const SHIPPED: &str = include_str!("../../scenarios/search-agglomeration.toml");

fn problem(text: &str) -> (Campaign, Problem) {
    let campaign = Campaign::from_toml(text).unwrap_or_else(|faults| panic!("{faults}"));
    let problem = Problem::new(&campaign, Path::new("")).unwrap();
    (campaign, problem)
}

/// Setting values in the tree is the same as setting them on the command line.
#[test]
fn scenarios_are_those_of_their_settings() {
    let (campaign, problem) = problem(SHIPPED);
    let text = crate::scenario::template("reacting").unwrap().text;
    let mut stream = Stream::new(5, Purpose::Sampling, 0);
    for _ in 0..20 {
        let point: Vec<f64> = problem.axes().iter().map(|_| stream.uniform()).collect();
        let candidate = problem.candidate(&point);
        let by_tree = problem.scenario(&candidate).unwrap();
        let by_text = Scenario::with_overrides(
            text,
            &[campaign.settings.clone(), problem.settings(&candidate)].concat(),
        )
        .unwrap();
        assert_eq!(by_tree, by_text);
        let spread = by_tree.grains[0].velocity_spread.clone().unwrap();
        assert!(format!("{spread:?}").contains(&format!("{:?}", 0.1 * candidate.values[0])), "{spread:?}");
        assert_eq!(by_tree.materials["grain"].hardness.unwrap().si(), candidate.values[3]);
    }
}

/// Columns have the unit of the file where that is an SI unit, else that of the dimension.
#[test]
fn columns_of_parameters_have_the_units_of_the_file() {
    let (_, problem) = problem(SHIPPED);
    let columns: Vec<String> = problem.axes().iter().map(Axis::column).collect();
    let wanted = [
        "v_m_s",
        "length_ratio",
        "density_kg_m3",
        "hardness_Pa",
        "heat_capacity_J_kg_K",
        "friction",
        "temperature_K",
        "activation_energy_J_mol",
        "reaction_heat_J_m2",
        "surface_energy_J_m2",
    ];
    assert_eq!(columns, wanted);
}

/// Constraints, limits, costs and their errors by hand, for four replicates of a small problem.
#[test]
fn fitness_by_hand() {
    let text = r#"
        version = 1
        base.template = "reacting"
        columns = ["impacts"]
        [[objectives]]
        maximize = "radius_ratio*scale"
        [[parameters]]
        name = "scale"
        range.linear = { lower = 1, upper = 3 }
        [[parameters]]
        name = "count"
        key = "grains.0.placement.fill.count"
        range.choices = [100, 400]
        [[derived]]
        key = "grains.0.size.length_ratio.count"
        formula = "count + 0.4"
        [[constraints]]
        formula = "count/100*scale"
        at_most = 4
        [[limits]]
        formula = "largest_fraction"
        at_least = 0.5
        at_most = 1
        [method.random]
        points = 4
    "#;
    let (_, problem) = problem(text);
    assert_eq!(problem.columns(), ["radius_ratio", "largest_fraction", "impacts"]);
    assert_eq!(problem.objectives().collect::<Vec<_>>(), [("radius_ratio*scale", true)]);
    let few = problem.candidate(&[0.5, 0.25]);
    assert_eq!((few.violation.to_bits(), few.values.as_slice()), (0, &[2.0, 0.0][..]));
    // 4 · 2 is 8, twice the bound: missed by the bound itself.
    let many = problem.candidate(&[0.5, 0.75]);
    assert_eq!(many.violation, 1.0);
    assert_eq!(problem.fitness(&many, &[]), Fitness { violation: 1.0, ..Fitness::failed() });
    assert_eq!(problem.fitness(&few, &[]), Fitness::failed());
    // A whole number that follows is rounded.
    let settings = ["grains.0.placement.fill.count=400", "grains.0.size.length_ratio.count=400"];
    assert_eq!(problem.settings(&many), settings);

    let replicates: Vec<Vec<f64>> = [1.0, 2.0, 3.0, 6.0].map(|ratio| vec![ratio, 0.4, 7.0]).to_vec();
    // Costs -2, -4, -6, -12: mean -6, variance (16 + 4 + 0 + 36)/3, error its root over 2. 0.4 misses 0.5 by a fifth.
    let fitness = problem.fitness(&few, &replicates);
    assert_eq!(fitness.costs, [-6.0]);
    assert_near!(fitness.standard_errors[0], (56.0_f64 / 3.0).sqrt() / 2.0, 1e-15);
    assert_near!(fitness.violation, 0.2, 1e-15);
    assert_false!(fitness.is_feasible(), "a point that breaks a constraint");
    let single = problem.fitness(&few, &[vec![1.0, 0.9, 7.0]]);
    assert_eq!((single.standard_errors[0], single.violation.to_bits()), (0.0, 0));
    assert_eq!(problem.costs(&few, &replicates[3]), [-12.0]);
}

/// What a run gives is what its summary says; a quantity that it does not have is a failure with words.
#[test]
fn quantities_are_those_of_the_summary() {
    let text = |objective: &str| {
        format!(
            r#"
            version = 1
            base.template = "reacting"
            settings = ["grains.0.placement.fill.count=60", "grains.0.size.length_ratio.count=60", "time.end=1 ms"]
            columns = ["energy.kinetic_J", "biot_number"]
            objectives = [{{ minimize = "{objective}" }}]
            method.random.points = 4
            [[parameters]]
            name = "mu"
            key = "impact.tangential.friction"
            range.linear = {{ lower = 0, upper = 1 }}
            "#
        )
    };
    let (_, problem) = problem(&text("growth_deficit"));
    let stop = AtomicBool::new(false);
    let center = problem.center();
    let quantities = problem.run(&problem.prepare(&center).unwrap(), 9, &stop).unwrap();
    let scenario = Scenario { seed: 9, ..problem.scenario(&center).unwrap() };
    let Ok(Ending::Finished(summary)) = run::quiet(&scenario, Path::new(""), &stop) else {
        panic!("it fails")
    };
    let run::Summary::Hard(summary) = summary else { panic!("these are hard spheres") };
    assert_eq!(quantities[..2], [summary.growth.growth_deficit, summary.energy.stored.kinetic]);
    assert!(quantities[2].is_nan(), "no thermal conductivity, no Biot number");

    let (_, problem) = self::problem(&text("biot_number"));
    let prepared = problem.prepare(&problem.center()).unwrap();
    let refused = problem.run(&prepared, 9, &stop).unwrap_err();
    assert_eq!(refused, Trouble::Failed("\"biot_number\" has no value for this run".to_owned()));
    assert_eq!(problem.run(&prepared, 9, &AtomicBool::new(true)), Err(Trouble::Stopped));
}

/// The grains fill (4/3) pi L³/8 of the box: 0.90 at L = 1.2, more than can be placed, and 0.14 at 0.65.
#[test]
fn ends_that_cannot_be_run_are_told() {
    let text = r#"
        version = 1
        base.template = "reacting"
        objectives = [{ minimize = "growth_deficit" }]
        method.random.points = 4
        [[parameters]]
        name = "L"
        key = "grains.0.size.length_ratio.ratio"
        range.linear = { lower = 0.1, upper = 1.2 }
    "#;
    let (_, problem) = problem(text);
    let told = problem.refused_ends();
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].starts_with("L = 1.2 cannot be run with the rest in the middle: grains.0."), "{told:?}");
}
