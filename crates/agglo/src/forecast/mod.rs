//! What a checked scenario will ask of the machine, and how far its models are to be believed.
//!
//! The grains are placed as a run places them. One pulse of each beam is sent through them while they are held still
//! (`push`), and the first second of the run is tried (`crate::run`): what comes of that is carried on to the end
//! (`cost`). Impacts of hard spheres follow from means (`mean_field`). What cannot be known so is said to be unknown.

mod cost;
mod counts;
mod gas;
mod hard;
mod mean_field;
mod notes;
mod placed;
mod push;
mod room;

use std::fmt;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::{Duration, Instant};

use serde::{Serialize, Serializer};

use crate::engine::{SimError, Start};
use crate::packing::StartError;
use crate::particles::Particles;
use crate::run::{Origin, Rehearsal, RunError, rehearse};
use crate::scenario::Scenario;
use crate::text::{digits, readable, two_digits};
use gas::Gas;
pub use room::{Demand, Room};
pub(crate) use room::{refuse_quiet, refuse_run};

/// How much a forecast may try out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// More grains than this are not placed, and little is then known.
    pub most_grains: u64,
    /// Time on the clock in which the first steps are tried.
    pub budget: Duration,
}

impl Effort {
    /// Nothing is placed or tried.
    pub const NONE: Self = Self { most_grains: 0, budget: Duration::ZERO };
}

impl Default for Effort {
    /// 2,000,000 grains, 1.5 s.
    fn default() -> Self {
        Self { most_grains: 2_000_000, budget: Duration::from_millis(1500) }
    }
}

/// The plan of a run. Programs are told of it under these names, with the units of SI at their ends.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Plan {
    /// Number of grains; expected where they were not placed.
    pub grains: u64,
    /// Rays of all beams in one pulse each.
    pub rays_per_pulse: u64,
    /// Pulses of all beams that start before the end.
    pub pulses: u64,
    /// Expected number of impacts of hard spheres.
    pub impacts: f64,
    /// Expected number of steps; of events, from impact to impact. Nothing where it is not known.
    pub steps: Option<f64>,
    /// Expected memory [B].
    #[serde(rename = "memory_B")]
    pub memory: f64,
    /// Expected size of the run's folder [B], where it is known.
    #[serde(rename = "disk_B")]
    pub disk: Option<f64>,
    /// Expected time of the run on this machine [s], where it is known.
    #[serde(rename = "wall_s")]
    pub seconds: Option<f64>,
    /// What else is worth knowing: label and value.
    #[serde(serialize_with = "labeled")]
    pub quantities: Vec<(String, String)>,
    /// What to keep in mind: validity of the models, laws that do not converge, settings without effect.
    pub notes: Vec<String>,
}

/// Each as an object of its own.
fn labeled<S: Serializer>(quantities: &[(String, String)], serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Quantity<'a> {
        label: &'a str,
        value: &'a str,
    }
    serializer.collect_seq(quantities.iter().map(|(label, value)| Quantity { label, value }))
}

impl Plan {
    /// Works out the plan; `base` is the folder that the scenario's tables are relative to.
    ///
    /// # Errors
    /// [`StartError`] where a run could not place its grains.
    pub fn new(scenario: &Scenario, base: &Path) -> Result<Self, StartError> {
        Self::with(scenario, base, Effort::default())
    }

    /// As [`Plan::new`], with no more effort than this.
    ///
    /// # Errors
    /// [`StartError`] where grains are placed and a run could not place them, or where the machine cannot hold the run.
    pub fn with(scenario: &Scenario, base: &Path, effort: Effort) -> Result<Self, StartError> {
        let room = Room::at(Path::new(""));
        let demand = Demand::of(scenario, base);
        demand.refuse_memory(&room, 1)?;
        demand.refuse_disk(&room)?;
        let mut plan = Self::default();
        let counts = counts::grains(&mut plan, scenario, base);
        counts::pulses(&mut plan, scenario);
        let began = Instant::now();
        let is_known = scenario.from.is_some() || plan.grains <= effort.most_grains;
        let origin =
            is_known.then(|| Origin::of(scenario, base, &mut || ControlFlow::Continue(()))).transpose()?;
        let placed_s = began.elapsed().as_secs_f64();
        // Grains of another run are told by what they are, as if the scenario had asked for them.
        let earlier = origin.as_ref().and_then(|origin| origin.earlier.as_ref());
        let told = earlier.map(|earlier| Scenario { grains: earlier.groups.clone(), ..scenario.clone() });
        let scenario = told.as_ref().unwrap_or(scenario);
        if let Some(origin) = &origin {
            plan.starts_from(origin);
        }
        let gas = match &origin {
            _ if !scenario.is_hard() => None,
            Some(origin) => Gas::at_start(scenario, &origin.counts, Some(&origin.by_groups())),
            None => Gas::at_start(scenario, &counts, None),
        };
        let start = origin.map(|origin| origin.start);
        let mut pushes = start.as_ref().map_or_else(Vec::new, |start| push::all(scenario, &start.grains));
        pushes.retain(|push| plan.can_tell(push));
        let smallest = smallest(scenario, start.as_ref().map(|start| &start.grains));
        push::describe(&mut plan, &pushes);
        if let Some(start) = &start {
            placed::notes(&mut plan.notes, scenario, start);
        }
        let tried = start.and_then(|start| plan.rehearsal(scenario, start, effort.budget));
        match (&gas, &tried) {
            (Some(gas), tried) => hard::estimate(&mut plan, scenario, gas, tried.as_ref()),
            (None, Some(tried)) => cost::of_soft(&mut plan, scenario, tried, &pushes),
            (None, None) => {}
        }
        if let Some(tried) = &tried {
            cost::of_files(&mut plan, scenario, tried, &pushes);
        }
        plan.seconds = plan.seconds.map(|seconds| seconds + placed_s);
        counts::memory(&mut plan, scenario, cost::flights(scenario, &pushes));
        plan.forget_what_is_no_number();
        let of_room = room::judge(&room, plan.memory, plan.disk)?;
        plan.notes.extend(of_room);
        notes::collect(&mut plan, scenario, &pushes, smallest);
        Ok(plan)
    }

