//! What a checked scenario will ask of the machine, and how far its models are to be believed.
//!
//! Everything here is an estimate from closed forms; nothing is simulated.

mod counts;
mod forecast;
mod gas;
mod hard;
mod notes;
mod push;
mod steps;

use std::fmt;
use std::path::Path;

use super::figures::{digits, readable};
use super::types::Scenario;

/// The plan of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plan {
    /// Expected number of grains.
    pub grains: u64,
    /// Rays of all beams in one pulse each.
    pub rays_per_pulse: u64,
    /// Pulses of all beams that start before the end.
    pub pulses: u64,
    /// Expected number of impacts of hard spheres.
    pub impacts: f64,
    /// Expected number of steps; from impact to impact none. Soft spheres with adaptive steps: the least.
    pub steps: f64,
    /// Length of a step [s]; 0 for hard spheres, whose steps follow the gaps.
    pub step: f64,
    /// Expected memory [B].
    pub memory: f64,
    /// Very rough time of the run on this machine [s].
    pub seconds: f64,
    /// What else is worth knowing: label and value.
    pub figures: Vec<(String, String)>,
    /// What to keep in mind: validity of the models, laws that do not converge, settings without effect.
    pub notes: Vec<String>,
}

impl Plan {
    /// Works out the plan; `base` is the folder that the scenario's tables are relative to.
    pub fn new(scenario: &Scenario, base: &Path) -> Self {
        let mut plan = Self::default();
        let counts = counts::grains(&mut plan, scenario, base);
        if scenario.engine.is_hard() {
            hard::estimate(&mut plan, scenario, &counts);
        } else {
            counts::pulses(&mut plan, scenario);
            steps::estimate(&mut plan, scenario);
        }
        let pushes = push::all(scenario);
        push::describe(&mut plan, &pushes);
        notes::collect(&mut plan, scenario, &pushes);
        plan
    }

    fn rows(&self) -> Vec<(String, String)> {
        let mut rows = vec![("grains".to_owned(), self.grains.to_string())];
        if self.pulses > 0 {
            rows.push(("rays per pulse".to_owned(), self.rays_per_pulse.to_string()));
            rows.push(("pulses".to_owned(), self.pulses.to_string()));
        }
        if self.step > 0.0 {
            let steps = format!("{} of {}", digits(self.steps.ceil()), readable(self.step, "s"));
            rows.push(("steps".to_owned(), steps));
        }
        rows.extend(self.figures.iter().cloned());
        rows.push(("memory".to_owned(), readable(self.memory, "B")));
        rows.push(("time of the run".to_owned(), format!("{}, very roughly", duration(self.seconds))));
        rows
    }
}

/// A time as people say it: "3 s", "12 min", "5 h".
fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 1.0 => "less than 1 s".to_owned(),
        s if s < 120.0 => format!("{s:.0} s"),
        s if s < 7200.0 => format!("{:.0} min", s / 60.0),
        s if s < 172_800.0 => format!("{:.0} h", s / 3600.0),
        s => format!("{:.0} days", s / 86_400.0),
    }
}

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rows = self.rows();
        let width = rows.iter().map(|(label, _)| label.chars().count()).max().unwrap_or(0);
        for (label, value) in &rows {
            writeln!(f, "  {label:<width$}  {value}")?;
        }
        for note in &self.notes {
            writeln!(f, "note: {note}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod hard_tests;
#[cfg(test)]
mod tests;
