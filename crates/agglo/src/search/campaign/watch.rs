//! Tells the observer how far a campaign is, not too often.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use super::archive::{Archive, Stage};
use super::progress::{CampaignObserver, CampaignProgress};

/// How often the observer is told.
const TELL_EVERY: Duration = Duration::from_millis(100);

/// Keeps the time and tells the observer.
pub struct Watch<'a> {
    observer: &'a mut CampaignObserver<'a>,
    began: Instant,
    told: Option<Instant>,
    evaluations_at_most: Option<u64>,
    /// Evaluations that were known when it sat down.
    known: u64,
    /// -1 where a cost is minus what is to be large; none where there is no goal.
    sign: Option<f64>,
    /// What is still to be told.
    warnings: Vec<String>,
}

/// Where a campaign is.
#[derive(Clone, Copy, Debug)]
pub struct Now {
    /// What happens.
    pub stage: Stage,
    /// Batches that were evaluated so far.
    pub generations: u64,
    /// Candidates of the batch at hand that are decided.
    pub decided: u64,
    /// Simulations that ended in this session.
    pub replicates: u64,
}

impl<'a> Watch<'a> {
    /// Begins with `known` evaluations from earlier sessions; what is told is `sign` times the cost, if there is one.
    pub fn new(
        observer: &'a mut CampaignObserver<'a>,
        began: Instant,
        evaluations_at_most: Option<u64>,
        known: u64,
        sign: Option<f64>,
    ) -> Self {
        Self { observer, began, told: None, evaluations_at_most, known, sign, warnings: Vec::new() }
    }

    /// The same with something to be told first.
    pub fn warning(mut self, warning: Option<&str>) -> Self {
        self.warnings.extend(warning.map(str::to_owned));
        self
    }

    /// Tells the observer, if it is time to; it may ask to stop.
    pub fn tell(&mut self, archive: &Archive, now: &Now) -> ControlFlow<()> {
        if self.told.is_some_and(|told| told.elapsed() < TELL_EVERY) {
            return ControlFlow::Continue(());
        }
        self.told = Some(Instant::now());
        let wall = self.began.elapsed().as_secs_f64();
        let evaluations = archive.evaluations.len() as u64 + now.decided;
        let new = evaluations.saturating_sub(self.known) as f64;
        let left = self.evaluations_at_most.map(|most| most.saturating_sub(evaluations) as f64);
        let of = |best: &super::Evaluation| {
            let error = best.fitness.standard_errors.first().copied().unwrap_or(0.0);
            Some((self.sign? * best.fitness.cost(), error))
        };
        let progress = CampaignProgress {
            best: archive.best().and_then(of),
            has_goal: self.sign.is_some(),
            stage: now.stage,
            evaluations,
            evaluations_at_most: self.evaluations_at_most,
            generations: now.generations,
            replicates: now.replicates,
            replicates_per_second: if wall > 0.0 { now.replicates as f64 / wall } else { 0.0 },
            failures: archive.failures,
            left_s: left.filter(|_| new > 0.0).map(|left| left * wall / new),
            warnings: std::mem::take(&mut self.warnings),
        };
        (self.observer)(&progress)
    }
}
