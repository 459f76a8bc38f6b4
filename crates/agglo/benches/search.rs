//! What an optimizer costs for each evaluation, ask and tell together: 2,000 evaluations of a bowl in 10 dimensions.

use agglo::search::functions::{TestFunction, minimize};
use agglo::search::optimizer::{CmaEs, Genetic, Method, NelderMead, PublishedGenetic, Random, Sobol};
use agglo::search::{Campaign, Fitness, Model, Problem};
use divan::Bencher;
use divan::counter::ItemsCount;

fn main() {
    divan::main();
}

fn search(bencher: Bencher, method: &Method, dimensions: usize) {
    let run = || {
        let mut evaluations = 0_usize;
        let mut search = method.start(dimensions, 1, 1).expect("a method of its own");
        minimize(search.as_mut(), 2000, |point, _| {
            evaluations += 1;
            Fitness::new(vec![TestFunction::Rosenbrock.at(point)])
        });
        evaluations
    };
    bencher.counter(ItemsCount::new(run())).bench(run);
}

#[divan::bench(args = [10, 30])]
fn cma_es(bencher: Bencher, dimensions: usize) {
    search(bencher, &Method::CmaEs(CmaEs { evaluations: 2000, ..Default::default() }), dimensions);
}

#[divan::bench]
fn genetic(bencher: Bencher) {
    search(bencher, &Method::Genetic(Genetic { generations: 49, ..Default::default() }), 10);
}

#[divan::bench]
fn published_genetic(bencher: Bencher) {
    search(
        bencher,
        &Method::PublishedGenetic(PublishedGenetic { generations: 141, ..Default::default() }),
        10,
    );
}

#[divan::bench]
fn nelder_mead(bencher: Bencher) {
    search(bencher, &Method::NelderMead(NelderMead { evaluations: 2000, ..Default::default() }), 10);
}

#[divan::bench]
fn random(bencher: Bencher) {
    search(bencher, &Method::Random(Random { points: 2000 }), 10);
}

#[divan::bench]
fn sobol(bencher: Bencher) {
    search(bencher, &Method::Sobol(Sobol { points: 2000 }), 10);
}

/// From a point to a checked scenario with ten values set.
#[divan::bench]
fn prepare_a_scenario(bencher: Bencher) {
    let text = include_str!("../../../scenarios/search-agglomeration.toml");
    let Ok(campaign) = Campaign::from_toml(text) else { return };
    let Ok(problem) = Problem::new(&campaign, std::path::Path::new("")) else { return };
    bencher.bench(|| problem.prepare(&problem.candidate(&[0.4; 10])));
}
