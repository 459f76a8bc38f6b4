//! A campaign as a model: from a point to a scenario, from its runs to quantities, costs and limits.

use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, OnceLock};

use serde::Deserialize;
use serde_json::Value as Json;

use super::analysis::Moments;
use super::axes::{self, Knob};
use super::base::BaseScenario;
use super::campaign::LimitKept;
use super::file::Campaign;
use super::formula::{Formula, value_of};
use super::formulas::{Corridor, Cost, Reader};
use super::runner::{Here, Replicate, Runner};
use super::setter::Setter;
use super::space::{self, Axis};
use super::{Candidate, Fitness, Model, Trouble, columns, kernels};
use crate::measure::SizeClasses;
use crate::scenario::{Fault, Faults, Scenario};

/// What a campaign evaluates: its scenario, with values for its parameters.
#[derive(Debug)]
pub struct Problem {
    base: BaseScenario,
    knobs: Vec<Knob>,
    axes: Vec<Axis>,
    derived: Vec<(Setter, Formula)>,
    constraints: Vec<Corridor>,
    objectives: Vec<Cost>,
    limits: Vec<Corridor>,
    columns: Vec<String>,
    /// How many of the columns are shown; the others are what rates by size are worked out from.
    shown: usize,
    /// Classes of sizes, where rates by size are wanted.
    classes: Option<SizeClasses>,
    /// Whether the file has objectives; a study without any is judged by its first column.
    has_objectives: bool,
    runner: Arc<dyn Runner>,
}

/// A candidate's scenario, checked.
#[derive(Clone, Debug)]
pub struct Prepared {
    scenario: Scenario,
    numbers: Vec<f64>,
    text: OnceLock<String>,
}

impl Prepared {
    /// The scenario, with the seed of the base.
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// The scenario as TOML with every default written out, for those who run it elsewhere; it is written once.
    ///
    /// # Errors
    /// As [`Scenario::to_toml`].
    pub fn to_toml(&self) -> Result<&str, Faults> {
        if let Some(text) = self.text.get() {
            return Ok(text);
        }
        let text = self.scenario.to_toml()?;
        Ok(self.text.get_or_init(|| text))
    }
}

impl Problem {
    /// Draws up the problem of a campaign whose file stands in `folder`.
    ///
    /// # Errors
    /// Everything that is wrong with base, parameters and formulas; the keys are paths in the campaign.
    pub fn new(campaign: &Campaign, folder: &Path) -> Result<Self, Faults> {
        let base = BaseScenario::load(campaign, folder).map_err(Faults::new)?;
        let mut faults = Vec::new();
        let mut knobs = Vec::new();
        for (at, parameter) in campaign.parameters.iter().enumerate() {
            match axes::knob(parameter, at, &base) {
                Ok(knob) => knobs.push(knob),
                Err(more) => faults.extend(more),
            }
        }
        // Formulas know a parameter by its name even if its range has faults.
        let names: Vec<&str> = campaign.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
        let is_numeric = |name: &str| {
            knobs.iter().find(|knob: &&Knob| knob.axis.name == name).is_none_or(|knob| knob.axis.is_numeric())
        };
        let mut reader = Reader {
            is_numeric: &is_numeric,
            names: &names,
            known: columns::known(base.scenario.is_hard()),
            columns: Vec::new(),
            faults,
        };
        let derived = reader.derived(&campaign.derived, &base);
        let constraints = reader.constraints(campaign);
        let objectives = reader.objectives(campaign);
        let limits = reader.limits(campaign);
        reader.columns(&campaign.columns);
        let Reader { mut columns, mut faults, .. } = reader;
        faults.extend(kernels::fault(campaign, &base.scenario));
        let (shown, classes) = (columns.len(), kernels::classes(campaign, &base.scenario));
        columns.extend(classes.iter().flat_map(columns::of_totals));
        if !faults.is_empty() {
            return Err(Faults::new(faults));
        }
        let axes = knobs.iter().map(|knob| knob.axis.clone()).collect();
        let has_objectives = !campaign.objectives.is_empty();
        let runner = Arc::new(Here);
        Ok(Self {
            base,
            knobs,
            axes,
            derived,
            constraints,
            objectives,
            limits,
            columns,
            shown,
            classes,
            has_objectives,
            runner,
        })
    }

    /// The same with simulations that someone else runs.
    #[must_use]
    pub fn run_by(self, runner: Arc<dyn Runner>) -> Self {
        Self { runner, ..self }
    }

    /// Classes of sizes, where rates by size are wanted.
    pub fn classes(&self) -> Option<&SizeClasses> {
        self.classes.as_ref()
    }