    /// Counts the grains, and says which run they come from.
    fn starts_from(&mut self, origin: &Origin) {
        self.grains = origin.start.grains.len() as u64;
        if let Some(earlier) = &origin.earlier {
            self.quantities.push(("starts from".to_owned(), earlier.words.clone()));
            self.notes.extend(origin.start.warnings.iter().cloned());
        }
    }

    /// Whether a push came to numbers; a note where it did not.
    fn can_tell(&mut self, push: &push::Push) -> bool {
        if !push.is_known() {
            self.notes.push(format!(
                "beam {}: what its first pulse does is not known: it is beyond numbers",
                push.beam
            ));
        }
        push.is_known()
    }

    /// What is not finite is not known.
    fn forget_what_is_no_number(&mut self) {
        for quantity in [&mut self.steps, &mut self.disk, &mut self.seconds] {
            *quantity = quantity.filter(|value| value.is_finite() && *value >= 0.0);
        }
        if !self.impacts.is_finite() {
            self.impacts = 0.0;
        }
        let is_no_number = |word: &str| matches!(word, "inf" | "NaN");
        for (_, words) in &mut self.quantities {
            if words.split(|c: char| !c.is_alphanumeric()).any(is_no_number) {
                UNKNOWN.clone_into(words);
            }
        }
    }

    /// Tries the first steps; nothing where that would take too long, or where the start fails.
    fn rehearsal(&mut self, scenario: &Scenario, start: Start, budget: Duration) -> Option<Rehearsal> {
        if let Some(reason) = cost::too_much_to_try(scenario, start.grains.len()) {
            self.notes.push(format!("steps and time are not known: {reason}"));
            return None;
        }
        let may_try_again =
            scenario.soft().is_some_and(|soft| soft.relax.is_some() || soft.acoustics.is_some());
        let again = may_try_again.then(|| start.clone());
        let mut tried = rehearse(scenario, start, budget);
        if matches!(tried, Err(RunError::Start(SimError::StoppedAtRest)))
            && let Some(again) = &again
        {
            let what = "start.relax takes long: how long is not known; steps and time are without it";
            self.notes.push(what.to_owned());
            let mut hasty = scenario.clone();
            if let Some(soft) = hasty.soft_mut() {
                soft.relax = None;
            }
            tried = rehearse(&hasty, again.clone(), budget);
        }
        let mut tried =
            tried.map_err(|error| self.notes.push(format!("a run would fail at its start: {error}"))).ok()?;
        if !tried.is_finished
            && tried.quiet.all.steps == 0.0
            && let Some(again) = again
        {
            let mut calm = scenario.clone();
            if let Some(soft) = calm.soft_mut() {
                (soft.acoustics, soft.relax) = (None, None);
            }
            tried.calm = rehearse(&calm, again, budget / 2).ok().map(|calm| calm.quiet);
        }
        Some(tried)
    }

    fn rows(&self) -> Vec<(String, String)> {
        let mut rows = vec![("grains".to_owned(), self.grains.to_string())];
        let mut row = |label: &str, value: String| rows.push((label.to_owned(), value));
        if self.pulses > 0 {
            row("rays per pulse", self.rays_per_pulse.to_string());
            row("pulses", self.pulses.to_string());
        }
        row("steps", self.steps.map_or(UNKNOWN.to_owned(), |steps| format!("about {}", about(steps))));
        rows.extend(self.quantities.iter().cloned());
        let mut row = |label: &str, value: String| rows.push((label.to_owned(), value));
        row("memory", format!("about {}", readable(two_digits(self.memory), "B")));
        row(
            "disk",
            self.disk.map_or(UNKNOWN.to_owned(), |disk| format!("about {}", readable(two_digits(disk), "B"))),
        );
        row("time of the run", self.seconds.map_or(UNKNOWN.to_owned(), duration));
        rows
    }
}

/// What is said of what cannot be told.
const UNKNOWN: &str = "not known";

/// Radius [m] of the smallest grain; as the scenario asks for it where none were placed.
fn smallest(scenario: &Scenario, placed: Option<&Particles>) -> f64 {
    let least = |radii: &mut dyn Iterator<Item = f64>| radii.fold(f64::INFINITY, f64::min);
    match placed {
        Some(grains) => least(&mut grains.radius.iter().copied()),
        None => least(&mut scenario.grains.iter().map(|group| group.size.smallest())),
    }
}

/// A year [s], and a time that nobody waits for.
const YEAR: f64 = 31_557_600.0;
const LONGEST: f64 = 1000.0 * YEAR;

/// A count in words: "1600", "3.2e6".
fn about(value: f64) -> String {
    digits(two_digits(value.max(1.0)))
}

/// A time as people say it: "about 3 s", "about 12 min", "about 5 h".
pub(crate) fn duration(seconds: f64) -> String {
    match seconds {
        s if !(0.0..=LONGEST).contains(&s) => format!("more than {} years", digits(LONGEST / YEAR)),
        s if s < 1.0 => "less than 1 s".to_owned(),
        s if s < 120.0 => format!("about {s:.0} s"),
        s if s < 7200.0 => format!("about {:.0} min", s / 60.0),
        s if s < 172_800.0 => format!("about {:.0} h", s / 3600.0),
        s => format!("about {:.0} days", s / 86_400.0),
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
