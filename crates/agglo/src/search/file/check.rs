//! The rules between the keys of a campaign, its base included; all faults at once.

use std::path::Path;

use super::{Campaign, Constraint, Limit};
use crate::math::formula;
use crate::scenario::Fault;
use crate::search::campaign::is_taken as is_taken_by_tables;
use crate::search::optimizer::Method;
use crate::search::{Axis, Model, Problem, Until, columns};
use crate::text::readable;

/// Everything that is wrong with a campaign whose form is right; files are relative to `folder`.
pub(super) fn faults(campaign: &Campaign, folder: &Path) -> Vec<Fault> {
    let mut check = Check { campaign, faults: Vec::new() };
    check.version();
    check.names();
    check.keys();
    check.corridors();
    check.kind();
    check.ensemble();
    check.method();
    let mut faults = check.faults;
    match Problem::new(campaign, folder) {
        Ok(problem) if faults.is_empty() => {
            faults.extend(table_columns(&problem));
            faults.extend(plan(campaign, &problem));
            faults.extend(center(campaign, &problem));
        }
        Ok(_) => {}
        Err(more) => faults.extend(more.iter().cloned()),
    }
    faults
}

struct Check<'a> {
    campaign: &'a Campaign,
    faults: Vec<Fault>,
}

impl Check<'_> {
    fn fail(&mut self, key: impl Into<String>, message: impl Into<String>) {
        self.faults.push(Fault::new(key, message));
    }

    fn version(&mut self) {
        let version = self.campaign.version;
        if version != 1 {
            let fault = Fault::new("version", format!("found {version}; this program reads version 1"));
            self.faults.push(fault.with_help("write version = 1"));
        }
        if i64::try_from(self.campaign.seed).is_err() {
            self.fail("seed", format!("found {}; at most {} is allowed", self.campaign.seed, i64::MAX));
        }
    }

    /// Names are words that formulas can use, and no two are the same.
    fn names(&mut self) {
        let columns = [true, false].map(columns::known).concat();
        let parameters = &self.campaign.parameters;
        if parameters.is_empty() {
            self.fail("parameters", "is empty; at least one parameter is wanted");
        }
        for (at, parameter) in parameters.iter().enumerate() {
            let key = format!("parameters.{at}.name");
            let name = &parameter.name;
            let begins = name.starts_with(|c: char| c.is_ascii_alphabetic());
            if !begins || !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') {
                let message =
                    format!("\"{name}\" is no name: a letter, then letters, digits and underscores");
                self.fail(key, message);
            } else if let Some(meaning) = formula::meaning(name) {
                self.fail(key, format!("\"{name}\" is {meaning}; choose another name"));
            } else if columns.contains(name) {
                self.fail(key, format!("\"{name}\" is a column of the summary; choose another name"));
            } else if parameters[..at].iter().any(|earlier| earlier.name == *name) {
                self.fail(key, format!("there are two parameters \"{name}\""));
            }
        }
    }

    /// No key of the scenario is set by two.
    fn keys(&mut self) {
        let set = self
            .campaign
            .parameters
            .iter()
            .zip(0..)
            .filter_map(|(parameter, at)| Some((format!("parameters.{at}.key"), parameter.key.clone()?)));
        let follow = self
            .campaign
            .derived
            .iter()
            .zip(0..)
            .map(|(derived, at)| (format!("derived.{at}.key"), derived.key.clone()));
        let all: Vec<(String, String)> = set.chain(follow).collect();
        for (at, (place, key)) in all.iter().enumerate() {
            if key == "seed" {
                self.fail(
                    place,
                    "the seed belongs to the random replicates; `ensemble` says how many there are",
                );
            }
            let clash = all[..at].iter().find(|(_, earlier)| {
                let within = |a: &str, b: &str| a.strip_prefix(b).is_some_and(|rest| rest.starts_with('.'));
                earlier == key || within(earlier, key) || within(key, earlier)
            });
            if let Some((other, _)) = clash {
                self.fail(place, format!("\"{key}\" is set by {} too", other.trim_end_matches(".key")));
            }
        }
    }

    /// Constraints and limits have a bound, and the lower is not above the upper.
    fn corridors(&mut self) {
        let constraints = self
            .campaign
            .constraints
            .iter()
            .map(|Constraint { at_least, at_most, .. }| (*at_least, *at_most));
        let limits = self.campaign.limits.iter().map(|Limit { at_least, at_most, .. }| (*at_least, *at_most));
        let bounds: Vec<_> = constraints
            .enumerate()
            .map(|(at, bounds)| (format!("constraints.{at}"), bounds))
            .chain(limits.enumerate().map(|(at, bounds)| (format!("limits.{at}"), bounds)))
            .collect();
        for (key, bounds) in bounds {
            match bounds {
                (None, None) => self.fail(key, "has no bound; at_least, at_most or both are wanted"),
                (Some(least), Some(most)) if least > most => {
                    self.fail(key, format!("nothing is at least {least} and at most {most}"));
                }
                _ => {}
            }
        }
    }

    /// A search has a method and costs; a study has a plan and something to measure.
    fn kind(&mut self) {
        let Campaign { method, plan, objectives, columns, polish, .. } = self.campaign;
        match (method, plan) {
            (Some(_), Some(_)) => self.fail("plan", "a search has a method and a study a plan; found both"),
            (None, None) => self.fail("", "neither method nor plan: a search has a method, a study a plan"),
            (Some(_), None) if objectives.is_empty() => {
                self.fail("objectives", "is empty; a search makes something small or large");
            }
            (None, Some(_)) if objectives.is_empty() && columns.is_empty() => {
                self.fail("columns", "is empty; a study without objectives measures columns of the summary");
            }
            _ => {}
        }
        if objectives.len() > 2 {
            self.fail(
                "objectives.2",
                format!("found {} objectives; at most 2 make a front", objectives.len()),
            );
        }
        if polish.is_some() && (method.is_none() || objectives.len() != 1) {
            self.fail("polish", "improves the best candidate of a search with one objective");
        }
        if let Some(budget) = &self.campaign.budget {
            let seconds = budget.time.si();
            if plan.is_some() {
                self.fail("budget", "is for searches; a study runs its whole plan");
            } else if seconds <= 0.0 {
                self.fail(
                    "budget.time",
                    format!("found {}; more than 0 s is wanted", readable(seconds, "s")),
                );
            }
        }
        let confirm = &self.campaign.confirm;
        if confirm.candidates > 0 && confirm.replicates == 0 {
            self.fail("confirm.replicates", "found 0; 1 or more is wanted, or candidates = 0");
        }
    }

    fn ensemble(&mut self) {
        match &self.campaign.ensemble.until {
            Until::Fixed(fixed) => {
                if fixed.replicates == 0 {
                    self.fail("ensemble.until.fixed.replicates", "found 0; 1 or more is wanted");
                }
            }
            Until::RunningMean(rule) => {
                self.positive("ensemble.until.running_mean.tolerance", rule.tolerance);
                self.counts("ensemble.until.running_mean", rule.least, 2, rule.most);
            }
            Until::Confidence(rule) => {
                self.positive("ensemble.until.confidence.half_width", rule.half_width);
                if !(rule.level > 0.0 && rule.level < 1.0) {
                    let message = format!("found {}; a number between 0 and 1 is wanted", rule.level);
                    self.fail("ensemble.until.confidence.level", message);
                }
                self.counts("ensemble.until.confidence", rule.least, 2, rule.most);
            }
        }
    }

    fn positive(&mut self, key: &str, value: f64) {
        if value <= 0.0 {
            self.fail(key, format!("found {value}; more than 0 is wanted"));
        }
    }

    /// Rules that compare replicates need two of them.
    fn counts(&mut self, key: &str, least: u32, fewest: u32, most: u32) {
        if least < fewest {
            self.fail(format!("{key}.least"), format!("found {least}; {fewest} or more is wanted"));
        }
        if most < least {
            self.fail(format!("{key}.most"), format!("found {most}, fewer than least = {least}"));
        }
    }

    fn method(&mut self) {
        let Campaign { method, polish, parameters, objectives, .. } = self.campaign;
        if parameters.is_empty() || objectives.is_empty() {
            return;
        }
        if let Some(method) = method {
            let place = format!("method.{}", method.word());
            self.own(&place, method.faults(parameters.len(), objectives.len()));
        }
        if let Some(polish) = polish {
            self.own("polish", Method::NelderMead(polish.clone()).faults(parameters.len(), 1));
        }
    }

    /// Takes over what a method says of itself; what it says of the campaign stands there.
    fn own(&mut self, place: &str, faults: Vec<(&'static str, String)>) {
        for (key, message) in faults {
            let is_own = !matches!(key, "objectives" | "parameters");
            self.fail(if is_own { format!("{place}.{key}") } else { key.to_owned() }, message);
        }
    }
}

