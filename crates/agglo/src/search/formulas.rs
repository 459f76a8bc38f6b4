//! The formulas of a campaign: what may be named in each, and what is wrong with them.

use super::base::BaseScenario;
use super::file::{Campaign, Derived, Objective};
use super::formula::{Formula, Source};
use super::setter::Setter;
use super::{axes, columns};
use crate::math::formula::{self, PI};
use crate::scenario::{Fault, nearest};

/// A formula and what it must keep to.
#[derive(Clone, Debug)]
pub struct Corridor {
    /// The formula.
    pub formula: Formula,
    /// Its smallest value.
    pub at_least: Option<f64>,
    /// Its largest value.
    pub at_most: Option<f64>,
}

/// A formula that is to be small times a sign.
#[derive(Clone, Debug)]
pub struct Cost {
    /// The formula.
    pub formula: Formula,
    /// 1, or -1 where the formula is to be large.
    pub sign: f64,
}

impl Corridor {
    /// By how much the mean of values misses the bounds, relative to them; the amount itself where a bound is 0.
    pub fn missed(&self, values: &[f64]) -> f64 {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        if mean.is_nan() {
            return f64::INFINITY;
        }
        let relative = |amount: f64, bound: f64| {
            if amount <= 0.0 { 0.0 } else { amount / if bound == 0.0 { 1.0 } else { bound.abs() } }
        };
        self.at_least.map_or(0.0, |bound| relative(bound - mean, bound))
            + self.at_most.map_or(0.0, |bound| relative(mean - bound, bound))
    }
}

/// Reads the formulas of a campaign, and gathers the columns that they name and what is wrong.
pub struct Reader<'a> {
    /// Names of the parameters.
    pub names: &'a [&'a str],
    /// Whether a parameter has numbers.
    pub is_numeric: &'a dyn Fn(&str) -> bool,
    /// Columns that there are.
    pub known: Vec<String>,
    /// Columns that are wanted, in the order in which they are first named.
    pub columns: Vec<String>,
    /// What is wrong.
    pub faults: Vec<Fault>,
}

