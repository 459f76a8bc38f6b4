//! What all methods have in common.

use super::*;
use crate::search::functions::{Noisy, TestFunction, minimize};

fn methods(evaluations: usize) -> Vec<Method> {
    vec![
        Method::CmaEs(CmaEs { evaluations, ..Default::default() }),
        Method::Genetic(Genetic { generations: evaluations / 40 - 1, ..Default::default() }),
        Method::PublishedGenetic(PublishedGenetic {
            generations: (evaluations - 20) / 14,
            ..Default::default()
        }),
        Method::NelderMead(NelderMead { evaluations, ..Default::default() }),
        Method::Random(Random { points: evaluations }),
        Method::Sobol(Sobol { points: evaluations }),
    ]
}

/// All that is asked, with a lowest point at a corner so that bounds are met.
fn asked(method: &Method, seed: u64) -> Vec<Point> {
    let mut points = Vec::new();
    let mut search = method.start(4, 1, seed).unwrap();
    let corner = |point: &[f64]| point.iter().map(|x| (1.0 - x).powi(2)).sum::<f64>();
    let best = minimize(search.as_mut(), 1000, |point, _| {
        points.push(point.to_vec());
        Fitness::new(vec![corner(point)])
    });
    assert!(corner(&best.unwrap()) < 0.3, "{method:?}");
    points
}

#[test]
fn the_seed_decides_and_bounds_are_kept() {
    for method in methods(400) {
        let points = asked(&method, 3);
        assert_eq!(points, asked(&method, 3));
        // The simplex has nothing random.
        assert!(
            matches!(method, Method::NelderMead(_)) || points != asked(&method, 4),
            "another seed asks for the same points: {method:?}"
        );
        assert!(points.iter().flatten().all(|x| (0.0..=1.0).contains(x)), "{method:?}");
        assert!(points.len() <= 400 && points.len() > 60, "{method:?} {}", points.len());
    }
}

#[test]
fn failures_alone_do_no_harm() {
    for method in methods(200) {
        minimize(method.start(3, 1, 1).unwrap().as_mut(), 200, |_, _| Fitness::failed());
    }
}

#[test]
fn defaults_have_no_faults_and_bad_numbers_have() {
    for method in methods(400) {
        assert_eq!(method.faults(10, 1), []);
    }
    let keys = |method: Method| method.faults(40, 2).into_iter().map(|(key, _)| key).collect::<Vec<_>>();
    let published =
        PublishedGenetic { parents: 5, offspring: 8, population: 10, shrink: 0.0, ..Default::default() };
    let expected = ["parents", "offspring", "population", "shrink", "objectives"];
    assert_eq!(keys(Method::PublishedGenetic(published)), expected);
    let cma_es = CmaEs {
        evaluations: 1,
        population: Some(3),
        step: 0.0,
        start: vec![2.0],
        growth: 0.5,
        tolerance: -1.0,
        ..Default::default()
    };
    let expected =
        ["start", "start", "evaluations", "population", "step", "growth", "tolerance", "objectives"];
    assert_eq!(keys(Method::CmaEs(cma_es)), expected);
    let genetic = Genetic {
        population: 5,
        crossover: 2.0,
        crossover_index: -1.0,
        mutation_index: f64::NAN,
        generations: 1,
    };
    assert_eq!(
        keys(Method::Genetic(genetic)),
        ["population", "crossover", "crossover_index", "mutation_index"]
    );
    let nelder_mead = NelderMead { evaluations: 40, start: Vec::new(), step: 0.9, tolerance: -1.0 };
    assert_eq!(keys(Method::NelderMead(nelder_mead)), ["evaluations", "step", "tolerance", "objectives"]);
    assert_eq!(keys(Method::Random(Random { points: 0 })), ["points"]);
    assert_eq!(keys(Method::Sobol(Sobol { points: 0 })), ["points", "parameters"]);
}

#[test]
fn mirror_images() {
    for (y, x) in
        [(0.3, 0.3), (-0.25, 0.25), (1.25, 0.75), (2.25, 0.25), (-1.25, 0.75), (1.0, 1.0), (0.0, 0.0)]
    {
        assert_eq!(mirrored(y), x);
    }
}

/// Median over seeds of the noise-free value at the point recommended after 2,000 evaluations in 10 dimensions.
fn median(method: &Method, noisy: Noisy, seeds: u64) -> f64 {
    let mut values: Vec<f64> = (0..seeds)
        .map(|seed| {
            let noisy = Noisy { seed, ..noisy };
            let best = minimize(method.start(10, 1, seed).unwrap().as_mut(), 2000, |point, n| {
                noisy.fitness(point, n)
            });
            noisy.function.at(&best.unwrap())
        })
        .collect();
    values.sort_by(f64::total_cmp);
    0.5 * (values[(values.len() - 1) / 2] + values[values.len() / 2])
}

