//! What a whole search or study will ask of the machine: replicates times candidates times the time of one run.
//!
//! The time of one run is the mean over some candidates of the box, each of which is tried for a moment on one thread, as
//! the forecast of a run is.

use std::time::Duration;

use super::campaign::{Stage, planned};
use super::file::Campaign;
use super::model::Model;
use super::optimizer::{Optimizer, Point, Sobol};
use super::problem::Problem;
use crate::forecast::{Effort, Plan, duration};
use crate::text::readable;

/// Candidates whose forecasts stand for all.
const SAMPLED: usize = 8;
/// Time on the clock in which each of them is tried.
const TRIED: Duration = Duration::from_millis(300);
/// Bytes of a cell of a table: 17 digits, an exponent, a comma.
const CELL: f64 = 20.0;
/// Bytes of the page and the pictures.
const PAGE: f64 = 3e6;

/// What a whole search or study will ask of the machine.
#[derive(Clone, Debug, PartialEq)]
pub struct CampaignForecast {
    /// Candidates of each stage at the most.
    pub planned: Vec<(Stage, u64)>,
    /// Simulations: at the least, at the most; the run of the best with frames comes besides.
    pub runs: [f64; 2],
    /// Threads, each of which runs one simulation at a time.
    pub threads: usize,
    /// Wall time [s]: at the least, at the most; none if that of one run is not known.
    pub seconds: Option<[f64; 2]>,
    /// Wall time [s] that the file allows.
    pub budget_s: Option<f64>,
    /// Memory [B]; none if that of one run is not known.
    pub memory: Option<f64>,
    /// Disk for tables, pictures and pages, and the run of the best with its frames [B]; none if that is not known.
    pub disk: Option<f64>,
}

impl CampaignForecast {
    /// Works it out for a checked campaign on so many threads.
    pub fn new(campaign: &Campaign, problem: &Problem, threads: usize) -> Self {
        let planned = planned(campaign, problem);
        let confirm = u64::from(campaign.confirm.replicates);
        let [least, most] = [campaign.ensemble.least(), campaign.ensemble.most()].map(u64::from);
        let runs = |each: u64| -> f64 {
            let of = |&(stage, candidates): &(Stage, u64)| {
                candidates as f64 * if stage.is_search() { each } else { confirm } as f64
            };
            planned.iter().map(of).sum()
        };
        let runs = [runs(least), runs(most)];
        let one = OneRun::of(campaign, problem);
        let keeps_best = campaign.plan.is_none();
        let last = f64::from(u8::from(keeps_best));
        let wall = |runs: f64, each: f64| each * (runs / threads as f64).max(1.0) + each * last;
        let candidates: u64 = planned.iter().map(|(_, candidates)| candidates).sum();
        let width = (problem.columns().len() + 2 * campaign.objectives.len()) as f64;
        let of_candidates = candidates as f64 * (width + 7.0 + problem.axes().len() as f64);
        let tables = CELL * (of_candidates + runs[1] * (width + 3.0)) + PAGE;
        Self {
            planned,
            runs,
            threads,
            seconds: one.and_then(|one| one.seconds).map(|each| runs.map(|runs| wall(runs, each))),
            budget_s: campaign.budget.as_ref().map(|budget| budget.time.si()),
            memory: one.map(|one| one.memory * threads as f64),
            disk: if keeps_best { one.and_then(|one| one.disk) } else { Some(0.0) }.map(|best| tables + best),
        }
    }

    /// The forecast as rows of a table: what, how much.
    pub fn rows(&self) -> Vec<(String, String)> {
        let stages: Vec<String> = self.planned.iter().map(stage_in_words).collect();
        let threads =
            if self.threads == 1 { "1 thread".to_owned() } else { format!("{} threads", self.threads) };
        let not_known = || "not known".to_owned();
        let time = self.seconds.map_or_else(not_known, |seconds| {
            let seconds = seconds.map(duration);
            format!("{} on {threads}", from_to(&seconds))
        });
        let time = match self.budget_s {
            Some(budget) => format!("{time}; the budget allows {}", duration(budget)),
            None => time,
        };
        let memory =
            self.memory.map_or_else(not_known, |memory| format!("{} on {threads}", readable(memory, "B")));
        let disk = self.disk.map_or_else(not_known, |disk| format!("up to {}", readable(disk, "B")));
        let rows = [
            ("candidates", format!("at most {}", stages.join(", then "))),
            ("simulations", from_to(&self.runs.map(|runs| format!("{runs}")))),
            ("time of all", time),
            ("memory", memory),
            ("disk", disk),
        ];
        rows.into_iter().map(|(what, words)| (what.to_owned(), words)).collect()
    }
}

fn stage_in_words((stage, candidates): &(Stage, u64)) -> String {
    match stage {
        Stage::Search | Stage::Close => format!("{candidates}"),
        Stage::Polish => format!("{candidates} of the polish"),
        Stage::Confirm => format!("the best {candidates} from fresh replicates"),
        Stage::Final => "the best of those once more".to_owned(),
    }
}

fn from_to(ends: &[String; 2]) -> String {
    if ends[0] == ends[1] { ends[0].clone() } else { format!("{} to {}", ends[0], ends[1]) }
}

/// What one run asks in the mean.
#[derive(Clone, Copy)]
struct OneRun {
    seconds: Option<f64>,
    memory: f64,
    disk: Option<f64>,
}

impl OneRun {
    /// Of some candidates that can be run; none if there are none. What is not known of one is not known.
    fn of(campaign: &Campaign, problem: &Problem) -> Option<Self> {
        // Each simulation of a campaign has one thread.
        let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().ok()?;
        let effort = Effort { budget: TRIED, ..Effort::default() };
        let plan = |point: &Point| {
            let candidate = problem.candidate(point);
            if candidate.violation > 0.0 {
                return None;
            }
            let scenario = problem.scenario(&candidate).ok()?;
            alone.install(|| Plan::with(&scenario, problem.folder(), effort)).ok()
        };
        let plans: Vec<Plan> = points(campaign, problem).iter().filter_map(plan).collect();
        if plans.is_empty() {
            return None;
        }
        let mean = |of: fn(&Plan) -> Option<f64>| {
            let known: Option<Vec<f64>> = plans.iter().map(of).collect();
            known.map(|known| known.iter().sum::<f64>() / known.len() as f64)
        };
        let memory = mean(|plan| Some(plan.memory))?;
        Some(Self { seconds: mean(|plan| plan.seconds), memory, disk: mean(|plan| plan.disk) })
    }
}

/// Some points of a study's plan at equal distances, or some that fill the box.
fn points(campaign: &Campaign, problem: &Problem) -> Vec<Point> {
    if let Some(plan) = &campaign.plan {
        let levels: Vec<Option<usize>> = problem.axes().iter().map(|axis| axis.scale.levels()).collect();
        let points = plan.points(&levels, campaign.seed);
        let every = points.len().div_ceil(SAMPLED).max(1);
        return points.into_iter().step_by(every).collect();
    }
    let dimensions = problem.axes().len();
    let spread = Sobol { points: SAMPLED };
    if !spread.faults(dimensions).is_empty() {
        return vec![vec![0.5; dimensions]];
    }
    spread.start(dimensions, campaign.seed).ask()
}
