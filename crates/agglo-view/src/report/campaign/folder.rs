//! What the folder of a search or study holds, and what of it cannot be used.

use std::path::{Path, PathBuf};

use crate::report::folder::{not_understood, why};
use agglo::folder::names::{self, CAMPAIGN, SCENARIO, SUMMARY};
use agglo::record::Sheet;
use agglo::record::door;
use agglo::scenario::{LoadError, Scenario};
use agglo::search::campaign::CampaignSummary;
use agglo::search::{Campaign, Objective};

/// What the folder of a search or study holds.
#[derive(Debug, Default)]
pub struct Folder {
    /// The folder.
    pub root: PathBuf,
    /// The resolved search or study.
    pub campaign: Option<Campaign>,
    /// Its text.
    pub campaign_text: String,
    /// The scenario that is varied.
    pub scenario: Option<Scenario>,
    /// What it came to.
    pub summary: Option<CampaignSummary>,
    /// Candidates.
    pub evaluations: Sheet,
    /// Generations.
    pub generations: Sheet,
    /// The best candidates.
    pub best: Sheet,
    /// Of a study: single replicates.
    pub runs: Sheet,
    /// Candidates that failed.
    pub failures: Sheet,
    /// Of a study: means of each candidate.
    pub measures: Sheet,
    /// Of a study of refinement: what it says.
    pub refinement: Sheet,
    /// Of a study of refinement: how far each level is from the finest.
    pub differences: Sheet,
    /// Of a study of sensitivity: what it says.
    pub sensitivity: Sheet,
    /// What is missing, cut or damaged.
    pub notes: Vec<String>,
}

impl Folder {
    /// Reads what is there.
    pub fn read(root: &Path) -> Self {
        let mut folder = Self { root: root.to_owned(), ..Self::default() };
        folder.read_campaign();
        folder.read_summary();
        folder.evaluations = folder.sheet(names::EVALUATIONS, true);
        folder.generations = folder.sheet(names::GENERATIONS, true);
        // What is written at the end is not missed before it.
        let has_ended = folder.summary.is_some();
        folder.best = folder.sheet(names::BEST, has_ended);
        if folder.is_study() {
            folder.runs = folder.sheet(names::RUNS, false);
        }
        folder.failures = folder.sheet(names::FAILURES, false);
        folder.measures = folder.sheet(names::MEASURES, has_ended && folder.is_study());
        folder.refinement = folder.sheet(names::REFINEMENT, false);
        folder.differences = folder.sheet(names::DIFFERENCES, false);
        folder.sensitivity = folder.sheet(names::SENSITIVITY, false);
        folder
    }

    /// Whether it is a study and no search.
    pub fn is_study(&self) -> bool {
        self.campaign.as_ref().is_some_and(|campaign| campaign.plan.is_some())
    }

    /// Names of the costs' columns.
    pub fn costs(&self) -> Vec<&str> {
        let is_cost = |name: &&String| *name == "cost" || name.strip_prefix("cost_").is_some_and(is_number);
        self.evaluations.names.iter().filter(is_cost).map(String::as_str).collect()
    }

    /// Names of the parameters' columns.
    pub fn parameters(&self) -> Vec<&str> {
        // They follow the last error of a cost, or the violation where there are no costs, and precede the outcomes.
        let names = &self.evaluations.names;
        let Some(last) = self.last_of_fixed() else { return Vec::new() };
        let count = match (&self.campaign, &self.summary) {
            (Some(campaign), _) => campaign.parameters.len(),
            (None, Some(summary)) => summary.best.as_ref().map_or(0, |best| best.parameters.0.len()),
            (None, None) => 0,
        };
        names.iter().skip(last + 1).take(count).map(String::as_str).collect()
    }

    /// Names of the outcomes' columns.
    pub fn outcomes(&self) -> Vec<&str> {
        let before = self.last_of_fixed().map_or(0, |last| last + 1) + self.parameters().len();
        self.evaluations.names.iter().skip(before).map(String::as_str).collect()
    }

