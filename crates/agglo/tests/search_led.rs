//! Campaigns that a program leads and others run: the same bits, and nothing of one point told as another's.

#[macro_use]
extern crate agglo_testing;

use std::collections::BTreeMap;
use std::fs;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use agglo::search::campaign::{self, CampaignEnding, CampaignError, CampaignProgress, Means};
use agglo::search::optimizer::{Optimizer, Point};
use agglo::search::{Campaign, Fitness, Replicate, Runner, Trouble, quantities};

const LED: &str = r#"
version = 1
base.template = "reacting"
settings = ["time.end=2 ms", "grains.0.size.length_ratio.count=40", "grains.0.placement.fill.count=40"]
objectives = [{ minimize = "growth_deficit" }]
ensemble.until.fixed.replicates = 2
confirm = { candidates = 1, replicates = 2 }
[[parameters]]
name = "v"
key = "grains.0.velocity_spread.uniform.bounds.0"
range.linear = { lower = "20 m/s", upper = "200 m/s" }
[method.external]
evaluations = 7
"#;

/// Goes along an axis, three points at a time.
struct March {
    step: f64,
    at: usize,
    fails_after: usize,
}

impl March {
    fn new(step: f64) -> Self {
        Self { step, at: 0, fails_after: usize::MAX }
    }
}

impl Optimizer for March {
    fn ask(&mut self) -> Vec<Point> {
        self.at += 3;
        (self.at - 3..self.at).map(|at| vec![self.step * at as f64]).collect()
    }

    fn tell(&mut self, fitnesses: &[Fitness]) {
        assert_all!(fitnesses.iter(), |fitness| fitness.costs.len() == 1 && fitness.cost().is_finite());
    }

    fn recommended(&self) -> Option<Point> {
        None
    }

    fn has_failed(&self) -> bool {
        self.at > self.fails_after
    }
}

/// Someone else who runs the simulations.
#[derive(Debug, Default)]
struct Elsewhere(AtomicUsize);

impl Runner for Elsewhere {
    fn run(&self, replicate: &Replicate<'_>, stop: &AtomicBool) -> Result<Vec<f64>, Trouble> {
        self.0.fetch_add(1, Ordering::Relaxed);
        let text = replicate.candidate.to_toml().expect("it can be written");
        let scenario = agglo::scenario::Scenario::from_toml(text).expect("it reads back");
        quantities(&scenario, replicate.seed, replicate.folder, replicate.columns, stop)
    }
}

fn led(dir: &Path, means: Means<'_>) -> Result<CampaignEnding, CampaignError> {
    let go_on = &mut |_: &CampaignProgress| ControlFlow::Continue(());
    if dir.exists() {
        return campaign::resume(dir, means, go_on);
    }
    let campaign = Campaign::from_toml(LED).unwrap_or_else(|faults| panic!("{faults}"));
    campaign::run(&campaign, Path::new(""), dir, means, go_on)
}

fn by(proposer: March) -> Means<'static> {
    Means { proposer: Some(Box::new(proposer)), ..Means::threads(2) }
}

/// All tables and the summary but for wall times.
fn files(dir: &Path) -> BTreeMap<String, String> {
    let texts = fs::read_dir(dir).expect("a folder").flatten().filter(|entry| entry.path().is_file());
    let kept =
        |text: String| text.lines().filter(|line| !line.contains("wall_s")).collect::<Vec<_>>().join("\n");
    texts
        .filter(|entry| entry.file_name() != ".agglo.lock")
        .map(|entry| {
            (
                entry.file_name().into_string().expect("text"),
                kept(fs::read_to_string(entry.path()).expect("a text")),
            )
        })
        .collect()
}

#[test]
fn a_campaign_that_a_program_leads_goes_on_with_the_same_bits_whoever_runs_it() {
    let folder = tempfile::tempdir().unwrap();
    let [whole, broken, elsewhere] = ["whole", "broken", "elsewhere"].map(|name| folder.path().join(name));
    let CampaignEnding::Finished(summary) = led(&whole, by(March::new(0.1))).unwrap() else {
        panic!("nobody asked it to stop")
    };
    assert_eq!(summary.stages[0].candidates, 7, "the last batch is cut to what the file allows");

    let failing = March { fails_after: 3, ..March::new(0.1) };
    assert_matches!(led(&broken, by(failing)), Ok(CampaignEnding::Interrupted));
    let error = led(&broken, by(March::new(0.11))).unwrap_err();
    assert!(matches!(error, CampaignError::OtherPoint { evaluation: 1 }), "{error}");
    led(&broken, by(March::new(0.1))).unwrap();
    assert_eq!(files(&broken), files(&whole));

    let others = Arc::new(Elsewhere::default());
    let runner: Arc<dyn Runner> = Arc::clone(&others) as _;
    led(&elsewhere, Means { runner: Some(runner), ..by(March::new(0.1)) }).unwrap();
    assert_eq!(files(&elsewhere), files(&whole));
    assert_eq!(
        others.0.load(Ordering::Relaxed),
        2 * (7 + 1),
        "two replicates each, those of the confirmation too"
    );
}

#[test]
fn without_a_program_nothing_is_begun() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path().join("led");
    let error = led(&dir, Means::threads(1)).unwrap_err();
    assert!(matches!(error, CampaignError::NoProposer) && error.exit_code() == 2, "{error}");
    assert_false!(dir.exists(), "a folder of a campaign that was refused");
    let own = LED.replace("[method.external]\nevaluations = 7", "[method.random]\npoints = 3");
    let own = Campaign::from_toml(&own).unwrap_or_else(|faults| panic!("{faults}"));
    let go_on = &mut |_: &CampaignProgress| ControlFlow::Continue(());
    let error = campaign::run(&own, Path::new(""), &dir, by(March::new(0.1)), go_on).unwrap_err();
    assert!(error.to_string().starts_with("found method.random; a campaign whose"), "{error}");
    assert_false!(dir.exists(), "a folder of a campaign that was refused");
}