/// A parameter's column, which has its unit in its name, must be the only one of that name in the tables.
fn table_columns(problem: &Problem) -> Vec<Fault> {
    let axes: Vec<String> = problem.axes().iter().map(Axis::column).collect();
    let is_taken = |at: usize| {
        let column = &axes[at];
        let is_an_error = ["_standard_error", "_standard_deviation"].iter().any(|end| column.ends_with(end));
        let is_searched = column.starts_with("search_") || column.starts_with("final_");
        is_taken_by_tables(column)
            || is_an_error
            || is_searched
            || problem.columns().contains(column)
            || axes[..at].contains(column)
    };
    let fault = |at: usize| {
        let message = format!(
            "its column in the tables would be \"{}\", which they have already; choose another name",
            axes[at]
        );
        Fault::new(format!("parameters.{at}.name"), message)
    };
    (0..axes.len()).filter(|at| is_taken(*at)).map(fault).collect()
}

/// What is wrong with a plan, whose rules depend on how many values its parameters have.
fn plan(campaign: &Campaign, problem: &Problem) -> Vec<Fault> {
    let Some(plan) = &campaign.plan else { return Vec::new() };
    let levels: Vec<Option<usize>> = problem.axes().iter().map(|axis| axis.scale.levels()).collect();
    let word = plan.word();
    let place = |key: &str| if key == word { format!("plan.{word}") } else { format!("plan.{word}.{key}") };
    plan.faults(&levels).into_iter().map(|(key, message)| Fault::new(place(key), message)).collect()
}

/// The scenario in the middle of the box must be valid; a fault stands at the parameter that sets its key, if one does.
fn center(campaign: &Campaign, problem: &Problem) -> Vec<Fault> {
    let center = problem.center();
    let Err(faults) = problem.scenario(&center) else { return Vec::new() };
    let settings = problem.settings(&center).join(" ");
    let place = |fault: &Fault| {
        let owner =
            campaign.parameters.iter().position(|parameter| parameter.key.as_ref() == Some(&fault.key));
        let key = owner.map_or("parameters".to_owned(), |at| format!("parameters.{at}.key"));
        let message = format!("the middle of the box cannot be run: {}", fault.headline());
        Fault::new(key, message).with_help(format!("it is the base with --set {settings}"))
    };
    faults.iter().map(place).collect()
}