const NOISY: [Noisy; 3] = [
    Noisy { function: TestFunction::Rastrigin, sigma: 2.0, seed: 0 },
    Noisy { function: TestFunction::Ackley, sigma: 0.5, seed: 0 },
    Noisy { function: TestFunction::Griewank, sigma: 0.2, seed: 0 },
];

/// Reference: medians of 20 seeds of the published algorithm written by others, with a shrink of 0.8. Quartiles of single
/// searches are about 11, 1.3 and 0.16 apart, so a median of 20 has standard errors of 2.3, 0.28 and 0.033; two of them
/// are allowed. The median of 4,000 seeds is 18.6, 3.34 and 1.19; of medians of 20 a tenth, a fifth and two thirds lie
/// below the reference. Other readings of the paper: mating 1-2, 2-3, 3-4 gives 21.8, 3.7 and 1.23, one weight for all
/// components 22.9, 3.8 and 1.21, mating all 20 strings and keeping 6 of 20 offspring 13.7, 3.0 and 1.18.
#[test]
fn val_published_genetic_has_its_published_place() {
    let method = Method::PublishedGenetic(PublishedGenetic { generations: 141, ..Default::default() });
    for (noisy, (expected, error)) in NOISY.into_iter().zip([(15.9, 2.3), (3.1, 0.28), (1.20, 0.033)]) {
        let found = median(&method, noisy, 100);
        assert!((found - expected).abs() < 2.0 * error, "{noisy:?} {found} {expected}");
    }
}

/// Reference, 20 seeds each: CMA-ES of pygmo 12.7, 0.40, 1.06; genetic algorithm of pymoo 8.8, 3.7, 1.25. Ours are told the
/// noise, which makes their populations grow.
#[test]
fn val_cma_es_beats_the_best_of_others() {
    let method = Method::CmaEs(CmaEs { evaluations: 2000, ..Default::default() });
    for (noisy, most) in NOISY.into_iter().zip([12.7, 0.40, 1.06]) {
        let found = median(&method, noisy, 100);
        assert!(found < most, "{noisy:?} {found} {most}");
    }
}

/// The same algorithm as pymoo's (population 100 there, 40 here); quartiles of single searches are 4, 0.9 and 0.16 apart, so
/// a median of 20 has standard errors of 0.8, 0.2 and 0.035; twice these are allowed above.
#[test]
fn val_genetic_is_as_good_as_others() {
    let method = Method::Genetic(Genetic { generations: 49, ..Default::default() });
    for (noisy, most) in NOISY.into_iter().zip([8.8 + 1.6, 3.7 + 0.4, 1.25 + 0.07]) {
        let found = median(&method, noisy, 100);
        assert!(found < most, "{noisy:?} {found} {most}");
    }
}

/// Reference: 82.5, 18.2 and 60.5, where quartiles of single searches are 13, 1.3 and 20 apart.
#[test]
fn val_random_search_has_its_place() {
    let method = Method::Random(Random { points: 2000 });
    for (noisy, (expected, error)) in NOISY.into_iter().zip([(82.5, 2.7), (18.2, 0.27), (60.5, 4.2)]) {
        let found = median(&method, noisy, 100);
        assert!((found - expected).abs() < 2.0 * error, "{noisy:?} {found} {expected}");
    }
}

/// What is asked for is what is used: with a rugged cost, on which nothing converges, each method asks for exactly as many
/// points as it says, whatever the number.
#[test]
fn budgets_are_used_to_the_last_evaluation() {
    let rugged = |point: &[f64]| point.iter().map(|x| (1e4 * x).sin()).sum::<f64>();
    for dimensions in 1..5 {
        for evaluations in (dimensions + 1).max(2)..40 {
            let genetic = Genetic { population: 4, generations: evaluations / 4, ..Default::default() };
            for method in [
                Method::CmaEs(CmaEs { evaluations, ..Default::default() }),
                Method::NelderMead(NelderMead { evaluations, ..Default::default() }),
                Method::Random(Random { points: evaluations }),
                Method::Sobol(Sobol { points: evaluations }),
                Method::Genetic(genetic),
            ] {
                let mut count = 0;
                let mut search = method.start(dimensions, 1, 3).unwrap();
                let mut turns = agglo_testing::Turns::at_most(1_000_000, "the search to end");
                loop {
                    turns.take();
                    let points = search.ask();
                    if points.is_empty() {
                        break;
                    }
                    count += points.len();
                    search.tell(&points.iter().map(|x| Fitness::new(vec![rugged(x)])).collect::<Vec<_>>());
                }
                assert_eq!(count, method.evaluations(), "{method:?} in {dimensions} dimensions");
                assert_eq!(
                    search.recommended().map(|point| point.len()),
                    Some(dimensions),
                    "coordinates of the recommended point"
                );
            }
        }
    }
}
