//! Everything of a campaign but its model, and what it came to.

use std::ops::{ControlFlow, Range};

use super::CampaignError;
use super::archive::{Evaluation, Stage};
use super::journal::Origin;
use super::part::Part;
use super::summary::{CampaignSummary, Goal, LimitKept};
use crate::folder::CampaignFolder;
use crate::search::optimizer::Optimizer;
use crate::search::{Axis, Candidate, Confirm, Ensemble};

/// Begins the improvement of the best point.
pub type Polish<'a> = dyn Fn(&[f64]) -> Box<dyn Optimizer> + 'a;

/// What is done in the folder once all is evaluated, before the summary is written. It may find its own work done, and
/// it breaks off where the second argument does.
pub type Closing<'a> = dyn FnMut(&Results<'_>, &mut Ask<'_>) -> Result<ControlFlow<()>, CampaignError> + 'a;

/// Tells the observer, who may ask to stop.
pub type Ask<'a> = dyn FnMut() -> ControlFlow<()> + Send + 'a;

/// Everything of a campaign but its model.
pub struct Course<'a> {
    /// One line that says what it is.
    pub title: &'a str,
    /// Seed of the random replicates.
    pub seed: u64,
    /// Worker threads; at least 1.
    pub threads: usize,
    /// Whether its optimizer is a plan.
    pub is_study: bool,
    /// The part of it that is evaluated, with the numbers of its evaluations; none for all.
    pub part: Option<(Part, Range<u64>)>,
    /// The parameters, in the order of a candidate's values.
    pub parameters: Vec<Axis>,
    /// What is to be small or large.
    pub objectives: Vec<Goal>,
    /// How many random replicates a candidate gets.
    pub ensemble: Ensemble,
    /// The name of what gives the quantities instead of runs.
    pub function: Option<String>,
    /// Whether a program outside proposes the points.
    pub is_led: bool,
    /// What proposes the points.
    pub optimizer: Box<dyn Optimizer>,
    /// Candidates that each stage is allowed; empty if that is not known.
    pub planned: Vec<(Stage, u64)>,
    /// Wall time [s] that the whole campaign is to end in; none for as long as it takes.
    pub budget_s: Option<f64>,
    /// Improves the best point at the end.
    pub polish: Option<&'a Polish<'a>>,
    /// What the best candidates are held to.
    pub confirm: Confirm,
    /// Settings that make a candidate's scenario of the base.
    pub settings: &'a dyn Fn(&Candidate) -> Vec<String>,
    /// The limits of an evaluation's outcome, and whether it keeps them.
    pub limits: &'a dyn Fn(&Evaluation) -> Vec<LimitKept>,
    /// What the evaluations say, in sentences.
    pub findings: &'a dyn Fn(&[Evaluation]) -> Vec<String>,
    /// What is done once all is evaluated.
    pub closing: &'a mut Closing<'a>,
}

impl Course<'_> {
    /// What its replicates come from; `campaign` is its text.
    pub(super) fn origin<'a>(&'a self, campaign: &'a str) -> Origin<'a> {
        Origin { campaign, function: self.function.as_deref() }
    }

    /// Number of the first evaluation that is its own.
    pub(super) fn first(&self) -> u64 {
        self.part.as_ref().map_or(0, |(_, own)| own.start)
    }
}

/// What a campaign came to, for its closing.
pub struct Results<'a> {
    /// The campaign's folder.
    pub folder: &'a CampaignFolder,
    /// Its summary but for the wall time.
    pub summary: &'a CampaignSummary,
    /// The best candidate.
    pub best: Option<&'a Candidate>,
    /// All that was evaluated.
    pub evaluations: &'a [Evaluation],
    /// Names of the model's columns.
    pub columns: &'a [String],
}