    /// The name of what gives the quantities instead of runs.
    pub fn function(&self) -> Option<&str> {
        self.runner.function()
    }

    /// The parameters as axes, in the order of a candidate's values.
    pub fn axes(&self) -> &[Axis] {
        &self.axes
    }

    /// The scenario that is varied, with the fixed settings.
    pub fn base(&self) -> &Scenario {
        &self.base.scenario
    }

    /// The folder that the scenario's tables are relative to.
    pub fn folder(&self) -> &Path {
        &self.base.folder
    }

    /// Texts of the file's objectives, and whether each is to be large; a cost is minus the value of such a one.
    pub fn objectives(&self) -> impl Iterator<Item = (&str, bool)> {
        let objectives = self.objectives.iter().filter(|_| self.has_objectives);
        objectives.map(|cost| (cost.formula.text(), cost.sign < 0.0))
    }

    /// The limits of a candidate's outcome over its replicates, and whether they are kept.
    pub fn limits_of(&self, candidate: &Candidate, replicates: &[Vec<f64>]) -> Vec<LimitKept> {
        let numbers = self.numbers(&candidate.values);
        let of = |limit: &Corridor| {
            let values: Vec<f64> =
                replicates.iter().map(|quantities| value_of(&limit.formula, &numbers, quantities)).collect();
            let moments = Moments::of(&values);
            let known = |quantity: f64| Some(quantity).filter(|quantity| quantity.is_finite());
            LimitKept {
                formula: limit.formula.text().to_owned(),
                at_least: limit.at_least,
                at_most: limit.at_most,
                mean: known(moments.mean),
                standard_error: known(moments.standard_error()),
                is_kept: limit.missed(&values) == 0.0,
            }
        };
        self.limits.iter().map(of).collect()
    }

    /// What to keep in mind of the formulas, in words.
    pub fn notes(&self) -> Vec<String> {
        let objectives = self.objectives.iter().map(|cost| &cost.formula);
        let formulas = objectives.chain(self.limits.iter().map(|limit| &limit.formula));
        let with_pi = formulas.filter(|formula| formula.names_pi() && self.base.scenario.is_hard());
        let note = |formula: &Formula| {
            format!(
                "pi in \"{}\" is 3.14159...; the cost Π of growth is the column growth_deficit",
                formula.text()
            )
        };
        with_pi.map(note).collect()
    }

    /// The candidate in the middle of the box.
    pub fn center(&self) -> Candidate {
        self.candidate(&vec![0.5; self.knobs.len()])
    }

    /// A candidate's scenario, checked.
    ///
    /// # Errors
    /// Why it cannot be run.
    pub fn scenario(&self, candidate: &Candidate) -> Result<Scenario, Faults> {
        let mut tree = self.base.tree.clone();
        for (setter, value) in self.assignments(candidate) {
            if value.is_null() {
                let message = "its formula has no value for these parameters".to_owned();
                return Err(Faults::new(vec![Fault::new(setter.key.as_str(), message)]));
            }
            setter.put(&mut tree, value);
        }
        let scenario = Scenario::deserialize(&tree)
            .map_err(|error| Faults::new(vec![Fault::new("", error.to_string())]))?;
        scenario.check()?;
        Ok(scenario)
    }

    /// The settings `key=value` that make the candidate's scenario of the base, as the command line takes them.
    pub fn settings(&self, candidate: &Candidate) -> Vec<String> {
        self.assignments(candidate).map(|(setter, value)| setter.setting(&value)).collect()
    }

    /// The candidates at the ends of each axis, the rest in the middle, that cannot be run, in words.
    pub fn refused_ends(&self) -> Vec<String> {
        let mut notes = Vec::new();
        for (at, axis) in self.axes.iter().enumerate() {
            for end in [0.0, 1.0] {
                let mut point = vec![0.5; self.axes.len()];
                point[at] = end;
                let candidate = self.candidate(&point);
                if candidate.violation > 0.0 {
                    continue;
                }
                if let Err(faults) = self.scenario(&candidate) {
                    let value = axis.readable(candidate.values[at]);
                    let first = faults.iter().next().map(Fault::headline).unwrap_or_default();
                    notes.push(format!(
                        "{} = {value} cannot be run with the rest in the middle: {first}",
                        axis.name
                    ));
                }
            }
        }
        notes
    }

    fn numbers(&self, values: &[f64]) -> Vec<f64> {
        self.axes.iter().zip(values).map(|(axis, value)| axis.number(*value)).collect()
    }

