//! What a campaign came to, in one file and one table.

use std::fmt;

use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::Value as Json;

use super::part::Part;
use crate::record::json;
use crate::text::{readable, with_error};

/// What a campaign came to; `summary.json` holds the same.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CampaignSummary {
    /// Version of agglo.
    pub version: String,
    /// The campaign's title.
    pub title: String,
    /// Seed.
    pub seed: u64,
    /// What is to be small or large; the cost of what is to be large is minus its value.
    pub objectives: Vec<Goal>,
    /// Whether it is a study, which tries what it is told to and looks for no best.
    #[serde(default)]
    pub is_study: bool,
    /// Which part of a study it is; left out where it is the whole.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub part: Option<Part>,
    /// The name of what gave the quantities instead of runs; left out where runs did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub function: Option<String>,
    /// The best candidate; null where there is nothing to be small.
    pub best: Option<Best>,
    /// Candidates that no other beats in every cost, where there are several; empty with one.
    pub front: Vec<FrontPoint>,
    /// Batches that were evaluated one after the other.
    pub generations: u64,
    /// Candidates that were evaluated, those included that failed, were excluded, or got fresh replicates at the end.
    pub evaluations: u64,
    /// What each stage came to, beside what it was allowed.
    #[serde(default)]
    pub stages: Vec<Spent>,
    /// Why the search tried fewer candidates than it was allowed: "convergence" or "budget.time"; null if it did not.
    #[serde(default)]
    pub ended_early: Option<String>,
    /// Simulations that count.
    pub runs: u64,
    /// Candidates that failed.
    pub failures: u64,
    /// Candidates that were not run, since they miss a constraint between parameters.
    pub excluded: u64,
    /// Candidates of the search that miss a limit.
    #[serde(default)]
    pub infeasible: u64,
    /// Candidates whose values had been evaluated before, and which were not run again.
    #[serde(default)]
    pub repeats: u64,
    /// How much of the differences between candidates may be chance.
    pub noise: Noise,
    /// What a study says, in sentences; empty for a search.
    #[serde(default)]
    pub findings: Vec<String>,
    /// Wall time [s], all sessions together.
    pub wall_s: f64,
}

/// What a stage of a campaign came to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Spent {
    /// Its word: "search", "polish", "confirm", "final".
    pub stage: String,
    /// Candidates that it was allowed; null if that is not known.
    pub allowed: Option<u64>,
    /// Candidates that it evaluated.
    pub candidates: u64,
    /// Simulations that count.
    pub runs: u64,
}

/// A limit of the outcome, and whether it is kept.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LimitKept {
    /// A column of a run's summary, or a formula of columns and parameters.
    pub formula: String,
    /// Its smallest value.
    pub at_least: Option<f64>,
    /// Its largest value.
    pub at_most: Option<f64>,
    /// Its mean over the replicates.
    pub mean: Option<f64>,
    /// Standard error of that; null from one replicate.
    pub standard_error: Option<f64>,
    /// Whether the mean is within the bounds.
    pub is_kept: bool,
}

impl LimitKept {
    /// "dispersion_degree = 0.75 +- 0.01, where at least 0.8 is wanted: missed".
    pub fn in_words(&self) -> String {
        let error = self.standard_error.map(|error| format!(" +- {}", quantity(error))).unwrap_or_default();
        let mean = self.mean.map_or("unknown".to_owned(), |mean| quantity(mean) + &error);
        let least = self.at_least.map(|least| format!("at least {least}"));
        let most = self.at_most.map(|most| format!("at most {most}"));
        let wanted: Vec<String> = least.into_iter().chain(most).collect();
        let verdict = if self.is_kept { "kept" } else { "missed" };
        format!("{} = {mean}, where {} is wanted: {verdict}", self.formula, wanted.join(" and "))
    }
}

/// What is to be small or large.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Goal {
    /// A column of a run's summary, or a formula of columns and parameters.
    pub formula: String,
    /// Whether it is to be large; its cost is then minus its value.
    pub is_to_be_large: bool,
}

