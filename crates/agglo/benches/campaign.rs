//! What a campaign costs for each candidate outside the model: 20,000 candidates of a model that takes no time, through
//! workers, journal and tables into a folder.

use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;

use agglo::folder::CampaignFolder;
use agglo::search::analysis::Moments;
use agglo::search::campaign::{CampaignEnding, Course, Goal, conduct};
use agglo::search::functions::TestFunction;
use agglo::search::optimizer::PublishedGenetic;
use agglo::search::{Axis, Candidate, Confirm, Ensemble, Fitness, Model, Scale, Trouble};
use divan::Bencher;
use divan::counter::ItemsCount;

fn main() {
    divan::main();
}

/// A function of ten parameters.
struct Bowl(Vec<String>);

impl Model for Bowl {
    type Prepared = Vec<f64>;

    fn columns(&self) -> &[String] {
        &self.0
    }

    fn candidate(&self, point: &[f64]) -> Candidate {
        Candidate { point: point.to_vec(), values: point.to_vec(), violation: 0.0 }
    }

    fn prepare(&self, candidate: &Candidate) -> Result<Vec<f64>, String> {
        Ok(candidate.values.clone())
    }

    fn run(&self, values: &Vec<f64>, _: u64, _: &AtomicBool) -> Result<Vec<f64>, Trouble> {
        Ok(vec![TestFunction::Rosenbrock.at(values)])
    }

    fn costs(&self, _: &Candidate, quantities: &[f64]) -> Vec<f64> {
        quantities.to_vec()
    }

    fn fitness(&self, _: &Candidate, replicates: &[Vec<f64>]) -> Fitness {
        Fitness::new(vec![Moments::of(&replicates.concat()).mean])
    }
}

fn campaign(threads: usize, replicates: u32) {
    let model = Bowl(vec!["value".to_owned()]);
    let dir = tempfile::tempdir().expect("a folder for temporary files");
    let folder = CampaignFolder::create(&dir.path().join("out")).expect("an empty folder");
    folder.put("", "").expect("a folder that can be written");
    let axis =
        |k: usize| Axis { name: format!("x{k}"), unit: String::new(), scale: Scale::Linear([0.0, 1.0]) };
    let method = PublishedGenetic { generations: 1427, ..PublishedGenetic::default() };
    let course = Course {
        title: "bowl",
        seed: 1,
        is_study: false,
        part: None,
        threads,
        parameters: (0..10).map(axis).collect(),
        objectives: vec![Goal { formula: "value".to_owned(), is_to_be_large: false }],
        ensemble: Ensemble::fixed(replicates),
        function: None,
        is_led: false,
        optimizer: Box::new(method.start(10, 1)),
        planned: Vec::new(),
        budget_s: None,
        limits: &|_| Vec::new(),
        polish: None,
        confirm: Confirm { candidates: 0, replicates: 0 },
        settings: &|_| Vec::new(),
        findings: &|_| Vec::new(),
        closing: &mut |_, _| Ok(ControlFlow::Continue(())),
    };
    let ended = conduct(&model, course, (&folder, ""), &mut |_| ControlFlow::Continue(()));
    let Ok(CampaignEnding::Finished(summary)) = ended else { panic!("not finished: {ended:?}") };
    assert_eq!(summary.evaluations, 19_998);
}

/// Candidates per second with one replicate each.
#[divan::bench(args = [1, 2], sample_count = 5, sample_size = 1)]
fn campaign_overhead(bencher: Bencher, threads: usize) {
    bencher.counter(ItemsCount::new(19_998_u32)).bench(|| campaign(threads, 1));
}

/// Replicates per second with ten for each candidate.
#[divan::bench(args = [1, 2], sample_count = 5, sample_size = 1)]
fn replicate_overhead(bencher: Bencher, threads: usize) {
    bencher.counter(ItemsCount::new(199_980_u32)).bench(|| campaign(threads, 10));
}