    /// What is set to what: parameters, then keys that follow from them.
    fn assignments<'a>(&'a self, candidate: &'a Candidate) -> impl Iterator<Item = (&'a Setter, Json)> {
        let set = self.knobs.iter().zip(&candidate.values).filter_map(|(knob, value)| {
            let setter = knob.setter.as_ref()?;
            Some((setter, knob.json(setter, *value)))
        });
        let numbers = self.numbers(&candidate.values);
        let follow = self
            .derived
            .iter()
            .map(move |(setter, formula)| (setter, setter.number(value_of(formula, &numbers, &[]))));
        set.chain(follow)
    }

    /// Costs of quantities; `numbers` are the parameters as numbers.
    fn costs_of(&self, numbers: &[f64], quantities: &[f64]) -> Vec<f64> {
        self.objectives.iter().map(|cost| cost.sign * value_of(&cost.formula, numbers, quantities)).collect()
    }

    /// The first objective or limit that has no value for these quantities.
    fn without_value(&self, numbers: &[f64], quantities: &[f64]) -> Option<&str> {
        let objectives = self.objectives.iter().map(|cost| &cost.formula);
        let mut formulas = objectives.chain(self.limits.iter().map(|limit| &limit.formula));
        formulas.find(|formula| !value_of(formula, numbers, quantities).is_finite()).map(Formula::text)
    }
}

impl Model for Problem {
    type Prepared = Prepared;

    fn columns(&self) -> &[String] {
        &self.columns
    }

    fn shown(&self) -> &[String] {
        &self.columns[..self.shown]
    }

    fn candidate(&self, point: &[f64]) -> Candidate {
        let values = space::values(&self.axes, point);
        let numbers = self.numbers(&values);
        let missed = |corridor: &Corridor| corridor.missed(&[value_of(&corridor.formula, &numbers, &[])]);
        // An empty sum would be -0, which orders before 0.
        let violation = self.constraints.iter().map(missed).fold(0.0, |sum, part| sum + part);
        Candidate { point: point.to_vec(), values, violation }
    }

    fn prepare(&self, candidate: &Candidate) -> Result<Prepared, String> {
        let scenario = self.scenario(candidate).map_err(|faults| {
            let lines: Vec<String> = faults.iter().map(Fault::to_string).collect();
            lines.join("; ")
        })?;
        Ok(Prepared { scenario, numbers: self.numbers(&candidate.values), text: OnceLock::new() })
    }

    fn run(&self, prepared: &Prepared, seed: u64, stop: &AtomicBool) -> Result<Vec<f64>, Trouble> {
        let (folder, columns) = (self.base.folder.as_path(), self.columns.as_slice());
        let replicate = Replicate { candidate: prepared, seed, folder, columns };
        let quantities = self.runner.run(&replicate, stop)?;
        match self.without_value(&prepared.numbers, &quantities) {
            Some(formula) => Err(Trouble::Failed(format!("\"{formula}\" has no value for this run"))),
            None => Ok(quantities),
        }
    }

    fn costs(&self, candidate: &Candidate, quantities: &[f64]) -> Vec<f64> {
        self.costs_of(&self.numbers(&candidate.values), quantities)
    }

    /// Costs are means over the replicates, with the standard error of the mean; limits hold for means.
    ///
    /// A candidate without replicates that misses constraints between parameters has that violation and no cost.
    fn fitness(&self, candidate: &Candidate, replicates: &[Vec<f64>]) -> Fitness {
        if replicates.is_empty() {
            let violation = candidate.violation;
            return if violation > 0.0 {
                Fitness { violation, ..Fitness::failed() }
            } else {
                Fitness::failed()
            };
        }
        let numbers = self.numbers(&candidate.values);
        let costs: Vec<Vec<f64>> =
            replicates.iter().map(|quantities| self.costs_of(&numbers, quantities)).collect();
        let of = |objective: usize| costs.iter().map(|costs| costs[objective]).collect::<Vec<_>>();
        let moments: Vec<Moments> = (0..self.objectives.len()).map(|at| Moments::of(&of(at))).collect();
        let limits = self.limits.iter().map(|limit| {
            let values: Vec<f64> =
                replicates.iter().map(|quantities| value_of(&limit.formula, &numbers, quantities)).collect();
            limit.missed(&values)
        });
        Fitness {
            violation: limits.fold(candidate.violation, |sum, part| sum + part),
            costs: moments.iter().map(|cost| cost.mean).collect(),
            standard_errors: moments.iter().map(known_error).collect(),
        }
    }
}

/// 0 from a single replicate, of which no error is known: an optimizer heeds only noise that is known.
fn known_error(cost: &Moments) -> f64 {
    if cost.count > 1 { cost.standard_error() } else { 0.0 }
}

#[cfg(test)]
#[path = "problem_tests.rs"]
mod tests;