/// The best candidate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Best {
    /// Number of the evaluation that these quantities are from.
    pub evaluation: u64,
    /// Its mean cost over `replicates`; if it was confirmed, over replicates that had no part in choosing it.
    pub cost: f64,
    /// Standard error of that; null from one replicate.
    pub cost_standard_error: Option<f64>,
    /// All costs, if there are several.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub costs: Vec<f64>,
    /// Random replicates.
    pub replicates: u32,
    /// Whether the replicates are fresh.
    pub is_confirmed: bool,
    /// Its mean cost by which it was chosen among those that were run again, which is too good where costs scatter; null if
    /// there was nothing to choose.
    #[serde(default)]
    pub confirm_cost: Option<f64>,
    /// Standard error of that; null from one replicate.
    #[serde(default)]
    pub confirm_cost_standard_error: Option<f64>,
    /// Its mean cost in the search, which is too good where costs scatter; null if the search did not evaluate it.
    pub search_cost: Option<f64>,
    /// Standard error of that; null from one replicate.
    pub search_cost_standard_error: Option<f64>,
    /// By how much it misses the limits: the sum of the parts; 0 if it keeps them.
    pub violation: f64,
    /// The limits of its outcome.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub limits: Vec<LimitKept>,
    /// Seed of its first replicate, which the run in `best/` has.
    pub replicate_seed: u64,
    /// Values by the names of parameters, in SI units; choices as their words.
    pub parameters: Named,
    /// The same for people: "v = 120.5 m/s".
    pub readable: Vec<String>,
    /// Settings that make its scenario of `scenario.toml`: `agglo run scenario.toml --set ...`.
    pub settings: Vec<String>,
    /// Mean quantities by their columns.
    pub quantities: Named,
}

/// A candidate of the front.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrontPoint {
    /// Number of its evaluation.
    pub evaluation: u64,
    /// Its mean costs.
    pub costs: Vec<f64>,
    /// Their standard errors.
    pub standard_errors: Vec<f64>,
    /// Values by the names of parameters.
    pub parameters: Named,
    /// By how much it misses the limits; 0 if it keeps them.
    #[serde(default)]
    pub violation: f64,
}

/// How much of the differences between candidates may be chance; null where it cannot be said.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Noise {
    /// Standard deviation of the cost of one replicate, pooled over all candidates.
    pub replicate_deviation: Option<f64>,
    /// Mean number of replicates of a candidate.
    pub replicates_mean: Option<f64>,
    /// Difference of two candidates' mean costs that chance exceeds once in twenty times, if each has so many replicates of
    /// its own. Common random numbers make smaller differences significant.
    pub significant_difference: Option<f64>,
}

impl CampaignSummary {
    /// The text of `summary.json`.
    pub fn to_json(&self) -> String {
        // A struct of numbers and strings always has a text; numbers that are not finite become null.
        json(self).unwrap_or_default()
    }

    /// The summary as rows of a table: what, how much.
    pub fn table(&self) -> Vec<(String, String)> {
        let mut rows = Vec::new();
        rows.extend(self.part.map(|part| ("part".to_owned(), part.to_string())));
        rows.extend(
            self.function.as_ref().map(|name| ("quantities".to_owned(), format!("by the function {name}"))),
        );
        if let Some(best) = &self.best {
            rows.push((self.best_is_called().to_owned(), self.best_row(best)));
            rows.extend(best.limits.iter().map(|limit| ("  limit".to_owned(), limit.in_words())));
            let parameters = best.readable.iter().filter_map(|text| text.split_once(" = "));
            rows.extend(parameters.map(|(name, value)| (format!("  {name}"), value.to_owned())));
        }
        if !self.front.is_empty() {
            let missed = if self.front.iter().any(|point| point.violation > 0.0) {
                "; all candidates miss a limit"
            } else {
                ""
            };
            let count = self.front.len();
            rows.push(("front".to_owned(), format!("{count} candidates that no other beats{missed}")));
        }
        rows.push(("evaluations".to_owned(), self.evaluations_row()));
        let replicates = self.noise.replicates_mean.map(|mean| format!(", {} a candidate", quantity(mean)));
        rows.push(("runs".to_owned(), format!("{}{}", self.runs, replicates.unwrap_or_default())));
        rows.extend(self.noise_row().map(|row| ("noise".to_owned(), row)));
        rows.extend(self.findings.iter().map(|finding| ("finding".to_owned(), finding.clone())));
        rows.push(("wall time".to_owned(), readable(self.wall_s, "s")));
        rows
    }