    fn last_of_fixed(&self) -> Option<usize> {
        let is_fixed = |name: &String| name == "violation" || name.ends_with("_standard_error");
        self.evaluations.names.iter().rposition(is_fixed)
    }

    /// What is to be small or large; the names of the costs where that is not known.
    pub fn goals(&self) -> Vec<String> {
        let mut goals: Vec<String> = self.objectives().map(|(formula, _)| formula.to_owned()).collect();
        let costs = self.costs();
        if goals.len() != costs.len() {
            goals = costs.into_iter().map(str::to_owned).collect();
        }
        goals
    }

    /// What each goal is times its cost: 1, or -1 where it is to be large.
    pub fn signs(&self) -> Vec<f64> {
        let known: Vec<f64> =
            self.objectives().map(|(_, is_to_be_large)| if is_to_be_large { -1.0 } else { 1.0 }).collect();
        let costs = self.costs().len();
        if known.len() == costs { known } else { vec![1.0; costs] }
    }

    /// Whether the outcome has limits.
    pub fn has_limits(&self) -> bool {
        self.campaign.as_ref().is_some_and(|campaign| !campaign.limits.is_empty())
    }

    fn objectives(&self) -> impl Iterator<Item = (&str, bool)> {
        let known = self.campaign.iter().flat_map(|campaign| &campaign.objectives);
        known.map(|objective| match objective {
            Objective::Minimize(formula) => (formula.as_str(), false),
            Objective::Maximize(formula) => (formula.as_str(), true),
        })
    }

    fn read_campaign(&mut self) {
        let path = self.root.join(CAMPAIGN);
        let loaded = Campaign::load(&path);
        let text = door::read(&path, door::MOST_OF_A_TABLE).unwrap_or_default();
        self.campaign_text = String::from_utf8_lossy(&text).into_owned();
        match loaded {
            Ok(campaign) => self.campaign = Some(campaign),
            Err(LoadError::Faulty { faults, .. }) => {
                let first = faults.iter().next().map(ToString::to_string).unwrap_or_default();
                self.notes.push(format!(
                    "{CAMPAIGN} is damaged or of another version ({first}): it is shown as it is"
                ));
            }
            Err(LoadError::Unreadable { cause, .. }) => {
                self.notes.push(format!("{CAMPAIGN} {}", why(&cause)));
            }
        }
        match Scenario::load(&self.root.join(SCENARIO)) {
            Ok(scenario) => self.scenario = Some(scenario),
            Err(_) => self
                .notes
                .push(format!("{SCENARIO} is missing or damaged: what to cite for its laws is not known")),
        }
    }

    fn read_summary(&mut self) {
        match door::read_text(&self.root.join(SUMMARY), door::MOST_OF_A_TEXT) {
            Ok(text) => match serde_json::from_str(&text) {
                Ok(summary) => self.summary = Some(summary),
                Err(_) => self.notes.push(not_understood(&text)),
            },
            Err(_) => self.notes.push(format!("{SUMMARY} is missing: the work has not finished")),
        }
    }

    fn sheet(&mut self, name: &str, is_due: bool) -> Sheet {
        let path = self.root.join(name);
        if !path.exists() {
            if is_due {
                self.notes.push(format!("{name} is missing: what it shows is left out"));
            }
            return Sheet::default();
        }
        match Sheet::read(&path) {
            Ok(sheet) => {
                if sheet.dropped > 0 {
                    self.notes.push(format!("{name} is cut or damaged: rows left out: {}", sheet.dropped));
                }
                sheet
            }
            Err(reason) => {
                self.notes.push(format!("{name} cannot be used: {reason}"));
                Sheet::default()
            }
        }
    }
}

fn is_number(text: &str) -> bool {
    text.parse::<u32>().is_ok()
}