impl Reader<'_> {
    /// A formula of parameters only.
    fn of_parameters(&mut self, text: &str, key: &str) -> Option<Formula> {
        let read = Formula::new(text, |name| {
            let found = self.parameter(name)?;
            found.ok_or_else(|| {
                let near = nearest(name, self.names.iter().copied());
                unknown(name, &format!("no parameter; parameters are {}", self.names.join(", ")), near)
            })
        });
        read.map_err(|message| self.faults.push(Fault::new(key, message))).ok()
    }

    /// A formula of parameters and columns, with at least one of them.
    fn of_columns(&mut self, text: &str, key: &str) -> Option<Formula> {
        let mut columns = std::mem::take(&mut self.columns);
        let read = Formula::new(text, |name| match self.parameter(name)? {
            Some(source) => Ok(source),
            None => self.column(name, &mut columns).map(Source::Column),
        });
        self.columns = columns;
        let read = read.and_then(|formula| self.with_names(formula));
        read.map_err(|message| self.faults.push(Fault::new(key, message))).ok()
    }

    fn with_names(&self, formula: Formula) -> Result<Formula, String> {
        if !formula.names().is_empty() {
            return Ok(formula);
        }
        let text = formula.text();
        let advice = if formula.names_pi() { self.renamed(PI).unwrap_or_default() } else { String::new() };
        Err(format!(
            "\"{text}\" is always the same: it names no column of the run's summary and no parameter{advice}"
        ))
    }

    /// Advice for the name that a column had in earlier versions.
    fn renamed(&self, name: &str) -> Option<String> {
        let (_, now) =
            RENAMED.iter().find(|(before, now)| *before == name && columns::is_known(now, &self.known))?;
        Some(format!("; {name} is 3.14159..., and the column that had this name is \"{now}\""))
    }

    fn parameter(&self, name: &str) -> Result<Option<Source>, String> {
        let Some(number) = self.names.iter().position(|known| *known == name) else { return Ok(None) };
        if (self.is_numeric)(name) {
            return Ok(Some(Source::Parameter(number)));
        }
        Err(format!("\"{name}\" is a choice of words, which formulas cannot use"))
    }

    /// The number of a column among those that are wanted.
    fn column(&self, name: &str, wanted: &mut Vec<String>) -> Result<usize, String> {
        if !columns::is_known(name, &self.known) {
            if let Some(advice) = self.renamed(name) {
                return Err(format!("\"{name}\" is no column of the run's summary{advice}"));
            }
            let words = self.known.iter().map(String::as_str).chain(self.names.iter().copied());
            let near = nearest(name, words);
            return Err(unknown(name, "neither a parameter nor a column of the run's summary", near));
        }
        Ok(wanted.iter().position(|column| column == name).unwrap_or_else(|| {
            wanted.push(name.to_owned());
            wanted.len() - 1
        }))
    }

    /// The keys that follow from the parameters.
    pub fn derived(&mut self, derived: &[Derived], base: &BaseScenario) -> Vec<(Setter, Formula)> {
        let mut read = Vec::new();
        for (at, follower) in derived.iter().enumerate() {
            let key = format!("derived.{at}.key");
            let formula = self.of_parameters(&follower.formula, &format!("derived.{at}.formula"));
            match axes::setter(&follower.key, &key, base) {
                Ok(setter) if setter.takes_numbers() => read.extend(formula.map(|formula| (setter, formula))),
                Ok(_) => {
                    let message = format!("\"{}\" takes words, and a formula gives numbers", follower.key);
                    self.faults.push(Fault::new(key, message));
                }
                Err(fault) => self.faults.push(*fault),
            }
        }
        read
    }

    /// The constraints between parameters.
    pub fn constraints(&mut self, campaign: &Campaign) -> Vec<Corridor> {
        let mut read = Vec::new();
        for (at, constraint) in campaign.constraints.iter().enumerate() {
            let formula = self.of_parameters(&constraint.formula, &format!("constraints.{at}.formula"));
            let (at_least, at_most) = (constraint.at_least, constraint.at_most);
            read.extend(formula.map(|formula| Corridor { formula, at_least, at_most }));
        }
        read
    }

    /// The objectives; of a study without any, the first of its columns.
    pub fn objectives(&mut self, campaign: &Campaign) -> Vec<Cost> {
        let mut read = Vec::new();
        for (at, objective) in campaign.objectives.iter().enumerate() {
            let (text, word, sign) = match objective {
                Objective::Minimize(text) => (text, "minimize", 1.0),
                Objective::Maximize(text) => (text, "maximize", -1.0),
            };
            let formula = self.of_columns(text, &format!("objectives.{at}.{word}"));
            read.extend(formula.map(|formula| Cost { formula, sign }));
        }
        if let (true, Some(first)) = (campaign.objectives.is_empty(), campaign.columns.first()) {
            let formula = self.of_columns(first, "columns.0");
            read.extend(formula.map(|formula| Cost { formula, sign: 1.0 }));
        }
        read
    }

    /// The limits of the outcome.
    pub fn limits(&mut self, campaign: &Campaign) -> Vec<Corridor> {
        let mut read = Vec::new();
        for (at, limit) in campaign.limits.iter().enumerate() {
            let formula = self.of_columns(&limit.formula, &format!("limits.{at}.formula"));
            let (at_least, at_most) = (limit.at_least, limit.at_most);
            read.extend(formula.map(|formula| Corridor { formula, at_least, at_most }));
        }
        read
    }

    /// Adds the columns that the tables show.
    pub fn columns(&mut self, names: &[String]) {
        for (at, name) in names.iter().enumerate() {
            let mut columns = std::mem::take(&mut self.columns);
            if let Err(message) = self.column(name, &mut columns) {
                let key = format!("columns.{at}");
                // The first one may have been read as what a study measures.
                if !self.faults.iter().any(|fault| fault.key == key) {
                    self.faults.push(Fault::new(key, message));
                }
            }
            self.columns = columns;
        }
    }
}

/// Columns that had another name once: before, now.
const RENAMED: [(&str, &str); 1] = [(PI, "growth_deficit")];

/// Other languages' names of constants and functions say more than a name that looks alike.
fn unknown(name: &str, what: &str, near: Option<&str>) -> String {
    let near = || near.map(|near| format!("did you mean \"{near}\"?"));
    let advice = formula::advice(name).map(str::to_owned).or_else(near);
    let advice = advice.map(|advice| format!("; {advice}")).unwrap_or_default();
    format!("\"{name}\" is {what}{advice}")
}