    /// A study tries what it was told to; it does not look for the best.
    fn best_is_called(&self) -> &'static str {
        let is_to_be_large = self.objectives.first().is_some_and(|goal| goal.is_to_be_large);
        match (self.is_study, is_to_be_large) {
            (false, _) => "best",
            (true, true) => "largest mean",
            (true, false) => "smallest mean",
        }
    }

    /// What the best candidate comes to, and which limits it misses, in words for a page.
    pub fn best_in_words(&self) -> Option<String> {
        let best = self.best.as_ref()?;
        let missed = best.limits.iter().filter(|limit| !limit.is_kept);
        let missed: Vec<String> = missed.map(LimitKept::in_words).collect();
        let whole = if missed.is_empty() {
            String::new()
        } else {
            format!(
                " It misses {}: {}.",
                if missed.len() == 1 { "a limit" } else { "limits" },
                missed.join("; ")
            )
        };
        Some(format!("The {} has {}.{whole}", self.best_is_called(), self.best_row(best)))
    }

    fn best_row(&self, best: &Best) -> String {
        let goal = self.objectives.first();
        let sign = if goal.is_some_and(|goal| goal.is_to_be_large) { -1.0 } else { 1.0 };
        let value = |cost: f64, error: Option<f64>| {
            error.map_or_else(|| quantity(sign * cost), |error| with_error(sign * cost, error))
        };
        let name = goal.map_or("cost", |goal| goal.formula.as_str());
        let replicates = match (best.replicates, best.is_confirmed) {
            (1, true) => "1 fresh replicate".to_owned(),
            (1, false) => "1 replicate".to_owned(),
            (count, true) => format!("{count} fresh replicates"),
            (count, false) => format!("{count} replicates"),
        };
        let chosen = best.confirm_cost.map(|cost| value(cost, best.confirm_cost_standard_error));
        let chosen = chosen.map(|value| format!("; chosen by {value}")).unwrap_or_default();
        let searched = best.search_cost.filter(|_| best.is_confirmed);
        let searched = searched.map(|cost| value(cost, best.search_cost_standard_error));
        let searched = searched.map(|value| format!("; in the search {value}")).unwrap_or_default();
        let missed = if best.violation > 0.0 { "; IT MISSES THE LIMITS" } else { "" };
        let value = value(best.cost, best.cost_standard_error);
        format!("{name} = {value} from {replicates}{chosen}{searched}{missed}")
    }

    fn evaluations_row(&self) -> String {
        let Self { evaluations, generations, failures, excluded, infeasible, repeats, .. } = self;
        let batches = if *generations == 1 { "1 batch".to_owned() } else { format!("{generations} batches") };
        let stages: Vec<String> = self.stages.iter().map(|stage| self.stage_in_words(stage)).collect();
        let stages = if stages.is_empty() { String::new() } else { format!(": {}", stages.join(", ")) };
        let mut parts = vec![format!("{evaluations} in {batches}{stages}")];
        let counts = [
            (failures, "failed"),
            (excluded, "not run: they miss the constraints"),
            (infeasible, "miss the limits"),
            (repeats, "not run again: their values were known"),
        ];
        for (count, what) in counts {
            parts.extend((*count > 0).then(|| format!("{count} {what}")));
        }
        parts.join("; ")
    }

    /// "search 15 of 24 (it had converged)".
    fn stage_in_words(&self, stage: &Spent) -> String {
        let allowed = stage.allowed.map(|allowed| format!(" of {allowed}")).unwrap_or_default();
        let why = match self.ended_early.as_deref().filter(|_| stage.stage == "search") {
            Some("budget.time") => " (the time was up)",
            Some(_) => " (it had converged)",
            None => "",
        };
        format!("{} {}{allowed}{why}", stage.stage, stage.candidates)
    }

    fn noise_row(&self) -> Option<String> {
        let deviation = self.noise.replicate_deviation?;
        let difference = self.noise.significant_difference?;
        let (deviation, difference) = (quantity(deviation), quantity(difference));
        Some(format!(
            "one replicate scatters by {deviation}; two candidates differ by more than chance (95 %) from {difference} on"
        ))
    }
}

/// Four significant digits.
fn quantity(value: f64) -> String {
    readable(value, "")
}

/// Values by their names, in an order that is kept.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Named(pub Vec<(String, Json)>);

impl Named {
    /// The value of this name.
    pub fn get(&self, name: &str) -> Option<&Json> {
        self.0.iter().find(|(known, _)| known == name).map(|(_, value)| value)
    }
}

impl Serialize for Named {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

impl<'de> Deserialize<'de> for Named {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(NamedVisitor)
    }
}

struct NamedVisitor;

impl<'de> Visitor<'de> for NamedVisitor {
    type Value = Named;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("values by their names")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Named, A::Error> {
        let mut named = Vec::new();
        while let Some(entry) = map.next_entry()? {
            named.push(entry);
        }
        Ok(Named(named))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_keep_their_order() {
        let text = r#"{"v_m_s":120.5,"a":1,"material":"sand"}"#;
        let named: Named = serde_json::from_str(text).unwrap();
        assert_eq!(serde_json::to_string(&named).unwrap(), text);
        assert_eq!(named.get("material"), Some(&Json::from("sand")));
    }
}
